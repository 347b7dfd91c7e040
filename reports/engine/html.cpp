#include "reports/engine/html.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace nearmiss {

void put_in_page(std::string& page, std::string_view mark, std::string_view text) {
  const std::size_t at = page.find(mark);
  if (at == std::string::npos) throw std::logic_error(fmt::format("the page has no {}", mark));
  page.replace(at, mark.size(), text);
}

}  // namespace nearmiss

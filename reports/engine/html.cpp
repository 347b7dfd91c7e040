#include "reports/engine/html.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace nearmiss {

void put_in_page(std::string& page, std::string_view mark, std::string_view text) {
  const std::size_t at = page.find(mark);
  if (at == std::string::npos) throw std::logic_error(fmt::format("the page has no {}", mark));
  page.replace(at, mark.size(), text);
}

std::string for_a_script(std::string text) {
  std::string safe;
  safe.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    const std::string_view rest = std::string_view(text).substr(i);
    if (rest.starts_with("</")) {
      safe += "<\\/";
      ++i;
    } else if (rest.starts_with("<!--")) {
      safe += "\\u003c";
    } else {
      safe += text[i];
    }
  }
  return safe;
}

}  // namespace nearmiss

#include <fmt/format.h>

#include "reports/findings/text.hpp"
#include "reports/triage/causes/cause.hpp"

namespace nearmiss {

std::string cause_text(const Cause& cause) {
  const std::string key = cause.key.empty() ? "" : fmt::format(" ({})", cause.key);
  std::string text = fmt::format("Cause: {}{}\n", name_of(cause.kind), key) + wrapped_text(cause.text, "  ");
  for (const Evidence& e : cause.evidence) text += wrapped_text(fmt::format("* {} {}", e.test, e.result), "  ");
  return text;
}

}  // namespace nearmiss

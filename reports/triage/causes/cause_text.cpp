#include <fmt/format.h>

#include "reports/findings/text.hpp"
#include "reports/triage/causes/cause.hpp"

namespace nearmiss {

namespace {

std::string name_with_key(const CauseName& c) {
  return c.key.empty() ? std::string(name_of(c.kind)) : fmt::format("{} ({})", name_of(c.kind), c.key);
}

}  // namespace

std::string names_of(const Cause& cause) {
  std::string text = name_with_key(cause);
  for (const CauseName& other : cause.either) text += ", or " + name_with_key(other);
  return text;
}

std::string sentences_of(const Cause& cause) {
  std::string text = cause.text;
  for (const CauseName& other : cause.either) text += " Or: " + other.text;
  return text;
}

std::string cause_text(const Cause& cause) {
  std::string text = fmt::format("Cause: {}\n", names_of(cause)) + wrapped_text(sentences_of(cause), "  ");
  for (const Evidence& e : cause.evidence) text += wrapped_text(fmt::format("* {} {}", e.test, e.result), "  ");
  return text;
}

}  // namespace nearmiss

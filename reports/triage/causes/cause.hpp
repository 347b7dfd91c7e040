/// The cause of a finding: a hypothesis that was tested by asking the subject again.
#pragma once

#include <chrono>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "reports/findings/report.hpp"

namespace nearmiss {

/// Kinds of causes. Each but the last is named only where a test of it passed.
enum class CauseKind {
  rounding,
  absolute_tolerance,
  relative_tolerance,
  iteration_limit,
  unsupported,
  overflow,
  underflow,
  convention,
  logic,
  unexplained
};

/// What was tried, and what was seen: a line each.
struct Evidence {
  std::string test, result;
  std::vector<CauseKind> against{};  ///< causes of these kinds are not named beside it
};

/// A cause without what was seen.
struct CauseName {
  CauseKind kind = CauseKind::unexplained;
  std::string key;   ///< tells two bugs of a kind apart, stable within one bug: "normal reversed"; may be empty
  std::string text;  ///< one sentence
};

struct Cause : CauseName {
  std::vector<CauseName> either;  ///< further causes whose tests passed: nothing tells which of all is the right one
  std::vector<Evidence> evidence;
  std::uint64_t questions = 0;
};

/// Each case that the tests start from may take at most 4,000 of the questions.
struct CauseLimits {
  std::uint64_t questions = 24000;
  std::chrono::duration<double> time = std::chrono::seconds(20);
};

std::string_view name_of(CauseKind kind);
/// "absolute tolerance (1e-6 length), or iteration limit".
std::string names_of(const Cause& cause);
/// The sentence of the cause; those of further ones after "Or:".
std::string sentences_of(const Cause& cause);
/// {"kind", "key", "text", "either": [{"kind", "key", "text"}], "evidence": [{"test", "result"}], "questions"}; without
/// "either" where there is one cause.
nlohmann::ordered_json cause_to_json(const Cause& cause);
/// The section of a page: a heading, the sentence, and the evidence.
std::string cause_text(const Cause& cause);

}  // namespace nearmiss

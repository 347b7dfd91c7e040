/// Which generated cases a subject answered wrong: what tells a case that was right from one that never was.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "impl/catalogue/case.hpp"
#include "reports/engine/answer_sample.hpp"

namespace nearmiss {

/// Of one subject and one query. Of a run's generated cases the first are noted, of which every answer is judged.
class WrongCases {
 public:
  static constexpr std::uint64_t noted = AnswerSample::judged_at_first;

  /// True for a generated case among the first.
  static bool may_have(const Case& c) { return c.index < noted && c.origin == "generator"; }
  /// The case must be one of these.
  void add(const Case& c);
  bool has(const Case& c) const { return may_have(c) && c.index < wrong_.size() && wrong_[c.index]; }

  /// Hexadecimal digits of four cases each, the first case in the lowest bit of the first digit. Cases behind the last
  /// digit are right.
  std::string text() const;
  /// Empty for any other text, and for more digits than there are cases.
  static std::optional<WrongCases> from_text(const std::string& digits);

 private:
  std::vector<bool> wrong_;  ///< by the index of the case
};

}  // namespace nearmiss

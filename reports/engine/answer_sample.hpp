/// Which answers of a subject are judged where too many are wrong: a proof takes several times as long as the look that
/// finds an answer right.
#pragma once

#include <cstdint>

namespace nearmiss {

/// Of one subject and one query. Depends on the answers alone, not on time.
class AnswerSample {
 public:
  static constexpr std::uint64_t judged_at_first = 16384;  ///< so many answers are judged in any case
  static constexpr std::uint64_t one_in = 16;              ///< then, where a fifth was proved wrong

  /// True where the next answer is to be judged.
  bool takes_next() {
    if (judged_ < judged_at_first || wrong_ * 5 < judged_) return true;
    return passed_over_++ % one_in == 0;
  }
  void count(bool proved_wrong) { ++judged_, wrong_ += proved_wrong; }

 private:
  std::uint64_t judged_ = 0, wrong_ = 0, passed_over_ = 0;
};

}  // namespace nearmiss

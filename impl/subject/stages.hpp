/// The stages of a subject that answers in stages, such as the tier Certified of `collide`: the cheapest that is
/// certain of an answer gives it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace nearmiss {

/// The stage that gave an answer. The numbers are those of a timed batch (wire::SharedRequest).
enum class AnswerStage : std::uint8_t {
  unknown,   ///< the subject counts no stages
  filter,    ///< floating-point numbers with error bounds
  extended,  ///< double-words with error bounds
  exact,     ///< exact real numbers
  plain,     ///< plain arithmetic, for inputs that are not finite
};
inline constexpr std::array known_stages = {AnswerStage::filter, AnswerStage::extended, AnswerStage::exact,
                                            AnswerStage::plain};

inline std::string_view name_of(AnswerStage stage) {
  switch (stage) {
    case AnswerStage::filter: return "filter";
    case AnswerStage::extended: return "extended";
    case AnswerStage::exact: return "exact";
    case AnswerStage::plain: return "plain";
    case AnswerStage::unknown: break;
  }
  return "unknown";
}

/// How many answers each of known_stages gave on this thread, in their order.
using StageTally = std::array<std::uint64_t, known_stages.size()>;
/// Reads the subject's tally. nullptr for a subject that counts no stages.
using StageTallyFunction = StageTally (*)();

/// The last of the stages that gave answers between two tallies: a call may ask several parts, and the dearest one
/// decides what it costs.
inline AnswerStage last_stage_between(const StageTally& before, const StageTally& after) {
  AnswerStage last = AnswerStage::unknown;
  for (std::size_t i = 0; i < known_stages.size(); ++i) {
    if (after[i] > before[i]) last = known_stages[i];
  }
  return last;
}

}  // namespace nearmiss

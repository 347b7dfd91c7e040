#include "fuzz/feedback.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <initializer_list>
#include <string_view>

#include "fuzz/fuzzed_query.hpp"
#include "fuzz/statistics.hpp"

namespace nearmiss::fuzz {

namespace {

enum class NumericFeature : std::uint64_t { margin, stage, branches, backward, forward, backward_by_branch };

void set(NumericFeature feature, std::initializer_list<std::uint64_t> of) {
  std::uint64_t h = 0xcbf29ce484222325 ^ std::uint64_t(feature);  // FNV-1a over whole numbers, then a final mix
  for (const std::uint64_t x : of) h = (h ^ x) * 0x100000001b3;
  h ^= h >> 32;
  h *= 0x9e3779b97f4a7c15;
  if (feedback_is_on()) nearmiss_feature_counters[h >> 50] = 1;
  count_feature(h >> 50);
}
static_assert(feature_counters == std::size_t{1} << (64 - 50));

/// The power of two of the proved backward error; 0: no difference is proved.
std::uint64_t backward_bucket(const Finding& f) {
  if (!f.backward) return 0;
  return 1 + (f.backward->above <= 0 ? 0 : std::uint64_t(1 + std::ilogb(f.backward->above)));
}

/// Half powers of two of the forward error, from 1/4 ulp up; 0: below.
std::uint64_t forward_bucket(double ulps) {
  constexpr double least = 0.25;
  if (!(ulps > least)) return 0;
  return 1 + std::uint64_t(2 * std::log2(std::min(ulps, 0x1p200) / least));
}

}  // namespace

bool feedback_is_on() {
  static const bool on = [] {
    const char* value = std::getenv("NEARMISS_FEEDBACK");
    return value == nullptr || std::string_view(value) != "off";
  }();
  return on;
}

void note_case(const Case& question, const Finding& f) {
  if (!feedback_is_on() && !statistics_are_asked()) return;
  const std::uint64_t ties = std::min<std::uint64_t>(f.right_answers, 4);
  set(NumericFeature::stage,
      {std::uint64_t(question.scalar), std::uint64_t(f.decided_by), std::uint64_t(f.truth_yes), ties});
  set(NumericFeature::branches, {f.branches, std::uint64_t(f.truth_yes), ties});
  if (!decides(question.query->kind)) return;
  static double margin = 0;  // of the last case, to which most cases are near
  margin = decision_margin(question, margin);
  const std::uint64_t rung = margin < 0 ? 0 : margin == 0 ? 1 : std::uint64_t(2 + std::ilogb(margin));
  set(NumericFeature::margin, {std::uint64_t(question.scalar), rung, std::uint64_t(f.truth_yes)});
}

void note_answer(std::size_t subject, const Finding& f) {
  if (!feedback_is_on() && !statistics_are_asked()) return;
  const std::uint64_t kind = std::uint64_t(f.verdict) << 8 | std::uint64_t(f.disagreement);
  set(NumericFeature::backward, {subject, kind, backward_bucket(f)});
  set(NumericFeature::forward, {subject, std::uint64_t(f.verdict), forward_bucket(f.forward_ulps)});
  set(NumericFeature::backward_by_branch, {subject, backward_bucket(f), f.branches});
}

double badness(const Finding& f) {
  const double backward = f.backward ? 1 + f.backward->above : 0;
  return 64 * std::log2(1 + backward) + std::log2(1 + std::min(f.forward_ulps, 0x1p200)) / 4;
}

}  // namespace nearmiss::fuzz

#include "reports/engine/slice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "corpus/files/errors.hpp"
#include "corpus/generator/generator.hpp"
#include "corpus/search/crossover.hpp"
#include "oracles/judge.hpp"

namespace nearmiss {

namespace {

/// Proves the decision of all floats of a range by subdivision.
class RangeDecider {
 public:
  RangeDecider(const Case& question, std::size_t number, const std::function<bool()>& stopped)
      : case_(question), number_(number), moves_(question.values.size(), 0.0), stopped_(stopped) {}

  /// False where it was stopped.
  bool decide(std::uint64_t begin, std::uint64_t end, std::vector<TruthRange>& into) {
    if (stopped_ && stopped_()) return false;
    if (const std::optional<bool> all = decision_of_all(begin, end)) {
      append(into, {begin, *all ? SliceTruth::yes : SliceTruth::no});
      return true;
    }
    const std::uint64_t middle = begin + (end - begin) / 2;
    return decide(begin, middle, into) && decide(middle, end, into);
  }

 private:
  std::optional<bool> decision_of_all(std::uint64_t begin, std::uint64_t end) {
    const double low = float_at(begin), high = float_at(end - 1);
    if (low == high) {  // one float, or both zeros
      case_.values[number_] = low;
      return exact_decision(case_);
    }
    // The halves are exact. Each rounded difference is less than an ulp away from the exact one.
    const double middle = low / 2 + high / 2;
    case_.values[number_] = middle;
    moves_[number_] = std::nextafter(std::max(high - middle, middle - low), HUGE_VAL);
    return decision_within(case_, moves_);
  }

  Case case_;
  std::size_t number_;
  std::vector<double> moves_;
  const std::function<bool()>& stopped_;
};

}  // namespace

void append(std::vector<TruthRange>& ranges, const TruthRange& next) {
  if (ranges.empty() || ranges.back().truth != next.truth) ranges.push_back(next);
}

Slice::Slice(Case question, std::size_t number) : question_(std::move(question)), number_(number) {
  if (is_discrete(field().role)) {
    throw BadInput(
        fmt::format("{} of {} is a whole number with few values; a sweep takes a number that may be any float",
                    field().name, query().name));
  }
  find_cells();
}

/// Every rule of the catalogue compares a number with 0 or with another number of the inputs. So the floats between two
/// neighbouring numbers of these are all valid or all invalid.
void Slice::find_cells() {
  std::vector<std::uint64_t> begins{0, position_of(-0.0f), position_of(0.0f) + 1};
  for (std::size_t i = 0; i < question_.values.size(); ++i) {
    const std::uint64_t at = position_of(float(question_.values[i]));
    if (i != number_) begins.insert(begins.end(), {at, at + 1});
  }
  std::sort(begins.begin(), begins.end());
  for (const std::uint64_t b : begins) {
    if (b < finite_floats) append(cells_, {b, is_valid(b) ? SliceTruth::yes : SliceTruth::invalid});
  }
}

Case Slice::at(std::uint64_t index) const {
  Case c = question_;
  c.values[number_] = double(float_at(index));
  return c;
}

SliceTruth Slice::truth_at(std::uint64_t index) const {
  if (!is_valid(index)) return SliceTruth::invalid;
  return exact_decision(at(index)) ? SliceTruth::yes : SliceTruth::no;
}

std::vector<TruthRange> Slice::truth(std::uint64_t begin, std::uint64_t end,
                                     const std::function<bool()>& stopped) const {
  RangeDecider decider(question_, number_, stopped);
  std::vector<TruthRange> ranges;
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    const std::uint64_t from = std::max(begin, cells_[i].begin);
    const std::uint64_t to = std::min(end, i + 1 < cells_.size() ? cells_[i + 1].begin : finite_floats);
    if (from >= to) continue;
    if (cells_[i].truth == SliceTruth::invalid) {
      append(ranges, {from, SliceTruth::invalid});
    } else if (!decider.decide(from, to, ranges)) {
      return {};
    }
  }
  return ranges;
}

namespace {

/// Whether the decision changes between two floats that are at most 2^20 apart, one on each side of the case's own.
bool changes_near(const Slice& slice) {
  constexpr std::uint64_t reach = 1u << 20;
  const std::uint64_t at = position_of(float(slice.question().values[slice.number()]));
  const std::uint64_t low = std::max(at, reach) - reach, high = std::min(at + reach, finite_floats - 1);
  const SliceTruth here = slice.truth_at(at), below = slice.truth_at(low), above = slice.truth_at(high);
  const auto differs = [&](SliceTruth other) { return other != SliceTruth::invalid && other != here; };
  return differs(below) || differs(above);
}

}  // namespace

std::optional<Case> touching_case(const Query& query, std::size_t number, std::uint64_t seed) {
  constexpr std::uint64_t most_attempts = 300;
  for (std::uint64_t index = 0; index < most_attempts; ++index) {
    Case c = generate(query, Scalar::float32, seed, index);
    if (has_extreme_mutator(c) || c.values[number] == 0 || !snap_to_touching(c, seed + index)) continue;
    c.origin = "generator, moved to a touch";
    if (changes_near(Slice(c, number))) return c;
  }
  return std::nullopt;
}

}  // namespace nearmiss

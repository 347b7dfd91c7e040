/// A slice: one number of a case runs through the floats. The exact decision of all of them is known from few proofs:
/// where the intervals of the oracle decide a whole range of the number, the decision of every float in the range is
/// proved.
#pragma once

#include <bit>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "impl/catalogue/case.hpp"

namespace nearmiss {

// The finite floats in order, counted from the lowest one. -0.0 is the float before 0.0.

inline constexpr std::uint64_t float_magnitudes = 0x7f800000;  ///< bit patterns of 0 and of the positive finite floats
inline constexpr std::uint64_t finite_floats = 2 * float_magnitudes;

inline float float_at(std::uint64_t index) {
  const bool negative = index < float_magnitudes;
  const auto magnitude = std::uint32_t(negative ? float_magnitudes - 1 - index : index - float_magnitudes);
  return std::bit_cast<float>(negative ? magnitude | 0x80000000u : magnitude);
}
/// The inverse of float_at(). `x` is finite.
inline std::uint64_t position_of(float x) {
  const auto bits = std::bit_cast<std::uint32_t>(x);
  const std::uint64_t magnitude = bits & 0x7fffffffu;
  return bits >> 31 != 0 ? float_magnitudes - 1 - magnitude : float_magnitudes + magnitude;
}

enum class SliceTruth : std::uint8_t {
  invalid,  ///< the inputs break a rule of the query
  no,
  yes,
};

/// Consecutive floats with one truth: from `begin` to the next range of a list.
struct TruthRange {
  std::uint64_t begin;
  SliceTruth truth;
  bool operator==(const TruthRange&) const = default;
};

class Slice {
 public:
  /// The case must be of scalar float, and its query must decide. Throws BadInput where the number can not be any float
  /// (a flag or an index).
  Slice(Case question, std::size_t number);

  const Case& question() const { return question_; }
  const Query& query() const { return *question_.query; }
  std::size_t number() const { return number_; }
  const Field& field() const { return question_.fields()[number_]; }

  /// The case with another float in the place of the number.
  Case at(std::uint64_t index) const;
  /// The truth at one float, from the exact decision at that float alone.
  SliceTruth truth_at(std::uint64_t index) const;
  /// The truth of every float from `begin` up to, without, `end`: the first range begins at `begin`, and neighbouring
  /// ranges differ. There are few ranges, because what the oracles decide is bounded by surfaces of low degree. Empty
  /// where `stopped` became true. Thread-safe.
  std::vector<TruthRange> truth(std::uint64_t begin, std::uint64_t end,
                                const std::function<bool()>& stopped = {}) const;

 private:
  bool is_valid(std::uint64_t index) const { return !query().broken(at(index).values); }
  void find_cells();

  Case question_;
  std::size_t number_;
  /// Where the floats change between valid and invalid ones, in the form of a list of ranges: `yes` stands for valid.
  std::vector<TruthRange> cells_;
};

/// Appends a range; joins it with the last one where the truth is the same.
void append(std::vector<TruthRange>& ranges, const TruthRange& next);

/// A generated case, exact in float and without extreme mutators, whose exact decision changes within 2^20 floats of
/// the given number. The same for the same seed on every machine. Empty where several hundred generated cases have
/// none.
std::optional<Case> touching_case(const Query& query, std::size_t number, std::uint64_t seed);

}  // namespace nearmiss

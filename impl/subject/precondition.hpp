/// The preconditions of a library. A case that does not meet them is not sent to it.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <initializer_list>
#include <string_view>

namespace nearmiss {

/// The closed list of preconditions, in the order of the bits in nearmiss_plugin.h.
enum class Precondition : std::uint8_t {
  true_rectangle,
  unit_normal,
  unit_direction,
  unit_quaternion,
  starts_outside,
  moves,
  no_zero_sizes,
};
inline constexpr std::size_t precondition_count = 7;

/// The texts of a precondition.
struct PreconditionText {
  std::string_view name;      ///< its name in JSON and on the command line
  std::string_view required;  ///< completes "it requires ..."
  std::string_view meaning;   ///< its definition, one sentence
};

inline constexpr std::array<PreconditionText, precondition_count> precondition_texts = {{
    {"true rectangle", "a true rectangle",
     "The four corners are those of a rectangle whose sides are not zero, each coordinate within 4 epsilon of the "
     "largest one."},
    {"unit normal", "unit normals", "Each given normal has the length 1 within 4 epsilon."},
    {"unit direction", "unit directions", "Each direction of a line or ray has the length 1 within 4 epsilon."},
    {"unit quaternion", "unit quaternions", "Each orientation has the length 1 within 4 epsilon."},
    {"starts outside", "a start outside",
     "The moving body or the ray's origin neither touches nor overlaps the other set at the start; of a plane it is in "
     "front."},
    {"moves", "a velocity that is not zero", "The velocity is not zero."},
    {"no zero sizes", "no zero sizes",
     "No radius, half extent, side of an axis-aligned box or length of a segment or of a capsule's axis is zero, and "
     "each triangle has an area."},
}};

inline std::string_view name_of(Precondition p) { return precondition_texts[std::size_t(p)].name; }

/// A set of preconditions.
class Preconditions {
 public:
  constexpr Preconditions() = default;
  constexpr Preconditions(std::initializer_list<Precondition> list) {
    for (const Precondition p : list) add(p);
  }
  /// The set with these bits of a plugin; every bit must be one of known_bits.
  static constexpr Preconditions of_bits(std::uint32_t bits) {
    Preconditions set;
    set.bits_ = bits;
    return set;
  }
  static constexpr std::uint32_t known_bits = (std::uint32_t{1} << precondition_count) - 1;

  constexpr void add(Precondition p) { bits_ |= std::uint32_t{1} << std::size_t(p); }
  constexpr bool has(Precondition p) const { return (bits_ >> std::size_t(p) & 1u) != 0; }
  constexpr bool empty() const { return bits_ == 0; }
  constexpr std::size_t size() const { return std::size_t(std::popcount(bits_)); }
  auto operator<=>(const Preconditions&) const = default;

 private:
  std::uint32_t bits_ = 0;
};

inline constexpr std::array<Precondition, precondition_count> all_preconditions = {
    Precondition::true_rectangle,  Precondition::unit_normal,    Precondition::unit_direction,
    Precondition::unit_quaternion, Precondition::starts_outside, Precondition::moves,
    Precondition::no_zero_sizes};

}  // namespace nearmiss

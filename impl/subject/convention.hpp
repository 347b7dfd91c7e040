/// The conventions of a library: what its documentation defines otherwise than the catalogue of queries does.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

namespace nearmiss {

struct Query;

/// The closed list of conventions that a subject may declare. The judge then holds its answers to that meaning, as
/// exactly as to that of the catalogue.
enum class Convention : std::uint8_t {
  two_sided,
  normal_of_front,
  normal_reversed,
  start_is_miss,
  start_is_hit,
  exit_from_start,
  ends_at_time_one,
  strict_touch,
  center_for_contact,
  unit_directions,
};
inline constexpr std::size_t convention_count = 10;

/// The texts of a convention.
struct ConventionText {
  std::string_view name;     ///< its name in JSON, on the command line and in a plugin
  std::string_view what;     ///< completes "the answer is right if"
  std::string_view meaning;  ///< its definition, one sentence
};

inline constexpr std::array<ConventionText, convention_count> convention_texts = {{
    {"two-sided", "the back counts as well as the front",
     "A plane, a triangle or a rectangle is hit from its back as from its front, with the normal of the side that is "
     "hit; what lies behind a plane is pushed out at the back."},
    {"normal of the front", "a hit from behind has the normal of the front",
     "A hit from behind has the normal of the front."},
    {"normal reversed", "its normal points the other way", "Every normal has the opposite direction."},
    {"start in contact is a miss", "a start in contact is a miss",
     "A motion whose start touches or overlaps the other set is a miss."},
    {"start in contact is a hit", "a start in contact is a hit at time 0",
     "A motion whose start touches or overlaps the other set is a hit at time 0; where the catalogue has a miss or a "
     "later hit, any place and any normal are right."},
    {"contact where it leaves", "a start in contact is a hit where the contact ends",
     "A motion or ray whose start touches or overlaps the other set is a hit where it leaves the set, with the outward "
     "normal there."},
    {"motion ends at time 1", "a contact after time 1 is a miss", "A contact after time 1 is a miss."},
    {"strict touch", "a touch is a miss", "An exact touch is a miss."},
    {"center in place of the contact", "its place is the center at the contact",
     "The place of a moving sphere's contact is its center at the time of the contact."},
    {"directions of unit length", "its directions have the length 1",
     "The directions of lines and rays have the length 1 within 4 epsilon; no other case is asked."},
}};

inline constexpr const ConventionText& text_of(Convention c) { return convention_texts[std::size_t(c)]; }
inline constexpr std::string_view name_of(Convention c) { return text_of(c).name; }

/// A set of conventions.
class Conventions {
 public:
  constexpr Conventions() = default;
  constexpr Conventions(std::initializer_list<Convention> list) {
    for (const Convention c : list) add(c);
  }
  constexpr void add(Convention c) { bits_ = std::uint16_t(bits_ | 1u << std::size_t(c)); }
  constexpr bool has(Convention c) const { return (bits_ >> std::size_t(c) & 1u) != 0; }
  constexpr bool empty() const { return bits_ == 0; }
  auto operator<=>(const Conventions&) const = default;

 private:
  std::uint16_t bits_ = 0;
};

inline constexpr std::array<Convention, convention_count> all_conventions = {
    Convention::two_sided,        Convention::normal_of_front, Convention::normal_reversed,
    Convention::start_is_miss,    Convention::start_is_hit,    Convention::exit_from_start,
    Convention::ends_at_time_one, Convention::strict_touch,    Convention::center_for_contact,
    Convention::unit_directions};

/// A convention, with the sentence of the library's documentation that says so.
struct Declaration {
  Convention convention;
  std::string sentence;  ///< empty: none is given

  bool operator==(const Declaration&) const = default;
};

/// Empty where no convention has that name.
std::optional<Convention> convention_named(std::string_view name);
/// "two-sided, normal of the front, ...": those that exist.
std::string convention_names();
/// Whether the convention makes a difference to some case of the query.
bool concerns(Convention c, const Query& query);
/// The convention of the set that says the opposite; empty where there is none.
std::optional<Convention> contradicted(Convention c, Conventions others);

}  // namespace nearmiss

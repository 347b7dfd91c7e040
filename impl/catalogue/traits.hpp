/// The traits of a query. Relations, static checks, explanations and tests read them here, so that none of these names
/// a query.
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string_view>

namespace nearmiss {

/// The identifier of a query: the FNV-1a hash of its name. Only query_ids.hpp lists the queries of the catalogue, so
/// that a new query changes no other header.
enum class QueryId : std::uint64_t;
consteval QueryId query_id(std::string_view name) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const char c : name) hash = (hash ^ std::uint8_t(c)) * 0x100000001b3;
  return QueryId(hash);
}

/// A reason for several right answers: the role of the member in which they differ, or a cone of normals.
enum class Tie : std::uint8_t { position, normal, depth, weight, index, cone };
std::string_view name_of(Tie tie);
inline constexpr std::array<Tie, 6> all_ties = {Tie::position, Tie::normal, Tie::depth,
                                                Tie::weight,   Tie::index,  Tie::cone};

class Ties {
 public:
  constexpr Ties() = default;
  constexpr Ties(std::initializer_list<Tie> list) {
    for (const Tie t : list) bits_ |= 1u << unsigned(t);
  }
  constexpr bool has(Tie t) const { return (bits_ >> unsigned(t) & 1u) != 0; }

 private:
  unsigned bits_ = 0;
};

/// Whether two operands whose names end with 1 and 2 may be exchanged.
enum class Exchange : std::uint8_t {
  none,                    ///< the answer depends on their order, or there are no two such operands
  always,                  ///< the answer of the exchanged operands follows
  unless_nearly_parallel,  ///< for parallel directions the order selects one of many answers
};

/// The frame of the outputs, and what else selects one of several possible outputs.
enum class OutputFrame : std::uint8_t {
  space,              ///< the outputs turn with the scene
  operands,           ///< the outputs are numbers in the operands' own frames
  order_of_axes,      ///< the outputs name the first axes of the operands, in their order, that have a property
  order_of_operands,  ///< a direction whose sign is that of a cross product of the operands' axes
};

/// Another query whose answer to a related case follows from the answer of this query. An input of the other query
/// takes the value of the input with the same name, after `renamed`. Without such an input it takes 0, or 1 for the w
/// of a rotation, or the value that `set` gives.
struct Link {
  enum class Kind : std::uint8_t {
    prepared,           ///< the same question with a prepared operand
    halves,             ///< the two triangles that a rectangle consists of
    same_decision,      ///< the same decision
    implied_decision,   ///< a yes of this query implies a yes of the other
    sign_of_distance,   ///< the decision whether the distance is at most 0
    within_any_time,    ///< a hit at any time implies a yes of the query without a limit
    contained_ball,     ///< a ball inside a solid operand
    point_as_sphere,    ///< a moving point as a sphere of radius 0
    sphere_as_point,    ///< a moving sphere of radius 0 as a point
    capsule_as_sphere,  ///< a capsule whose ends are one point
    box_as_point,       ///< a box without extents
    at_rest,            ///< the static query about the place of the moving body at one time
  };
  struct Renamed {
    std::string_view there, here;  ///< prefixes of names; "-": no such input here
  };
  struct Set {
    std::string_view name;
    double value;
  };

  Kind kind;
  QueryId to;  ///< query_id(NAME): catalogue.cpp asserts that the catalogue has this query
  std::array<Renamed, 3> renamed{};
  Set set{};
  bool times_alone = false;                  ///< only the decision and the time are equal
  std::array<std::string_view, 2> except{};  ///< members of the answer that may differ
};

/// The sentences for a decision in reports.
struct Sentences {
  std::string_view yes{}, no{};  ///< "the point is in the triangle"; empty: composed from the operands
};

/// The shares that the generator reaches at least.
struct Balance {
  int knifes_edge_per_mille = 10;  ///< cases whose decision flips within 4 epsilon
  int either_percent = 12;         ///< cases with a yes, and cases with a no
};

struct Traits {
  Sentences decision{};
  bool touching_is_yes = true;  ///< true: the query decides whether two closed sets meet
  bool one_sided = false;       ///< the plane, triangle or rectangle can be hit from its front only
  bool grows = false;     ///< a larger size contains the smaller solid: a yes stays a yes, no later and no shallower
  bool projects = false;  ///< it projects along an axis of space that a normal selects
  bool directions_are_lines = false;     ///< the sign of a direction has no meaning
  bool contact_is_of_the_first = false;  ///< the contact lies on the first of two operands that may be exchanged
  Exchange exchange = Exchange::none;
  OutputFrame frame = OutputFrame::space;
  Ties ties{};
  Balance balance{};
  std::span<const Link> links{};
};

}  // namespace nearmiss

/// What is known of a query besides its inputs: relations, static checks, explanations and tests read it here and name
/// no query.
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string_view>

namespace nearmiss {

/// The queries by name, in the catalogue's order.
enum class QueryId {
#define NEARMISS_QUERY(query) query,
#include "impl/catalogue/catalogue.def"
#undef NEARMISS_QUERY
};

/// A way in which several answers may be right: the role of what differs between them, or a cone of normals.
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

/// How two operands whose names end with 1 and 2 may be exchanged.
enum class Exchange : std::uint8_t {
  none,                    ///< what is answered depends on their order, or there are no two
  always,                  ///< the answer follows
  unless_nearly_parallel,  ///< parallel directions have many answers, of which the order chooses one
};

/// In which frame the outputs are, and what besides the scene decides which of several outputs is given.
enum class OutputFrame : std::uint8_t {
  space,              ///< they turn with the scene
  operands,           ///< they are numbers in the operands' own frames
  order_of_axes,      ///< they name the first axes, in the order of the axes of the operands, that have a property
  order_of_operands,  ///< a direction whose sign is that of a cross product of the operands' axes
};

/// A query whose answer to a related question is known where this one's is. An input of the other query has the value
/// of the input of the same name, after `renamed`; 0 where there is none, 1 for the w of a rotation, or what `set`
/// says.
struct Link {
  enum class Kind : std::uint8_t {
    prepared,           ///< the same question, with something of an operand computed beforehand
    halves,             ///< of a rectangle: the two triangles that it consists of
    same_decision,      ///< the same yes or no
    implied_decision,   ///< a yes here is a yes there
    within_any_time,    ///< what hits at some time passes there
    contained_ball,     ///< a ball inside of a solid operand
    point_as_sphere,    ///< a moving point as a sphere of radius 0
    sphere_as_point,    ///< a moving sphere of radius 0 as a point
    capsule_as_sphere,  ///< a capsule whose ends are one point
    box_as_point,       ///< a box without extents
    at_rest,            ///< the static query about the place of the moving body at one time
  };
  struct Renamed {
    std::string_view there, here;  ///< beginnings of names; "-": there is none here
  };
  struct Set {
    std::string_view name;
    double value;
  };

  Kind kind;
  QueryId to;
  std::array<Renamed, 3> renamed{};
  Set set{};
  bool times_alone = false;                  ///< of an answer, the decision and the time are the same and nothing else
  std::array<std::string_view, 2> except{};  ///< members of the answer that are not the same
};

/// What a decision is called when people are told of it.
struct Sentences {
  std::string_view yes{}, no{};  ///< "the point is in the triangle"; empty: made from the operands
};

/// The least shares that the generator reaches.
struct Balance {
  int knifes_edge_per_mille = 10;  ///< of decisions that inputs within 4 epsilon turn
  int either_percent = 12;         ///< of yes, and of no
};

struct Traits {
  /// "the sphere", "the box": the two things of which the query asks whether they meet; empty where there are none.
  std::array<std::string_view, 2> operands{};
  Sentences decision{};
  bool touching_is_yes = true;  ///< the decision is whether closed sets meet; false where it is of another kind
  bool one_sided = false;       ///< the plane, triangle or rectangle has a front, and is met from there alone
  bool grows = false;           ///< with each of its sizes a solid grows: a yes stays a yes, no later and no shallower
  bool projects = false;        ///< it looks along an axis of space, which a normal chooses
  bool directions_are_lines = false;     ///< the sign of a direction means nothing
  bool contact_is_of_the_first = false;  ///< of two operands that may be exchanged
  Exchange exchange = Exchange::none;
  OutputFrame frame = OutputFrame::space;
  Ties ties{};
  Balance balance{};
  std::span<const Link> links{};
};

}  // namespace nearmiss

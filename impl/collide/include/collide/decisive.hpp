/// The tier `Decisive`: every decision is exact for all finite inputs, as in `Certified`; the other numbers of an
/// answer have at most the errors of `Fast`. Needs the library collide::certified.
///
/// It is for programs whose logic depends on decisions (exact predicates, inexact constructions): the numbers of
/// `Certified` within two units in the last place need more digits than the machine's numbers have, and most of its
/// time.
///
/// - A query that always says yes (closest points, directions, values of two boxes) is answered by `Fast`.
/// - A query with a decision is answered by `Fast` where a bound proves that the decision of this answer is exact, and
///   by `Certified` elsewhere. Eleven queries have such a bound: the penetrations, points and spheres that move toward
///   a plane, points that move toward a triangle or an axis-aligned box, and rays.
/// - All other queries with a decision are answered by `Certified`.
#pragma once

#include <collide/certified.hpp>
#include <collide/contract.hpp>
#include <collide/tiers.hpp>

#include <collide/detail/strict_begin.hpp>

namespace collide {

/// The tier `Decisive`. For all finite inputs each decision is exact. The numbers have the contract of `Fast`. The
/// processor must round to nearest. If memory runs out, a query throws std::bad_alloc or GMP terminates the program.
struct Decisive : Certified {
  using Decisions = Certified;
  using Numbers = Fast;

  /// The contract of `Fast`, with exact decisions. Outside of its domain the decisions are exact too.
  template <class T>
  static constexpr Contract contract(const Contract& fast) {
    Contract promised = fast;
    promised.exact_decisions = true;
    return promised;
  }
};

}  // namespace collide

#include <collide/detail/strict_end.hpp>

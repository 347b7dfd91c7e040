/// The kinds of answer. Judging depends on the kind, never on the query.
#pragma once

#include <string_view>

#include <collide/answers.hpp>

namespace nearmiss {

enum class Kind {
  decision,   ///< yes or no, some with numbers that explain a yes
  impact,     ///< a time of contact or a miss
  points,     ///< points that always exist
  depth,      ///< an overlap or a separation
  direction,  ///< a vector that always exists
  measure,    ///< other numbers that always exist
};

std::string_view name_of(Kind kind);

/// True where answers of this kind are yes or no; all other answers are always yes.
constexpr bool decides(Kind kind) { return kind == Kind::decision || kind == Kind::impact || kind == Kind::depth; }

namespace detail {

template <template <class> class Answer>
struct KindOf;

template <Kind k>
struct Is {
  static constexpr Kind kind = k;
};
template <>
struct KindOf<collide::Decision> : Is<Kind::decision> {};
template <>
struct KindOf<collide::Containment> : Is<Kind::decision> {};
template <>
struct KindOf<collide::RayHit> : Is<Kind::decision> {};
template <>
struct KindOf<collide::Span> : Is<Kind::decision> {};
template <>
struct KindOf<collide::BoxOverlap> : Is<Kind::decision> {};
template <>
struct KindOf<collide::ParallelAxes> : Is<Kind::decision> {};
template <>
struct KindOf<collide::Impact> : Is<Kind::impact> {};
template <>
struct KindOf<collide::TriangleImpact> : Is<Kind::impact> {};
template <>
struct KindOf<collide::Entry> : Is<Kind::impact> {};
template <>
struct KindOf<collide::ClosestPoint> : Is<Kind::points> {};
template <>
struct KindOf<collide::EdgePoint> : Is<Kind::points> {};
template <>
struct KindOf<collide::ClosestPoints> : Is<Kind::points> {};
template <>
struct KindOf<collide::SignedDistance> : Is<Kind::points> {};
template <>
struct KindOf<collide::Penetration> : Is<Kind::depth> {};
template <>
struct KindOf<collide::BoxPenetration> : Is<Kind::depth> {};
template <>
struct KindOf<collide::CornerContacts> : Is<Kind::depth> {};
template <>
struct KindOf<collide::Direction> : Is<Kind::direction> {};
template <>
struct KindOf<collide::Measure> : Is<Kind::measure> {};
template <>
struct KindOf<collide::BoxBoxInfo> : Is<Kind::measure> {};

template <template <class> class Answer, class T>
constexpr Kind kind_of(const Answer<T>*) {
  return KindOf<Answer>::kind;
}

}  // namespace detail

/// The kind of an answer's type.
template <class Answer>
inline constexpr Kind kind_of = detail::kind_of(static_cast<const Answer*>(nullptr));

}  // namespace nearmiss

/// Batches: a query for many arguments at once, in structures of arrays (soa.hpp).
///
///   Soa<Sphere<float>> balls, others;  // filled by push_back, or views of arrays of your own
///   Soa<Decision<float>> hits(balls.size());
///   batch::sphere_sphere_overlap(balls.view(), others.view(), hits.span());
///
/// Query i of a batch has the arguments with index i, and its answer is written to index i. It has the same bits as the
/// answer of the query for these arguments in the tier `Fast`, whatever the arguments are; any NaN stands for any
/// other. So the contract of the query in `Fast` holds.
///
/// On x86-64 with GCC or Clang, a batch computes in lanes with the widest instructions of the machine (SSE2 or AVX2),
/// whatever the program is compiled for; `simd` chooses others, for tests. Instructions that the machine does not have
/// are replaced by the widest that it has. Elsewhere, and with COLLIDE_NO_LANES, a batch calls the query for one index
/// after the other.
///
/// The arguments and the answers have the same size. The arrays of answers overlap no other array. Units: those of the
/// query. Errors: std::invalid_argument if two sizes differ; nothing is then written. With -fno-exceptions one line
/// goes to standard error and the program aborts. Nothing is allocated.
#pragma once

#include <collide/detail/batch_avx2.hpp>
#include <collide/detail/batch_queries.hpp>
#include <collide/detail/batch_simd.hpp>
#include <collide/detail/batch_sse2.hpp>
#include <collide/detail/refuse_argument.hpp>
#include <collide/soa.hpp>

namespace collide {

namespace detail {

template <class Query, class T>
void answer_batch(Simd simd, std::size_t count, const void* const* in, void* const* out, AnswerOne one) {
#if defined(COLLIDE_BATCH_LANES) && !defined(__clang_analyzer__)  // which would follow each kernel for minutes
  if (simd == Simd::avx2 && widest_simd() == Simd::avx2) return avx2::answer_blocks<Query, T>(count, in, out, one);
  if (simd != Simd::none) return sse2::answer_blocks<Query, T>(count, in, out, one);
#else
  static_cast<void>(simd);
#endif
  for (std::size_t i = 0; i < count; ++i) one(i, in, out);
}

/// Answers the query for each index. T is the scalar of the arguments.
template <class Query, class T, class Answer, class... Arguments>
void answer_batch(Simd simd, const SoaSpan<Answer>& answers, const SoaView<Arguments>&... arguments) {
  if (((arguments.size() != answers.size()) || ...))
    refuse_argument("a batch has arguments and answers of different sizes");
  std::array<const void*, (leaf_count<Arguments> + ...)> in{};
  std::size_t next = 0;
  const auto append = [&](const auto& arrays) {
    for (const void* array : arrays) in[next++] = array;
  };
  (append(arguments.arrays()), ...);
  answer_batch<Query, T>(simd, answers.size(), in.data(), answers.arrays().data(), answer_one<Query, Arguments...>);
}

}  // namespace detail

namespace batch {

template <class T>
void sphere_sphere_overlap(SoaView<Sphere<T>> sphere1, SoaView<Sphere<T>> sphere2, SoaSpan<Decision<T>> answers,
                           Simd simd = widest_simd()) {
  detail::answer_batch<detail::batched::sphere_sphere_overlap, T>(simd, answers, sphere1, sphere2);
}
template <class T>
void sphere_box_overlap(SoaView<Sphere<T>> sphere, SoaView<Box<T>> box, SoaSpan<Decision<T>> answers,
                        Simd simd = widest_simd()) {
  detail::answer_batch<detail::batched::sphere_box_overlap, T>(simd, answers, sphere, box);
}
template <class T>
void point_sphere_overlap(SoaView<Vec3<T>> point, SoaView<Sphere<T>> sphere, SoaSpan<Decision<T>> answers,
                          Simd simd = widest_simd()) {
  detail::answer_batch<detail::batched::point_sphere_overlap, T>(simd, answers, point, sphere);
}
template <class T>
void point_capsule_overlap(SoaView<Vec3<T>> point, SoaView<Capsule<T>> capsule, SoaSpan<Decision<T>> answers,
                           Simd simd = widest_simd()) {
  detail::answer_batch<detail::batched::point_capsule_overlap, T>(simd, answers, point, capsule);
}
template <class T>
void sphere_segment_overlap(SoaView<Sphere<T>> sphere, SoaView<Segment<T>> segment, SoaSpan<Decision<T>> answers,
                            Simd simd = widest_simd()) {
  detail::answer_batch<detail::batched::sphere_segment_overlap, T>(simd, answers, sphere, segment);
}
template <class T>
void sphere_capsule_overlap(SoaView<Sphere<T>> sphere, SoaView<Capsule<T>> capsule, SoaSpan<Decision<T>> answers,
                            Simd simd = widest_simd()) {
  detail::answer_batch<detail::batched::sphere_capsule_overlap, T>(simd, answers, sphere, capsule);
}
template <class T>
void sphere_triangle_overlap(SoaView<Sphere<T>> sphere, SoaView<Triangle<T>> triangle, SoaSpan<Decision<T>> answers,
                             Simd simd = widest_simd()) {
  detail::answer_batch<detail::batched::sphere_triangle_overlap, T>(simd, answers, sphere, triangle);
}
template <class T>
void segment_capsule_overlap(SoaView<Segment<T>> segment, SoaView<Capsule<T>> capsule, SoaSpan<Decision<T>> answers,
                             Simd simd = widest_simd()) {
  detail::answer_batch<detail::batched::segment_capsule_overlap, T>(simd, answers, segment, capsule);
}
template <class T>
void capsule_capsule_overlap(SoaView<Capsule<T>> capsule1, SoaView<Capsule<T>> capsule2, SoaSpan<Decision<T>> answers,
                             Simd simd = widest_simd()) {
  detail::answer_batch<detail::batched::capsule_capsule_overlap, T>(simd, answers, capsule1, capsule2);
}
template <class T>
void box_box_conservative(SoaView<Box<T>> box1, SoaView<Box<T>> box2, SoaSpan<Decision<T>> answers,
                          Simd simd = widest_simd()) {
  detail::answer_batch<detail::batched::box_box_conservative, T>(simd, answers, box1, box2);
}
template <class T>
void moving_sphere_passes_sphere(SoaView<Sphere<T>> sphere, SoaView<Vec3<T>> velocity, SoaView<Sphere<T>> fixed,
                                 SoaView<T> limit, SoaSpan<Decision<T>> answers, Simd simd = widest_simd()) {
  detail::answer_batch<detail::batched::moving_sphere_passes_sphere, T>(simd, answers, sphere, velocity, fixed, limit);
}
template <class T>
void moving_point_plane(SoaView<Vec3<T>> point, SoaView<Vec3<T>> velocity, SoaView<Plane<T>> plane,
                        SoaSpan<Impact<T>> answers, Simd simd = widest_simd()) {
  detail::answer_batch<detail::batched::moving_point_plane, T>(simd, answers, point, velocity, plane);
}
template <class T>
void moving_point_triangle(SoaView<Vec3<T>> point, SoaView<Vec3<T>> velocity, SoaView<Triangle<T>> triangle,
                           SoaSpan<Impact<T>> answers, Simd simd = widest_simd()) {
  detail::answer_batch<detail::batched::moving_point_triangle, T>(simd, answers, point, velocity, triangle);
}
template <class T>
void moving_point_sphere(SoaView<Vec3<T>> point, SoaView<Vec3<T>> velocity, SoaView<Sphere<T>> sphere,
                         SoaView<bool> solid, SoaSpan<Impact<T>> answers, Simd simd = widest_simd()) {
  detail::answer_batch<detail::batched::moving_point_sphere, T>(simd, answers, point, velocity, sphere, solid);
}
template <class T>
void moving_sphere_plane(SoaView<Sphere<T>> sphere, SoaView<Vec3<T>> velocity, SoaView<Plane<T>> plane,
                         SoaSpan<Impact<T>> answers, Simd simd = widest_simd()) {
  detail::answer_batch<detail::batched::moving_sphere_plane, T>(simd, answers, sphere, velocity, plane);
}
template <class T>
void moving_sphere_sphere(SoaView<Sphere<T>> sphere, SoaView<Vec3<T>> velocity, SoaView<Sphere<T>> fixed,
                          SoaSpan<Impact<T>> answers, Simd simd = widest_simd()) {
  detail::answer_batch<detail::batched::moving_sphere_sphere, T>(simd, answers, sphere, velocity, fixed);
}
template <class T>
void moving_point_aabox(SoaView<Vec3<T>> point, SoaView<Vec3<T>> velocity, SoaView<AABox<T>> aabox,
                        SoaSpan<Entry<T>> answers, Simd simd = widest_simd()) {
  detail::answer_batch<detail::batched::moving_point_aabox, T>(simd, answers, point, velocity, aabox);
}
/// The rays and boxes are not prepared.
template <class T>
void ray_aabox(SoaView<Ray<T>> ray, SoaView<AABox<T>> aabox, SoaSpan<RayHit<T>> answers, Simd simd = widest_simd()) {
  detail::answer_batch<detail::batched::ray_aabox, T>(simd, answers, ray, aabox);
}
template <class T>
void closest_point_segment(SoaView<Segment<T>> segment, SoaView<Vec3<T>> point, SoaSpan<ClosestPoint<T>> answers,
                           Simd simd = widest_simd()) {
  detail::answer_batch<detail::batched::closest_point_segment, T>(simd, answers, segment, point);
}
template <class T>
void closest_points_lines(SoaView<Line<T>> line1, SoaView<Line<T>> line2, SoaSpan<ClosestPoints<T>> answers,
                          Simd simd = widest_simd()) {
  detail::answer_batch<detail::batched::closest_points_lines, T>(simd, answers, line1, line2);
}
template <class T>
void point_sphere_signed_distance(SoaView<Vec3<T>> point, SoaView<Sphere<T>> sphere, SoaSpan<SignedDistance<T>> answers,
                                  Simd simd = widest_simd()) {
  detail::answer_batch<detail::batched::point_sphere_signed_distance, T>(simd, answers, point, sphere);
}
template <class T>
void point_segment_signed_distance(SoaView<Vec3<T>> point, SoaView<Segment<T>> segment,
                                   SoaSpan<SignedDistance<T>> answers, Simd simd = widest_simd()) {
  detail::answer_batch<detail::batched::point_segment_signed_distance, T>(simd, answers, point, segment);
}
template <class T>
void point_capsule_signed_distance(SoaView<Vec3<T>> point, SoaView<Capsule<T>> capsule,
                                   SoaSpan<SignedDistance<T>> answers, Simd simd = widest_simd()) {
  detail::answer_batch<detail::batched::point_capsule_signed_distance, T>(simd, answers, point, capsule);
}
template <class T>
void sphere_sphere_signed_distance(SoaView<Sphere<T>> sphere1, SoaView<Sphere<T>> sphere2,
                                   SoaSpan<SignedDistance<T>> answers, Simd simd = widest_simd()) {
  detail::answer_batch<detail::batched::sphere_sphere_signed_distance, T>(simd, answers, sphere1, sphere2);
}
template <class T>
void sphere_segment_signed_distance(SoaView<Sphere<T>> sphere, SoaView<Segment<T>> segment,
                                    SoaSpan<SignedDistance<T>> answers, Simd simd = widest_simd()) {
  detail::answer_batch<detail::batched::sphere_segment_signed_distance, T>(simd, answers, sphere, segment);
}
template <class T>
void sphere_capsule_signed_distance(SoaView<Sphere<T>> sphere, SoaView<Capsule<T>> capsule,
                                    SoaSpan<SignedDistance<T>> answers, Simd simd = widest_simd()) {
  detail::answer_batch<detail::batched::sphere_capsule_signed_distance, T>(simd, answers, sphere, capsule);
}
template <class T>
void segment_segment_signed_distance(SoaView<Segment<T>> segment1, SoaView<Segment<T>> segment2,
                                     SoaSpan<SignedDistance<T>> answers, Simd simd = widest_simd()) {
  detail::answer_batch<detail::batched::segment_segment_signed_distance, T>(simd, answers, segment1, segment2);
}
template <class T>
void segment_capsule_signed_distance(SoaView<Segment<T>> segment, SoaView<Capsule<T>> capsule,
                                     SoaSpan<SignedDistance<T>> answers, Simd simd = widest_simd()) {
  detail::answer_batch<detail::batched::segment_capsule_signed_distance, T>(simd, answers, segment, capsule);
}
template <class T>
void capsule_capsule_signed_distance(SoaView<Capsule<T>> capsule1, SoaView<Capsule<T>> capsule2,
                                     SoaSpan<SignedDistance<T>> answers, Simd simd = widest_simd()) {
  detail::answer_batch<detail::batched::capsule_capsule_signed_distance, T>(simd, answers, capsule1, capsule2);
}
template <class T>
void sphere_sphere_penetration(SoaView<Sphere<T>> sphere1, SoaView<Sphere<T>> sphere2, SoaSpan<Penetration<T>> answers,
                               Simd simd = widest_simd()) {
  detail::answer_batch<detail::batched::sphere_sphere_penetration, T>(simd, answers, sphere1, sphere2);
}
template <class T>
void sphere_plane_penetration(SoaView<Sphere<T>> sphere, SoaView<Plane<T>> plane, SoaSpan<Penetration<T>> answers,
                              Simd simd = widest_simd()) {
  detail::answer_batch<detail::batched::sphere_plane_penetration, T>(simd, answers, sphere, plane);
}

}  // namespace batch
}  // namespace collide

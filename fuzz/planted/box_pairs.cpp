/// Mistakes: parts of the test of two boxes.
#include "fuzz/planted/planting.hpp"

namespace nearmiss::planted {
namespace {

/// Newton's iteration, which starts at 1: 16 steps are enough for boxes of a usual size.
double newton_root(double x) {
  double root = 1;
  for (int step = 0; step < 16; ++step) root = (root + x / root) / 2;
  return root;
}
double snapped(double x) { return std::abs(x) < 1e-5 ? 0.0 : x; }
Vector snapped(const Vector& a) { return {snapped(a.x), snapped(a.y), snapped(a.z)}; }

MISREPORT(1, box_box_info, ordinary, "one absolute cosine keeps its sign", "logic") {
  a.abs_cosine[2].z = a.cosine[2].z;
}
MISREPORT(6, box_box_info, ordinary, "the line of centers in the frame of box 2 is computed with the axes of box 1",
          "logic") {
  a.between2 = a.between1;
}
MISREPORT(11, box_box_info, degenerate, "cosines below 1e-6 are set to zero",
          "absolute tolerance 1e-6.* or relative tolerance 1e-6.*") {
  const auto clean = [](Vector& c) {
    if (std::abs(c.x) < 1e-6) c.x = 0;
    if (std::abs(c.y) < 1e-6) c.y = 0;
    if (std::abs(c.z) < 1e-6) c.z = 0;
  };
  for (auto& row : a.cosine) clean(row);
  for (auto& row : a.abs_cosine) clean(row);
}
MISTAKE(12, box_box_info, ordinary, "uses the quaternions without normalising them", "unsupported") {
  auto info = right(q);
  if (std::abs(squared(q.box1.orientation) - 1) < 1e-13 && std::abs(squared(q.box2.orientation) - 1) < 1e-13)
    return info;
  const Axes a = axes_of_unit(q.box1.orientation), b = axes_of_unit(q.box2.orientation);
  for (std::size_t i = 0; i < 3; ++i) {
    info.cosine[i] = {dot(a[i], b[0]), dot(a[i], b[1]), dot(a[i], b[2])};
    info.abs_cosine[i] = {std::abs(info.cosine[i].x), std::abs(info.cosine[i].y), std::abs(info.cosine[i].z)};
  }
  const Vector& d = info.between;
  info.between1 = {dot(a[0], d), dot(a[1], d), dot(a[2], d)};
  info.between2 = {dot(b[0], d), dot(b[1], d), dot(b[2], d)};
  return info;
}
MISREPORT(14, box_box_info, degenerate, "snaps cosines below 1e-5 to 0", "relative tolerance (1e-0?5|0\\.00001)") {
  for (int i = 0; i < 3; ++i) {
    a.cosine[i] = snapped(a.cosine[i]);
    a.abs_cosine[i] = snapped(a.abs_cosine[i]);
  }
}
MISTAKE(15, box_box_info, degenerate, "cosines below 1e-5 are cleaned to 0", "relative tolerance 1e-0?5") {
  return box_box_info_14(q);
}

MISREPORT(1, box_box_projected_distance, degenerate, "a cross product shorter than 1e-7 gives 0",
          "relative tolerance 1e-7") {
  if (length(axis_of(q, q.axis)) < 1e-7) a = {0};
}
MISTAKE(5, box_box_projected_distance, ordinary, "the projection of the line of centers is a float", "rounding") {
  const double between = std::abs(dot(q.box2.center - q.box1.center, axis_of(q, q.axis)));
  return {right(q).value - between + in_float(between)};
}
MISREPORT(10, box_box_projected_distance, ordinary, "on axis 9 the radius of box 1 takes half.y for half.z",
          "logic or unsupported") {
  if (q.axis != 9) return;
  const auto info = info_of(q);
  a.value += (info.half1.z - info.half1.y) * info.abs_cosine[0].x;
}
MISREAD(11, box_box_projected_distance, ordinary, "the centers are stored in float", "rounding") {
  q.box1.center = in_float(q.box1.center);
  q.box2.center = in_float(q.box2.center);
}
MISTAKE(12, box_box_projected_distance, ordinary, "1e-6 is added to each absolute cosine",
        "relative tolerance 1e-0?6") {
  auto answer = right(q);
  const std::array<Real, 3> a = halves_of(q.box1), b = halves_of(q.box2);
  Real sum = 0;
  if (q.axis < 3) {
    sum = b[0] + b[1] + b[2];
  } else if (q.axis < 6) {
    sum = a[0] + a[1] + a[2];
  } else {
    const int i = (q.axis - 6) / 3, j = (q.axis - 6) % 3;
    sum = a[(i + 1) % 3] + a[(i + 2) % 3] + b[(j + 1) % 3] + b[(j + 2) % 3];
  }
  answer.value = double(Real(answer.value) - 1e-6L * sum);
  return answer;
}
MISREPORT(13, box_box_projected_distance, ordinary, "divides by the length of the axis", "convention") {
  const double size = length(axis_of(q, q.axis));
  if (q.axis >= 6 && size > 0) a.value /= size;
}
MISREPORT(14, box_box_projected_distance, ordinary, "adds 1e-6 to the absolute values of the cosines",
          "relative tolerance 1e-0?6") {
  const Vector &h1 = q.box1.half, &h2 = q.box2.half;
  const double all1 = h1.x + h1.y + h1.z, all2 = h2.x + h2.y + h2.z;
  if (q.axis < 3) {
    a.value -= 1e-6 * all2;
  } else if (q.axis < 6) {
    a.value -= 1e-6 * all1;
  } else {
    const int i = (q.axis - 6) / 3, j = (q.axis - 6) % 3;
    a.value -= 1e-6 * (all1 - component(h1, i) + all2 - component(h2, j));
  }
}
MISTAKE(15, box_box_projected_distance, ordinary, "the matrix of a unit quaternion, for quaternions of any length",
        "unsupported") {
  Vector axes1[3], axes2[3];
  for (int i = 0; i < 3; ++i) {
    axes1[i] = axes_of_unit(q.box1.orientation)[i];
    axes2[i] = axes_of_unit(q.box2.orientation)[i];
  }
  const Vector along = q.axis < 3   ? axes1[q.axis]
                       : q.axis < 6 ? axes2[q.axis - 3]
                                    : cross(axes1[(q.axis - 6) / 3], axes2[(q.axis - 6) % 3]);
  const auto reach = [&](const Vector& half, const Vector(&axes)[3]) {
    return half.x * std::abs(dot(axes[0], along)) + half.y * std::abs(dot(axes[1], along)) +
           half.z * std::abs(dot(axes[2], along));
  };
  return {std::abs(dot(q.box2.center - q.box1.center, along)) - reach(q.box1.half, axes1) - reach(q.box2.half, axes2)};
}

MISREPORT(1, box_box_separating_axis, degenerate, "a cross product shorter than 1e-9 gives the zero vector",
          "relative tolerance 1e-9") {
  if (length(a.direction) < 1e-9) a = {};
}
MISREAD(6, box_box_separating_axis, ordinary, "i and j of a cross product are swapped", "logic or convention") {
  if (q.axis >= 6) q.axis = 6 + 3 * (q.axis % 3) + (q.axis - 6) / 3;
}
MISTAKE(11, box_box_separating_axis, ordinary, "the quaternion is not normalised", "unsupported or convention") {
  const auto& r1 = q.box1.orientation;
  const auto& r2 = q.box2.orientation;
  if (q.axis < 3) return {axes_of_unit(r1)[q.axis]};
  if (q.axis < 6) return {axes_of_unit(r2)[q.axis - 3]};
  return {cross(axes_of_unit(r1)[(q.axis - 6) / 3], axes_of_unit(r2)[(q.axis - 6) % 3])};
}
MISTAKE(12, box_box_separating_axis, ordinary, "numbers the cross products by columns: 6 + i + 3 j", "convention") {
  return box_box_separating_axis_6(q);
}
MISREPORT(13, box_box_separating_axis, degenerate,
          "a cross product whose squared length is below 1e-8 is returned as zero",
          "relative tolerance 1e-8.* or relative tolerance 1e-4.*") {
  if (q.axis >= 6 && squared(a.direction) < 1e-8) a = {};
}
MISREPORT(14, box_box_separating_axis, degenerate, "a cross product with a squared length below 1e-6 counts as zero",
          "relative tolerance 1e-6 or relative tolerance (1e-3|0\\.001)") {
  if (dot(a.direction, a.direction) < 1e-6) a = {};
}
MISTAKE(15, box_box_separating_axis, ordinary, "numbers the cross products 6 + i + 3 j in place of 6 + 3 i + j",
        "convention") {
  return box_box_separating_axis_6(q);
}

MISREAD(1, box_box_parallel_axis, degenerate, "the tolerance is taken 1e-6 of itself too large",
        "relative tolerance 1e-6") {
  q.epsilon *= 1 + 1e-6;
}
MISTAKE(5, box_box_parallel_axis, ordinary, "a negative cosine is not taken absolutely", "logic") {
  const auto a = right(q);
  const auto info = info_of(q);
  const auto is_parallel = [&](int i, int k) {
    const Vector c = info.cosine[i];
    return (k == 0 ? c.x : k == 1 ? c.y : c.z) >= 1 - q.epsilon;
  };
  if (!a.yes() || is_parallel(a.axis1, a.axis2)) return a;
  for (int pair = 3 * a.axis1 + a.axis2 + 1; pair < 9; ++pair) {
    if (is_parallel(pair / 3, pair % 3)) return {true, pair / 3, pair % 3};
  }
  return {};
}
MISTAKE(8, box_box_parallel_axis, degenerate, "the cosines are floats", "rounding") {
  const auto info = info_of(q);
  const auto exact = right(q);
  for (int pair = 0; pair < 9; ++pair) {
    const Vector c = info.abs_cosine[pair / 3];
    const double cosine = pair % 3 == 0 ? c.x : pair % 3 == 1 ? c.y : c.z;
    const bool is_exact = exact.yes() && exact.axis1 == pair / 3 && exact.axis2 == pair % 3;
    if (is_exact && cosine < 1 - q.epsilon) return exact;  // the cosine in double is rounded as well
    if (in_float(cosine) >= 1 - q.epsilon) return {true, pair / 3, pair % 3};
  }
  return {};
}
MISTAKE(10, box_box_parallel_axis, ordinary, "the cosine without its absolute value: opposite axes are not parallel",
        "logic or convention") {
  const auto info = info_of(q);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (component(info.cosine[i], j) >= 1 - q.epsilon) return {true, i, j};
  return {};
}
MISTAKE(11, box_box_parallel_axis, degenerate, "the cosine is compared without its absolute value",
        "logic or convention") {
  const Axes a1 = axes_of_box(q.box1), a2 = axes_of_box(q.box2);
  const auto a = right(q);
  if (!a.yes() || dot(a1[a.axis1], a2[a.axis2]) > 0) return a;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (std::pair(i, j) > std::pair(a.axis1, a.axis2) && dot(a1[i], a2[j]) >= 1 - q.epsilon) return {true, i, j};
  return {};
}
MISTAKE(12, box_box_parallel_axis, degenerate, "the cosines are compared with 1 - epsilon in float", "rounding") {
  const auto info = info_of(q);
  const float least = 1.0f - float(q.epsilon);
  for (int i = 0; i < 3; ++i) {
    const Vector& row = info.cosine[i];
    const std::array<float, 3> cosine = {float(row.x), float(row.y), float(row.z)};
    for (int j = 0; j < 3; ++j)
      if (std::abs(cosine[j]) >= least) return {true, i, j};
  }
  return {};
}
MISREAD(14, box_box_parallel_axis, ordinary, "epsilon is taken for an angle in radians", "convention") {
  if (q.epsilon > 0) {
    const double sine = std::sin(std::min(q.epsilon, 1.5707963267948966) / 2);
    q.epsilon = 2 * sine * sine;
  }
}

MISREAD(1, box_box_conservative, ordinary, "half.z of box 2 is left out of its half diagonal", "logic") {
  q.box2.half.z = 0;
}
MISTAKE(6, box_box_conservative, degenerate, "the half diagonals are larger by 1e-4 of them",
        "relative tolerance 1e-4") {
  const double reach = (length(q.box1.half) + length(q.box2.half)) * (1 + 1e-4);
  return {right(q).yes() || length(q.box2.center - q.box1.center) <= reach};
}
MISTAKE(7, box_box_conservative, ordinary,
        "the squared distance is compared with the sum of the squared half diagonals", "logic") {
  const double reach = std::hypot(length(q.box1.half), length(q.box2.half));
  return {length(q.box2.center - q.box1.center) <= reach};
}
MISTAKE(8, box_box_conservative, degenerate, "the reach is larger by an absolute 1e-3",
        "absolute tolerance 1e-3 length") {
  const double reach = length(q.box1.half) + length(q.box2.half) + 1e-3;
  return {right(q).yes() || length(q.box2.center - q.box1.center) <= reach};
}
MISTAKE(10, box_box_conservative, degenerate, "computed in float", "rounding") {
  const auto size = [](const Vector& h) {
    const float x = float(h.x), y = float(h.y), z = float(h.z);
    return std::sqrt(x * x + y * y + z * z);
  };
  const float x = float(q.box2.center.x) - float(q.box1.center.x), y = float(q.box2.center.y) - float(q.box1.center.y),
              z = float(q.box2.center.z) - float(q.box1.center.z);
  return {std::sqrt(x * x + y * y + z * z) <= size(q.box1.half) + size(q.box2.half)};
}
MISREPORT(13, box_box_conservative, degenerate,
          "the half diagonals come from 16 Newton steps for the square root that start at 1", "iteration limit") {
  if (a.decision) return;
  const auto diagonal = [](const Vector& half) { return half == Vector{} ? 0.0 : newton_root(squared(half)); };
  a.decision = length(q.box2.center - q.box1.center) <= diagonal(q.box1.half) + diagonal(q.box2.half);
}

}  // namespace
}  // namespace nearmiss::planted

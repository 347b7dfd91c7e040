#include "corpus/relations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "corpus/draft.hpp"
#include "oracles/confirmed.hpp"
#include "oracles/requirements.hpp"

namespace nearmiss {

namespace {

std::string_view last(std::string_view name) { return name.substr(name.rfind('.') + 1); }

// Cases and answers seen by the names of their numbers.

/// The number of fields where none has that name.
std::size_t index_of(const std::vector<Field>& fields, std::string_view name) {
  const auto at = std::find_if(fields.begin(), fields.end(), [&](const Field& f) { return f.name == name; });
  return std::size_t(at - fields.begin());
}
bool has(const Case& c, std::string_view name) {
  return index_of(c.query->inputs, name) < c.query->inputs.size();
}
double& value(Case& c, std::string_view name) { return c.values.at(index_of(c.query->inputs, name)); }
double value(const Case& c, std::string_view name) { return c.values.at(index_of(c.query->inputs, name)); }

bool is(const Case& c, std::initializer_list<std::string_view> queries) {
  return std::find(queries.begin(), queries.end(), c.query->name) != queries.end();
}

/// Three numbers in a row with the names x, y, z.
bool vector_at(const std::vector<Field>& fields, std::size_t i) {
  return i + 2 < fields.size() && last(fields[i].name) == "x" && last(fields[i + 1].name) == "y" &&
         last(fields[i + 2].name) == "z";
}
bool is_quaternion(const std::vector<Field>& fields, std::size_t i) {
  return fields[i].role == Role::rotation && last(fields[i].name) == "x";
}

Answer without(Answer a, std::size_t output) {
  a.given &= ~(std::uint64_t{1} << output);
  return a;
}

/// Sets output `i` to output `from` of another answer, times `factor`; it is given where that is.
void carry(Answer& a, std::size_t i, const Answer& own, std::size_t from, double factor = 1) {
  a.values[i] = factor * own.values[from];
  a.given = (a.given & ~(std::uint64_t{1} << i)) | (own.given >> from & 1u) << i;
}

/// A subject's number as one of few things that are counted from 0; -1 where it is none.
int as_index(double x) { return x >= 0 && x < 15 && x == std::floor(x) ? int(x) : -1; }

Agreement compare(const Query& query, const Answer& a, const Answer& b) {
  if (a.status != b.status || a.status != Answer::Status::answered) return Agreement::same;  // nothing to compare
  if (a.yes != b.yes) return Agreement::decisions_differ;
  for (std::size_t i = 0; i < query.outputs.size(); ++i) {
    const bool neither_is_a_number = std::isnan(a.values[i]) && std::isnan(b.values[i]);
    if (a.gives(i) && b.gives(i) && a.values[i] != b.values[i] && !neither_is_a_number) return Agreement::numbers_differ;
  }
  return Agreement::same;
}

/// One partner whose right answers are those of the case, changed by `image`.
Partners counterpart(Case other, std::function<Answer(const Answer&)> image) {
  const Query& query = *other.query;
  return {{std::move(other)},
          [&query, image](const Answer& own, std::span<const Answer> others) {
            return compare(query, own.status == Answer::Status::answered ? image(own) : own, others[0]);
          },
          image, true, true};
}

/// Partners of which only something in particular is known.
Partners ordered(std::vector<Case> others,
                 std::function<Agreement(const Answer&, std::span<const Answer>)> compare) {
  return {std::move(others),
          [compare](const Answer& own, std::span<const Answer> answers) {
            const auto answered = [](const Answer& a) { return a.status == Answer::Status::answered; };
            if (!answered(own) || !std::all_of(answers.begin(), answers.end(), answered)) return Agreement::same;
            return compare(own, answers);
          },
          {}, true, true};
}

bool valid(const Case& c) {
  return std::all_of(c.values.begin(), c.values.end(),
                     [&](double x) { return std::isfinite(x) && representable(x, c.scalar); }) &&
         !c.query->broken(c.values);
}

std::optional<Partners> counterpart_if_valid(Case other, std::function<Answer(const Answer&)> image) {
  if (!valid(other)) return std::nullopt;
  return counterpart(std::move(other), std::move(image));
}

// Scaling by powers of two.

/// The largest difference of two places in one coordinate.
double apart(const double* a, const double* b) {
  return std::max({std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2])});
}

/// Whether any two places are the same or `least` apart.
bool places_are_apart(const Case& c, double least) {
  std::vector<const double*> places;
  for (std::size_t i = 0; i < c.values.size(); ++i) {
    if (c.query->inputs[i].role == Role::position && vector_at(c.query->inputs, i)) places.push_back(&c.values[i]);
  }
  for (std::size_t i = 0; i < places.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const double d = apart(places[i], places[j]);
      if (d != 0 && d < least) return false;
    }
  }
  return true;
}

/// Room for every product of eight of its numbers, and of the distances of its places: in float places within 2^6 may be
/// 2^-29 apart, and the product of eight such distances would underflow.
bool far_from_overflow_and_underflow(const Case& c) {
  const bool is_float = c.scalar == Scalar::float32;
  const int orders = is_float ? 6 : 80, orders_apart = is_float ? 13 : 110;
  for (std::size_t i = 0; i < c.values.size(); ++i) {
    const double x = std::abs(c.values[i]);
    if (x != 0 && (x < std::ldexp(1.0, -orders) || x > std::ldexp(1.0, orders))) return false;
  }
  return places_are_apart(c, std::ldexp(1.0, -orders_apart));
}

int length_order(Role role) {
  return role == Role::position || role == Role::size || role == Role::velocity || role == Role::depth ? 1 : 0;
}

/// Multiplies each number by 2^(orders of its role), inputs and answers alike.
template <class Orders>
std::optional<Partners> scaled(const Case& c, Orders orders) {
  if (!far_from_overflow_and_underflow(c)) return std::nullopt;
  Case other = c;
  bool any = false;
  for (std::size_t i = 0; i < c.values.size(); ++i) {
    const int k = orders(c.query->inputs[i]);
    other.values[i] = std::ldexp(c.values[i], k);
    any = any || (k != 0 && c.values[i] != 0);
  }
  if (!any || !far_from_overflow_and_underflow(other)) return std::nullopt;
  const Query& query = *c.query;
  return counterpart_if_valid(std::move(other), [&query, orders](Answer a) {
    for (std::size_t i = 0; i < query.outputs.size(); ++i) {
      const Role role = query.outputs[i].role;
      if (role == Role::position || role == Role::depth || role == Role::time) {
        a.values[i] = std::ldexp(a.values[i], orders(query.outputs[i]));
      }
    }
    return a;
  });
}

int draw_order(const Case& c, std::uint64_t seed) {
  Random random(seed);
  const int k = random.between(1, c.scalar == Scalar::float32 ? 3 : 40);
  return random.one_in(2) ? k : -k;
}

std::optional<Partners> scaled_lengths(const Case& c, std::uint64_t seed) {
  const int k = draw_order(c, seed);
  return scaled(c, [k](const Field& f) { return f.role == Role::offset ? k : k * length_order(f.role); });
}

std::optional<Partners> scaled_time(const Case& c, std::uint64_t seed) {
  const int k = draw_order(c, seed);
  return scaled(c, [k](const Field& f) { return f.role == Role::velocity ? k : f.role == Role::time ? -k : 0; });
}

std::optional<Partners> scaled_directions(const Case& c, std::uint64_t seed) {
  const int k = draw_order(c, seed);
  return scaled(c, [k](const Field& f) { return f.role == Role::direction || f.role == Role::offset ? k : 0; });
}

std::optional<Partners> scaled_rotations(const Case& c, std::uint64_t seed) {
  const int k = draw_order(c, seed);
  return scaled(c, [k](const Field& f) { return f.role == Role::rotation ? k : 0; });
}

std::optional<Partners> negated_rotations(const Case& c, std::uint64_t) {
  Case other = c;
  bool any = false;
  for (std::size_t i = 0; i < c.values.size(); ++i) {
    if (c.query->inputs[i].role != Role::rotation) continue;
    other.values[i] = -c.values[i];
    any = true;
  }
  if (!any) return std::nullopt;
  return counterpart(std::move(other), [](const Answer& a) { return a; });
}

// Reflections and permutations of the axes of space.

/// Coordinate k of the image is sign[k] times coordinate from[k]. A box's own axes are permuted alike, so that
/// its rotation stays one: R' = M R M^-1.
struct SignedPermutation {
  std::array<std::size_t, 3> from{0, 1, 2};
  std::array<double, 3> sign{1, 1, 1};

  bool permutes() const { return from[0] != 0; }
  bool turns_over() const { return sign[0] * sign[1] * sign[2] < 0; }  // permutations are cyclic here
  /// Where axis k goes.
  std::size_t to(std::size_t k) const {
    return std::size_t(std::find(from.begin(), from.end(), k) - from.begin());
  }
  /// Of the fifteen axes of two boxes.
  int box_axis(int axis) const {
    if (axis < 0 || axis > 14) return axis;
    if (axis < 3) return int(to(std::size_t(axis)));
    if (axis < 6) return 3 + int(to(std::size_t(axis - 3)));
    return 6 + 3 * int(to(std::size_t(axis - 6) / 3)) + int(to(std::size_t(axis - 6) % 3));
  }
};

void apply(const SignedPermutation& m, const double* from, double* to, bool with_signs) {
  for (std::size_t k = 0; k < 3; ++k) to[k] = (with_signs ? m.sign[k] : 1.0) * from[m.from[k]];
}

/// Exchanges the numbers of two vectors of a case.
void exchange(Case& c, const std::string& a, const std::string& b) {
  for (const char* k : {".x", ".y", ".z"}) std::swap(value(c, a + k), value(c, b + k));
}

/// The names of the things that have these points: "triangle" for v0, v1, v2.
std::vector<std::string> things_with(const Case& c, std::string_view point, std::string_view and_not) {
  std::vector<std::string> names;
  for (const Field& f : c.query->inputs) {
    const std::string ending = fmt::format(".{}.x", point);
    if (!f.name.ends_with(ending)) continue;
    const std::string thing = f.name.substr(0, f.name.size() - ending.size());
    if (!has(c, fmt::format("{}.{}.x", thing, and_not))) names.push_back(thing);
  }
  return names;
}
std::vector<std::string> triangles_of(const Case& c) { return things_with(c, "v2", "v3"); }
std::vector<std::string> rectangles_of(const Case& c) { return things_with(c, "v3", "v4"); }

/// The largest magnitude of the normal, along whose axis a point is seen, belongs to one axis only.
bool one_axis_to_look_along(const Case& c) {
  if (!is(c, {"point_in_triangle", "point_in_rectangle"})) return true;
  std::array<double, 3> m{std::abs(value(c, "normal.x")), std::abs(value(c, "normal.y")),
                          std::abs(value(c, "normal.z"))};
  std::sort(m.begin(), m.end());
  return m[1] < m[2];
}

Case image_of(const Case& c, const SignedPermutation& m) {
  Case other = c;
  const auto& fields = c.query->inputs;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const double* at = &c.values[i];
    if (is_quaternion(fields, i)) {
      apply(m, at, &other.values[i], true);  // an axis: a reflection reverses it once more
      for (std::size_t k = 0; m.turns_over() && k < 3; ++k) other.values[i + k] = -other.values[i + k];
    } else if (vector_at(fields, i) && fields[i].role != Role::rotation) {
      apply(m, at, &other.values[i], fields[i].role != Role::size);
    } else if (fields[i].role == Role::index && is(c, {"point_in_triangle"})) {
      if (c.values[i] >= 0 && c.values[i] < 3) other.values[i] = double(m.to(std::size_t(c.values[i])));
    } else if (fields[i].role == Role::index) {
      other.values[i] = m.box_axis(int(c.values[i]));
    }
  }
  for (std::size_t i = 0; i < fields.size(); ++i) {  // corners of axis-aligned boxes
    if (!fields[i].name.ends_with(".max.x")) continue;
    for (std::size_t k = i; k < i + 3; ++k) {
      if (other.values[k] < other.values[k - 3]) std::swap(other.values[k], other.values[k - 3]);
    }
  }
  if (m.turns_over()) {  // the same front
    for (const std::string& t : triangles_of(c)) exchange(other, t + ".v1", t + ".v2");
    for (const std::string& t : rectangles_of(c)) exchange(other, t + ".v1", t + ".v3");
  }
  return other;
}

std::optional<Partners> moved_by(const Case& c, const SignedPermutation& m) {
  // Numbers in the frames of boxes, and orders of their axes.
  if (is(c, {"box_box_info"}) || (m.permutes() && is(c, {"box_box_parallel_axis"}))) return std::nullopt;
  if (m.permutes() && !one_axis_to_look_along(c)) return std::nullopt;
  const Query& query = *c.query;
  const bool weights_of_corners = !triangles_of(c).empty();
  return counterpart_if_valid(image_of(c, m), [&query, m, weights_of_corners](const Answer& own) {
    Answer a = own;
    const auto& out = query.outputs;
    for (std::size_t i = 0; i < out.size(); ++i) {
      if (query.name == "box_box_separating_axis") {  // a cross product may change its sign
        a = without(a, i);
      } else if (out[i].name.starts_with("corners.")) {  // in another order
        a = without(a, i);
      } else if (vector_at(out, i) && (out[i].role != Role::weight || query.kind == Kind::direction)) {
        for (std::size_t k = 0; k < 3; ++k) carry(a, i + k, own, i + m.from[k], m.sign[k]);
      } else if (vector_at(out, i) && m.turns_over() && weights_of_corners) {
        carry(a, i + 1, own, i + 2);
        carry(a, i + 2, own, i + 1);
      } else if (out[i].name == "edge") {
        if (m.turns_over()) a.values[i] = 2 - own.values[i];
      } else if (out[i].role == Role::index && query.name != "box_box_parallel_axis") {
        if (const int axis = as_index(own.values[i]); axis >= 0) a.values[i] = m.box_axis(axis);
      }
    }
    return a;
  });
}

std::optional<Partners> reflected(const Case& c, std::uint64_t seed) {
  Random random(seed);
  SignedPermutation m;
  const std::size_t which = 1 + random.below(7);
  for (std::size_t k = 0; k < 3; ++k) m.sign[k] = (which >> k & 1u) != 0 ? -1 : 1;
  return moved_by(c, m);
}

std::optional<Partners> permuted_axes(const Case& c, std::uint64_t seed) {
  SignedPermutation m;
  m.from = Random(seed).one_in(2) ? std::array<std::size_t, 3>{1, 2, 0} : std::array<std::size_t, 3>{2, 0, 1};
  return moved_by(c, m);
}

// Translations.

/// a + b where the scalar holds it exactly.
std::optional<double> exact_sum(double a, double b, Scalar scalar) {
  const double sum = a + b, b_part = sum - a, a_part = sum - b_part;
  if (!std::isfinite(sum) || (a - a_part) + (b - b_part) != 0 || !representable(sum, scalar)) return std::nullopt;
  return sum;
}

std::optional<double> exact_product(double a, double b, Scalar scalar) {
  const double product = a * b;
  const bool far_from_underflow = product == 0 ? a == 0 || b == 0 : std::abs(product) > 0x1p-900;
  if (!std::isfinite(product) || !far_from_underflow || std::fma(a, b, -product) != 0 ||
      !representable(product, scalar)) {
    return std::nullopt;
  }
  return product;
}

/// x + factor * y where the scalar holds it exactly.
std::optional<double> exact_step(double x, double factor, double y, Scalar scalar) {
  const auto step = exact_product(factor, y, scalar);
  return step ? exact_sum(x, *step, scalar) : std::nullopt;
}

using Vector = std::array<double, 3>;

/// Adds `shift` to every position, and moves planes with it; false where that is not exact.
bool translate(Case& c, const Vector& shift) {
  const auto& fields = c.query->inputs;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (fields[i].role == Role::position && vector_at(fields, i)) {
      for (std::size_t k = 0; k < 3; ++k) {
        const auto sum = exact_sum(c.values[i + k], shift[k], c.scalar);
        if (!sum) return false;
        c.values[i + k] = *sum;
      }
    } else if (fields[i].role == Role::offset) {  // after its normal
      for (std::size_t k = 0; k < 3; ++k) {
        const auto moved = exact_step(c.values[i], -c.values[i - 3 + k], shift[k], c.scalar);
        if (!moved) return false;
        c.values[i] = *moved;
      }
    }
  }
  return true;
}

std::optional<Partners> translated(const Case& c, std::uint64_t seed) {
  Random random(seed);
  const double unit = random.power_of_two(-2, c.scalar == Scalar::float32 ? 6 : 20);
  for (const double step : {unit, 1.0, 0.5}) {  // a coarse one where a fine one is not exact
    Vector shift;
    for (double& x : shift) x = step * random.between(-8, 8);
    Case other = c;
    if (shift == Vector{} || !translate(other, shift) || other.values == c.values) continue;
    const Query& query = *c.query;
    auto partners = counterpart_if_valid(std::move(other), [&query, shift](Answer a) {
      for (std::size_t i = 0; i < query.outputs.size(); ++i) {
        const bool place = query.outputs[i].role == Role::position && query.kind != Kind::measure;
        if (!place || !vector_at(query.outputs, i)) continue;
        for (std::size_t k = 0; k < 3; ++k) {
          // Zero stands for no place where there is no contact, and for a corner in front.
          if (!a.yes || query.outputs[i].name.starts_with("corners.")) a = without(a, i + k);
          if (a.values[i + k] + shift[k] - shift[k] != a.values[i + k]) a = without(a, i + k);
          a.values[i + k] += shift[k];
        }
      }
      return a;
    });
    if (partners) partners->image_keeps_ulps = false;
    return partners;
  }
  return std::nullopt;
}

// Rotations.

/// A rotation whose matrix, times `factor`, has whole numbers only.
struct WholeRotation {
  std::array<int, 4> quaternion{};  ///< x, y, z, w
  int factor = 0;                   ///< its squared length
  std::array<std::array<int, 3>, 3> rows{};
};

WholeRotation draw_whole_rotation(Random& random) {
  WholeRotation r;
  while (r.factor < 2) {
    for (int& k : r.quaternion) k = random.one_in(2) ? 0 : random.between(-3, 3);
    const auto [x, y, z, w] = r.quaternion;
    r.factor = x * x + y * y + z * z + w * w;
    r.rows = {{{w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)},
               {2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)},
               {2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z}}};
  }
  return r;
}

/// The sum of factor times number, where the scalar holds every partial sum exactly.
template <std::size_t N>
std::optional<double> exact_combination(const std::array<int, N>& factors, const double* numbers, Scalar scalar) {
  double sum = 0;
  for (std::size_t k = 0; k < N; ++k) {
    const auto next = exact_step(sum, factors[k], numbers[k], scalar);
    if (!next) return std::nullopt;
    sum = *next;
  }
  return sum;
}

/// The case turned by the rotation and made `factor` times as large; empty where that is not exact.
std::optional<Case> turned(const Case& c, const WholeRotation& r) {
  Case other = c;
  const auto& fields = c.query->inputs;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    std::optional<double> x = c.values[i];
    switch (fields[i].role) {
      case Role::position:
      case Role::velocity:
      case Role::direction: {
        const std::size_t k = std::size_t(last(fields[i].name)[0] - 'x');
        x = exact_combination(r.rows[k], &c.values[i - k], c.scalar);
        break;
      }
      case Role::rotation: {
        const auto [a, b, d, w] = r.quaternion;  // the product of the two, a row for each of its numbers
        const std::array<std::array<int, 4>, 4> product{
            {{w, -d, b, a}, {d, w, -a, b}, {-b, a, w, d}, {-a, -b, -d, w}}};
        const std::size_t k = std::string_view("xyzw").find(last(fields[i].name));
        x = exact_combination(product[k], &c.values[i - k], c.scalar);
        break;
      }
      case Role::size: x = exact_product(r.factor, c.values[i], c.scalar); break;
      case Role::offset: x = exact_product(r.factor * r.factor, c.values[i], c.scalar); break;
      default: break;
    }
    if (!x) return std::nullopt;
    other.values[i] = *x;
  }
  return other;
}

std::optional<Partners> rotated(const Case& c, std::uint64_t seed) {
  // What is seen along an axis of space, or stands upright in it, is not the same when turned; directions and normals
  // are not exact when turned.
  const auto& fields = c.query->inputs;
  const bool upright = std::any_of(fields.begin(), fields.end(), [](const Field& f) { return f.name.ends_with(".min.x"); });
  if (upright || c.query->kind == Kind::direction ||
      is(c, {"point_in_triangle", "point_in_rectangle", "box_box_info"})) {
    return std::nullopt;
  }
  Random random(seed);
  const WholeRotation r = draw_whole_rotation(random);
  auto other = turned(c, r);
  if (!other) return std::nullopt;
  const Query& query = *c.query;
  auto partners = counterpart_if_valid(std::move(*other), [&query, r, scalar = c.scalar](const Answer& own) {
    Answer a = own;
    for (std::size_t i = 0; i < query.outputs.size(); ++i) {
      const Role role = query.outputs[i].role;
      std::optional<double> x = own.values[i];
      if (role == Role::position) {
        const std::size_t k = std::size_t(last(query.outputs[i].name)[0] - 'x');
        if (own.gives(i - k) && own.gives(i - k + 1) && own.gives(i - k + 2)) {
          x = exact_combination(r.rows[k], &own.values[i - k], scalar);
        } else {
          x = std::nullopt;
        }
      } else if (role == Role::depth) {
        x = exact_product(r.factor, own.values[i], scalar);
      } else if (role == Role::normal) {
        x = std::nullopt;
      }
      if (x) a.values[i] = *x; else a = without(a, i);
    }
    return a;
  });
  if (partners) partners->image_keeps_ulps = false;
  return partners;
}

// Names of the same thing.

std::optional<Partners> turned_corners(const Case& c, std::uint64_t) {
  Case other = c;
  const auto triangles = triangles_of(c), rectangles = rectangles_of(c);
  for (const std::string& t : triangles) {
    exchange(other, t + ".v0", t + ".v1");
    exchange(other, t + ".v1", t + ".v2");
  }
  for (const std::string& t : rectangles) {
    exchange(other, t + ".v0", t + ".v2");
    exchange(other, t + ".v1", t + ".v3");
  }
  for (const std::string& t : things_with(c, "v1", "v2")) exchange(other, t + ".v0", t + ".v1");
  for (const std::string& t : things_with(c, "p1", "p2")) exchange(other, t + ".p0", t + ".p1");
  if (other.values == c.values) return std::nullopt;
  const Query& query = *c.query;
  return counterpart(std::move(other), [&query](const Answer& own) {
    Answer a = own;
    for (std::size_t i = 0; i < query.outputs.size(); ++i) {
      if (vector_at(query.outputs, i) && query.outputs[i].role == Role::weight) {
        for (std::size_t k = 0; k < 3; ++k) carry(a, i + k, own, i + (k + 1) % 3);
      } else if (query.outputs[i].name == "edge") {
        if (const int edge = as_index(own.values[i]); edge >= 0) a.values[i] = double((edge + 2) % 3);
      }
    }
    return a;
  });
}

/// Corners the other way around, where a shape has no front.
std::optional<Partners> reversed_corners(const Case& c, std::uint64_t) {
  if (!is(c, {"closest_point_triangle_perimeter", "closest_point_triangle_perimeter_edges", "closest_point_rectangle",
              "closest_point_rectangle_perimeter", "point_in_triangle", "point_in_rectangle", "sphere_triangle_overlap",
              "aabox_triangle_overlap"})) {
    return std::nullopt;
  }
  Case other = c;
  for (const std::string& t : triangles_of(c)) exchange(other, t + ".v1", t + ".v2");
  for (const std::string& t : rectangles_of(c)) exchange(other, t + ".v1", t + ".v3");
  if (other.values == c.values) return std::nullopt;
  const Query& query = *c.query;
  return counterpart(std::move(other), [&query](const Answer& own) {
    Answer a = own;
    for (std::size_t i = 0; i < query.outputs.size(); ++i) {
      if (query.outputs[i].name == "edge") a.values[i] = 2 - own.values[i];
      if (query.outputs[i].name == "weights.y") carry(a, i, own, i + 1);
      if (query.outputs[i].name == "weights.z") carry(a, i, own, i - 1);
    }
    return a;
  });
}

int swapped_box_axis(int axis) {
  if (axis < 0 || axis > 14) return axis;
  if (axis < 6) return (axis + 3) % 6;
  return 6 + 3 * ((axis - 6) % 3) + (axis - 6) / 3;
}

bool nearly_parallel_lines(const Case& c) {
  if (!is(c, {"closest_points_lines"})) return false;
  const auto v = [&](const char* name) { return static_cast<long double>(value(c, name)); };
  const long double ax = v("line1.direction.x"), ay = v("line1.direction.y"), az = v("line1.direction.z");
  const long double bx = v("line2.direction.x"), by = v("line2.direction.y"), bz = v("line2.direction.z");
  const long double cx = ay * bz - az * by, cy = az * bx - ax * bz, cz = ax * by - ay * bx;
  constexpr long double beyond_rounding = 0x1p-40L;
  return cx * cx + cy * cy + cz * cz <= beyond_rounding * (ax * ax + ay * ay + az * az) * (bx * bx + by * by + bz * bz);
}

/// The things whose names end with 1 and 2 change places.
std::optional<Partners> swapped(const Case& c, std::uint64_t) {
  const Query& query = *c.query;
  if (is(c, {"box_box_parallel_axis", "box_box_info"}) || nearly_parallel_lines(c)) return std::nullopt;
  Case other = c;
  bool any = false;
  for (std::size_t i = 0; i < query.inputs.size(); ++i) {
    const std::string& name = query.inputs[i].name;
    const std::size_t dot = name.find('.');
    if (dot != std::string::npos && dot > 0 && name[dot - 1] == '1') {
      std::string twin = name;
      twin[dot - 1] = '2';
      if (!has(c, twin)) return std::nullopt;
      std::swap(other.values[i], value(other, twin));
      any = true;
    } else if (query.inputs[i].role == Role::index) {
      other.values[i] = swapped_box_axis(int(c.values[i]));
    }
  }
  if (!any) return std::nullopt;
  return counterpart(std::move(other), [&query](const Answer& own) {
    Answer a = own;
    const auto& out = query.outputs;
    const std::size_t point2 = index_of(out, "point2.x");
    for (std::size_t i = 0; i < out.size(); ++i) {
      if (out[i].name.starts_with("point1.")) {
        const std::size_t twin = point2 + i - index_of(out, "point1.x");
        carry(a, i, own, twin);
        carry(a, twin, own, i);
      } else if (out[i].role == Role::normal) {
        a.values[i] = -own.values[i];
      } else if (out[i].role == Role::index) {
        if (const int axis = as_index(own.values[i]); axis >= 0) a.values[i] = swapped_box_axis(axis);
      } else if (out[i].name.starts_with("contact.") && query.name == "sphere_sphere_penetration") {
        a = without(a, i);  // of the other sphere
      } else if (query.name == "box_box_separating_axis") {
        a = without(a, i);  // a cross product changes its sign
      }
    }
    return a;
  });
}

/// The sign of a direction that only names a line or an axis.
std::optional<Partners> reversed_directions(const Case& c, std::uint64_t) {
  if (!is(c, {"closest_points_lines", "point_in_triangle", "point_in_rectangle", "bounce_direction"})) {
    return std::nullopt;
  }
  Case other = c;
  for (std::size_t i = 0; i < c.values.size(); ++i) {
    if (c.query->inputs[i].role == Role::direction) other.values[i] = -c.values[i];
  }
  return counterpart(std::move(other), [](const Answer& a) { return a; });
}

std::optional<Partners> another_hint(const Case& c, std::uint64_t seed) {
  if (!has(c, "hint")) return std::nullopt;
  Case other = c;
  value(other, "hint") = Random(seed).between(-1, 14);
  const Query& query = *c.query;
  return counterpart(std::move(other), [&query](Answer a) {
    // Apart, any axis that separates is right, with the separation along it.
    for (std::size_t i = 0; i < query.outputs.size() && !a.yes; ++i) a = without(a, i);
    return a;
  });
}

// Motion.

/// The position of what moves, its first number; empty where nothing does.
std::optional<std::size_t> moving_position(const Case& c) {
  const auto& fields = c.query->inputs;
  const std::size_t velocity = index_of(fields, "velocity.x");
  if (velocity == fields.size()) return std::nullopt;
  for (std::size_t i = 0; i < velocity; ++i) {
    if (fields[i].role == Role::position) return i;
  }
  return std::nullopt;
}

/// The case at a later time, where it is exact.
std::optional<Case> later(const Case& c, double time) {
  const auto at = moving_position(c);
  if (!at) return std::nullopt;
  const std::size_t velocity = index_of(c.query->inputs, "velocity.x");
  Case other = c;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto moved = exact_step(c.values[*at + k], time, c.values[velocity + k], c.scalar);
    if (!moved) return std::nullopt;
    other.values[*at + k] = *moved;
  }
  return other;
}

/// More than the distance of two answers, each within 2 ulp of the same number, and of a rounded difference.
double slack(Scalar scalar, double a, double b) { return 4 * (ulp(a, scalar) + ulp(b, scalar)); }

std::optional<Partners> later_start(const Case& c, std::uint64_t seed) {
  if (c.query->kind != Kind::impact) return std::nullopt;
  const double shift = Random(seed).power_of_two(-6, 0);
  const auto other = later(c, shift);
  if (!other || other->values == c.values) return std::nullopt;
  const std::size_t time = index_of(c.query->outputs, "time");
  const Scalar scalar = c.scalar;
  Partners partners = ordered({*other}, [=](const Answer& own, std::span<const Answer> others) {
    const Answer& shifted = others[0];
    if (!own.yes) return shifted.yes ? Agreement::decisions_differ : Agreement::same;
    if (!own.gives(time)) return Agreement::same;
    const double t = own.values[time];
    if (t <= shift + slack(scalar, t, shift)) return Agreement::same;  // it may start after the contact
    if (!shifted.yes) return Agreement::decisions_differ;
    if (!shifted.gives(time)) return Agreement::same;
    const double s = shifted.values[time];
    return std::abs((t - shift) - s) <= slack(scalar, t, s) ? Agreement::same : Agreement::numbers_differ;
  });
  partners.decisions_alone = false;  // the time says from when on there is no contact
  return partners;
}

std::optional<Partners> split_motion(const Case& c, std::uint64_t seed) {
  if (!is(c, {"moving_sphere_passes_box", "moving_sphere_passes_sphere"})) return std::nullopt;
  const double limit = value(c, "limit"), part = Random(seed).power_of_two(-6, 0);
  const bool forever = value(c, "forever") != 0;
  if (!forever && part > limit) return std::nullopt;
  const auto rest = exact_sum(limit, -part, c.scalar);
  auto second = later(c, part);
  if (!rest || !second) return std::nullopt;
  Case first = c;
  value(first, "limit") = part;
  value(first, "forever") = 0;
  value(*second, "limit") = forever ? limit : *rest;
  return ordered({first, *second}, [](const Answer& own, std::span<const Answer> others) {
    return own.yes == (others[0].yes || others[1].yes) ? Agreement::same : Agreement::decisions_differ;
  });
}

// Order.

/// Queries whose yes stays a yes when a solid grows: time does not become later, depth not smaller.
bool grows(const Case& c) {
  return is(c, {"moving_sphere_plane", "moving_sphere_triangle", "moving_sphere_rectangle", "moving_sphere_sphere",
                "moving_sphere_box", "moving_sphere_capsule", "moving_sphere_passes_box",
                "moving_sphere_passes_sphere", "sphere_sphere_overlap", "sphere_box_overlap", "box_box_overlap",
                "sphere_triangle_overlap", "sphere_sphere_penetration", "sphere_plane_penetration",
                "box_plane_penetration", "sphere_box_penetration", "box_box_penetration", "box_box_conservative"});
}

/// Compares a case with one that contains it.
Agreement not_later_nor_shallower(const Query& query, Scalar scalar, const Answer& small, const Answer& large) {
  if (small.yes && !large.yes) return Agreement::decisions_differ;
  for (std::size_t i = 0; i < query.outputs.size() && small.yes; ++i) {
    if (!small.gives(i) || !large.gives(i)) continue;
    const double a = small.values[i], b = large.values[i];
    const Role role = query.outputs[i].role;
    if (role == Role::time && b > a + slack(scalar, a, b)) return Agreement::numbers_differ;
    if (role == Role::depth && b < a - slack(scalar, a, b)) return Agreement::numbers_differ;
  }
  return Agreement::same;
}

std::optional<Partners> grown_size(const Case& c, std::uint64_t seed) {
  if (!grows(c)) return std::nullopt;
  Random random(seed);
  std::vector<std::size_t> sizes;
  for (std::size_t i = 0; i < c.values.size(); ++i) {
    if (c.query->inputs[i].role == Role::size) sizes.push_back(i);
  }
  const std::size_t at = random.pick(sizes);
  // Where a sphere of radius 0 only touches, its point may slide along a small solid and lead away from a larger.
  if (has(c, "velocity.x") && value(c, "sphere.radius") == 0 && c.query->inputs[at].name != "sphere.radius") {
    return std::nullopt;
  }
  Case other = c;
  const double x = c.values[at], more = x == 0 ? random.power_of_two(-8, 2) : x * random.power_of_two(-8, 2);
  other.values[at] = rounded_to(c.scalar, x + more);
  if (!(other.values[at] > x) || !valid(other)) return std::nullopt;
  const Query& query = *c.query;
  const Scalar scalar = c.scalar;
  return ordered({std::move(other)}, [&query, scalar](const Answer& own, std::span<const Answer> others) {
    return not_later_nor_shallower(query, scalar, own, others[0]);
  });
}

std::optional<Partners> longer_limit(const Case& c, std::uint64_t seed) {
  if (!has(c, "limit")) return std::nullopt;
  Random random(seed);
  Case other = c;
  if (random.one_in(3)) {
    value(other, "forever") = 1;
  } else {
    value(other, "limit") = rounded_to(c.scalar, value(c, "limit") + random.power_of_two(-10, 4));
  }
  if (!valid(other) || other.values == c.values) return std::nullopt;
  return ordered({std::move(other)}, [](const Answer& own, std::span<const Answer> others) {
    return own.yes && !others[0].yes ? Agreement::decisions_differ : Agreement::same;
  });
}

// Different queries about the same thing.

/// A case of another query: each of its numbers has the value of the number of `c` with the same name, after the
/// beginning of the name was replaced; 0 where `c` has none, and 1 for the w of a rotation.
Case recast(const Case& c, std::string_view query, const std::map<std::string, std::string>& beginnings) {
  Case other{find_query(query), c.scalar, {}, c.origin, c.seed, c.index, c.moves};
  for (const Field& f : other.query->inputs) {
    std::string name = f.name;
    for (const auto& [theirs, ours] : beginnings) {
      if (name == theirs || name.starts_with(theirs + ".")) {
        name = fmt::format("{}{}", ours, name.substr(theirs.size()));
        break;
      }
    }
    const bool w = f.role == Role::rotation && last(f.name) == "w";
    other.values.push_back(has(c, name) ? value(c, name) : w ? 1.0 : 0.0);
  }
  return other;
}

/// The same answer in the members that both answer types have by the same name.
Partners same_answer(const Case& c, Case other, std::initializer_list<std::string_view> but = {}) {
  const Query &from = *c.query, &to = *other.query;
  const std::vector<std::string_view> not_these(but.begin(), but.end());
  Partners partners = counterpart(std::move(other), [&from, &to, not_these](const Answer& own) {
    Answer a = own;
    for (std::size_t i = 0; i < to.outputs.size(); ++i) {
      const std::size_t at = index_of(from.outputs, to.outputs[i].name);
      const bool excepted = std::any_of(not_these.begin(), not_these.end(), [&](std::string_view name) {
        return to.outputs[i].name == name || to.outputs[i].name.starts_with(fmt::format("{}.", name));
      });
      if (at == from.outputs.size() || excepted) {
        a = without(a, i);
      } else {
        carry(a, i, own, at);
      }
    }
    return a;
  });
  // What has fewer numbers has fewer moves that make an answer right.
  partners.image_keeps_ulps = to.inputs.size() >= from.inputs.size();
  return partners;
}

std::optional<Partners> prepared(const Case& c, std::uint64_t) {
  constexpr std::pair<std::string_view, std::string_view> forms[] = {
      {"closest_point_segment", "closest_point_segment_unit"},
      {"closest_point_triangle_perimeter", "closest_point_triangle_perimeter_edges"},
      {"moving_point_triangle", "moving_point_triangle_prepared"}};
  for (const auto& [plain, with_help] : forms) {
    if (c.query->name == plain) return same_answer(c, recast(c, with_help, {}));
  }
  return std::nullopt;
}

bool ends_are_one(const Case& c) {
  return value(c, "capsule.p0.x") == value(c, "capsule.p1.x") &&
         value(c, "capsule.p0.y") == value(c, "capsule.p1.y") && value(c, "capsule.p0.z") == value(c, "capsule.p1.z");
}

/// What hits here, hits there, no later; at the same time, unless it may be earlier.
Partners hit_at_the_same_time(const Case& c, Case other, bool or_earlier = false) {
  const std::size_t ours = index_of(c.query->outputs, "time"), theirs = index_of(other.query->outputs, "time");
  return ordered({std::move(other)}, [=, scalar = c.scalar](const Answer& own, std::span<const Answer> others) {
    if (!own.yes) return Agreement::same;
    if (!others[0].yes) return Agreement::decisions_differ;
    if (!own.gives(ours) || !others[0].gives(theirs)) return Agreement::same;
    const double t = own.values[ours], s = others[0].values[theirs];
    const bool alike = or_earlier ? s <= t + slack(scalar, s, t) : std::abs(s - t) <= slack(scalar, s, t);
    return alike ? Agreement::same : Agreement::numbers_differ;
  });
}

/// A capsule whose ends are one point, and a box without extents, as the sphere or point that they are.
std::optional<Partners> one_point(const Case& c, std::uint64_t) {
  if (is(c, {"moving_sphere_capsule"}) && ends_are_one(c)) {
    return same_answer(c, recast(c, "moving_sphere_sphere",
                                 {{"fixed.center", "capsule.p0"}, {"fixed.radius", "capsule.radius"}}));
  }
  if (is(c, {"moving_point_capsule"}) && ends_are_one(c)) {  // which, unlike a solid sphere, is missed from inside
    Case other = recast(c, "moving_point_sphere", {{"sphere.center", "capsule.p0"}, {"sphere.radius", "capsule.radius"}});
    value(other, "solid") = 1;
    return hit_at_the_same_time(c, std::move(other));
  }
  if (!has(c, "box.half.x") || value(c, "box.half.x") != 0 || value(c, "box.half.y") != 0 ||
      value(c, "box.half.z") != 0) {
    return std::nullopt;
  }
  if (is(c, {"moving_sphere_box"})) {
    return same_answer(c, recast(c, "moving_sphere_sphere", {{"fixed.center", "box.center"}, {"fixed.radius", "-"}}));
  }
  const std::map<std::string, std::string> names{
      {"sphere1", "sphere"}, {"sphere2.center", "box.center"}, {"sphere2.radius", "-"}};
  if (is(c, {"sphere_box_overlap"})) return same_answer(c, recast(c, "sphere_sphere_overlap", names));
  // The contacts of two spheres and of a sphere with a box are different points.
  if (is(c, {"sphere_box_penetration"})) {
    return same_answer(c, recast(c, "sphere_sphere_penetration", names), {"contact", "normal"});
  }
  return std::nullopt;
}

/// A moving sphere of radius 0 as the point that it is, and a point as such a sphere, which sees the edges of a
/// one-sided shape as well.
std::optional<Partners> sphere_as_point(const Case& c, std::uint64_t) {
  constexpr std::pair<std::string_view, std::string_view> one_sided[] = {
      {"moving_point_plane", "moving_sphere_plane"},
      {"moving_point_triangle", "moving_sphere_triangle"},
      {"moving_point_rectangle", "moving_sphere_rectangle"}};
  for (const auto& [point, sphere] : one_sided) {
    if (c.query->name != point) continue;
    return hit_at_the_same_time(c, recast(c, sphere, {{"sphere.center", "point"}}), true);
  }
  if (!has(c, "sphere.radius") || value(c, "sphere.radius") != 0) return std::nullopt;
  if (is(c, {"moving_sphere_box"})) return same_answer(c, recast(c, "moving_point_box", {{"point", "sphere.center"}}));
  if (is(c, {"moving_sphere_capsule"})) {
    return same_answer(c, recast(c, "moving_point_capsule", {{"point", "sphere.center"}}));
  }
  return std::nullopt;
}

/// A ball inside of a box or a capsule is met by nothing that does not meet these, and not before them.
std::optional<Partners> contained_ball(const Case& c, std::uint64_t) {
  struct Link {
    std::string_view outer, inner, ball;
  };
  constexpr Link links[] = {{"moving_sphere_box", "moving_sphere_sphere", "fixed"},
                            {"moving_sphere_capsule", "moving_sphere_sphere", "fixed"},
                            {"moving_sphere_passes_box", "moving_sphere_passes_sphere", "fixed"},
                            {"sphere_box_overlap", "sphere_sphere_overlap", "sphere2"}};
  const auto link = std::find_if(std::begin(links), std::end(links), [&](const Link& l) { return l.outer == c.query->name; });
  if (link == std::end(links)) return std::nullopt;
  // Where a sphere of radius 0 only touches, its point may slide along the ball and lead away from the box.
  if (has(c, "velocity.x") && value(c, "sphere.radius") == 0) return std::nullopt;
  const bool box = has(c, "box.half.x");
  const std::string ball(link->ball);
  Case other = recast(c, link->inner, {{"sphere1", "sphere"}, {ball + ".center", box ? "box.center" : "capsule.p0"}});
  value(other, ball + ".radius") =
      box ? std::min({value(c, "box.half.x"), value(c, "box.half.y"), value(c, "box.half.z")}) : value(c, "capsule.radius");
  const bool impact = c.query->kind == Kind::impact;
  const std::size_t ours = index_of(c.query->outputs, "time"), theirs = index_of(other.query->outputs, "time");
  return ordered({std::move(other)}, [=, scalar = c.scalar](const Answer& own, std::span<const Answer> others) {
    if (!others[0].yes) return Agreement::same;
    if (!own.yes) return Agreement::decisions_differ;
    if (!impact) return Agreement::same;
    if (!own.gives(ours) || !others[0].gives(theirs)) return Agreement::same;
    const double outer = own.values[ours], inner = others[0].values[theirs];
    return outer <= inner + slack(scalar, outer, inner) ? Agreement::same : Agreement::numbers_differ;
  });
}

/// A point is seen in a rectangle where it is seen in one of its triangles.
Partners seen_in_two_triangles(const Case& c) {
  std::vector<Case> others{recast(c, "point_in_triangle", {{"triangle", "rectangle"}}),
                           recast(c, "point_in_triangle",
                                  {{"triangle.v0", "rectangle.v0"},
                                   {"triangle.v1", "rectangle.v2"},
                                   {"triangle.v2", "rectangle.v3"}})};
  for (Case& other : others) value(other, "axis") = -1;
  return ordered(std::move(others), [](const Answer& own, std::span<const Answer> answers) {
    return own.yes == (answers[0].yes || answers[1].yes) ? Agreement::same : Agreement::decisions_differ;
  });
}

std::optional<Partners> two_triangles(const Case& c, std::uint64_t) {
  if (is(c, {"point_in_rectangle"})) return seen_in_two_triangles(c);
  const bool point = is(c, {"moving_point_rectangle"});
  if (!point && !is(c, {"moving_sphere_rectangle"})) return std::nullopt;
  const std::string_view query = point ? "moving_point_triangle" : "moving_sphere_triangle";
  const std::size_t theirs = index_of(find_query(query)->outputs, "time");
  const std::size_t ours = index_of(c.query->outputs, "time");
  return ordered({recast(c, query, {{"triangle", "rectangle"}}),
                  recast(c, query, {{"triangle.v0", "rectangle.v0"},
                                    {"triangle.v1", "rectangle.v2"},
                                    {"triangle.v2", "rectangle.v3"}})},
                 [=, scalar = c.scalar](const Answer& own, std::span<const Answer> others) {
                   if (own.yes != (others[0].yes || others[1].yes)) return Agreement::decisions_differ;
                   const auto tells = [theirs](const Answer& a) { return !a.yes || a.gives(theirs); };
                   if (!own.yes || !own.gives(ours) || !tells(others[0]) || !tells(others[1])) return Agreement::same;
                   const double t = own.values[ours], a = others[0].values[theirs], b = others[1].values[theirs];
                   const double first = others[0].yes && (!others[1].yes || a < b) ? a : b;
                   return std::abs(t - first) <= slack(scalar, t, first) ? Agreement::same : Agreement::numbers_differ;
                 });
}

/// Two queries one of whose yes implies the other's, or is the other's.
std::optional<Partners> same_decision(const Case& c, std::uint64_t) {
  struct Link {
    std::string_view from, to;
    bool both_ways;
  };
  constexpr Link links[] = {{"sphere_sphere_overlap", "sphere_sphere_penetration", true},
                            {"sphere_box_overlap", "sphere_box_penetration", true},
                            {"box_box_overlap", "box_box_penetration", true},
                            {"box_box_overlap", "box_box_conservative", false},
                            {"moving_point_aabox", "ray_aabox", false}};
  std::vector<Case> others;
  std::vector<bool> both_ways;
  for (const Link& l : links) {
    if (c.query->name != l.from) continue;
    Case other = recast(c, l.to, {{"ray.origin", "point"}, {"ray.direction", "velocity"}});
    if (!valid(other)) continue;
    others.push_back(std::move(other));
    both_ways.push_back(l.both_ways);
  }
  if (others.empty()) return std::nullopt;
  return ordered(std::move(others), [both_ways](const Answer& own, std::span<const Answer> answers) {
    for (std::size_t i = 0; i < answers.size(); ++i) {
      if (own.yes == answers[i].yes || (!own.yes && !both_ways[i])) continue;
      return Agreement::decisions_differ;
    }
    return Agreement::same;
  });
}

/// What hits, passes through.
std::optional<Partners> hits_pass(const Case& c, std::uint64_t) {
  const bool box = is(c, {"moving_sphere_box"});
  if (!box && !is(c, {"moving_sphere_sphere"})) return std::nullopt;
  Case other = recast(c, box ? "moving_sphere_passes_box" : "moving_sphere_passes_sphere", {});
  value(other, "forever") = 1;
  return ordered({std::move(other)}, [](const Answer& own, std::span<const Answer> others) {
    return own.yes && !others[0].yes ? Agreement::decisions_differ : Agreement::same;
  });
}

/// From the two sides of a one-sided shape at most one sees a point come.
std::optional<Partners> other_side(const Case& c, std::uint64_t) {
  Case other = c;
  if (is(c, {"moving_point_plane"})) {
    for (const char* name : {"plane.normal.x", "plane.normal.y", "plane.normal.z", "plane.offset"}) {
      value(other, name) = -value(c, name);
    }
  } else if (is(c, {"moving_point_triangle", "moving_point_triangle_prepared"})) {
    exchange(other, "triangle.v1", "triangle.v2");
  } else {
    return std::nullopt;
  }
  return ordered({std::move(other)}, [](const Answer& own, std::span<const Answer> others) {
    return own.yes && others[0].yes ? Agreement::decisions_differ : Agreement::same;
  });
}

/// The closed table. The first group follows from the roles of the numbers alone, and holds for every query.
constexpr Relation table[] = {
    {"scaled-lengths", "all lengths times a power of two: lengths of the answer alike, times unchanged", true, scaled_lengths},
    {"scaled-time", "velocities times a power of two: times divided by it", true, scaled_time},
    {"scaled-directions", "directions and planes times a power of two: nothing changes", true, scaled_directions},
    {"scaled-rotations", "quaternions times a power of two: nothing changes", true, scaled_rotations},
    {"negated-rotations", "quaternions times -1: nothing changes", true, negated_rotations},
    {"reflected", "space reflected in coordinate planes: the answer alike", false, reflected},
    {"permuted-axes", "x, y, z renamed: the answer alike", false, permuted_axes},
    {"translated", "everything moved by a vector that adds exactly: places alike", false, translated},
    {"rotated", "everything turned by a whole quaternion, and as many times larger: times and decisions alike", false, rotated},
    {"turned-corners", "corners named in another order: nothing changes but their weights", false, turned_corners},
    {"reversed-corners", "corners the other way around, where there is no front: the same but for weights and edges", false, reversed_corners},
    {"swapped", "the first thing as the second: normals turn around", false, swapped},
    {"reversed-directions", "a direction that only names a line, the other way: nothing changes", false, reversed_directions},
    {"another-hint", "another hint: nothing changes where the boxes overlap, and never the decision", false, another_hint},
    {"later-start", "the same motion from a later time on: contacts come so much earlier", false, later_start},
    {"split-motion", "a motion in two parts: it passes where one of them does", false, split_motion},
    {"grown-size", "a larger solid: hit no later, no shallower, never missed instead", false, grown_size},
    {"contained-ball", "a ball inside of a box or capsule: not hit before it, nor without it", false, contained_ball},
    {"longer-limit", "a longer limit: never fewer passes", false, longer_limit},
    {"prepared", "what is computed beforehand changes nothing", false, prepared},
    {"one-point", "a capsule with equal ends is a sphere, a box without extents a point", false, one_point},
    {"sphere-as-point", "a moving sphere of radius 0 is a moving point", false, sphere_as_point},
    {"two-triangles", "a rectangle is hit when the first of its triangles is, and seen in where one of them is", false, two_triangles},
    {"same-decision", "overlap is a depth of at least 0; boxes that meet pass the conservative test", false, same_decision},
    {"hits-pass", "what hits at some time passes within unlimited time", false, hits_pass},
    {"other-side", "a point that hits one side of a shape does not hit the other", false, other_side},
};

bool proves_wrong(const Finding& f) {
  return f.is_proved() || f.verdict == Verdict::broke;
}

constexpr double ulps_of_slack = 2;  ///< see slack()

std::string said_of(const RelationFinding& r, const Subject& subject, const Partners& partners, bool bit_for_bit,
                    Breach& breach) {
  bool exact = true, near = true;
  breach = Breach::contract;
  for (std::size_t i = 0; i < r.cases.size(); ++i) {
    if (r.findings[i].verdict == Verdict::broke) {
      breach = Breach::broke;
      return fmt::format("no answer {}: {}", i + 1, r.findings[i].clause);
    }
    if (proves_wrong(r.findings[i])) {
      return fmt::format("answer {}: {}, {}", i + 1, name_of(r.findings[i].disagreement), r.findings[i].clause);
    }
    const collide::Contract contract = subject.standard_for(r.cases[i].query->name).contract;
    exact = exact && contract.exact_decisions && r.findings[i].verdict != Verdict::out_of_domain;
    near = near && contract.forward <= ulps_of_slack;
  }
  if (r.agreement == Agreement::decisions_differ && exact && partners.decisions_alone) {
    return "decisions that are promised to be exact differ";
  }
  if (r.agreement == Agreement::numbers_differ && exact && near && !partners.image) {
    return "numbers differ by more than promised";
  }
  breach = Breach::bits;
  if (bit_for_bit && r.relation->bitwise && r.agreement != Agreement::same) {
    return "the change commutes with every rounded operation, and yet answers differ";
  }
  breach = Breach::none;
  return {};
}

/// Promises nothing, everywhere: only what is true counts.
constexpr collide::Contract no_promise{};

/// One of the decisions is wrong: the judge says which, whatever was promised.
bool some_decision_is_wrong(const RelationFinding& r) {
  for (std::size_t i = 0; i < r.cases.size(); ++i) {
    if (confirmed(r.cases[i], r.answers[i], no_promise, Detail::verdict).truth_yes != r.answers[i].yes) return true;
  }
  return false;
}

/// The judge's words on a case and on its image must not contradict each other.
std::string said_of_the_oracle(const RelationFinding& r, const Subject& subject, const Partners& partners) {
  if (!partners.image) return {};
  if (r.findings[0].verdict == Verdict::out_of_domain || r.findings[1].verdict == Verdict::out_of_domain) return {};
  if (r.findings[0].verdict == Verdict::broke) return {};
  if (r.findings[1].verdict == Verdict::broke) return {};
  if (r.findings[0].truth_yes != r.findings[1].truth_yes) return "the exact decisions differ";
  const collide::Contract contract = subject.standard_for(r.cases[1].query->name).contract;
  const collide::Contract own = subject.standard_for(r.cases[0].query->name).contract;
  if (!partners.image_keeps_ulps || contract.backward < own.backward || contract.forward < own.forward) return {};
  if (r.findings[0].verdict != Verdict::agrees) return {};  // not proved to be wrong is not yet right
  const Finding image = confirmed(r.cases[1], partners.image(r.answers[0]), contract, Detail::verdict);
  if (proves_wrong(image)) {
    return fmt::format("an answer is right, but its image is wrong: {}, {}", name_of(image.disagreement), image.clause);
  }
  return {};
}

}  // namespace

std::string_view name_of(Agreement a) {
  switch (a) {
    case Agreement::same: return "same";
    case Agreement::numbers_differ: return "numbers differ";
    case Agreement::decisions_differ: return "decisions differ";
  }
  return "?";
}

std::span<const Relation> relations() { return table; }

const Relation* find_relation(std::string_view name) {
  for (const Relation& r : table) {
    if (r.name == name) return &r;
  }
  return nullptr;
}

std::string_view name_of(Breach b) {
  switch (b) {
    case Breach::none: return "none";
    case Breach::contradiction: return "contradiction";
    case Breach::bits: return "bits";
    case Breach::contract: return "contract";
    case Breach::broke: return "broke";
  }
  return "?";
}

bool claims_same_bits(const Subject& subject) { return subject.name.starts_with("collide-"); }

bool offers_all(const Subject& subject, const Partners& partners) {
  return std::all_of(partners.cases.begin(), partners.cases.end(),
                     [&](const Case& c) { return !(subject.offering(c.query->name).answer == nullptr); });
}

bool may_be_asked_all(const Subject& subject, const Partners& partners) {
  return std::all_of(partners.cases.begin(), partners.cases.end(), [&](const Case& c) {
    return unmet_by(c, subject.offering(c.query->name).required).empty();
  });
}

RelationFinding relate(const Relation& relation, const Partners& partners, const Case& question,
                       std::vector<Answer> answers, const Subject& subject, bool bit_for_bit) {
  RelationFinding r;
  r.relation = &relation;
  r.cases.push_back(question);
  r.cases.insert(r.cases.end(), partners.cases.begin(), partners.cases.end());
  r.answers = std::move(answers);
  r.agreement = partners.compare(r.answers[0], std::span(r.answers).subspan(1));
  const bool some_broke = std::any_of(r.answers.begin(), r.answers.end(),
                                      [](const Answer& a) { return a.status == Answer::Status::broke; });
  if (r.agreement == Agreement::same && !some_broke) return r;
  for (std::size_t i = 0; i < r.cases.size(); ++i) {
    const Standard standard = subject.standard_for(r.cases[i].query->name);
    r.findings.push_back(confirmed(r.cases[i], r.answers[i], standard, Detail::verdict));
  }
  r.broken = said_of(r, subject, partners, bit_for_bit, r.breach);
  r.oracle = said_of_the_oracle(r, subject, partners);
  if (r.breach != Breach::none || r.agreement != Agreement::decisions_differ) return r;
  if (some_decision_is_wrong(r)) {
    r.breach = Breach::contradiction;
  } else if (partners.decisions_alone) {
    r.oracle = "decisions contradict each other, and the judge finds none of them wrong";
  }
  return r;
}

std::optional<RelationFinding> examine(const Relation& relation, const Case& question, std::uint64_t seed,
                                       const Subject& subject, const Ask& ask, bool bit_for_bit) {
  const auto partners = relation.of(question, seed);
  if (!partners || !offers_all(subject, *partners)) return std::nullopt;
  const Offering& own = subject.offering(question.query->name);
  if (own.answer == nullptr || !unmet_by(question, own.required).empty()) return std::nullopt;
  if (!may_be_asked_all(subject, *partners)) return std::nullopt;
  std::vector<Answer> answers{ask(question)};
  for (const Case& c : partners->cases) answers.push_back(ask(c));
  return relate(relation, *partners, question, std::move(answers), subject, bit_for_bit);
}

}  // namespace nearmiss

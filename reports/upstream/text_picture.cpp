#include "reports/upstream/text_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "impl/adapters/motion.hpp"
#include "reports/upstream/case_shapes.hpp"

namespace nearmiss {

namespace {

using namespace collide;

double component(const Vec3<double>& v, int k) { return k == 0 ? v.x : k == 1 ? v.y : v.z; }

struct Flat {
  double u = 0, v = 0;
};

/// Looks along a coordinate axis: u is to the right, v upward.
struct View {
  int right = 0, up = 1, along = 2;

  Flat flat(const Vec3<double>& p) const { return {component(p, right), component(p, up)}; }
};

/// The projection of a shape: the points within a radius of the convex hull of some points.
struct Outline {
  std::vector<Flat> points;
  double radius = 0;

  bool covers(const Flat& p) const {
    if (points.size() > 2 && in_hull(p)) return true;
    double least = HUGE_VAL;
    for (std::size_t i = 0; i < points.size(); ++i) {
      for (std::size_t j = i; j < points.size(); ++j) least = std::min(least, distance(p, points[i], points[j]));
    }
    return least <= radius;
  }

 private:
  static double cross(const Flat& a, const Flat& b, const Flat& p) {
    return (b.u - a.u) * (p.v - a.v) - (b.v - a.v) * (p.u - a.u);
  }
  static double distance(const Flat& p, const Flat& a, const Flat& b) {
    const double u = b.u - a.u, v = b.v - a.v, length2 = u * u + v * v;
    const double t = length2 > 0 ? std::clamp(((p.u - a.u) * u + (p.v - a.v) * v) / length2, 0.0, 1.0) : 0.0;
    return std::hypot(p.u - a.u - t * u, p.v - a.v - t * v);
  }
  /// By Caratheodory: in some triangle of the points.
  bool in_hull(const Flat& p) const {
    for (std::size_t i = 0; i < points.size(); ++i) {
      for (std::size_t j = i + 1; j < points.size(); ++j) {
        for (std::size_t k = j + 1; k < points.size(); ++k) {
          const double a = cross(points[i], points[j], p), b = cross(points[j], points[k], p),
                       c = cross(points[k], points[i], p);
          const bool has_area = cross(points[i], points[j], points[k]) != 0;
          if (has_area && ((a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0))) return true;
        }
      }
    }
    return false;
  }
};

/// The points whose convex hull, rounded by the radius, is the shape; none for an unbounded one.
struct Rounded {
  std::vector<Vec3<double>> points;
  double radius = 0;
};
struct ToRounded {
  Rounded operator()(const Sphere<double>& s) const { return {{s.center}, s.radius}; }
  Rounded operator()(const Capsule<double>& c) const { return {{c.p0, c.p1}, c.radius}; }
  Rounded operator()(const Triangle<double>& t) const { return {{t.v0, t.v1, t.v2}, 0}; }
  Rounded operator()(const Rectangle<double>& r) const { return {{r.v0, r.v1, r.v2, r.v3}, 0}; }
  Rounded operator()(const Segment<double>& s) const { return {{s.v0, s.v1}, 0}; }
  Rounded operator()(const AABox<double>& b) const {
    Rounded r;
    for (int i = 0; i < 8; ++i) {
      r.points.push_back({i & 1 ? b.max.x : b.min.x, i & 2 ? b.max.y : b.min.y, i & 4 ? b.max.z : b.min.z});
    }
    return r;
  }
  Rounded operator()(const Box<double>& b) const {
    const auto [x, y, z, w] = adapters::unit(b.orientation);
    const Vec3<double> e0{1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)};
    const Vec3<double> e1{2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)};
    const Vec3<double> e2{2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)};
    Rounded r;
    for (int i = 0; i < 8; ++i) {
      r.points.push_back(b.center + e0 * (i & 1 ? b.half.x : -b.half.x) + e1 * (i & 2 ? b.half.y : -b.half.y) +
                         e2 * (i & 4 ? b.half.z : -b.half.z));
    }
    return r;
  }
  template <class S>
  Rounded operator()(const S&) const {
    return {};
  }
};

/// What a case shows.
struct Things {
  std::vector<NamedShape> shapes;
  std::optional<Vec3<double>> start, velocity, contact;
  std::optional<Vec3<double>> normal;
  double time = 0;  ///< the exact time of contact
};

std::optional<Vec3<double>> exact_vector(const Report& r, const std::string& name) {
  if (r.truth.alternatives.empty()) return std::nullopt;
  const Alternative& a = r.truth.alternatives.front();
  const std::vector<Field>& outputs = r.question.query->outputs;
  for (std::size_t i = 0; i + 2 < outputs.size() && i + 2 < a.count; ++i) {
    if (outputs[i].name != name + ".x" || (name == "normal" && a.many_normals)) continue;
    const auto middle = [&](std::size_t k) { return a.values[k].low / 2 + a.values[k].high / 2; };
    return Vec3<double>{middle(i), middle(i + 1), middle(i + 2)};
  }
  return std::nullopt;
}

double exact_time(const Report& r) {
  if (r.truth.alternatives.empty() || r.question.query->outputs.empty()) return 0;
  for (std::size_t i = 0; i < r.question.query->outputs.size(); ++i) {
    const Bounds& b = r.truth.alternatives.front().values[i];
    if (r.question.query->outputs[i].role == Role::time && r.truth.yes) return b.low / 2 + b.high / 2;
  }
  return 0;
}

Things things_of(const Report& r) {
  const CaseShapes shapes(r.question);
  Things t{shapes.operands(), {}, {}, exact_vector(r, "location"), exact_vector(r, "normal"), exact_time(r)};
  if (shapes.has("velocity.x")) t.velocity = shapes.vector("velocity");
  if (shapes.has("point.x")) {
    t.start = shapes.vector("point");
  } else if (t.velocity && shapes.has("sphere.center.x")) {
    t.start = shapes.vector("sphere.center");
  }
  return t;
}

/// The view along the axis with the least of what matters.
View view_of(const Things& t, const std::vector<Rounded>& shapes) {
  std::array<double, 3> score{};
  const auto add = [&](const Vec3<double>& v) {
    const double n = adapters::length(v);
    for (int k = 0; k < 3; ++k) score[std::size_t(k)] += n > 0 ? std::abs(component(v, k)) / n : 0;
  };
  if (t.velocity) add(*t.velocity);
  if (t.normal) add(*t.normal);
  if (shapes.size() == 2 && !shapes[0].points.empty() && !shapes[1].points.empty()) {
    add(shapes[1].points.front() - shapes[0].points.front());
  }
  for (const NamedShape& o : t.shapes) {
    if (const auto* plane = std::get_if<Plane<double>>(&o.shape)) add(plane->normal);
  }
  const int along = int(std::min_element(score.rbegin(), score.rend()) - score.rbegin());
  switch (2 - along) {
    case 0: return {1, 2, 0};
    case 1: return {0, 2, 1};
    default: return {0, 1, 2};
  }
}

/// Characters over a part of the plane; the first row is the highest.
class Canvas {
 public:
  static constexpr int columns = 64, most_rows = 26;

  Canvas(const Flat& low, const Flat& high) {
    const double width = high.u - low.u, height = high.v - low.v;
    // A character is twice as high as wide.
    cell_ = std::max(width / columns, height / (2.0 * most_rows)) * 1.04;
    rows_ = std::clamp(int(std::ceil(height * 1.04 / (2 * cell_))), 1, most_rows);
    origin_ = {low.u / 2 + high.u / 2 - cell_ * columns / 2, low.v / 2 + high.v / 2 + cell_ * rows_};
    text_.assign(std::size_t(rows_), std::string(columns, ' '));
  }
  bool is_usable() const {
    return std::isfinite(cell_) && cell_ > 0 && std::isfinite(origin_.u) && std::isfinite(origin_.v);
  }
  double cell() const { return cell_; }
  template <class Letter>
  void fill(Letter letter) {
    for (int row = 0; row < rows_; ++row) {
      for (int column = 0; column < columns; ++column) {
        char& c = text_[std::size_t(row)][std::size_t(column)];
        c = letter(Flat{origin_.u + (column + 0.5) * cell_, origin_.v - (2 * row + 1) * cell_}, c);
      }
    }
  }
  void put(const Flat& p, char c) {
    if (char* at = at_point(p)) *at = c;
  }
  void put_on_blank(const Flat& p, char c) {
    char* at = at_point(p);
    if (at != nullptr && *at == ' ') *at = c;
  }
  /// Without empty rows at the top.
  std::string text() const {
    std::string all;
    for (const std::string& line : text_) {
      const std::string shown = line.substr(0, line.find_last_not_of(' ') + 1);
      if (!all.empty() || !shown.empty()) all += shown + "\n";
    }
    return all;
  }

 private:
  /// nullptr outside of the picture.
  char* at_point(const Flat& p) {
    const double column = std::floor((p.u - origin_.u) / cell_), row = std::floor((origin_.v - p.v) / (2 * cell_));
    const bool inside = column >= 0 && column < columns && row >= 0 && row < rows_;
    return inside ? &text_[std::size_t(row)][std::size_t(column)] : nullptr;
  }

  Flat origin_;  ///< the upper left corner
  double cell_ = 0;
  int rows_ = 1;
  std::vector<std::string> text_;
};

void include(Flat& low, Flat& high, const Flat& p, double radius) {
  low = {std::min(low.u, p.u - radius), std::min(low.v, p.v - radius)};
  high = {std::max(high.u, p.u + radius), std::max(high.v, p.v + radius)};
}

constexpr char letter_of(std::size_t shape) { return char('a' + shape); }

std::string legend(const Report& r, const Things& t, const View& view, double cell) {
  constexpr const char* axes[] = {"x", "y", "z"};
  std::string text = fmt::format("{} to the right, {} up; a column is {:.2g} wide, a row {:.2g} high\n",
                                 axes[view.right], axes[view.up], cell, 2 * cell);
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < t.shapes.size(); ++i) {
    const bool plane = std::holds_alternative<Plane<double>>(t.shapes[i].shape);
    parts.push_back(fmt::format("{}: {}{}", letter_of(i), plane ? "behind the " : "", t.shapes[i].name));
  }
  if (t.shapes.size() == 2) parts.push_back("#: both");
  if (t.start && t.velocity)
    parts.push_back(t.shapes.size() == 1 ? "o: the start; .: the way" : "o: the center's start; .: its way");
  if (t.contact && r.truth.yes) parts.push_back("+: the exact contact");
  return text + fmt::format("{}\n", fmt::join(parts, "; "));
}

/// Behind a plane, in the section through the middle of the picture.
bool is_behind(const Plane<double>& plane, const View& view, const Flat& p, double middle) {
  double along = plane.offset;
  for (int k = 0; k < 3; ++k) {
    along += component(plane.normal, k) * (k == view.right ? p.u : k == view.up ? p.v : middle);
  }
  return along <= 0;
}

}  // namespace

std::string text_picture(const Report& r) {
  const Things t = things_of(r);
  std::vector<Rounded> shapes;
  for (const NamedShape& o : t.shapes) {
    shapes.push_back(std::visit(ToRounded(), o.shape));
    const bool plane = std::holds_alternative<Plane<double>>(o.shape);
    if (shapes.back().points.empty() && !plane) return "";
  }
  const View view = view_of(t, shapes);
  Flat low{HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL};
  std::vector<Outline> outlines;
  double middle = 0;
  for (const Rounded& s : shapes) {
    outlines.push_back({{}, s.radius});
    for (const Vec3<double>& p : s.points) {
      outlines.back().points.push_back(view.flat(p));
      include(low, high, view.flat(p), s.radius);
      middle = component(p, view.along);
    }
  }
  if (t.start) include(low, high, view.flat(*t.start), 0), middle = component(*t.start, view.along);
  if (t.contact && r.truth.yes) include(low, high, view.flat(*t.contact), 0);
  Canvas canvas(low, high);
  if (!canvas.is_usable()) return "";
  canvas.fill([&](const Flat& p, char) {
    char c = ' ';
    for (std::size_t i = 0; i < shapes.size(); ++i) {
      const auto* plane = std::get_if<Plane<double>>(&t.shapes[i].shape);
      if (plane != nullptr ? is_behind(*plane, view, p, middle) : outlines[i].covers(p))
        c = c == ' ' ? letter_of(i) : '#';
    }
    return c;
  });
  if (t.start && t.velocity) {
    // The way beyond the picture is not drawn.
    const double speed = std::hypot(view.flat(*t.velocity).u, view.flat(*t.velocity).v);
    for (int i = 1; speed > 0 && i < 4 * Canvas::columns; ++i) {
      canvas.put_on_blank(view.flat(*t.start + *t.velocity * (i * canvas.cell() / speed)), '.');
    }
    canvas.put(view.flat(*t.start), 'o');
  }
  if (t.contact && r.truth.yes) canvas.put(view.flat(*t.contact), '+');
  return canvas.text() + "\n" + legend(r, t, view, canvas.cell());
}

}  // namespace nearmiss

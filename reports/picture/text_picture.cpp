#include "reports/picture/text_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "reports/picture/drawn_case.hpp"
#include "reports/picture/flat_picture.hpp"

namespace nearmiss {

namespace {

struct Flat {
  double u = 0, v = 0;
};

/// A vector in doubles.
using Numbers = std::array<double, 3>;
Numbers numbers_of(const PictureVector& v) { return {rounded(v.x), rounded(v.y), rounded(v.z)}; }

/// Looks along a coordinate axis: u is to the right, v upward.
struct View {
  std::size_t right = 0, up = 1, along = 2;

  Flat flat(const PictureVector& p) const {
    const Numbers n = numbers_of(p);
    return {n[right], n[up]};
  }
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

/// What is drawn with letters: every shape but a point, which is the start of a motion or nothing.
struct Things {
  std::vector<PictureShape> shapes;
  std::optional<PictureVector> start, velocity, contact, normal;
};

Things things_of(const Report& r) {
  const DrawnCase c = drawn_case(r);
  Things t{{}, {}, c.inputs.velocity, {}, c.exact.normal};
  if (c.exact.yes && !c.exact.places.empty()) t.contact = c.exact.places[0];
  for (const PictureShape& s : c.inputs.shapes) {
    const bool is_start = s.shape == Shape::point || (t.velocity && s.moves && s.shape == Shape::sphere);
    if (is_start && !t.start) t.start = s.corners[0];
    if (s.is_body() && s.shape != Shape::point) t.shapes.push_back(s);
  }
  return t;
}

/// The view along the axis with the least of what matters.
View view_of(const Things& t) {
  Numbers score{};
  const auto add = [&](const PictureVector& v) {
    const Numbers n = numbers_of(unit(v));
    for (std::size_t k = 0; k < 3; ++k) score[k] += std::abs(n[k]);
  };
  if (t.velocity) add(*t.velocity);
  if (t.normal) add(*t.normal);
  if (t.shapes.size() == 2 && !t.shapes[0].corners.empty() && !t.shapes[1].corners.empty())
    add(t.shapes[1].corners[0] - t.shapes[0].corners[0]);
  for (const PictureShape& s : t.shapes) {
    if (s.has_one_plane()) add(s.axis);
  }
  const auto along = std::min_element(score.rbegin(), score.rend()) - score.rbegin();
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

std::string legend(const Things& t, const View& view, double cell) {
  constexpr const char* axes[] = {"x", "y", "z"};
  std::string text = fmt::format("{} to the right, {} up; a column is {:.2g} wide, a row {:.2g} high\n",
                                 axes[view.right], axes[view.up], cell, 2 * cell);
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < t.shapes.size(); ++i) {
    const bool plane = t.shapes[i].shape == Shape::plane;
    parts.push_back(fmt::format("{}: {}{}", letter_of(i), plane ? "behind the " : "", t.shapes[i].name));
  }
  if (t.shapes.size() == 2) parts.push_back("#: both");
  if (t.start && t.velocity)
    parts.push_back(t.shapes.size() == 1 ? "o: the start; .: the way" : "o: the center's start; .: its way");
  if (t.contact) parts.push_back("+: the exact contact");
  return text + fmt::format("{}\n", fmt::join(parts, "; "));
}

/// Behind a plane, in the section through the middle of the picture.
bool is_behind(const PictureShape& plane, const View& view, const Flat& p, double middle) {
  const Numbers normal = numbers_of(plane.axis);
  return normal[view.right] * p.u + normal[view.up] * p.v + normal[view.along] * middle + rounded(plane.offset) <= 0;
}

}  // namespace

std::string text_picture(const Report& r) {
  const Things t = things_of(r);
  const bool is_unbounded = std::ranges::any_of(
      t.shapes, [](const PictureShape& s) { return s.shape == Shape::ray || s.shape == Shape::line; });
  if (is_unbounded) return "";
  const View view = view_of(t);
  Flat low{HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL};
  std::vector<Outline> outlines;
  double middle = 0;
  for (const PictureShape& s : t.shapes) {
    outlines.push_back({{}, rounded(s.radius)});
    for (const PictureVector& p : rounded_points(s)) {
      outlines.back().points.push_back(view.flat(p));
      include(low, high, view.flat(p), rounded(s.radius));
      middle = numbers_of(p)[view.along];
    }
  }
  if (t.start) include(low, high, view.flat(*t.start), 0), middle = numbers_of(*t.start)[view.along];
  if (t.contact) include(low, high, view.flat(*t.contact), 0);
  Canvas canvas(low, high);
  if (!canvas.is_usable()) return "";
  canvas.fill([&](const Flat& p, char) {
    char c = ' ';
    for (std::size_t i = 0; i < t.shapes.size(); ++i) {
      const bool is_plane = t.shapes[i].has_one_plane();
      if (is_plane ? is_behind(t.shapes[i], view, p, middle) : outlines[i].covers(p)) c = c == ' ' ? letter_of(i) : '#';
    }
    return c;
  });
  if (t.start && t.velocity) {
    // The way beyond the picture is not drawn.
    const double speed = std::hypot(view.flat(*t.velocity).u, view.flat(*t.velocity).v);
    for (int i = 1; speed > 0 && i < 4 * Canvas::columns; ++i) {
      canvas.put_on_blank(view.flat(*t.start + *t.velocity * PictureReal(i * canvas.cell() / speed)), '.');
    }
    canvas.put(view.flat(*t.start), 'o');
  }
  if (t.contact) canvas.put(view.flat(*t.contact), '+');
  const std::string text = canvas.text();
  return text.empty() ? "" : text + "\n" + legend(t, view, canvas.cell());
}

}  // namespace nearmiss

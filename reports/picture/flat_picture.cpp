#include "reports/picture/flat_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "reports/findings/report_text.hpp"
#include "reports/findings/text.hpp"
#include "reports/picture/drawn_case.hpp"

namespace nearmiss {

namespace {

/// Twice the area of the triangle, positive where it is counterclockwise.
double turn(const FlatPoint& a, const FlatPoint& b, const FlatPoint& c) {
  return (b.right - a.right) * (c.up - a.up) - (b.up - a.up) * (c.right - a.right);
}

/// The part of a convex polygon where a . p + d <= 0.
std::vector<FlatPoint> clipped(const std::vector<FlatPoint>& polygon, const FlatPoint& a, double d) {
  std::vector<FlatPoint> left;
  const auto side = [&](const FlatPoint& p) { return a.right * p.right + a.up * p.up + d; };
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const FlatPoint &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    if (side(p) <= 0) left.push_back(p);
    if ((side(p) < 0 && side(q) > 0) || (side(p) > 0 && side(q) < 0))
      left.push_back(p + (q - p) * (side(p) / (side(p) - side(q))));
  }
  return left;
}

/// A rectangle that contains the view, whose border is out of sight.
std::vector<FlatPoint> around_the_view() {
  constexpr double right = FlatView::width / 2 + 10, up = FlatView::height / 2 + 10;
  return {{-right, -up}, {right, -up}, {right, up}, {-right, up}};
}

/// An orthogonal projection. What is seen is `right`, `up` and nearer along `toward`.
struct Sight {
  PictureVector right, up, toward;

  FlatPoint flat(const PictureVector& p) const { return {rounded(dot(p, right)), rounded(dot(p, up))}; }
};

const PictureVector coordinate_axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

/// Along the unit vector or against it: a coordinate axis is to the right or upward where it can be, y and z upward.
Sight sight_along(const PictureVector& along) {
  const PictureReal x = abs(along.x), y = abs(along.y), z = abs(along.z);
  const PictureVector &to_right = x > y && x > z ? coordinate_axes[1] : coordinate_axes[0],
                      &upward = z >= x && z >= y ? coordinate_axes[1] : coordinate_axes[2];
  const PictureVector up = unit(upward - along * dot(along, upward));
  const PictureVector right = unit(to_right - along * dot(along, to_right) - up * dot(up, to_right));
  return {right, up, cross(right, up)};
}

/// The share of the unit vector's length that is seen.
double seen_share(const PictureVector& along, const PictureVector& v) { return rounded(length(cross(along, v))); }

/// Less is taken for parallel: half a degree.
constexpr double least_angle = std::numbers::pi / 360;

/// The smallest rectangle with these discs.
class Extent {
 public:
  void include(const FlatPoint& p, double radius = 0) {
    low_ = {std::min(low_.right, p.right - radius), std::min(low_.up, p.up - radius)};
    high_ = {std::max(high_.right, p.right + radius), std::max(high_.up, p.up + radius)};
  }
  double width() const { return high_.right - low_.right; }
  double height() const { return high_.up - low_.up; }
  double most() const { return std::max(width(), height()); }
  FlatPoint middle() const { return low_ * 0.5 + high_ * 0.5; }

 private:
  FlatPoint low_{HUGE_VAL, HUGE_VAL}, high_{-HUGE_VAL, -HUGE_VAL};
};

/// 0.577, 1: at most three decimals. No number of an enclosure's middle is so near to a tie that compilers differ.
std::string short_text(double x) {
  if (!std::isfinite(x)) return number_text(std::abs(x));
  const std::string text = fmt::format("{:.3f}", x + std::copysign(1e-9, x));
  const std::string without = text.substr(0, text.find_last_not_of('0') + 1);
  const std::string shown = without.ends_with('.') ? without.substr(0, without.size() - 1) : without;
  return shown == "-0" ? "0" : shown;
}
std::string four_digits(double x) { return fmt::format("{:.4g}", x + 0.0); }
std::string triple_text(const std::array<double, 3>& v, std::string (*text)(double)) {
  return fmt::format("({}, {}, {})", text(v[0]), text(v[1]), text(v[2]));
}

/// The text, or six digits of the number where the text is longer.
std::string shortened(const std::string& text, double x) {
  constexpr std::size_t most = 9;
  return text.size() <= most ? text : fmt::format("≈{:.6g}", x);
}

/// An answer in the picture.
struct Side {
  Ink ink;
  DrawnContact contact;
  std::optional<PictureShape> mover;  ///< at the time of contact
  std::optional<PictureVector> foot;  ///< of the arrow
};

class Drawing {
 public:
  explicit Drawing(const Report& r) : report_(r), case_(drawn_case(r)) {
    add_side(Ink::exact, case_.exact);
    if (case_.given) add_side(Ink::given, *case_.given);
    choose_anchor();
    choose_sights();
  }

  FlatPicture picture() const {
    FlatPicture p;
    // All of it is a point where it is seen from its end, with no scale of its own.
    const double first = pixels_per_unit(sights_[0]), second = pixels_per_unit(sights_[1]);
    const double pixels = std::isfinite(first) ? first : second;
    if (!(pixels > 0) || !std::isfinite(pixels)) return p;
    p.views.push_back(view(sights_[0], pixels, middle(sights_[0])));
    p.views.push_back(view(sights_[1], std::isfinite(second) ? second : pixels, middle(sights_[1])));
    if (const auto part = too_small(pixels)) {
      add_enlarged(p, *part, pixels);
    }
    p.legend = legend(p);
    return p;
  }

 private:
  struct Part {
    PictureVector middle;
    double size;
  };
  static constexpr double margin = 38;       ///< of a view, in pixels: an arrow of `plain_arrow` fits
  static constexpr double plain_arrow = 34;  ///< pixels, of a normal without a depth, or with one too short to be seen
  static constexpr double least_size = 12;   ///< pixels; what is smaller is enlarged
  static constexpr double room = std::min(FlatView::width, FlatView::height) - 2 * margin;

  const PictureInputs& inputs() const { return case_.inputs; }

  void add_side(Ink ink, const DrawnContact& contact) {
    Side s{ink, contact, {}, {}};
    const PictureShape* mover = inputs().moving();
    const bool moves = mover != nullptr && inputs().velocity && contact.yes && mover->shape != Shape::point;
    if (moves) {
      s.mover = *mover;
      move_by(*s.mover, *inputs().velocity * contact.time.value_or(inputs().time_of_approach()));
    }
    sides_.push_back(s);
  }

  /// Coordinates become those about a place of contact.
  void choose_anchor() {
    PictureVector at = inputs().where_shapes_meet();
    if (inputs().velocity && inputs().moving() != nullptr) {
      PictureInputs then = inputs();
      const PictureReal time = case_.exact.time.value_or(inputs().time_of_approach());
      for (PictureShape& s : then.shapes) {
        if (s.moves) move_by(s, *inputs().velocity * time);
      }
      at = then.where_shapes_meet();
    }
    for (const Side& s : sides_) {
      if (s.contact.places.empty()) continue;
      at = s.contact.places[0];
      break;
    }
    const PictureVector by = at * PictureReal(-1);
    for (PictureShape& s : case_.inputs.shapes) move_by(s, by);
    for (Side& s : sides_) {
      if (s.mover) move_by(*s.mover, by);
      for (PictureVector& p : s.contact.places) p = p + by;
      s.foot = s.contact.places.empty() ? PictureVector{} : s.contact.places[0];
    }
  }

  /// Unit vectors, the most important first.
  std::vector<PictureVector> important() const {
    std::vector<PictureVector> all;
    const auto add = [&](const std::optional<PictureVector>& v) {
      if (v && length(*v) > 0) all.push_back(unit(*v));
    };
    const std::optional<PictureVector>& exact = sides_[0].contact.normal;
    const std::optional<PictureVector> given = sides_.size() > 1 ? sides_[1].contact.normal : std::nullopt;
    const bool differ = exact && given && length(cross(unit(*exact), unit(*given))) > least_angle;
    if (!differ) add(inputs().velocity);
    add(exact);
    add(given);
    if (differ) add(inputs().velocity);
    for (const PictureShape& s : inputs().shapes) {
      if (s.has_one_plane() || s.shape == Shape::ray || s.shape == Shape::line) add(s.axis);
    }
    const PictureShape *first = inputs().first_body(), *other = inputs().other_than(first);
    if (first != nullptr && other != nullptr && !first->corners.empty() && !other->corners.empty())
      add(other->corners[0] - first->corners[0]);
    for (const PictureShape& s : inputs().shapes) {
      if (s.corners.size() == 2) add(s.corners[1] - s.corners[0]);
    }
    return all;
  }

  /// Of what matters most, the share that is seen least.
  static double worth(const PictureVector& along, const std::vector<PictureVector>& vectors) {
    double least = 1;
    for (std::size_t i = 0; i < std::min(vectors.size(), std::size_t(3)); ++i)
      least = std::min(least, seen_share(along, vectors[i]));
    return least;
  }
  void choose_sights() {
    const std::vector<PictureVector> vectors = important();
    std::vector<PictureVector> by_axes = {coordinate_axes[2], coordinate_axes[1], coordinate_axes[0]};
    std::ranges::stable_sort(by_axes, std::greater(), [&](const PictureVector& a) { return worth(a, vectors); });
    PictureVector along = by_axes[0], second = by_axes[1];
    constexpr double nearly_whole = 0.9;
    if (worth(along, vectors) < nearly_whole) {
      for (std::size_t i = 1; i < vectors.size(); ++i) {
        const PictureVector across = cross(vectors[0], vectors[i]);
        if (length(across) <= least_angle) continue;
        along = unit(across);
        second = cross(along, vectors[0]);
        break;
      }
    }
    sights_ = {sight_along(along), sight_along(second)};
  }

  static void include(Extent& e, const Sight& sight, const PictureShape& s) {
    for (const PictureVector& p : rounded_points(s)) e.include(sight.flat(p), rounded(s.radius));
  }
  /// The shapes at their start and the exact contact; what is given, too, where the picture stays of that size.
  Extent extent(const Sight& sight) const {
    Extent e;
    e.include({});
    for (const PictureShape& s : inputs().shapes) {
      include(e, sight, s);
      if (s.shape == Shape::ray || s.shape == Shape::line) e.include(sight.flat(s.corners[0]));
      if (s.has_one_plane()) e.include(sight.flat(nearest_point(s, {})));
    }
    for (const Side& s : sides_) {
      Extent with = e;
      if (s.mover) include(with, sight, *s.mover);
      for (const PictureVector& p : s.contact.places) with.include(sight.flat(p));
      if (s.contact.normal && s.contact.depth)
        with.include(sight.flat(*s.foot + unit(*s.contact.normal) * *s.contact.depth));
      constexpr double most_growth = 4;
      if (s.ink == Ink::exact || with.most() <= most_growth * e.most()) e = with;
    }
    return e;
  }
  double pixels_per_unit(const Sight& sight) const {
    const Extent e = extent(sight);
    return std::min((FlatView::width - 2 * margin) / e.width(), (FlatView::height - 2 * margin) / e.height());
  }
  FlatPoint middle(const Sight& sight) const { return extent(sight).middle(); }

  FlatView view(const Sight& sight, double pixels, const FlatPoint& middle) const {
    FlatView v{.pixels_per_unit = pixels};
    for (std::size_t k = 0; k < 3; ++k) v.axes[k] = sight.flat(coordinate_axes[k]);
    const auto at = [&](const PictureVector& p) { return (sight.flat(p) - middle) * pixels; };
    bool is_first = true;
    for (const PictureShape& s : inputs().shapes) {
      if (!s.is_body()) continue;
      v.outlines.push_back(outline(is_first ? Ink::first_shape : Ink::other_shape, s, sight, at, pixels));
      is_first = false;
    }
    if (const auto end = end_of_way()) v.arrows.push_back({Ink::way, at(start()), at(*end)});
    for (const Side& s : sides_) {
      if (s.mover) v.outlines.push_back(outline(s.ink, *s.mover, sight, at, pixels));
    }
    add_contacts(v, sight, at);
    return v;
  }

  template <class At>
  FlatOutline outline(Ink ink, const PictureShape& s, const Sight& sight, const At& at, double pixels) const {
    if (s.has_one_plane()) {
      const FlatPoint n = sight.flat(s.axis), zero = at({});
      const double d = rounded(s.offset) * pixels - (n.right * zero.right + n.up * zero.up);
      return {ink, clipped(around_the_view(), n, d), 0};
    }
    std::vector<FlatPoint> points;
    for (const PictureVector& p : rounded_points(s)) points.push_back(at(p));
    if (points.empty()) {  // beyond the view on both sides, or on one
      const FlatPoint along = sight.flat(unit(s.axis)) * (4 * FlatView::width);
      points = {at(s.corners[0]) + along, s.shape == Shape::line ? at(s.corners[0]) - along : at(s.corners[0])};
    }
    FlatOutline o{ink, convex_hull(points), rounded(s.radius) * pixels};
    if (o.radius == 0 && o.corners.size() > 2) {
      for (std::size_t k = 0; k < 4; ++k) {
        const FlatPoint side = around_the_view()[k];
        const FlatPoint outward = k % 2 == 0 ? FlatPoint{0, side.up} : FlatPoint{side.right, 0};
        o.corners = clipped(o.corners, outward, -(outward.right * side.right + outward.up * side.up));
      }
    }
    add_edges(o, s, sight, at);
    return o;
  }
  /// Of a box the edges at the corner that is nearest to the viewer, where they are not on the outline.
  template <class At>
  static void add_edges(FlatOutline& o, const PictureShape& s, const Sight& sight, const At& at) {
    if (s.axes.empty()) return;
    std::array<PictureVector, 3> toward;
    std::array<bool, 3> is_seen{};
    PictureVector corner = s.corners[0];
    for (std::size_t k = 0; k < 3; ++k) {
      const PictureReal facing = dot(s.axes[k], sight.toward);
      toward[k] = s.axes[k] * (facing > 0 ? s.half[k] : -s.half[k]);
      is_seen[k] = abs(facing) > least_angle;
      corner = corner + toward[k];
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const bool is_inside = is_seen[(k + 1) % 3] && is_seen[(k + 2) % 3];
      if (is_inside) o.edges.push_back({at(corner), at(corner - toward[k] * PictureReal(2))});
    }
  }

  PictureVector start() const {
    PictureVector sum;
    const PictureShape& mover = *inputs().moving();
    for (const PictureVector& c : mover.corners) sum = sum + c;
    return sum * (1 / PictureReal(mover.corners.size()));
  }
  /// The way is drawn to the last contact, or past the nearest approach by a half, at least for a unit of time.
  std::optional<PictureVector> end_of_way() const {
    if (!inputs().velocity || inputs().moving() == nullptr || inputs().moving()->corners.empty()) return std::nullopt;
    std::optional<PictureReal> end;
    for (const Side& s : sides_) {
      if (s.contact.time && (!end || *s.contact.time > *end)) end = s.contact.time;
    }
    if (!end) end = std::max<PictureReal>(1, inputs().time_of_approach() * PictureReal(1.5));
    if (inputs().time && *end > *inputs().time) end = PictureReal(*inputs().time);
    return start() + *inputs().velocity * *end;
  }

  /// How long an arrow is, in pixels: as long as the depth, or 0 for `plain_arrow` on both sides.
  double depth_pixels(const Side& s, double pixels) const {
    double most = 0;
    for (const Side& any : sides_) {
      if (any.contact.depth && any.contact.normal)
        most = std::max(most, std::abs(rounded(*any.contact.depth)) * pixels);
    }
    if (most < 2 * least_size || !s.contact.depth) return plain_arrow;
    return std::max(least_size, std::abs(rounded(*s.contact.depth)) * pixels);
  }
  template <class At>
  void add_contacts(FlatView& v, const Sight& sight, const At& at) const {
    for (const Side& s : sides_) {
      if (!s.contact.yes) continue;
      if (s.contact.places.empty()) v.marks.push_back({s.ink, at({})});
      for (const PictureVector& p : s.contact.places) v.marks.push_back({s.ink, at(p)});
      if (!s.contact.normal) continue;
      const FlatPoint from = at(*s.foot);
      v.arrows.push_back(
          {s.ink, from, from + sight.flat(unit(*s.contact.normal)) * depth_pixels(s, v.pixels_per_unit)});
    }
  }

  /// How large the shape is seen: its thickness, where that is thinner than a line.
  double size_of(const PictureShape& s, double pixels) const {
    double most = 0;
    for (const Sight& sight : sights_) {
      Extent e;
      include(e, sight, s);
      most = std::max(most, e.most());
    }
    constexpr double line = 3;  // pixels
    double thickness = s.half.empty() ? 2 * rounded(s.radius) : HUGE_VAL;
    for (const PictureReal& half : s.half) thickness = std::min(thickness, 2 * rounded(half));
    return thickness > 0 && thickness * pixels < line ? thickness : most;
  }
  /// What matters and is too small to be seen at this scale.
  std::optional<Part> too_small(double pixels) const {
    const auto part = [&](const PictureVector& middle, double size) {
      constexpr double least_ratio = 1e-5;  // of the room; less is a rounding of float, or none
      const bool is_small = size * pixels < least_size && size * pixels > least_ratio * room;
      return is_small ? std::optional(Part{middle, size}) : std::nullopt;
    };
    for (const PictureShape& s : inputs().shapes) {
      if (rounded_points(s).empty()) continue;
      const PictureVector at = s.moves ? PictureVector{} : nearest_point(s, {});
      if (const auto p = part(at, size_of(s, pixels))) return p;
    }
    std::vector<Part> all;
    if (sides_.size() > 1 && !sides_[0].contact.places.empty() && !sides_[1].contact.places.empty()) {
      const PictureVector &exact = *sides_[0].foot, &given = *sides_[1].foot;
      all.push_back({(exact + given) * PictureReal(0.5), rounded(length(exact - given))});
    }
    for (const Side& s : sides_) {
      if (s.contact.depth && *s.contact.depth != 0) all.push_back({{}, std::abs(rounded(*s.contact.depth))});
    }
    const PictureShape *first = inputs().first_body(), *other = inputs().other_than(first);
    if (!inputs().velocity && first != nullptr && other != nullptr && !case_.exact.yes) {
      const auto [p, q] = meeting(*first, *other);
      all.push_back({(p + q) * PictureReal(0.5), rounded(length(p - q))});
    }
    for (const Part& p : all) {
      if (const auto found = part(p.middle, p.size)) return found;
    }
    return std::nullopt;
  }
  void add_enlarged(FlatPicture& p, const Part& part, double pixels) const {
    constexpr double share = 0.35;  // of the view's room that the part takes
    const Sight& sight = sights_[0];
    FlatView v = view(sight, share * room / part.size, sight.flat(part.middle));
    v.enlarged = v.pixels_per_unit / pixels;
    p.views.push_back(v);
    const FlatPoint at = (sight.flat(part.middle) - middle(sight)) * pixels;
    const double right = std::max(5.0, FlatView::width / 2 / v.enlarged),
                 up = right * FlatView::height / FlatView::width;
    p.views[0].outlines.push_back({Ink::frame,
                                   {at + FlatPoint{-right, -up}, at + FlatPoint{right, -up}, at + FlatPoint{right, up},
                                    at + FlatPoint{-right, up}},
                                   0});
  }

  /// ", normal (0, 0, 1)" as it is given, also where it is none.
  std::string normal_text(bool yes, const std::function<std::optional<double>(std::size_t)>& number) const {
    const Layout::Part* part = report_.question.query->layout.at(Role::normal);
    if (!yes || part == nullptr) return "";
    const auto x = number(part->begin), y = number(part->begin + 1), z = number(part->begin + 2);
    return x && y && z ? ", normal " + triple_text({*x, *y, *z}, short_text) : "";
  }
  /// ", at (1, 2, 3)" where the two places differ by what is seen.
  std::string place_text(const PictureVector& place, double pixels) const {
    const bool differ = sides_.size() > 1 && !sides_[0].contact.places.empty() && !sides_[1].contact.places.empty() &&
                        rounded(length(*sides_[0].foot - *sides_[1].foot)) * pixels > 2;
    return differ ? ", at " + triple_text({rounded(place.x), rounded(place.y), rounded(place.z)}, four_digits) : "";
  }
  /// A truth with one answer, as truth_text() reads it; none where no number says how much.
  static Truth said(bool yes, std::vector<std::string> decimals) {
    Truth t;
    t.yes = yes;
    if (decimals.empty()) return t;
    t.alternatives.resize(1);
    t.alternatives[0].yes = yes;
    t.alternatives[0].count = decimals.size();
    t.alternatives[0].decimals = std::move(decimals);
    return t;
  }
  std::string exact_text(double pixels) const {
    const Query& query = *report_.question.query;
    const std::vector<Alternative>& all = report_.truth.alternatives;
    if (all.empty()) return truth_text(query, report_.truth);
    const Alternative& a = all[case_.alternative];
    const auto middle = [&](std::size_t i) { return a.values[i].low / 2 + a.values[i].high / 2; };
    std::vector<std::string> decimals;
    for (std::size_t i = 0; i < a.count; ++i) decimals.push_back(shortened(a.decimals[i], middle(i)));
    Truth t = said(report_.truth.yes, decimals);
    t.because = report_.truth.because;
    std::string text = truth_text(query, t);
    if (a.yes && a.many_normals) {
      text += ", any of many normals";
    } else {
      text += normal_text(a.yes, [&](std::size_t i) { return std::optional(middle(i)); });
    }
    return case_.exact.places.empty() ? text : text + place_text(case_.exact.places[0], pixels);
  }
  std::string given_text(double pixels) const {
    const Query& query = *report_.question.query;
    const Answer& answer = report_.answer;
    if (!case_.given) return "no answer: it " + answer_text(query, answer, report_.question.scalar);
    std::vector<std::string> decimals;
    bool has_measure = false;
    for (std::size_t i = 0; i < query.outputs.size(); ++i) {
      const bool is_given = is_part(query, answer, i);
      has_measure = has_measure || (is_given && !is_discrete(query.outputs[i].role));
      const std::string text = is_given ? value_text(answer.values[i], report_.question.scalar) : "?";
      decimals.push_back(shortened(text, answer.values[i]));
    }
    if (!has_measure) decimals.clear();
    std::string text = truth_text(query, said(answer.yes, decimals));
    text += normal_text(answer.yes, [&](std::size_t i) {
      return is_part(query, answer, i) ? std::optional(answer.values[i]) : std::nullopt;
    });
    return case_.given->places.empty() ? text : text + place_text(case_.given->places[0], pixels);
  }
  std::vector<FlatLegend> legend(const FlatPicture& p) const {
    const Query& query = *report_.question.query;
    std::vector<FlatLegend> lines{{Ink::frame, fmt::format("{}, {}", query.name, report_.subject)}};
    for (const PictureShape& s : inputs().shapes) {
      if (s.is_body()) lines.push_back({lines.size() == 1 ? Ink::first_shape : Ink::other_shape, s.name});
    }
    if (inputs().velocity) lines.push_back({Ink::way, "motion"});
    const double pixels = p.views.back().pixels_per_unit;
    lines.push_back({Ink::exact, "exactly, " + exact_text(pixels)});
    lines.push_back({Ink::given, "given: " + given_text(pixels)});
    return lines;
  }

  const Report& report_;
  DrawnCase case_;
  std::vector<Side> sides_;  ///< the exact one, then the given one
  std::vector<Sight> sights_;
};

bool is_finite(const Case& question) {
  return std::ranges::all_of(question.values, [](double x) { return std::isfinite(x); });
}

}  // namespace

std::vector<PictureVector> rounded_points(const PictureShape& s) {
  if (s.has_one_plane() || s.shape == Shape::ray || s.shape == Shape::line) return {};
  if (s.axes.empty()) return s.corners;
  std::vector<PictureVector> corners;
  for (int i = 0; i < 8; ++i) {
    PictureVector p = s.corners[0];
    for (std::size_t k = 0; k < 3; ++k) p = p + s.axes[k] * (i >> k & 1 ? s.half[k] : -s.half[k]);
    corners.push_back(p);
  }
  return corners;
}

std::vector<FlatPoint> convex_hull(std::vector<FlatPoint> points) {
  std::ranges::sort(points, {}, [](const FlatPoint& p) { return std::pair(p.right, p.up); });
  constexpr double same = 1e-6;  // pixels
  const auto [repeated, end] =
      std::ranges::unique(points, [](const FlatPoint& a, const FlatPoint& b) { return (a - b).length() < same; });
  points.erase(repeated, end);
  if (points.size() < 3) return points;
  std::vector<FlatPoint> hull;
  for (int half = 0; half < 2; ++half) {  // the lower chain, then the upper one
    const std::size_t start = hull.size();
    for (const FlatPoint& p : points) {
      while (hull.size() >= start + 2 && turn(hull[hull.size() - 2], hull.back(), p) <= same) hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    std::ranges::reverse(points);
  }
  return hull;
}

FlatPicture flat_picture(const Report& r) {
  const bool has_body = std::ranges::any_of(picture_inputs(r.question).shapes, &PictureShape::is_body);
  return has_body && is_finite(r.question) ? Drawing(r).picture() : FlatPicture{};
}

}  // namespace nearmiss

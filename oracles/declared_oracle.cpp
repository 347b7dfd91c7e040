#include "oracles/declared_oracle.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "impl/catalogue/query_ids.hpp"
#include "impl/subject/floating_point.hpp"
#include "oracles/derived_case.hpp"
#include "oracles/exact_decision.hpp"
#include "oracles/motion_numbers.hpp"
#include "oracles/requirements.hpp"
#include "oracles/seen_from_behind.hpp"
#include "oracles/touch.hpp"

namespace nearmiss {

namespace {

using Long = long double;
static_assert(std::numeric_limits<Long>::digits >= 64, "the slack of a Range is derived from it");

/// An interval in long double. Each operation adds the rounding of its result, at most 2^-63 of it, to both sides.
struct Range {
  Long low, high;

  static Range around(Long low, Long high) {
    const Long slack = std::max(std::abs(low), std::abs(high)) * 0x1p-62L;
    return {low - slack, high + slack};
  }
  static Range of(const Bounds& b) { return {b.low, b.high}; }
  static Range within(double x, double by) { return around(Long(x) - by, Long(x) + by); }
  Bounds bounds() const {
    const auto down = [](Long x) { return std::nextafter(double(x), -HUGE_VAL); };
    return {down(low), -down(-high)};
  }
  bool is_finite() const { return std::isfinite(low) && std::isfinite(high); }
};
Range operator+(const Range& a, const Range& b) { return Range::around(a.low + b.low, a.high + b.high); }
Range operator-(const Range& a, const Range& b) { return Range::around(a.low - b.high, a.high - b.low); }
Range operator*(const Range& a, const Range& b) {
  const auto [low, high] = std::minmax({a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high});
  return Range::around(low, high);
}
constexpr Bounds anything{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};

Bounds magnitude_of(const Bounds& b) { return {b.nearest_to_zero(), b.furthest_from_zero()}; }

std::uint64_t bits_of(const Layout::Part& p) { return ((std::uint64_t{1} << (p.end - p.begin)) - 1) << p.begin; }

Answer with_normal_reversed(const Case& c, Answer a) {
  for (std::size_t i = 0; i < c.query->outputs.size(); ++i) {
    if (c.query->outputs[i].role == Role::normal) a.values[i] = -a.values[i];
  }
  return a;
}

std::string reversed_sign(std::string decimal) {
  if (decimal.empty() || decimal == "0") return decimal;
  if (decimal.front() == '-') return decimal.substr(1);
  return "-" + decimal;
}

void reverse_normals(const Query& query, Alternative& a) {
  for (std::size_t i = 0; i < std::min(a.count, query.outputs.size()); ++i) {
    if (query.outputs[i].role != Role::normal) continue;
    a.values[i] = {-a.values[i].high, -a.values[i].low};
    if (i < a.nearest.size()) a.nearest[i] = -a.nearest[i];
    if (i < a.decimals.size()) a.decimals[i] = reversed_sign(a.decimals[i]);
  }
  for (Alternative::Face& f : a.facing) f.range = {-f.range.high, -f.range.low};
}

void exchange_weights(const Case& c, Alternative& a) {
  for (const Layout::Part& p : c.query->layout.parts) {
    if (p.role != Role::weight || p.end - p.begin != 3 || a.count < p.end) continue;
    std::swap(a.values[p.begin + 1], a.values[p.begin + 2]);
    std::swap(a.nearest[p.begin + 1], a.nearest[p.begin + 2]);
    std::swap(a.decimals[p.begin + 1], a.decimals[p.begin + 2]);
  }
}

void exchange_weights(const Case& c, Enclosure& e) {
  for (std::size_t member = 0; member < c.query->layout.parts.size(); ++member) {
    const Layout::Part& p = c.query->layout.parts[member];
    if (p.role != Role::weight || p.end - p.begin != 3) continue;
    const int one = int(p.begin) + 1, other = one + 1;
    std::swap(e.error[p.begin + 1], e.error[p.begin + 2]);
    for (int* number : {&e.worst, &e.members[member].number})
      *number = *number == one ? other : *number == other ? one : *number;
  }
}

void set_number(Alternative& a, std::size_t i, double x) {
  a.values[i] = {x, x}, a.nearest[i] = x, a.decimals[i] = fmt::format("{}", x);
}

/// The case whose limit of time counts: no flag says that there is none.
Case with_limit(Case c) {
  for (std::size_t i = 0; i < c.values.size(); ++i) {
    if (c.role(i) == Role::flag) c.values[i] = 0;
  }
  return c;
}

/// A power of two that is several times as long as the motion needs to leave everything in the case; empty where
/// nothing moves, or where that number overflows.
std::optional<double> time_beyond_all(const Case& c, const MotionNumbers& m) {
  double reach = 0;
  for (std::size_t i = 0; i < c.values.size(); ++i) {
    const Role role = c.role(i);
    if (role == Role::position || role == Role::size) reach += std::abs(c.values[i]);
  }
  const double speed = std::hypot(c.values[m.way], c.values[m.way + 1], c.values[m.way + 2]);
  const double time = std::exp2(std::ceil(std::log2(reach / speed)) + 3);
  return speed > 0 && std::isfinite(time) && time > 0 && std::isfinite(time * speed) ? std::optional(time)
                                                                                     : std::nullopt;
}

}  // namespace

bool exact_decision(const Case& question, Conventions declared) {
  if (declared.empty()) return exact_decision(question);
  const FloatingPointScope standard_modes;
  const Answer none{};
  return DeclaredOracle(question, none, declared).exact().may_be_yes;
}

DeclaredOracle::DeclaredOracle(const Case& question, const Answer& answer, Conventions declared)
    : question_(question), answer_(answer) {
  for (const Convention c : all_conventions) {
    if (declared.has(c) && concerns(c, *question.query)) declared_.add(c);
  }
  if (declared_.empty()) return;
  const bool ends_by_limit = has(Convention::ends_at_time_one) && question.query->kind != Kind::impact;
  Case meant = ends_by_limit ? with_limit(question) : question;
  if (ends_by_limit) {
    const std::size_t limit = question.operands().at(Role::time)->begin;
    const bool is_forever = meant.values != question.values;
    meant.values[limit] = is_forever ? 1 : std::min(meant.values[limit], 1.0);
  }
  views_.push_back(view_of(meant, answer, false));
  if (!has(Convention::two_sided)) return;
  if (const auto behind = seen_from_behind(meant)) views_.push_back(view_of(*behind, answer, true));
}

DeclaredOracle::View DeclaredOracle::view_of(const Case& question, Answer answer, bool from_behind) const {
  const bool turned = has(Convention::normal_reversed) != (from_behind && has(Convention::normal_of_front));
  if (turned) answer = with_normal_reversed(question, answer);
  if (from_behind) answer = seen_from_behind(question, answer);
  if (has(Convention::center_for_contact)) answer.given &= ~bits_of(*part(Role::position));
  return {question, answer, from_behind};
}

const Layout::Part* DeclaredOracle::part(Role role) const {
  const auto& parts = question_.query->layout.parts;
  const auto found = std::find_if(parts.begin(), parts.end(), [&](const Part& p) { return p.role == role; });
  return found == parts.end() ? nullptr : &*found;
}

Enclosure DeclaredOracle::interval(Widening widening) const {
  if (declared_.empty())
    return oracle_of(*question_.query).interval(question_.values, widening, answer_, question_.scalar);
  const bool is_still = std::all_of(widening.begin(), widening.end(), [](double w) { return w == 0; });
  return under({false, widening, is_still}).enclosure;
}

Enclosure DeclaredOracle::exact(AlternativeList* list) const {
  if (declared_.empty()) return oracle_of(*question_.query).exact(question_.values, answer_, question_.scalar, list);
  const std::vector<double> still(question_.values.size());
  lists_ = list != nullptr;
  Result r = under({true, still, true});
  lists_ = false;
  if (list != nullptr) list->all = std::move(r.right);
  return r.enclosure;
}

bool DeclaredOracle::may_be_on_surface(Widening widening, std::size_t number, double ulps) const {
  const Oracle& oracle = oracle_of(*question_.query);
  if (oracle.may_be_on_surface == nullptr || has(Convention::center_for_contact)) return true;
  return oracle.may_be_on_surface(question_.values, widening, answer_, number, ulps, question_.scalar);
}

DeclaredOracle::Result DeclaredOracle::ask(const Case& question, const Answer& answer, const Asked& asked) const {
  const Oracle& oracle = oracle_of(*question.query);
  if (!asked.exactly) return {oracle.interval(question.values, asked.widening, answer, question.scalar)};
  Result r;
  AlternativeList list;
  r.enclosure = oracle.exact(question.values, answer, question.scalar, lists() ? &list : nullptr);
  r.right = std::move(list.all);
  return r;
}

DeclaredOracle::Result DeclaredOracle::under(const Asked& asked) const { return by_start(of_views(asked), asked); }

DeclaredOracle::Result DeclaredOracle::of_views(const Asked& asked) const {
  if (views_.size() == 1) return of_view(views_[0], asked);
  if (question_.query->kind == Kind::depth) return of_sides(asked);
  Result front = of_view(views_[0], asked), back = of_view(views_[1], asked);
  // A sure hit of one side would hide that intervals leave the other one open.
  const bool may_both_hit = front.enclosure.may_be_yes && back.enclosure.may_be_yes;
  if (may_both_hit && asked.is_still && !asked.exactly) {
    const Asked exactly{true, asked.widening, true};
    front = of_view(views_[0], exactly), back = of_view(views_[1], exactly);
  }
  return front_or_back(std::move(front), std::move(back));
}

std::optional<bool> DeclaredOracle::is_behind(const Asked& asked) const {
  const Operand& plane = *question_.operands().find(Shape::plane);
  std::optional<std::size_t> center;
  for (const Operand& o : question_.operands()) {
    if (o.shape != Shape::plane && !o.positions.empty()) center = o.positions[0];
  }
  if (!center) return std::nullopt;
  DerivedCase point(question_, QueryId::sphere_plane_penetration);
  point.set_vector("sphere.center", *center);
  point.set_vector("plane.normal", *plane.direction);
  point.set("plane.offset", *plane.offset);
  if (asked.is_still && !exact_decision(point.question())) return false;
  const std::vector<double> moves = point.of_inputs({asked.widening.begin(), asked.widening.end()});
  const std::optional<bool> front = decision_within(point.question(), moves);
  if (front == std::optional(false)) return false;
  const Case behind = *seen_from_behind(point.question());
  const bool is_not_on_it = asked.is_still ? !exact_decision(behind) : decision_within(behind, moves) == false;
  return is_not_on_it ? std::optional(true) : std::nullopt;
}

DeclaredOracle::Result DeclaredOracle::of_sides(const Asked& asked) const {
  const std::optional<bool> behind = is_behind(asked);
  if (behind) return of_view(views_[*behind ? 1 : 0], asked);
  return either(of_view(views_[0], asked), of_view(views_[1], asked));
}

DeclaredOracle::Result DeclaredOracle::of_view(const View& view, const Asked& asked) const {
  Result r = ask(view.question, view.answer, asked);
  const bool turned = has(Convention::normal_reversed) != (view.from_behind && has(Convention::normal_of_front));
  for (Alternative& a : r.right) {
    if (turned) reverse_normals(*question_.query, a);
    if (view.from_behind) exchange_weights(question_, a);
  }
  if (view.from_behind) exchange_weights(question_, r.enclosure);
  const bool is_yes = r.enclosure.may_be_yes && !r.enclosure.may_be_no;
  if (has(Convention::strict_touch) && asked.is_still && is_yes && touches_exactly(view.question)) return no();
  if (has(Convention::center_for_contact)) r = with_center(std::move(r), view, asked);
  if (has(Convention::ends_at_time_one) && question_.query->kind == Kind::impact)
    r = until_time_one(std::move(r), view, asked);
  return r;
}

/// The place is p + v t, t the exact time.
DeclaredOracle::Result DeclaredOracle::with_center(Result r, const View& view, const Asked& asked) const {
  const Part& place = *part(Role::position);
  const std::size_t time = part(Role::time)->begin;
  const MotionNumbers m = *motion_numbers_of(view.question);
  const auto number = [&](std::size_t i) { return Range::within(view.question.values[i], asked.widening[i]); };
  for (Alternative& a : r.right) {
    if (!a.yes || a.count < place.end) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const Range at = number(m.place + k) + number(m.way + k) * Range::of(a.values[time]);
      set_number(a, place.begin + k, double((at.low + at.high) / 2));
      a.values[place.begin + k] = at.bounds();
    }
  }
  Enclosure& e = r.enclosure;
  if (!answer_.yes || !e.may_be_yes) return r;
  std::array<Bounds, 3> off, magnitude;
  const Range t = Range::of({answer_.values[time], answer_.values[time]}) + Range::of(e.error[time]);
  for (std::size_t k = 0; k < 3; ++k) {
    const double given = answer_.values[place.begin + k];
    const Range at = number(m.place + k) + number(m.way + k) * t;
    const bool is_known = t.is_finite() && at.is_finite() && std::isfinite(given);
    off[k] = is_known ? (at - Range{given, given}).bounds() : anything;
    magnitude[k] = is_known ? magnitude_of(at.bounds()) : Bounds{0, HUGE_VAL};
  }
  compare(e, place, off, magnitude);
  return r;
}

DeclaredOracle::Result DeclaredOracle::until_time_one(Result r, const View& view, const Asked& asked) const {
  if (!r.enclosure.may_be_yes) return r;
  const std::size_t time = part(Role::time)->begin;
  Answer at_one;
  at_one.yes = true, at_one.count = answer_.count, at_one.given = std::uint64_t{1} << time, at_one.values[time] = 1;
  const bool lists_all = std::exchange(lists_, false);
  const Bounds after = ask(view.question, at_one, asked).enclosure.error[time];
  lists_ = lists_all;
  if (after.low > 0) return no();
  return after.high <= 0 ? r : either(std::move(r), no());
}

std::optional<bool> DeclaredOracle::starts_in_contact(const Asked& asked) const {
  const auto moves = asked.is_still ? Widening{} : asked.widening;
  const std::optional<bool> front = contact_at_start(question_, moves);
  const bool has_space_behind = question_.operands().start->obstacle.shape == Shape::plane;
  if (!has_space_behind || views_.size() == 1 || front == std::optional(false)) return front;
  const std::optional<bool> back = contact_at_start(views_[1].question, moves);
  return back == std::optional(false) ? back : front && back ? front : std::nullopt;
}

DeclaredOracle::Result DeclaredOracle::by_start(Result r, const Asked& asked) const {
  const bool is_miss = has(Convention::start_is_miss), leaves = has(Convention::exit_from_start);
  if (!is_miss && !leaves && !has(Convention::start_is_hit)) return r;
  const std::optional<bool> contact = starts_in_contact(asked);
  if (contact == std::optional(false)) return r;
  Result other;
  if (is_miss) {
    other = r.enclosure.may_be_yes ? no() : r;
  } else if (leaves) {
    auto exit = where_it_leaves(asked);
    if (!exit) return r;
    other = std::move(*exit);
    for (Alternative& a : other.right) {
      if (has(Convention::normal_reversed)) reverse_normals(*question_.query, a);
    }
  } else {
    other = hit_at_start(r);
  }
  return contact ? other : either(std::move(r), std::move(other));
}

/// What the catalogue calls a hit at time 0 keeps its place and normal.
DeclaredOracle::Result DeclaredOracle::hit_at_start(Result r) const {
  const std::size_t time = part(Role::time)->begin;
  const bool is_hit = r.enclosure.may_be_yes && !r.enclosure.may_be_no;
  std::erase_if(r.right, [&](const Alternative& a) { return !a.yes || a.values[time].nearest_to_zero() > 0; });
  if (!is_hit || (lists() && r.right.empty())) return open_hit_at_start();
  if (!answer_.yes) return r;
  const Long given = answer_.values[time];
  const Bounds& error = r.enclosure.error[time];
  if (given + error.low == 0 && given + error.high == 0) return r;
  if (given + error.low > 0 || given + error.high < 0) return open_hit_at_start();
  return either(std::move(r), open_hit_at_start());
}

/// A hit at time 0 with any place and any normal.
DeclaredOracle::Result DeclaredOracle::open_hit_at_start() const {
  const Part& time = *part(Role::time);
  const double given = answer_.values[time.begin];
  Result hit;
  Enclosure& e = hit.enclosure;
  e.may_be_yes = true, e.may_match = answer_.yes, e.answers = 1;
  if (answer_.yes) {
    for (const Part& p : question_.query->layout.parts) leave_open(e, p);
    const Bounds off = std::isfinite(given) ? Bounds{-given, -given} : anything, exact{0, 0};
    compare(e, time, {&off, 1}, {&exact, 1});
  }
  if (lists()) hit.right.push_back(start_as_hit());
  return hit;
}

/// The numbers up to the time: the place is the start, and the other ones are open.
Alternative DeclaredOracle::start_as_hit() const {
  const Part &time = *part(Role::time), &place = *part(Role::position);
  Alternative a;
  a.yes = true, a.count = time.end;
  a.nearest.resize(a.count), a.decimals.resize(a.count);
  for (std::size_t i = 0; i < a.count; ++i) {
    const Role role = question_.query->outputs[i].role;
    const double at =
        role == Role::position ? question_.values[question_.operands().start->place + i - place.begin] : 0;
    set_number(a, i, role == Role::flag ? 1 : at);
  }
  return a;
}

/// A query with a flag for it has this meaning itself. Otherwise the end of the contact is the first contact of the
/// reversed motion, which comes from beyond everything. The rounding of its start widens that case.
std::optional<DeclaredOracle::Result> DeclaredOracle::where_it_leaves(const Asked& asked) const {
  const View& view = views_[0];
  if (const InputMember* solid = question_.operands().at(Role::flag); solid != nullptr && solid->name == "solid") {
    Case hollow = view.question;
    hollow.values[solid->begin] = 0;
    return ask(hollow, view.answer, asked);
  }
  const auto motion = motion_numbers_of(view.question);
  if (!motion) return std::nullopt;
  const auto beyond = time_beyond_all(view.question, *motion);
  if (!beyond) return std::nullopt;
  const double* way_of_case = &view.question.values[motion->way];
  const double speed = std::hypot(way_of_case[0], way_of_case[1], way_of_case[2]);
  const double turned = *std::max_element(&asked.widening[motion->way], &asked.widening[motion->way] + 3);
  if (4 * turned > speed) return unknown();  // some motion in the neighbourhood may not come from beyond
  Case back = view.question;
  back.scalar = Scalar::float64;
  std::vector<double> moves(asked.widening.begin(), asked.widening.end());
  for (std::size_t k = 0; k < 3; ++k) {
    double &place = back.values[motion->place + k], &way = back.values[motion->way + k];
    const double on = *beyond * way, rounding = (std::abs(place) + std::abs(on)) * 0x1p-51;
    moves[motion->place + k] += *beyond * moves[motion->way + k] + rounding;
    place += on, way = -way;
  }
  const Part *time = part(Role::time), *place = part(Role::position), *normal = part(Role::normal);
  Answer from_beyond = view.answer;
  const std::uint64_t compared = bits_of(*place) | (normal == nullptr ? 0 : bits_of(*normal));
  from_beyond.given &= compared;
  if (time != nullptr) from_beyond.values[time->begin] = *beyond - answer_.values[time->begin];
  const Oracle& oracle = oracle_of(*back.query);
  Result r{oracle.interval(back.values, moves, from_beyond, question_.scalar)};
  Enclosure& e = r.enclosure;
  if (asked.is_still) e.may_be_no = false;  // the reversed motion meets what it comes from
  if (e.may_be_no || !e.may_be_yes) return unknown();
  if (time != nullptr && answer_.yes) {
    const std::size_t i = time->begin;
    const Range exact =
        Range{*beyond, *beyond} - (Range{from_beyond.values[i], from_beyond.values[i]} + Range::of(e.error[i]));
    const bool is_known = exact.is_finite() && std::isfinite(answer_.values[i]);
    const Bounds off = is_known ? (exact - Range{answer_.values[i], answer_.values[i]}).bounds() : anything;
    const Bounds magnitude = is_known ? magnitude_of(exact.bounds()) : Bounds{0, HUGE_VAL};
    compare(e, *time, {&off, 1}, {&magnitude, 1});
  }
  if (lists()) {
    AlternativeList list;
    oracle.exact(back.values, Answer{}, question_.scalar, &list);
    r.right = std::move(list.all);
    // The rounded start of the reversed motion may just miss what the motion grazes: then only the hit is known.
    const bool misses = std::erase_if(r.right, [](const Alternative& a) { return !a.yes; }) > 0;
    if (misses && r.right.empty()) r.right.emplace_back().yes = true;
    for (Alternative& a : r.right) {
      if (time != nullptr && a.count > time->begin) set_number(a, time->begin, *beyond - a.nearest[time->begin]);
    }
  }
  return r;
}

DeclaredOracle::Result DeclaredOracle::unknown() const {
  Result r;
  Enclosure& e = r.enclosure;
  e.may_be_yes = e.may_be_no = e.may_match = true;
  e.error.fill(anything);
  for (Enclosure::Member& m : e.members) m = {true, 0, 0, -1};
  e.ulps_at_most = e.ulps_at_most_of_any = HUGE_VAL;
  return r;
}

DeclaredOracle::Result DeclaredOracle::no() const {
  Result r;
  Enclosure& e = r.enclosure;
  e.may_be_no = true, e.may_match = !answer_.yes, e.answers = 1;
  if (!answer_.yes) {
    for (const Part& p : question_.query->layout.parts) leave_open(e, p);
  }
  if (lists()) r.right.emplace_back();
  return r;
}

/// One of them is right, and it is not known which.
DeclaredOracle::Result DeclaredOracle::either(Result a, Result b) const {
  if (!compares(a.enclosure) || (compares(b.enclosure) && b.enclosure.ulps < a.enclosure.ulps)) std::swap(a, b);
  Enclosure& e = a.enclosure;
  const Enclosure& other = b.enclosure;
  e.may_be_yes = e.may_be_yes || other.may_be_yes, e.may_be_no = e.may_be_no || other.may_be_no;
  e.branches |= other.branches, e.answers += other.answers;
  a.right.insert(a.right.end(), b.right.begin(), b.right.end());
  if (!compares(other)) return a;
  e.may_match = e.may_match || other.may_match;
  e.ulps_at_most_of_any = std::max(e.ulps_at_most_of_any, other.ulps_at_most_of_any);
  for (std::size_t i = 0; i < e.error.size(); ++i) e.error[i].include(other.error[i]);
  for (std::size_t i = 0; i < e.members.size(); ++i) {
    Enclosure::Member &m = e.members[i], o = other.members[i];
    o.may_match = o.may_match || m.may_match;
    if (m.number < 0 || (o.number >= 0 && o.ulps < m.ulps)) std::swap(m, o);
    m.may_match = m.may_match || o.may_match;
  }
  return a;
}

/// Certainly the first of two hits, for every input.
bool DeclaredOracle::is_earlier(const Enclosure& a, const Enclosure& b) const {
  const Part* time = part(Role::time);
  const auto is_hit = [](const Enclosure& e) { return e.may_be_yes && !e.may_be_no; };
  if (time == nullptr || !answer_.yes || !is_hit(a) || !is_hit(b)) return false;
  return a.error[time->begin].high < b.error[time->begin].low;
}

/// Leaves out each miss beside a hit, and each hit that is certainly later than another one.
void DeclaredOracle::keep_earliest(std::vector<Alternative>& all) const {
  const bool any_yes = std::any_of(all.begin(), all.end(), [](const Alternative& a) { return a.yes; });
  if (any_yes) std::erase_if(all, [](const Alternative& a) { return !a.yes; });
  const Part* time = part(Role::time);
  if (!any_yes || time == nullptr) return;
  double first = HUGE_VAL;
  for (const Alternative& a : all) first = std::min(first, a.values[time->begin].high);
  std::erase_if(all, [&](const Alternative& a) { return a.values[time->begin].low > first; });
}

/// A hit of either side; of two hits the earlier one.
DeclaredOracle::Result DeclaredOracle::front_or_back(Result front, Result back) const {
  if (is_earlier(front.enclosure, back.enclosure)) return front;
  if (is_earlier(back.enclosure, front.enclosure)) return back;
  const Enclosure f = front.enclosure, b = back.enclosure;
  Result r = either(std::move(front), std::move(back));
  Enclosure& e = r.enclosure;
  e.may_be_no = f.may_be_no && b.may_be_no;
  if (!answer_.yes) {
    e.may_match = f.may_match && b.may_match;
    for (std::size_t i = 0; i < e.members.size(); ++i)
      e.members[i].may_match = f.members[i].may_match && b.members[i].may_match;
  }
  keep_earliest(r.right);
  return r;
}

void DeclaredOracle::leave_open(Enclosure& e, const Part& p) const {
  const auto member = std::size_t(&p - question_.query->layout.parts.data());
  e.members[member] = {true, 0, 0, int(p.begin)};
}

void DeclaredOracle::compare(Enclosure& e, const Part& p, std::span<const Bounds> off,
                             std::span<const Bounds> magnitude) const {
  const Scalar scalar = question_.scalar;
  const auto unit = [&](double x) { return ulp(std::min(x, largest_finite(scalar)), scalar); };
  Bounds largest{0, 0};
  for (std::size_t k = 0; k < off.size(); ++k) {
    const double given = std::abs(answer_.values[p.begin + k]);
    largest = {std::max({largest.low, given, magnitude[k].low}), std::max({largest.high, given, magnitude[k].high})};
  }
  Enclosure::Member m{false, 0, 0, int(p.begin)};
  double most = 0;
  for (std::size_t k = 0; k < off.size(); ++k) {
    e.error[p.begin + k] = off[k];
    if (!answer_.gives(p.begin + k)) continue;
    const double least = off[k].nearest_to_zero() / unit(largest.high);
    most = std::max(most, off[k].furthest_from_zero() / unit(largest.low));
    if (least > m.ulps) m = {false, least, off[k].nearest_to_zero(), int(p.begin + k)};
  }
  m.may_match = m.ulps <= 1;
  const auto member = std::size_t(&p - question_.query->layout.parts.data());
  e.members[member] = m;
  e.may_match = e.may_match && m.may_match;
  if (m.ulps > e.ulps || e.worst < 0) e.ulps = m.ulps, e.absolute = m.absolute, e.worst = m.number;
  e.ulps_at_most = std::max(e.ulps_at_most, most), e.ulps_at_most_of_any = std::max(e.ulps_at_most_of_any, most);
}

}  // namespace nearmiss

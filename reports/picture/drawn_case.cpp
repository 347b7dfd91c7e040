#include "reports/picture/drawn_case.hpp"

#include <algorithm>
#include <cmath>

namespace nearmiss {

namespace {

/// The numbers of an answer; an exact one is the middle of its enclosure.
struct GivenNumbers {
  std::vector<double> values;
  std::vector<bool> are_given;
};

GivenNumbers numbers_in(const Query& query, const Answer& answer) {
  GivenNumbers n;
  for (std::size_t i = 0; i < query.outputs.size(); ++i) {
    n.values.push_back(answer.values[i]);
    n.are_given.push_back(is_part(query, answer, i) && std::isfinite(answer.values[i]));
  }
  return n;
}

GivenNumbers numbers_in(const Query& query, const Alternative& a) {
  GivenNumbers n;
  for (std::size_t i = 0; i < query.outputs.size(); ++i) {
    const Role role = query.outputs[i].role;
    const bool is_known = i < a.count && (a.yes || !decides(query.kind) || role == Role::depth) &&
                          !(role == Role::normal && a.many_normals);
    n.values.push_back(is_known ? a.values[i].low / 2 + a.values[i].high / 2 : 0);
    n.are_given.push_back(is_known && std::isfinite(n.values.back()));
  }
  return n;
}

/// False for an entry of a list whose flag says that it is no contact.
bool is_contact(const Query& query, const Layout::Part& part, const GivenNumbers& numbers) {
  if (!part.is_entry) return true;
  const std::string entry = part.name.substr(0, part.name.rfind('.') + 1);
  return std::ranges::none_of(query.layout.parts, [&](const Layout::Part& other) {
    return other.role == Role::flag && other.name.starts_with(entry) && numbers.values[other.begin] == 0;
  });
}

DrawnContact contact_of(const Query& query, bool yes, const GivenNumbers& numbers) {
  DrawnContact c;
  c.yes = yes;
  for (const Layout::Part& part : query.layout.parts) {
    bool is_given = true;
    for (std::size_t i = part.begin; i < part.end; ++i) is_given = is_given && numbers.are_given[i];
    if (!is_given) continue;
    const double* at = numbers.values.data() + part.begin;
    if (part.role == Role::time && !c.time) c.time = at[0];
    if (part.role == Role::depth) c.depth = at[0];
    if (!part.is_vector() || query.traits.frame == OutputFrame::operands) continue;
    const PictureVector v{at[0], at[1], at[2]};
    if (part.role == Role::position && is_contact(query, part, numbers)) c.places.push_back(v);
    if ((part.role == Role::normal || query.kind == Kind::direction) && length(v) > 0) c.normal = v;
  }
  return c;
}

/// Of the places and of the unit normals, in sum.
PictureReal difference(const DrawnContact& a, const DrawnContact& b) {
  PictureReal sum = 0;
  for (std::size_t i = 0; i < std::min(a.places.size(), b.places.size()); ++i) sum += length(a.places[i] - b.places[i]);
  if (a.normal && b.normal) sum += length(unit(*a.normal) - unit(*b.normal));
  return sum;
}

}  // namespace

DrawnCase drawn_case(const Report& r) {
  const Query& query = *r.question.query;
  DrawnCase c{picture_inputs(r.question), {}, 0, {}};
  c.exact.yes = r.truth.yes;
  if (r.answer.status == Answer::Status::answered)
    c.given = contact_of(query, r.answer.yes, numbers_in(query, r.answer));
  std::optional<PictureReal> least;
  for (std::size_t i = 0; i < r.truth.alternatives.size(); ++i) {
    const DrawnContact exact = contact_of(query, r.truth.yes, numbers_in(query, r.truth.alternatives[i]));
    const PictureReal d = c.given ? difference(exact, *c.given) : PictureReal(0);
    if (!least || d < *least) c.exact = exact, c.alternative = i, least = d;
  }
  return c;
}

}  // namespace nearmiss

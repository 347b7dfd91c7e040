#include "reports/page/picture.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "reports/picture/picture_shapes.hpp"

namespace nearmiss {

namespace {

using Json = nlohmann::ordered_json;

/// A vector of an answer: three enclosures, each one number for a subject's answer.
struct PictureValue {
  std::string name;
  std::array<double, 3> low{}, high{};

  PictureVector middle() const {
    const auto mid = [&](std::size_t i) { return (PictureReal(low[i]) + PictureReal(high[i])) / 2; };
    return {mid(0), mid(1), mid(2)};
  }
  PictureVector half() const {
    const auto width = [&](std::size_t i) { return (PictureReal(high[i]) - PictureReal(low[i])) / 2; };
    return {width(0), width(1), width(2)};
  }
  bool is_finite() const {
    return std::all_of(low.begin(), low.end(), [](double x) { return std::isfinite(x); }) &&
           std::all_of(high.begin(), high.end(), [](double x) { return std::isfinite(x); });
  }
};

/// What an answer or an alternative says about the contact.
struct PictureContact {
  std::vector<PictureValue> places, directions;
  std::optional<std::array<double, 2>> time;
};

const nlohmann::json* value_at(const nlohmann::json& values, std::string name) {
  std::replace(name.begin(), name.end(), '.', '/');
  const nlohmann::json::json_pointer pointer("/" + name);
  return values.contains(pointer) ? &values.at(pointer) : nullptr;
}

/// A number, or an enclosure [low, high]; empty for a number that is not finite, which is text.
std::optional<std::array<double, 2>> bounds_in(const nlohmann::json& j) {
  if (j.is_number()) return std::array{j.get<double>(), j.get<double>()};
  if (!j.is_array() || j.size() != 2 || !j[0].is_number() || !j[1].is_number()) return std::nullopt;
  return std::array{j[0].get<double>(), j[1].get<double>()};
}

/// A vector as [x, y, z] or, for the enclosure of an item of a list, as {"x", "y", "z"}.
std::optional<PictureValue> vector_in(const nlohmann::json& values, const std::string& name) {
  const nlohmann::json* j = value_at(values, name);
  if (j == nullptr || j->size() != 3) return std::nullopt;
  PictureValue v{name};
  for (std::size_t i = 0; i < 3; ++i) {
    const char component[] = {"xyz"[i], '\0'};
    const nlohmann::json* number = j->is_array() ? &j->at(i) : value_at(*j, component);
    const auto b = number == nullptr ? std::nullopt : bounds_in(*number);
    if (!b) return std::nullopt;
    v.low[i] = (*b)[0], v.high[i] = (*b)[1];
  }
  return v.is_finite() ? std::optional(v) : std::nullopt;
}

/// False for an item of a list that says by a flag beside the member that it has no meaning: a corner that is no
/// contact.
bool has_meaning(const Query& query, std::size_t part, const nlohmann::json& values) {
  const std::string& name = query.layout.parts[part].name;
  const std::size_t item = name.rfind('.');
  if (item == std::string::npos) return true;
  for (std::size_t p = 0; p < query.layout.parts.size(); ++p) {
    const std::string& other = query.layout.parts[p].name;
    if (query.layout.parts[p].role != Role::flag || other.substr(0, other.rfind('.')) != name.substr(0, item)) continue;
    const nlohmann::json* flag = value_at(values, other);
    const bool unset = flag == nullptr || *flag == false || *flag == nlohmann::json::array({0.0, 0.0});
    if (unset) return false;
  }
  return true;
}

PictureContact contact_in(const Query& query, const nlohmann::json& values) {
  PictureContact c;
  if (query.traits.frame == OutputFrame::operands) return c;  // not in the space of the inputs
  for (std::size_t p = 0; p < query.layout.parts.size(); ++p) {
    const Layout::Part& part = query.layout.parts[p];
    const std::string& name = part.name;
    if (part.role == Role::time && !c.time) {
      if (const nlohmann::json* t = value_at(values, name)) c.time = bounds_in(*t);
    }
    if (part.end - part.begin != 3 || !has_meaning(query, p, values)) continue;
    const bool is_direction = part.role == Role::normal || query.kind == Kind::direction;
    if (!is_direction && part.role != Role::position) continue;
    if (const auto v = vector_in(values, name)) (is_direction ? c.directions : c.places).push_back(*v);
  }
  return c;
}

PictureReal distance_of(const PictureContact& a, const PictureContact& b) {
  PictureReal most = 0;
  for (std::size_t i = 0; i < std::min(a.places.size(), b.places.size()); ++i)
    most = std::max<PictureReal>(most, length(a.places[i].middle() - b.places[i].middle()));
  return most;
}

/// Assembles the picture of one report.
class CasePicture {
 public:
  CasePicture(const Case& question, const FileValue& report) : question_(question), inputs_(picture_inputs(question)) {
    const FileValue answer = report.at("answer");
    if (answer.at("status").text() == "answered") claimed_ = contact_in(*question.query, answer.at("values").json());
    for (const FileValue& a : report.at("truth").at("alternatives").items())
      true_.push_back(contact_in(*question.query, a.at("values").json()));
    std::stable_sort(true_.begin(), true_.end(), [&](const PictureContact& a, const PictureContact& b) {
      return distance_of(a, claimed_) < distance_of(b, claimed_);
    });
    choose_time();
    choose_anchor();
    choose_unit();
  }

  Json to_json() const {
    Json j{{"scalar", name_of(question_.scalar)}, {"anchor", Json::array({anchor_[0], anchor_[1], anchor_[2]})},
           {"unit_exponent", unit_exponent_},     {"ulp", rounded(ulp_at_anchor() / unit_)},
           {"reach", rounded(reach_ / unit_)},    {"shapes", Json::array()}};
    for (const PictureShape& s : inputs_.shapes) j["shapes"].push_back(shape_to_json(s, unit_));
    j["motion"] = motion();
    j["contacts"] = Json::array();
    for (const PictureContact& c : true_) add_contact(j["contacts"], c, &c == true_.data() ? "true" : "also true");
    add_contact(j["contacts"], claimed_, "claimed");
    return j;
  }

 private:
  /// The time for which the moving shapes are placed: the true time of contact, otherwise the claimed one, otherwise
  /// that of the nearest approach.
  void choose_time() {
    if (!inputs_.velocity || dot(*inputs_.velocity, *inputs_.velocity) == 0) return;
    if (!true_.empty() && true_[0].time) {
      time_ = (PictureReal((*true_[0].time)[0]) + PictureReal((*true_[0].time)[1])) / 2;
    } else if (claimed_.time) {
      time_ = (*claimed_.time)[0];
    } else if (inputs_.time && !decides(question_.query->kind)) {
      time_ = *inputs_.time;
    } else {
      time_ = inputs_.time_of_approach();
    }
    for (PictureShape& s : inputs_.shapes) {
      if (s.moves) move_by(s, *inputs_.velocity * time_);
    }
  }

  /// The point that the coordinates are relative to, rounded to a number of the scalar.
  void choose_anchor() {
    PictureVector at;
    if (!true_.empty() && !true_[0].places.empty()) {
      at = true_[0].places[0].middle();
    } else if (!claimed_.places.empty()) {
      at = claimed_.places[0].middle();
    } else {
      at = inputs_.where_shapes_meet();
    }
    anchor_ = {in_scalar_of(at.x), in_scalar_of(at.y), in_scalar_of(at.z)};
    for (PictureShape& s : inputs_.shapes) move_by(s, anchor() * PictureReal(-1));
  }
  double in_scalar_of(const PictureReal& x) const {
    const double most = largest_finite(question_.scalar), d = std::clamp(x.convert_to<double>(), -most, most);
    return question_.scalar == Scalar::float32 ? double(float(d)) : d;
  }
  PictureVector anchor() const { return {anchor_[0], anchor_[1], anchor_[2]}; }
  /// Of the anchor's largest coordinate; of the largest input where the anchor is the origin.
  PictureReal ulp_at_anchor() const {
    double most = 0;
    for (const double x : anchor_) most = std::max(most, std::abs(x));
    for (std::size_t i = 0; most == 0 && i < question_.values.size(); ++i) {
      if (question_.role(i) == Role::position || question_.role(i) == Role::size) most = std::abs(question_.values[i]);
    }
    return ulp(most == 0 ? 1.0 : most, question_.scalar);
  }

  /// The picture is as large as its shapes, its true contacts and the way of what moves.
  void choose_unit() {
    for (const PictureShape& s : inputs_.shapes) reach_ = std::max<PictureReal>(reach_, reach(s));
    if (reach_ == 0) reach_ = distance_of_planes();
    for (const PictureContact& c : true_) {
      for (const PictureValue& v : c.places) reach_ = std::max<PictureReal>(reach_, length(v.middle() - anchor()));
    }
    PictureReal all = reach_;
    if (inputs_.velocity) all = std::max<PictureReal>(all, length(*inputs_.velocity) * time_);
    if (all == 0) all = ulp_at_anchor();
    unit_exponent_ = int(ilogb(all)) + 1;
    unit_ = ldexp(PictureReal(1), unit_exponent_);
    if (reach_ == 0) reach_ = all;
  }

  /// Where all else is one point: the nearest plane.
  PictureReal distance_of_planes() const {
    PictureReal least = 0;
    for (const PictureShape& s : inputs_.shapes) {
      if (s.has_one_plane() && (least == 0 || length(nearest_point(s, {})) < least))
        least = length(nearest_point(s, {}));
    }
    return least;
  }

  /// Distances along the way from the place at `time` on; a time is time + distance * time_per_unit.
  Json motion() const {
    if (!inputs_.velocity || inputs_.moving() == nullptr) return nullptr;
    const PictureReal speed = length(*inputs_.velocity);
    const auto distance = [&](const PictureReal& t) { return rounded((t - time_) * speed / unit_); };
    Json j{{"along", vector_to_json(unit(*inputs_.velocity))},
           {"time", rounded(time_)},
           {"time_per_unit", speed == 0 ? 0.0 : rounded(unit_ / speed)},
           {"start", distance(0)},
           {"limit", inputs_.time ? Json(distance(*inputs_.time)) : Json(nullptr)},
           {"true", nullptr},
           {"claimed", nullptr}};
    if (!true_.empty() && true_[0].time) j["true"] = {distance((*true_[0].time)[0]), distance((*true_[0].time)[1])};
    if (claimed_.time) j["claimed"] = distance((*claimed_.time)[0]);
    return j;
  }

  /// The point at which an arrow of an answer without a place begins: the last point among the inputs.
  PictureVector foot_of_arrows() const {
    for (auto s = inputs_.shapes.rbegin(); s != inputs_.shapes.rend(); ++s) {
      if (s->shape == Shape::point) return s->corners[0];
    }
    return {};
  }
  void add_contact(Json& list, const PictureContact& c, const char* of) const {
    const Json direction =
        c.directions.empty() ? Json(nullptr) : vector_to_json(::nearmiss::unit(c.directions[0].middle()));
    for (const PictureValue& v : c.places) {
      list.push_back({{"of", of},
                      {"name", v.name},
                      {"at", vector_to_json((v.middle() - anchor()) * (1 / unit_))},
                      {"half", vector_to_json(v.half() * (1 / unit_))},
                      {"normal", direction}});
    }
    if (!c.places.empty() || c.directions.empty()) return;
    list.push_back({{"of", of},
                    {"name", c.directions[0].name},
                    {"at", vector_to_json(foot_of_arrows() * (1 / unit_))},
                    {"half", nullptr},
                    {"normal", direction}});
  }

  const Case& question_;
  PictureInputs inputs_;
  PictureContact claimed_;
  std::vector<PictureContact> true_;
  PictureReal time_ = 0, unit_ = 1, reach_ = 0;
  int unit_exponent_ = 0;
  std::array<double, 3> anchor_{};
};

}  // namespace

nlohmann::ordered_json picture_of(const Case& question, const FileValue& report) {
  return CasePicture(question, report).to_json();
}

}  // namespace nearmiss

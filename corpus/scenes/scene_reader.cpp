#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "corpus/files/near_words.hpp"
#include "corpus/scenes/operands.hpp"
#include "corpus/scenes/recorded_cases.hpp"
#include "corpus/scenes/scene_file.hpp"
#include "impl/subject/printable.hpp"

namespace nearmiss::scenes {

namespace {

using nlohmann::json;

/// The numbers that a field may have.
struct Bounds {
  double low = 0, high = std::numeric_limits<double>::infinity();
  bool above_low = false;  ///< low itself is not allowed

  bool contain(double x) const { return (above_low ? x > low : x >= low) && x <= high; }
  std::string text() const {
    std::string text = fmt::format("{} {:g}", above_low ? "above" : "at least", low);
    if (std::isfinite(high)) text += fmt::format(" and at most {:g}", high);
    return text;
  }
};
constexpr Bounds not_negative{}, positive{0, std::numeric_limits<double>::infinity(), true}, share{0, 1};

/// Reads the fields of a scene. Each error states file, field, value and rule.
/// The rule for the name of a query, with those that are near the given one.
std::string name_of_query_text(const std::string& name) {
  const std::vector<std::string> near = nearest_queries(name);
  return "a name that `list` shows" + (near.empty() ? "" : fmt::format(", such as {}", fmt::join(near, " or ")));
}

class SceneReader {
 public:
  explicit SceneReader(const std::filesystem::path& file) : file_(file), where_(file.string()) {}

  Scene scene(const json& j) const;

 private:
  [[noreturn]] void fail(std::string_view path, const std::string& value, std::string_view rule) const {
    throw BadInput(fmt::format("{}: {} is {}: it must be {}", where_, path, value, rule));
  }
  [[noreturn]] void fail(std::string_view path, const json& value, std::string_view rule) const {
    std::string text = value.dump(-1, ' ', true, json::error_handler_t::replace);
    if (text.size() > 60) text = text.substr(0, 57) + "...";
    fail(path, text, rule);
  }
  static std::string below(std::string_view path, std::string_view name) {
    return path.empty() ? std::string(name) : fmt::format("{}.{}", path, name);
  }
  void expect_object(const json& j, std::string_view path, std::initializer_list<std::string_view> names) const {
    if (!j.is_object()) fail(path.empty() ? "the scene" : path, j, "an object");
    for (const auto& item : j.items()) {
      if (std::find(names.begin(), names.end(), item.key()) == names.end())
        throw BadInput(fmt::format("{}: {} is unknown", where_, below(path, item.key().substr(0, 40))));
    }
  }
  const json& member(const json& object, std::string_view path, std::string_view name) const {
    const auto found = object.find(name);
    if (found == object.end()) throw BadInput(fmt::format("{}: {} is missing", where_, below(path, name)));
    return *found;
  }
  std::string text(const json& object, std::string_view path, std::string_view name) const {
    const json& j = member(object, path, name);
    if (!j.is_string() || j.get_ref<const std::string&>().empty())
      fail(below(path, name), j, "a text that is not empty");
    const std::string text = j.get<std::string>();
    if (printable(text) != text) fail(below(path, name), j, "a text without control characters");
    return text;
  }
  const json& list(const json& object, std::string_view name) const {
    const json& j = member(object, "", name);
    if (!j.is_array() || j.empty()) fail(name, j, "an array that is not empty");
    return j;
  }
  Sourced sourced(const json& object, std::string_view path, std::string_view name, const Bounds& bounds) const;
  Spread spread(const json& object, std::string_view path, std::string_view name, const Bounds& bounds) const;
  Shapes shapes(const json& j, const std::string& path, const std::vector<Shapes>& before) const;
  MixedQuery mixed(const json& j, const std::string& path, const Scene& scene) const;
  void operands(MixedQuery& m, const json& j, const std::string& path, const Scene& scene) const;
  std::size_t operand(const json& j, const std::string& path, const Operand& place, bool moves,
                      const Scene& scene) const;
  Requirements requirements(const json& j, const Scene& scene) const;
  void whole(const json& j, Scene& scene) const;
  void recorded(const json& j, Scene& scene) const;

  const std::filesystem::path& file_;
  std::string where_;
};

Sourced SceneReader::sourced(const json& object, std::string_view path, std::string_view name,
                             const Bounds& bounds) const {
  const json& j = member(object, path, name);
  const std::string own = below(path, name);
  expect_object(j, own, {"value", "source"});
  const json& value = member(j, own, "value");
  if (!value.is_number() || !bounds.contain(value.get<double>())) fail(own, value, "a number " + bounds.text());
  return {value.get<double>(), text(j, own, "source")};
}

/// One number, or {"least", "most", "logarithmic"}.
Spread SceneReader::spread(const json& object, std::string_view path, std::string_view name,
                           const Bounds& bounds) const {
  const json& j = member(object, path, name);
  const std::string own = below(path, name);
  if (j.is_object() && j.contains("value")) {
    const Sourced one = sourced(object, path, name, bounds);
    return {one, one, false};
  }
  expect_object(j, own, {"least", "most", "logarithmic"});
  Spread s{sourced(j, own, "least", bounds), sourced(j, own, "most", bounds), false};
  if (s.most.value < s.least.value)
    fail(own + ".most", fmt::format("{:g}", s.most.value), fmt::format("at least {}.least, {:g}", own, s.least.value));
  if (const auto found = j.find("logarithmic"); found != j.end()) {
    if (!found->is_boolean()) fail(own + ".logarithmic", *found, "true or false");
    s.logarithmic = found->get<bool>();
  }
  if (s.logarithmic && s.least.value <= 0)
    fail(own + ".least", fmt::format("{:g}", s.least.value), "above 0, because the spread is logarithmic");
  return s;
}

Shapes SceneReader::shapes(const json& j, const std::string& path, const std::vector<Shapes>& before) const {
  expect_object(j, path, {"name", "type", "count", "size", "speed"});
  Shapes s;
  s.name = text(j, path, "name");
  if (std::any_of(before.begin(), before.end(), [&](const Shapes& b) { return b.name == s.name; }))
    fail(path + ".name", '"' + s.name + '"', "a name that no other shapes have");
  const std::string type = text(j, path, "type");
  const auto found =
      std::find_if(scene_shapes.begin(), scene_shapes.end(), [&](Shape t) { return name_of(t) == type; });
  if (found == scene_shapes.end()) {
    std::vector<std::string_view> names;
    for (const Shape t : scene_shapes) names.push_back(name_of(t));
    fail(path + ".type", '"' + type + '"', fmt::format("one of {}", fmt::join(names, ", ")));
  }
  s.type = *found;
  s.count = sourced(j, path, "count", {1});
  const bool has_size = s.type != Shape::point && !has_one_plane(s.type);
  if (!has_size && j.contains("size")) fail(path + ".size", j["size"], fmt::format("absent for a {}", type));
  if (has_size) s.size = spread(j, path, "size", not_negative);
  if (j.contains("speed")) s.speed = spread(j, path, "speed", not_negative);
  return s;
}

std::size_t SceneReader::operand(const json& j, const std::string& path, const Operand& place, bool moves,
                                 const Scene& scene) const {
  const std::string name = text(j, path, place.name), own = below(path, place.name);
  for (std::size_t i = 0; i < scene.shapes.size(); ++i) {
    const Shapes& s = scene.shapes[i];
    if (s.name != name) continue;
    if (s.type != place.shape)
      fail(own, '"' + name + '"',
           fmt::format("shapes of the type {}, and these are of the type {}", name_of(place.shape), name_of(s.type)));
    if (moves && !(s.speed.most.value > 0))
      fail(own, '"' + name + '"', "shapes with a speed above 0, because they move");
    return i;
  }
  fail(own, '"' + name + '"', "the name of shapes of this scene");
}

void SceneReader::operands(MixedQuery& m, const json& j, const std::string& path, const Scene& scene) const {
  const auto plan = query_plan(*m.query);
  if (!plan)
    fail(path + ".query", fmt::format("\"{}\"", m.query->name),
         "a query of two shapes, or the scene must have recorded cases");
  const json& given = member(j, path, "operands");
  const std::string own = path + ".operands";
  expect_object(given, own, {plan->operands[0].name, plan->operands[1].name});
  m.operands = {operand(given, own, plan->operands[0], plan->velocity.has_value(), scene),
                operand(given, own, plan->operands[1], false, scene)};
}

MixedQuery SceneReader::mixed(const json& j, const std::string& path, const Scene& scene) const {
  expect_object(j, path, {"query", "weight", "operands"});
  const std::string name = text(j, path, "query");
  MixedQuery m;
  m.query = find_query(name);
  if (m.query == nullptr) fail(path + ".query", '"' + name + '"', name_of_query_text(name));
  if (scene.find(*m.query) != nullptr) fail(path + ".query", '"' + name + '"', "listed once");
  m.weight = sourced(j, path, "weight", positive);
  if (!scene.is_recorded()) {
    operands(m, j, path, scene);
    return m;
  }
  if (j.contains("operands")) fail(path + ".operands", j["operands"], "absent where the cases are recorded");
  for (std::size_t i = 0; i < scene.recorded.size(); ++i) {
    if (scene.recorded[i].query == m.query) m.recorded.push_back(i);
  }
  if (m.recorded.empty()) fail(path + ".query", '"' + name + '"', "a query of a case in " + scene.cases_file.string());
  return m;
}

/// A tolerance below the spacing of doubles at the scene's largest coordinate is impossible: no answer can meet it.
Requirements SceneReader::requirements(const json& j, const Scene& scene) const {
  constexpr std::string_view path = "requires";
  expect_object(j, path,
                {"position_error", "missed_depth", "time_error", "missed_rate", "phantom_rate", "time_budget"});
  const double largest = scene.extent.value + scene.distance.most.value;
  const double spacing = std::nextafter(largest, std::numeric_limits<double>::infinity()) - largest;
  Requirements r;
  r.position_error = sourced(j, path, "position_error", positive);
  r.missed_depth = sourced(j, path, "missed_depth", positive);
  r.time_error = sourced(j, path, "time_error", {0, 1, true});
  r.missed_rate = sourced(j, path, "missed_rate", share);
  r.phantom_rate = sourced(j, path, "phantom_rate", share);
  r.time_budget = sourced(j, path, "time_budget", {0, scene.step.value, true});
  for (const auto& [name, value] :
       {std::pair{"position_error", r.position_error.value}, std::pair{"missed_depth", r.missed_depth.value}}) {
    if (value < spacing)
      fail(below(path, name), fmt::format("{:g}", value),
           fmt::format("at least {:.3g}, the spacing of doubles at the scene's largest coordinate {:g}", spacing,
                       largest));
  }
  return r;
}

/// The fields about the scene as a whole.
void SceneReader::whole(const json& j, Scene& scene) const {
  scene.name = text(j, "", "name");
  if (scene.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-_") != std::string::npos)
    fail("name", '"' + scene.name + '"', "of small letters, digits, - and _");
  scene.title = text(j, "", "title");
  scene.unit = text(j, "", "unit");
  const auto units = known_units();
  if (std::none_of(units.begin(), units.end(), [&](const Unit& u) { return u.name == scene.unit; })) {
    std::vector<std::string_view> names;
    for (const Unit& u : units) names.push_back(u.name);
    fail("unit", '"' + scene.unit + '"', fmt::format("one of {}", fmt::join(names, ", ")));
  }
  const json& scalar = member(j, "", "scalar");
  expect_object(scalar, "scalar", {"value", "source"});
  const std::string value = text(scalar, "scalar", "value");
  if (value != name_of(Scalar::float32) && value != name_of(Scalar::float64))
    fail("scalar", '"' + value + '"', "\"float\" or \"double\"");
  scene.scalar = value == name_of(Scalar::float32) ? Scalar::float32 : Scalar::float64;
  scene.scalar_source = text(scalar, "scalar", "source");
  scene.extent = sourced(j, "", "extent", positive);
  scene.distance = spread(j, "", "distance", not_negative);
  scene.step = sourced(j, "", "step", positive);
  scene.queries_per_step = sourced(j, "", "queries_per_step", {1});
  scene.near_contact = sourced(j, "", "near_contact", share);
}

void SceneReader::recorded(const json& j, Scene& scene) const {
  if (!j.contains("cases")) return;
  if (j.contains("shapes"))
    throw BadInput(fmt::format("{}: shapes and cases are both given: one must be absent", where_));
  scene.cases_file = file_.parent_path() / text(j, "", "cases");
  scene.recorded = read_json_lines(scene.cases_file);
}

Scene SceneReader::scene(const json& j) const {
  expect_object(j, "",
                {"name", "title", "unit", "scalar", "extent", "distance", "step", "queries_per_step", "near_contact",
                 "shapes", "queries", "requires", "cases"});
  Scene scene;
  scene.file = file_;
  whole(j, scene);
  recorded(j, scene);
  if (!scene.is_recorded()) {
    const json& all = list(j, "shapes");
    for (std::size_t i = 0; i < all.size(); ++i)
      scene.shapes.push_back(shapes(all[i], fmt::format("shapes[{}]", i), scene.shapes));
  }
  const json& mix = list(j, "queries");
  for (std::size_t i = 0; i < mix.size(); ++i)
    scene.queries.push_back(mixed(mix[i], fmt::format("queries[{}]", i), scene));
  scene.required = requirements(member(j, "", "requires"), scene);
  return scene;
}

}  // namespace

Scene scene_from_json(const json& j, const std::filesystem::path& file) { return SceneReader(file).scene(j); }

}  // namespace nearmiss::scenes

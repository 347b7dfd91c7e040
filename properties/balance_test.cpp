/// The balance of the generator: both decisions, every kind of feature, ties and near flips are frequent enough.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <set>

#include "corpus/generator/generator.hpp"
#include "corpus/storage/codec.hpp"
#include "impl/catalogue/query_ids.hpp"
#include "properties/features.hpp"
#include "properties/support.hpp"

namespace nearmiss {
namespace {

using Vector = std::array<double, 3>;

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector sub(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// A case and one right answer, by the names of their vectors. The test only classifies, so doubles are precise enough.
class AnsweredCase {
 public:
  AnsweredCase(const Case& c, const Alternative& a) : case_(c), alternative_(a) {}

  std::optional<Vector> given(const std::string& name) const {
    return three(case_.fields(), name, [&](std::size_t i) { return case_.values[i]; });
  }
  std::optional<Vector> answered(const std::string& name) const {
    return three(case_.query->outputs, name, [&](std::size_t i) { return middle(i); });
  }
  double given_number(const std::string& name) const {
    for (std::size_t i = 0; i < case_.values.size(); ++i) {
      if (case_.name(i) == name) return case_.values[i];
    }
    return 0;
  }
  std::optional<int> index() const {
    for (std::size_t i = 0; i < case_.query->outputs.size() && i < alternative_.count; ++i) {
      if (case_.query->outputs[i].role == Role::index) return int(middle(i));
    }
    return std::nullopt;
  }

 private:
  double middle(std::size_t i) const { return alternative_.values[i].low / 2 + alternative_.values[i].high / 2; }
  template <class Number>
  std::optional<Vector> three(std::span<const Field> fields, const std::string& name, Number number) const {
    for (std::size_t i = 0; i + 2 < fields.size(); ++i) {
      const bool there = fields.data() == case_.fields().data() || i + 2 < alternative_.count;
      if (fields[i].name == name + ".x" && there) return Vector{number(i), number(i + 1), number(i + 2)};
    }
    return std::nullopt;
  }

  const Case& case_;
  const Alternative& alternative_;
};

/// Relative to the sizes of the case; for classification only.
constexpr double at_most = 1e-9;

std::string_view corner_kind(int coordinates_at_their_end) {
  constexpr std::string_view kinds[] = {"inside", "face", "edge", "vertex"};
  return kinds[coordinates_at_their_end];
}

std::string_view of_box(const Vector& local, const Vector& half) {
  const double size = std::max({half[0], half[1], half[2], std::abs(local[0]), std::abs(local[1]), std::abs(local[2])});
  int ends = 0;
  for (std::size_t k = 0; k < 3; ++k) ends += std::abs(std::abs(local[k]) - half[k]) <= at_most * size;
  return corner_kind(ends);
}

Vector turned_back(const Vector& v, const Vector& u, double w) {  // by the inverse of the quaternion u, w
  const Vector once = cross(v, u), twice = cross(once, u);
  const double n = dot(u, u) + w * w;
  Vector out;
  for (std::size_t k = 0; k < 3; ++k) out[k] = v[k] + 2 * (w * once[k] + twice[k]) / n;
  return out;
}

/// The feature of the fixed shape on which an answer lies; empty if the query has none.
std::string feature_of(const AnsweredCase& s) {
  if (const auto w = s.answered("weights")) {
    const auto zeros = std::count_if(w->begin(), w->end(), [](double x) { return std::abs(x) <= at_most; });
    return std::string(zeros == 0 ? "face" : zeros == 1 ? "edge" : "vertex");
  }
  if (const auto i = s.index()) return *i < 0 ? "" : fmt::format("index {}", *i);
  auto point = s.answered("location");
  if (!point) point = s.answered("contact");
  if (!point) point = s.answered("point");
  if (!point) return "";
  if (const auto half = s.given("box.half")) {
    const Vector u = *s.given("box.orientation");
    return std::string(
        of_box(turned_back(sub(*point, *s.given("box.center")), u, s.given_number("box.orientation.w")), *half));
  }
  if (const auto low = s.given("aabox.min")) {
    const Vector high = *s.given("aabox.max");
    Vector center, half;
    for (std::size_t k = 0; k < 3; ++k) center[k] = (*low)[k] / 2 + high[k] / 2, half[k] = high[k] / 2 - (*low)[k] / 2;
    return std::string(of_box(sub(*point, center), half));
  }
  if (const auto p0 = s.given("capsule.p0")) {
    const auto normal = s.answered("normal");
    const Vector axis = sub(*s.given("capsule.p1"), *p0);
    if (!normal || dot(axis, axis) == 0) return "";
    return std::abs(dot(*normal, axis)) <= at_most * std::sqrt(dot(axis, axis)) ? "tube" : "end";
  }
  for (const char* thing : {"segment", "triangle", "rectangle"}) {
    bool vertex = false;
    for (int v = 0; v < 4; ++v) {
      const auto corner = s.given(fmt::format("{}.v{}", thing, v));
      if (!corner) continue;
      const Vector off = sub(*point, *corner);
      vertex = vertex || dot(off, off) <= at_most * at_most * (1 + dot(*point, *point));
    }
    if (s.given(fmt::format("{}.v0", thing))) return vertex ? "vertex" : "between";
  }
  return "";
}

/// The reasons for which several answers are right.
std::set<std::string> ties_of(const Case& c, const Truth& t) {
  const Query& query = *c.query;
  std::set<std::string> ties;
  if (query.id == QueryId::sphere_sphere_penetration && std::equal(&c.values[0], &c.values[3], &c.values[4])) {
    ties.insert("cone");  // any normal is right if the centers coincide; the truth lists only the given one
  }
  for (const Alternative& a : t.alternatives) {
    bool any = a.many_normals;
    for (std::size_t i = 0; i < std::min(a.count, query.outputs.size()); ++i) {
      any = any || (query.outputs[i].role == Role::normal && a.values[i].high - a.values[i].low >= 1);
    }
    if (any) ties.insert("cone");
  }
  for (std::size_t n = 1; n < t.alternatives.size(); ++n) {
    const Alternative &a = t.alternatives[0], &b = t.alternatives[n];
    for (std::size_t i = 0; i < std::min({a.count, b.count, query.outputs.size()}); ++i) {
      if (a.many_normals && query.outputs[i].role == Role::normal) continue;
      const bool apart = a.values[i].high < b.values[i].low || b.values[i].high < a.values[i].low;
      // Two cones may be one normal each.
      const bool of_cones = query.outputs[i].role == Role::normal && !query.traits.ties.has(Tie::normal);
      if (apart) ties.insert(of_cones ? "cone" : std::string(name_of(query.outputs[i].role)));
    }
  }
  return ties;
}

/// Shares over the first cases of a stream.
struct Balance {
  int cases = 0, yes = 0, knifes_edge = 0;
  std::map<std::string, int> features, ties;

  int feature(const std::string& name) const { return features.contains(name) ? features.at(name) : 0; }
  int tie(const std::string& name) const { return ties.contains(name) ? ties.at(name) : 0; }

  std::string text() const {
    const auto percent = [&](int n) { return fmt::format("{:.1f}", 100.0 * n / cases); };
    std::string all = fmt::format("yes {}, knife's edge {}", percent(yes), percent(knifes_edge));
    for (const auto& [name, count] : features) all += fmt::format(", {} {}", name, percent(count));
    for (const auto& [name, count] : ties) all += fmt::format(", tie of {} {}", name, percent(count));
    return all;
  }
};

/// Whether the decision changes for an input within 4 epsilon.
bool on_the_knifes_edge(const Truth& t) { return t.margin_at_least < 4; }

Balance balance_of(const Query& query, Scalar scalar, int cases) {
  Balance b;
  b.cases = cases;
  for (int i = 0; i < cases; ++i) {
    const Case c = generate(query, scalar, 1, std::uint64_t(i));
    const Truth t = truth_of(c);
    b.yes += t.yes;
    b.knifes_edge += decides(query.kind) && on_the_knifes_edge(t);
    for (const std::string& tie : ties_of(c, t)) ++b.ties[tie];
    std::set<std::string> features;
    for (const Alternative& a : t.alternatives) features.insert(feature_of(AnsweredCase(c, a)));
    for (const std::string& f : features) {
      if (!f.empty()) ++b.features[f];
    }
  }
  return b;
}

/// The features of each query: the parts of a shape on which its answers can lie. Empty for queries without features.
std::vector<std::string> features_of(const Query& query) {
  const auto has = [](std::span<const Field> fields, std::string_view beginning) {
    return std::any_of(fields.begin(), fields.end(), [&](const Field& f) { return f.name.starts_with(beginning); });
  };
  if (has(query.outputs, "weights")) return {"face", "edge", "vertex"};
  if (has(query.outputs, "edge")) return {"index 0", "index 1", "index 2"};
  if (has(query.inputs, "hint")) {
    std::vector<std::string> axes;
    for (int i = 0; i < 15; ++i) axes.push_back(fmt::format("index {}", i));
    return axes;
  }
  const bool place = has(query.outputs, "location") || has(query.outputs, "contact") || has(query.outputs, "point.");
  if (place && (has(query.inputs, "box.") || has(query.inputs, "aabox."))) return {"face", "edge", "vertex"};
  if (place && has(query.inputs, "capsule")) return {"tube", "end"};
  if (place && (has(query.inputs, "segment") || has(query.inputs, "rectangle"))) return {"between", "vertex"};
  return {};
}

/// Every reason for which a query may have several right answers; each has a stated share.
std::set<std::string> expected_ties(const Query& query) {
  std::set<std::string> names;
  for (const Tie t : all_ties) {
    if (query.traits.ties.has(t)) names.emplace(name_of(t));
  }
  return names;
}

class GeneratorBalance : public testing::TestWithParam<NamedQuery> {};

TEST_P(GeneratorBalance, ReachesEveryFeatureTieAndKnifesEdgeOftenEnough) {
  const Query& query = *GetParam().query;
  constexpr int cases = 2000;
  for (const Scalar scalar : scalars) {
    const Balance b = balance_of(query, scalar, cases);
    RecordProperty(std::string(name_of(scalar)), b.text());
    const std::string line = fmt::format("{} {}: {}", query.name, name_of(scalar), b.text());
    if (decides(query.kind)) {
      const auto [knifes_edge_per_mille, either_percent] = query.traits.balance;
      EXPECT_GE(b.knifes_edge, cases * knifes_edge_per_mille / 1000) << line;
      EXPECT_GE(std::min(b.yes, cases - b.yes), cases * either_percent / 100) << line;
    }
    for (const std::string& f : features_of(query)) EXPECT_GE(b.feature(f), cases * 5 / 1000) << f << ": " << line;
    for (const std::string& t : expected_ties(query)) EXPECT_GE(b.tie(t), cases / 2000) << t << ": " << line;
    for (const auto& [name, count] : b.ties) {
      EXPECT_TRUE(expected_ties(query).contains(name)) << "a tie without a stated share: " << name << ": " << line;
    }
    if (std::getenv("NEARMISS_PRINT_BALANCE") != nullptr) fmt::print("{}\n", line);
  }
}

/// Each band was measured. Without the move that builds a configuration, its share is below the band.
TEST_P(GeneratorBalance, BuildsEveryConfigurationOftenEnough) {
  const Query& query = *GetParam().query;
  constexpr int cases = 20000;
  for (const Scalar scalar : scalars) {
    std::map<std::string_view, int> counts;
    for (int i = 0; i < cases; ++i) {
      const Case c = generate(query, scalar, 1, std::uint64_t(i));
      for (const Configuration& k : configurations()) counts[k.name] += k.concerns(query) && k.found(c);
    }
    for (const Configuration& k : configurations()) {
      if (!k.concerns(query)) continue;
      const double per_mille = 1000.0 * counts[k.name] / cases;
      const std::string line =
          fmt::format("{} {}: {}: {:.2f} of 1,000 cases", query.name, name_of(scalar), k.name, per_mille);
      EXPECT_GE(per_mille, k.at_least_per_mille) << line;
      EXPECT_LE(per_mille, k.at_most_per_mille) << line;
      if (std::getenv("NEARMISS_PRINT_BALANCE") != nullptr) fmt::print("{}\n", line);
    }
  }
}

INSTANTIATE_FOR_EVERY_QUERY(Every, GeneratorBalance, testing::ValuesIn(every_query()),
                            testing::PrintToStringParamName());

}  // namespace
}  // namespace nearmiss

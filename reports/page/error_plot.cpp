#include "reports/page/error_plot.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "oracles/confirmed.hpp"
#include "oracles/requirements.hpp"
#include "reports/findings/report.hpp"

namespace nearmiss {

namespace {

using Json = nlohmann::ordered_json;

/// The largest magnitude among the numbers of the same role.
double scale_of_group(const Case& c, std::size_t number) {
  double most = 0;
  for (std::size_t i = 0; i < c.values.size(); ++i) {
    if (c.role(i) == c.role(number)) most = std::max(most, std::abs(c.values[i]));
  }
  return most == 0 ? 1 : most;
}

double in_scalar_of_case(const Case& c, double x) { return c.scalar == Scalar::float32 ? double(float(x)) : x; }

/// The values that are asked, with the changes that lead to them.
std::map<double, double> values_around(const Case& c, std::size_t number) {
  constexpr int most_exponent = 2, step = 3;  // four times the group's scale; every third power of two
  const double own = c.values[number], scale = scale_of_group(c, number);
  std::map<double, double> values{{own, 0.0}};
  const int digits = c.scalar == Scalar::float32 ? 24 : 53;
  for (int e = most_exponent; e >= most_exponent - digits - step; e -= step) {
    for (const double sign : {-1.0, 1.0}) {
      const double change = sign * std::ldexp(scale, e), x = in_scalar_of_case(c, own + change);
      if (std::isfinite(x)) values.try_emplace(x, change);
    }
  }
  return values;
}

/// One sample; empty where the subject exceeds a time limit.
std::optional<Json> sample_at(const Case& question, const Subject& subject, Workers& workers, double change,
                              double value) {
  const Standard standard = subject.standard_for(question.query->name);
  if (question.query->broken(question.values) || !unmet_by(question, standard.required).empty())
    return Json{change, value, nullptr, nullptr, nullptr};
  const Answer answer = workers.ask(subject, question);
  if (answer.late()) return std::nullopt;
  const Finding f = confirmed(question, answer, standard, Detail::full);
  const bool finite = std::isfinite(f.forward_ulps) && f.forward_ulps > 0;
  const std::string_view fault = f.verdict == Verdict::broke ? "broke" : is_bad(f) ? name_of(f.disagreement) : "";
  return Json{change, value, fault, f.backward ? Json(f.backward->above) : Json(nullptr),
              finite ? Json(f.forward_ulps) : Json(nullptr)};
}

}  // namespace

nlohmann::ordered_json error_plots(const Case& question, const Subject& subject, Workers& workers,
                                   const std::function<bool()>& go_on) {
  Json plots = Json::array();
  for (std::size_t i = 0; i < question.values.size(); ++i) {
    const Field& field = question.fields()[i];
    if (is_discrete(field.role)) continue;
    Json plot{{"number", field.name}, {"value", question.values[i]}, {"scale", scale_of_group(question, i)}};
    Case moved = question;
    for (const auto& [value, change] : values_around(question, i)) {
      if (!go_on()) return plots;
      moved.values[i] = value;
      const std::optional<Json> sample = sample_at(moved, subject, workers, change, value);
      if (!sample) return plots;
      plot["samples"].push_back(*sample);
    }
    plots.push_back(std::move(plot));
  }
  return plots;
}

}  // namespace nearmiss

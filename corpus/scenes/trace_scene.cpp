#include "corpus/scenes/trace_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "corpus/scenes/recorded_cases.hpp"
#include "corpus/storage/codec.hpp"

namespace nearmiss::scenes {

namespace {

using Json = nlohmann::ordered_json;

Json sourced_json(double value, const std::string& source) { return {{"value", value}, {"source", source}}; }

/// The absolute values of all numbers of a role that are not 0, from the smallest on.
std::vector<double> numbers_of(const std::vector<Case>& cases, Role role) {
  std::vector<double> all;
  for (const Case& c : cases) {
    for (std::size_t i = 0; i < c.values.size(); ++i) {
      if (c.role(i) == role && c.values[i] != 0) all.push_back(std::abs(c.values[i]));
    }
  }
  std::sort(all.begin(), all.end());
  return all;
}

/// A thousandth of the median size; without sizes, a ten-thousandth of the extent.
Json chosen_tolerance(const std::vector<double>& sizes, double extent) {
  constexpr double of_size = 1e-3, of_extent = 1e-4;
  if (sizes.empty())
    return sourced_json(extent * of_extent,
                        "chosen by import: a ten-thousandth of the extent; state what the program needs");
  return sourced_json(std::max(sizes[sizes.size() / 2] * of_size, extent * 0x1p-40),
                      "chosen by import: a thousandth of the median size; state what the program needs");
}

Json mix_json(const std::vector<Case>& cases, const std::string& from) {
  std::map<const Query*, std::uint64_t> counts;
  for (const Case& c : cases) ++counts[c.query];
  Json mix = Json::array();
  for (const Query& q : catalogue()) {
    if (const auto found = counts.find(&q); found != counts.end())
      mix.push_back({{"query", q.name}, {"weight", sourced_json(double(found->second), "counted in " + from)}});
  }
  return mix;
}

Json requires_json(const Json& tolerance) {
  constexpr const char* state = "chosen by import; state what the program needs";
  return {{"position_error", tolerance},
          {"missed_depth", tolerance},
          {"time_error", sourced_json(0.01, state)},
          {"missed_rate", sourced_json(0, state)},
          {"phantom_rate", sourced_json(0, state)},
          {"time_budget", sourced_json(0.001, state)}};
}

Json trace_json(const std::string& name, const std::vector<Case>& cases, const std::string& from) {
  const std::vector<double> positions = numbers_of(cases, Role::position);
  const double extent = positions.empty() ? 1 : positions.back();
  const bool all_float =
      std::all_of(cases.begin(), cases.end(), [](const Case& c) { return c.scalar == Scalar::float32; });
  return {{"name", name},
          {"title", fmt::format("{} recorded cases", cases.size())},
          {"unit", "metre"},
          {"scalar", {{"value", all_float ? "float" : "double"}, {"source", "of the cases in " + from}}},
          {"extent", sourced_json(extent, "the largest coordinate in " + from)},
          {"distance", sourced_json(0, "the extent is from the origin")},
          {"step", sourced_json(1, "the time unit of the velocities in " + from)},
          {"queries_per_step", sourced_json(1, "chosen by import; state what the program needs")},
          {"near_contact", sourced_json(0, "the cases are recorded")},
          {"queries", mix_json(cases, from)},
          {"requires", requires_json(chosen_tolerance(numbers_of(cases, Role::size), extent))},
          {"cases", name + ".jsonl"}};
}

}  // namespace

Scene write_trace_scene(const std::filesystem::path& file, const std::vector<Case>& cases, const std::string& from) {
  if (file.extension() != ".json")
    throw BadInput(fmt::format("{}: the file of a scene must end with .json", file.string()));
  if (cases.empty()) throw BadInput(fmt::format("{}: there is no case for the scene", from));
  const Json j = trace_json(file.stem().string(), cases, from);
  std::filesystem::path lines = file;
  write_file(lines.replace_extension(".jsonl"), json_lines(cases));
  write_file(file, j.dump(2) + "\n");
  return load_scene(file.string());
}

}  // namespace nearmiss::scenes

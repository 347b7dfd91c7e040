#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "corpus/scenes/scene_file.hpp"
#include "reports/commands/command.hpp"
#include "reports/commands/options.hpp"
#include "reports/commands/scene_advise.hpp"
#include "reports/engine/output.hpp"
#include "reports/findings/text.hpp"

namespace nearmiss {

namespace {

using SceneRows = std::vector<std::vector<std::string>>;

std::string spread_text(const scenes::Spread& s, const std::string& unit) {
  if (s.least.value == s.most.value) return fmt::format("{:g} {}", s.least.value, unit);
  return fmt::format("{:g} to {:g} {}{}", s.least.value, s.most.value, unit, s.logarithmic ? ", logarithmic" : "");
}

void add_scene_row(SceneRows& rows, const std::string& what, const scenes::Sourced& number, std::string_view unit) {
  rows.push_back({what, fmt::format("{:g}{}{}", number.value, unit.empty() ? "" : " ", unit), number.source});
}

void add_scene_row(SceneRows& rows, const std::string& what, const scenes::Spread& spread, const std::string& unit) {
  if (spread.least.source.empty()) return;
  std::string source = spread.least.source;
  if (spread.most.source != source) source += "; " + spread.most.source;
  rows.push_back({what, spread_text(spread, unit), source});
}

std::string list_of_scenes() {
  SceneRows rows{{"SCENE", "SCALAR", "UNIT", "QUERIES", "TITLE"}};
  for (const std::string& name : scenes::scene_names()) {
    const scenes::Scene s = scenes::load_scene(name);
    rows.push_back({s.name, std::string(name_of(s.scalar)), s.unit, std::to_string(s.queries.size()), s.title});
  }
  return table_text(rows);
}

std::string world_text(const scenes::Scene& s) {
  SceneRows rows{{"NUMBER", "VALUE", "SOURCE"}};
  rows.push_back({"scalar", std::string(name_of(s.scalar)), s.scalar_source});
  add_scene_row(rows, "extent", s.extent, s.unit);
  add_scene_row(rows, "distance", s.distance, s.unit);
  add_scene_row(rows, "step", s.step, "s");
  add_scene_row(rows, "queries per step", s.queries_per_step, "");
  add_scene_row(rows, "near contact", s.near_contact, "");
  for (const scenes::Shapes& shapes : s.shapes) {
    add_scene_row(rows, fmt::format("{} ({}), count", shapes.name, name_of(shapes.type)), shapes.count, "");
    add_scene_row(rows, shapes.name + ", size", shapes.size, s.unit);
    add_scene_row(rows, shapes.name + ", speed", shapes.speed, s.unit + "/s");
  }
  return table_text(rows);
}

std::string mix_text(const scenes::Scene& s) {
  SceneRows rows{{"QUERY", "SHARE", "OF", "SOURCE"}};
  for (const scenes::MixedQuery& m : s.queries) {
    std::string of = fmt::format("{} recorded cases", m.recorded.size());
    if (!m.operands.empty()) of = fmt::format("{}, {}", s.shapes[m.operands[0]].name, s.shapes[m.operands[1]].name);
    rows.push_back(
        {std::string(m.query->name), fmt::format("{:.1f} %", 100 * s.share_of(*m.query)), of, m.weight.source});
  }
  return table_text(rows);
}

std::string requirements_text(const scenes::Scene& s) {
  SceneRows rows{{"REQUIRED", "AT MOST", "SOURCE"}};
  add_scene_row(rows, "position error", s.required.position_error, s.unit);
  add_scene_row(rows, "missed depth", s.required.missed_depth, s.unit);
  add_scene_row(rows, "time error", s.required.time_error, "of the step");
  add_scene_row(rows, "missed rate", s.required.missed_rate, "");
  add_scene_row(rows, "phantom rate", s.required.phantom_rate, "");
  add_scene_row(rows, "time budget", s.required.time_budget, "s a step");
  return table_text(rows);
}

class SceneCommand : public Command {
 public:
  Manual manual() const override {
    return {
        "scene",
        "scenes, worlds that cases are taken from: list, show and check them, and get advice for them",
        {"A scene is a JSON file (docs/scenes.md): the extent of a world and its distance from the origin, the sizes "
         "and speeds of its shapes, the mix of its queries, and what it requires of answers. Each number has its "
         "source. 'run', 'relations' and other commands take their cases from a scene with --scene.",
         "ACTION is list (the scenes of Nearmiss), show (every number of a scene, with its source) or check (reads "
         "files; says nothing more than that they are valid, or states file, field, value and rule).",
         "advise finds for each query of a scene the cheapest tier of collide, or the cheapest of the chosen subjects, "
         "that meets every requirement of the scene. All are timed and judged on the same cases; then the cheapest "
         "ones answer fresh cases until one of them meets everything. Where that is not the cheapest of all, advise "
         "tries to re-centre the origin, to split the step and to use another unit, each on changed cases of the "
         "scene. The folder receives advice.json, trade.json, the worst case of each choice, and the profile: "
         "profile.json, and collide_profile.hpp with collide_profile.cmake, which offer exactly the queries of the "
         "scene to a program.",
         "verify reads a profile, asks each of its subjects fresh cases, and says whether every requirement still "
         "holds."},
        {{"0", "The scenes are valid; each query has a subject that meets every requirement."},
         {"1", "advise: no subject meets every requirement of some query. verify: a requirement failed."},
         {"2", "A scene is unknown, its file cannot be read or is invalid, wrong arguments, or an interrupt."},
         internal_error_status()},
        {{"nearmiss scene list", "The scenes of Nearmiss."},
         {"nearmiss scene show robot-cell", "One of them."},
         {"nearmiss scene check my-world.json", "Is this file a valid scene?"},
         {"nearmiss scene advise driving --cases 1e5 --out profile",
          "The cheapest tier for each query, and a profile."},
         {"nearmiss scene verify profile/profile.json", "Does it still hold on other cases?"}}};
  }
  void declare(CLI::App& app) override {
    app.add_option("ACTION", action_, "What to do: list, show, check, advise or verify")
        ->required()
        ->type_name("")
        ->check(CLI::Validator(
            [](const std::string& t) {
              const auto known = {"list", "show", "check", "advise", "verify"};
              if (std::find(known.begin(), known.end(), t) != known.end()) return std::string();
              return "unknown action '" + t + "'; known are list, show, check, advise, verify";
            },
            ""));
    app.add_option("SCENE", names_, "The name of a scene, or a file; for verify a profile.json")->type_name("");
    advise_.declare(app);
  }
  int run(const CLI::App&) override {
    if (action_ == "advise" || action_ == "verify") return advise_or_verify();
    if (const std::string option = advise_.given(); !option.empty())
      throw BadInput(fmt::format("{}: scene {} does not take it", option, action_));
    if (action_ == "list") {
      if (!names_.empty()) throw BadInput(fmt::format("scene list: takes no scene, and {} is given", names_.front()));
      say("{}", list_of_scenes());
      return 0;
    }
    if (names_.empty())
      throw BadInput(fmt::format("scene {}: which scene? 'nearmiss scene list' shows the names", action_));
    for (const std::string& name : names_) {
      const scenes::Scene s = scenes::load_scene(name);
      if (action_ == "show") {
        say("{}: {}\n\n{}\n{}\n{}", s.name, s.title, world_text(s), mix_text(s), requirements_text(s));
      } else {
        say("{}: valid: {} queries, {}\n", path_text(s.file), s.queries.size(),
            s.is_recorded() ? fmt::format("{} recorded cases", count_text(s.recorded.size()))
                            : fmt::format("{} kinds of shapes", s.shapes.size()));
      }
    }
    return 0;
  }

 private:
  int advise_or_verify() const {
    const bool advises = action_ == "advise";
    if (names_.size() != 1)
      throw BadInput(fmt::format("scene {}: give one {}", action_, advises ? "scene" : "file profile.json"));
    return advises ? advise_scene(names_.front(), advise_) : verify_profile(names_.front(), advise_);
  }

  std::string action_;
  std::vector<std::string> names_;
  AdviseOptions advise_;
};

}  // namespace

std::unique_ptr<Command> scene_command() { return std::make_unique<SceneCommand>(); }

}  // namespace nearmiss

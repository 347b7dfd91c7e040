/// Scenes: worlds that cases are taken from, and what a world requires of answers. One JSON file each, of the schema
/// corpus/scenes/scene.schema.json; Nearmiss has those in corpus/scenes/, and docs/scenes.md explains the fields.
///
/// A scene has one unit of length. Its speeds are in this unit a second, its times in seconds.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "corpus/files/errors.hpp"
#include "impl/catalogue/case.hpp"
#include "oracles/scene_limits.hpp"

namespace nearmiss::scenes {

/// A number of a scene. Its source is a reference, or "chosen: " and the reason.
struct Sourced {
  double value = 0;
  std::string source;
};

/// The numbers from `least` to `most`, uniform, or uniform in their logarithm.
struct Spread {
  Sourced least, most;
  bool logarithmic = false;
};

/// The shapes that a scene may have. A size is a radius (sphere, capsule), a half extent (box, aabox) or a side
/// (capsule's axis, segment, triangle, rectangle); a point and a plane have none.
inline constexpr std::array scene_shapes = {Shape::point, Shape::sphere,   Shape::capsule,  Shape::segment,
                                            Shape::box,   Shape::aabox,    Shape::triangle, Shape::rectangle,
                                            Shape::plane, Shape::halfspace};

/// Shapes of a scene that are alike.
struct Shapes {
  std::string name;  ///< "player"
  Shape type = Shape::point;
  Sourced count;  ///< how many the scene has
  Spread size;    ///< in the scene's unit
  Spread speed;   ///< unit a second, of those that move
};

/// A query that the scene asks.
struct MixedQuery {
  const Query* query = nullptr;
  Sourced weight;  ///< how often, relative to the weights of the scene's other queries
  /// The shapes that its operands are drawn from, as indices into Scene::shapes, in the order of the query's inputs.
  /// Empty where the cases are recorded.
  std::vector<std::size_t> operands;
  std::vector<std::size_t> recorded;  ///< its recorded cases, as indices into Scene::recorded
};

/// What a scene requires of answers. An answer within all of these is good enough for it.
struct Requirements {
  Sourced position_error;  ///< the largest tolerable error of a place or depth, in the unit
  Sourced missed_depth;    ///< the largest tolerable depth of a contact that an answer misses, in the unit
  Sourced time_error;      ///< the largest tolerable error of a time of impact, as a share of the step
  Sourced missed_rate;     ///< the largest tolerable share of contacts that are missed more deeply, 0 to 1
  Sourced phantom_rate;    ///< the largest tolerable share of contacts that are none by more than position_error
  Sourced time_budget;     ///< seconds for all queries of a step
};

struct Scene {
  std::string name;   ///< "robot-cell"
  std::string title;  ///< one line
  std::filesystem::path file;
  std::string unit;                  ///< one of known_units()
  Scalar scalar = Scalar::float64;   ///< in which the scene's programs compute
  std::string scalar_source;         ///< the source of `scalar`
  Sourced extent;                    ///< half the width of the cube in which the shapes are, in the unit
  Spread distance;                   ///< of the middle of that cube from the origin, in the unit
  Sourced step;                      ///< the time step, in seconds
  Sourced queries_per_step;          ///< how many queries a step asks
  Sourced near_contact;              ///< the share of drawn cases that are made near contact, 0 to 1
  std::vector<Shapes> shapes;        ///< empty where the cases are recorded
  std::vector<MixedQuery> queries;   ///< the mix; not empty
  Requirements required;             ///< "requires" in the file
  std::filesystem::path cases_file;  ///< the recorded cases, JSON lines; empty without
  std::vector<Case> recorded;        ///< its cases; empty without

  bool is_recorded() const { return !recorded.empty(); }
  /// The entry of the mix; nullptr for a query that the scene does not ask.
  const MixedQuery* find(const Query& query) const;
  /// The share of the query in the mix, 0 to 1; 0 for a query that the scene does not ask.
  double share_of(const Query& query) const;
  std::vector<const Query*> all_queries() const;
};

/// What the scene requires of a single answer. Its rates are about many answers, and no part of it.
std::shared_ptr<const SceneLimits> limits_of(const Scene& scene);

/// A unit of length and its length in metres.
struct Unit {
  std::string_view name;
  double metres;
};
std::span<const Unit> known_units();

/// Reads a scene from its JSON; `file` is where it is from, and where the path of recorded cases starts. Throws
/// BadInput that states file, field, value and rule.
Scene scene_from_json(const nlohmann::json& j, const std::filesystem::path& file);
/// The name of a scene in corpus/scenes/, or a file. Throws BadInput for an unknown name, which lists the known ones.
Scene load_scene(const std::string& name_or_file);
/// The names of the scenes in corpus/scenes/, in order.
std::vector<std::string> scene_names();
std::filesystem::path scenes_folder();

}  // namespace nearmiss::scenes

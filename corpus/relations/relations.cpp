#include "corpus/relations/relations.hpp"

namespace nearmiss {

namespace {

/// The closed table. The first group depends on the roles of the numbers alone and holds for every query.
constexpr Relation all_relations[] = {
    {"scaled-lengths", "all lengths times a power of two: lengths of the answer alike, times unchanged", true,
     metamorphic::scaled_lengths},
    {"scaled-time", "velocities times a power of two: times divided by it", true, metamorphic::scaled_time},
    {"scaled-directions", "directions and planes times a power of two: nothing changes", true,
     metamorphic::scaled_directions},
    {"scaled-rotations", "quaternions times a power of two: nothing changes", true, metamorphic::scaled_rotations},
    {"negated-rotations", "quaternions times -1: nothing changes", true, metamorphic::negated_rotations},
    {"reflected", "space reflected in coordinate planes: the answer alike", false, metamorphic::reflected},
    {"permuted-axes", "x, y, z renamed: the answer alike", false, metamorphic::permuted_axes},
    {"translated", "everything moved by a vector that adds exactly: places alike", false, metamorphic::translated},
    {"rotated", "everything turned by a whole quaternion, and as many times larger: times and decisions alike", false,
     metamorphic::rotated},
    {"turned-corners", "corners named in another order: nothing changes but their weights", false,
     metamorphic::turned_corners},
    {"reversed-corners", "corners the other way around, where there is no front: the same but for weights and edges",
     false, metamorphic::reversed_corners},
    {"swapped", "the first thing as the second: normals turn around", false, metamorphic::swapped},
    {"reversed-directions", "a direction that only names a line, the other way: nothing changes", false,
     metamorphic::reversed_directions},
    {"another-hint", "another hint: nothing changes where the boxes overlap, and never the decision", false,
     metamorphic::another_hint},
    {"later-start", "the same motion from a later time on: contacts come so much earlier", false,
     metamorphic::later_start},
    {"split-motion", "a motion in two parts: it passes where one of them does", false, metamorphic::split_motion},
    {"grown-size", "a larger solid: hit no later, no shallower, never missed instead", false, metamorphic::grown_size},
    {"grown-radius", "a larger radius: the distance smaller by as much", false, metamorphic::grown_radius},
    {"contained-ball", "a ball inside of a box or capsule: not hit before it, nor without it", false,
     metamorphic::contained_ball},
    {"longer-limit", "a longer limit: never fewer passes", false, metamorphic::longer_limit},
    {"prepared", "what is computed beforehand changes nothing", false, metamorphic::prepared},
    {"one-point", "a capsule with equal ends is a sphere, a box without extents a point", false,
     metamorphic::one_point},
    {"sphere-as-point", "a sphere of radius 0 is a point", false, metamorphic::sphere_as_point},
    {"two-triangles", "a rectangle is hit when the first of its triangles is, and seen in where one of them is", false,
     metamorphic::two_triangles},
    {"same-decision", "overlap is a depth of at least 0; boxes that meet pass the conservative test", false,
     metamorphic::same_decision},
    {"sign-of-distance", "shapes overlap where their distance is below 0, and are apart where it is above", false,
     metamorphic::sign_of_distance},
    {"depth-of-distance", "the depth of an overlap is the distance below 0", false, metamorphic::depth_of_distance},
    {"distance-of-closest", "the closest point is as far away as the shape", false, metamorphic::distance_of_closest},
    {"gap-before-contact", "a moving shape needs time for the distance at the start", false,
     metamorphic::gap_before_contact},
    {"hits-pass", "what hits at some time passes within unlimited time", false, metamorphic::hits_pass},
    {"other-side", "a point that hits one side of a shape does not hit the other", false, metamorphic::other_side},
};

}  // namespace

std::span<const Relation> relations() { return all_relations; }

const Relation* find_relation(std::string_view name) {
  for (const Relation& r : all_relations) {
    if (r.name == name) return &r;
  }
  return nullptr;
}

}  // namespace nearmiss

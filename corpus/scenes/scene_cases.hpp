/// The cases of a scene.
#pragma once

#include <cstdint>

#include "corpus/scenes/scene_file.hpp"
#include "impl/subject/precondition.hpp"

namespace nearmiss::scenes {

/// The `index`-th case of a query of the scene in the stream `seed`: the same on every machine, valid, and exact in
/// `scalar`. Throws std::logic_error for a query that the scene does not ask.
///
/// Without recorded cases: shapes of the scene's sizes at places of the scene, near enough to each other that a broad
/// phase keeps the pair. The share `near_contact` of the cases is made to touch, but for a gap or an overlap of up to
/// eight times the tolerable error; moving shapes graze. With recorded cases: these in their order, rounded to the
/// scalar; then again and again, with one operand moved by up to eight times the tolerable error.
void draw_case(Case& into, const Scene& scene, const Query& query, Scalar scalar, std::uint64_t seed,
               std::uint64_t index);
Case draw_case(const Scene& scene, const Query& query, Scalar scalar, std::uint64_t seed, std::uint64_t index);

/// The same, changed to meet the preconditions of a subject where it does not (see fit() in corpus/generator/fit.hpp).
void draw_case_inside(Case& into, const Scene& scene, const Query& query, Scalar scalar, std::uint64_t seed,
                      std::uint64_t index, Preconditions required);

/// The largest gap or overlap of a case that is made near contact: eight times the tolerable error of places and
/// depths.
double largest_gap(const Scene& scene);

/// Which query the `index`-th question of the mix asks: drawn by weight, the same on every machine.
const Query& drawn_query(const Scene& scene, std::uint64_t seed, std::uint64_t index);

}  // namespace nearmiss::scenes

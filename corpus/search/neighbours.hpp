/// Neighbours of a case: the steps of a search that climbs towards a larger error.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "impl/catalogue/case.hpp"

namespace nearmiss {

/// A case that differs from `of` by `changes` small changes, drawn by `seed`. Each change concerns one number: it moves
/// by 2^k ulps for any k, is multiplied by a small power of two, changes its sign, loses its low bits or mirrors them,
/// or becomes equal to another number of its role. Flags and indices stay. The case is valid and exact in its scalar,
/// and the same on every machine. `of` itself where several attempts make no valid case.
Case neighbour(const Case& of, int changes, std::uint64_t seed);

/// The case that lies beyond `here` as seen from `before`: each number at here + factor * (here - before), rounded to
/// the scalar. Empty where it is not valid or differs in nothing from `here`. Flags and indices are those of `here`.
std::optional<Case> beyond(std::span<const double> before, const Case& here, double factor);

}  // namespace nearmiss

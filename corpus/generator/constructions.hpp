/// Mutators that build a configuration from the structure of the operands. For the table in mutators.cpp.
#pragma once

#include "corpus/generator/case_builder.hpp"

namespace nearmiss {

/// Whole numbers that are the sides of a box with a whole diagonal; the diagonal comes last.
inline constexpr int whole_diagonals[][4] = {{1, 2, 2, 3}, {2, 3, 6, 7},   {1, 4, 8, 9},   {4, 4, 7, 9},  {2, 6, 9, 11},
                                             {3, 4, 0, 5}, {5, 12, 0, 13}, {8, 15, 0, 17}, {7, 24, 0, 25}};

// exact_contacts.cpp: configurations in a frame of whole numbers, in which no number is rounded.

/// Four corners become those of a rectangle: upright, or tilted with sides at an exact right angle.
bool true_rectangle(CaseBuilder& d);
/// The moving operand touches another operand, or the plane, at the start. It moves in, along the surface or out.
bool start_on_surface(CaseBuilder& d);
/// A vertex of the first operand touches the second one, and its other vertices lead away. For two operands at rest, of
/// which the first one is no box.
void touch_at_rest(CaseBuilder& d);
/// The moving operand meets another operand exactly at the query's time, or that time is an ulp off.
bool limit_at_contact(CaseBuilder& d);

// near_parallel.cpp

/// Two long, thin boxes cross at an angle of 1e-5 ... 0.3 degrees. Their long edges are a little apart, or their boxes
/// overlap a little, along the cross product of these edges.
bool crossed_edges(CaseBuilder& d);
/// The moving operand starts far away and moves nearly along a capsule's axis, nearly touching the side or an end.
bool along_capsule(CaseBuilder& d);

}  // namespace nearmiss

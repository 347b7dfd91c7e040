/// Mutators that build a configuration from the structure of the operands. For the table in mutators.cpp.
#pragma once

#include "corpus/generator/case_builder.hpp"

namespace nearmiss {

/// Whole numbers that are the sides of a box with a whole diagonal; the diagonal comes last.
inline constexpr int whole_diagonals[][4] = {{1, 2, 2, 3}, {2, 3, 6, 7},   {1, 4, 8, 9},   {4, 4, 7, 9},  {2, 6, 9, 11},
                                             {3, 4, 0, 5}, {5, 12, 0, 13}, {8, 15, 0, 17}, {7, 24, 0, 25}};

/// 1e-16 ... 1e-2, of either sign; or the powers of ten that are given.
double tiny(CaseBuilder& d, int least = 2, int most = 16);

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

// feature_pairs.cpp: special positions of two features of any two shapes

/// An edge of one operand gets the direction of another operand's edge or face diagonal. Boxes are turned alike, or by
/// right angles.
bool parallel_edges(CaseBuilder& d);
/// The same, 1e-16 ... 1e-2 off. For operands of which one has an edge that can turn alone.
bool nearly_parallel_edges(CaseBuilder& d);
/// All positions of an operand lie in the plane of another operand's face, or in a plane through its edge. Two boxes
/// have faces in one plane.
bool coplanar_features(CaseBuilder& d);
/// A point of an edge of one operand becomes a point of another operand's edge, or its center: the cores share it, but
/// for rounding.
bool crossing_edges(CaseBuilder& d);
/// Vertex, edge or face of one operand meets one of another operand, or the surfaces of their radii meet above these.
/// In half of the cases the gap is off by 1e-16 ... 1e-2 of the radii.
bool touching_features(CaseBuilder& d);

}  // namespace nearmiss

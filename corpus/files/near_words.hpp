/// Words that a user may have meant: by edit distance, and by the words that other programs use.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace nearmiss {

/// At most three of `words` that are near `word` by edit distance, without regard to case, nearest first.
std::vector<std::string> close_matches(std::string_view word, std::span<const std::string> words);

/// At most three queries of the catalogue, nearest first: those that are close matches, or that have the same words
/// where "ray" is a moving point, "obb" a box, "aabb" an aabox, and so on.
std::vector<std::string> nearest_queries(std::string_view name);
/// "unknown query 'ray_triangle'; did you mean moving_point_triangle?"; where none is near, the command that lists all.
std::string unknown_query_text(std::string_view name);

/// What to say about a field that is not among the expected ones: "did you mean velocity?"; for the corners of a box,
/// how its own fields follow from them. Empty where nothing is near.
std::string nearest_field_text(std::string_view name, std::span<const std::string> expected);

}  // namespace nearmiss

#include "oracles/seen_from_behind.hpp"

#include <algorithm>
#include <utility>

namespace nearmiss {

namespace {

void swap_vectors(Case& c, std::size_t i, std::size_t k) {
  std::swap_ranges(&c.values[i], &c.values[i] + 3, &c.values[k]);
}

Case with_reversed_plane(Case c, const Operand& plane) {
  for (std::size_t i = plane.begin; i < plane.begin + plane.count; ++i) c.values[i] = -c.values[i];
  return c;
}

}  // namespace

std::optional<Case> seen_from_behind(const Case& question) {
  const Operands& parts = question.operands();
  if (const Operand* plane = parts.find(Shape::plane)) return with_reversed_plane(question, *plane);
  Case other = question;
  if (!parts.rectangles.empty()) {
    swap_vectors(other, parts.rectangles[0][1], parts.rectangles[0][3]);
  } else if (!parts.triangles.empty()) {
    swap_vectors(other, parts.triangles[0][1], parts.triangles[0][2]);
  } else {
    return std::nullopt;
  }
  return other;
}

Answer seen_from_behind(const Case& question, Answer answer) {
  for (const Layout::Part& p : question.query->layout.parts) {
    if (p.role != Role::weight || p.end - p.begin != 3) continue;
    const std::uint64_t one = std::uint64_t{1} << (p.begin + 1), other = one << 1;
    const bool had_one = answer.gives(p.begin + 1), had_other = answer.gives(p.begin + 2);
    std::swap(answer.values[p.begin + 1], answer.values[p.begin + 2]);
    answer.given = (answer.given & ~(one | other)) | (had_other ? one : 0) | (had_one ? other : 0);
  }
  return answer;
}

}  // namespace nearmiss

#include "reports/engine/schedule.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "corpus/generator/fit.hpp"
#include "corpus/scenes/scene_cases.hpp"

namespace nearmiss {

namespace {

/// The sum of the weights of those queries in the scene's mix.
double weight_of_all(const std::vector<const Query*>& queries, const scenes::Scene& scene) {
  double sum = 0;
  for (const Query* q : queries) sum += scene.share_of(*q);
  return sum;
}

}  // namespace

Schedule::Schedule(const std::vector<const Query*>& queries, const std::vector<const Subject*>& subjects,
                   std::optional<std::uint64_t> cases, std::size_t first_batch, const scenes::Scene* scene) {
  for (const Query* q : queries) {
    const double share = scene == nullptr ? 1 : scene->share_of(*q) / weight_of_all(queries, *scene);
    if (!(share > 0)) continue;
    const auto own =
        cases ? std::optional(std::max<std::uint64_t>(1, std::uint64_t(std::llround(share * double(*cases)))))
              : std::nullopt;
    for (const Scalar scalar : {Scalar::float32, Scalar::float64}) {
      std::map<Preconditions, std::vector<const Subject*>> sets;
      for (const Subject* s : subjects) {
        const Offering& o = s->offering(q->name);
        if (s->scalar == scalar && !(o.answer == nullptr)) sets[o.required].push_back(s);
      }
      for (const auto& [required, alike] : sets) {
        streams_.push_back({q, scalar, required, alike, 0, 0, first_batch, own, scene, share});
      }
    }
  }
}

Stream* Schedule::next() {
  const auto stream = std::min_element(streams_.begin(), streams_.end(), [&](const Stream& a, const Stream& b) {
    return std::pair(a.is_over(), a.seconds / a.share) < std::pair(b.is_over(), b.seconds / b.share);
  });
  return stream == streams_.end() || stream->is_over() ? nullptr : &*stream;
}

std::size_t Schedule::batch_of(const Stream& s, std::size_t most) const {
  const std::size_t wanted = std::min(s.batch, most);
  return s.cases ? std::min(wanted, std::size_t(*s.cases - s.next)) : wanted;
}

void generate_next(Stream& s, std::uint64_t seed, std::size_t count, std::vector<Case>& into) {
  into.resize(count);
  for (Case& c : into) {
    if (s.scene == nullptr) {
      generate_inside(c, *s.query, s.scalar, seed, s.next++, s.required);
    } else {
      scenes::draw_case_inside(c, *s.scene, *s.query, s.scalar, seed, s.next++, s.required);
    }
  }
}

}  // namespace nearmiss

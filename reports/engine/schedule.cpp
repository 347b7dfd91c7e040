#include "reports/engine/schedule.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "corpus/fit.hpp"

namespace nearmiss {

Schedule::Schedule(const std::vector<const Query*>& queries, const std::vector<const Subject*>& subjects,
                   std::optional<std::uint64_t> cases, std::size_t first_batch)
    : cases_(cases) {
  for (const Query* q : queries) {
    for (const Scalar scalar : {Scalar::float32, Scalar::float64}) {
      std::map<Preconditions, std::vector<const Subject*>> sets;
      for (const Subject* s : subjects) {
        const Offering& o = s->offering(q->name);
        if (s->scalar == scalar && !(o.answer == nullptr)) sets[o.required].push_back(s);
      }
      for (const auto& [required, alike] : sets) streams_.push_back({q, scalar, required, alike, 0, 0, first_batch});
    }
  }
}

Stream* Schedule::next() {
  const auto stream = std::min_element(streams_.begin(), streams_.end(), [&](const Stream& a, const Stream& b) {
    return std::pair(is_over(a), a.seconds) < std::pair(is_over(b), b.seconds);
  });
  return stream == streams_.end() || is_over(*stream) ? nullptr : &*stream;
}

std::size_t Schedule::batch_of(const Stream& s, std::size_t most) const {
  const std::size_t wanted = std::min(s.batch, most);
  return cases_ ? std::min(wanted, std::size_t(*cases_ - s.next)) : wanted;
}

void generate_next(Stream& s, std::uint64_t seed, std::size_t count, std::vector<Case>& into) {
  into.resize(count);
  for (Case& c : into) generate_inside(c, *s.query, s.scalar, seed, s.next++, s.required);
}

}  // namespace nearmiss

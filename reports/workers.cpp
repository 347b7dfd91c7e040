#include "reports/workers.hpp"

#include <algorithm>

namespace nearmiss {

Worker& Workers::of(const Subject& subject) {
  std::unique_ptr<Worker>& worker = workers_[&subject];
  if (!worker) worker = std::make_unique<Worker>(limits_);
  return *worker;
}

std::size_t Workers::capacity_for(const Query& query) {
  return std::min(Worker::capacity, Worker::max_values / query.inputs.size());
}

Answer Workers::ask(const Subject& subject, const Case& question) {
  send(subject, {&question, 1});
  return receive(subject).front();
}

void Workers::send(const Subject& subject, std::span<const Case> cases) {
  flat_.clear();
  for (const Case& c : cases) flat_.insert(flat_.end(), c.values.begin(), c.values.end());
  of(subject).send(subject.offering(cases.front().query->name), flat_, cases.front().values.size());
}

std::span<const Answer> Workers::receive(const Subject& subject) { return of(subject).receive(); }

std::optional<Case> in_scalar(const Case& question, Scalar scalar) {
  const bool exact =
      std::all_of(question.values.begin(), question.values.end(), [&](double x) { return representable(x, scalar); });
  if (!exact) return std::nullopt;
  Case c = question;
  c.scalar = scalar;
  return c;
}

}  // namespace nearmiss

#include "reports/findings/workers.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "impl/host/hosts.hpp"
#include "oracles/requirements.hpp"

namespace nearmiss {

Workers::Asked& Workers::of(const Subject& subject) {
  Asked& asked = workers_[&subject];
  if (!asked.worker) asked.worker = std::make_unique<Worker>(worker_limits(), subject.host, on_wait_);
  return asked;
}

std::size_t Workers::capacity_for(const Query& query) {
  return std::min(Worker::capacity, Worker::max_values / query.most_numbers());
}

Answer Workers::ask(const Subject& subject, const Case& question) {
  if (on_wait_ && !on_wait_()) return answer_of_given_up();
  send(subject, {&question, 1});
  const std::span<const Answer> answers = receive(subject);
  return answers.empty() ? answer_of_given_up() : answers.front();
}

Answer answer_of_given_up() { return Answer::without(Answer::Status::cannot_answer, "not asked: interrupted"); }

/// Adds a case to those that are sent next.
void Workers::add(const Case& c) {
  flat_.insert(flat_.end(), c.values.begin(), c.values.end());
  lengths_.push_back(std::uint32_t(c.values.size()));
}

void Workers::send(const Subject& subject, std::span<const Case> cases, Rounding rounding) {
  const Offering& offering = subject.offering(cases.front().query->name);
  Asked& asked = of(subject);
  asked.all = offering.required.empty();
  asked.inside.clear();
  asked.answers.clear();
  flat_.clear(), lengths_.clear();
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const Preconditions unmet = unmet_by(cases[i], offering.required);
    if (!asked.all) asked.answers.push_back(unmet.empty() ? Answer{} : answer_of_unasked(unmet));
    if (!unmet.empty()) continue;
    if (!asked.all) asked.inside.push_back(i);
    add(cases[i]);
  }
  if (!flat_.empty()) asked.worker->send(offering, flat_, lengths_, rounding);
}

std::span<const Answer> Workers::receive(const Subject& subject, std::size_t most_broken) {
  try {
    return received(of(subject), most_broken);
  } catch (const HostFailed& e) {
    throw BadSubject(fmt::format("{}: {}", subject.command.empty() ? subject.plugin : subject.command, e.what()));
  }
}

std::span<const Answer> Workers::received(Asked& asked, std::size_t most_broken) {
  if (asked.all) return asked.worker->receive(most_broken);
  if (asked.inside.empty()) return asked.answers;
  const std::span<const Answer> given = asked.worker->receive(most_broken);
  for (std::size_t i = 0; i < given.size(); ++i) asked.answers[asked.inside[i]] = given[i];
  if (given.size() < asked.inside.size()) return {asked.answers.data(), asked.inside[given.size()]};
  return asked.answers;
}

bool Workers::was_sent(const Subject& subject, std::size_t case_of_batch) const {
  return sent_at(workers_.at(&subject), case_of_batch).has_value();
}

std::string Workers::lost(const Subject& subject) const {
  const auto found = workers_.find(&subject);
  return found == workers_.end() ? "" : found->second.worker->lost();
}

std::optional<std::size_t> Workers::sent_at(const Asked& asked, std::size_t case_of_batch) const {
  if (asked.all) return case_of_batch;
  const auto at = std::lower_bound(asked.inside.begin(), asked.inside.end(), case_of_batch);
  if (at == asked.inside.end() || *at != case_of_batch) return std::nullopt;
  return std::size_t(at - asked.inside.begin());
}

std::string_view Workers::output(const Subject& subject, std::size_t case_of_batch) const {
  const auto found = workers_.find(&subject);
  if (found == workers_.end()) return {};
  const auto at = sent_at(found->second, case_of_batch);
  return at ? found->second.worker->output(*at) : std::string_view{};
}

std::uint8_t Workers::raised(const Subject& subject, std::size_t case_of_batch) const {
  const auto found = workers_.find(&subject);
  if (found == workers_.end()) return 0;
  const auto at = sent_at(found->second, case_of_batch);
  return at ? found->second.worker->raised(*at) : std::uint8_t{0};
}

std::optional<Worker::Times> Workers::time(const Subject& subject, std::span<const Case> cases) {
  flat_.clear(), lengths_.clear();
  for (const Case& c : cases) add(c);
  const Offering& offering = subject.offering(cases.front().query->name);
  return of(subject).worker->time(offering, flat_, lengths_);
}

double Workers::processor_seconds(const Subject& subject) const {
  const auto found = workers_.find(&subject);
  return found == workers_.end() ? 0 : found->second.worker->processor_seconds();
}

std::optional<Case> in_scalar(const Case& question, Scalar scalar) {
  const bool exact =
      std::all_of(question.values.begin(), question.values.end(), [&](double x) { return representable(x, scalar); });
  if (!exact) return std::nullopt;
  Case c = question;
  c.scalar = scalar;
  return c;
}

}  // namespace nearmiss

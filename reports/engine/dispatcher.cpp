#include "reports/engine/dispatcher.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "reports/findings/text.hpp"

namespace nearmiss {

std::string given_up_text(std::string_view subject, std::string_view query, const Endurance& e) {
  const std::string more = plural_text(e.gave_up, "more case");
  if (!e.lost.empty())
    return fmt::format("{} cannot be started again ({}), and was not asked {} of {}", subject, e.lost, more, query);
  if (e.is_often_late() || !e.always_broke())
    return fmt::format("{} was late {} of {}, and was not asked {}", subject, plural_text(e.late, "time"), query, more);
  return fmt::format("{} broke in each of its first {} of {}, and was not asked {}", subject,
                     plural_text(e.broke, "case"), query, more);
}

bool Dispatcher::is_given_up(const Subject& subject, const Query& query) {
  if (rule_ == GiveUp::never) return false;
  return endurance(subject, query).is_often_late() || most_broken(subject, query) == 0 || lost_.contains(&subject);
}

/// The number of breakages, from now on, after which the subject is given up on the query.
std::uint64_t Dispatcher::most_broken(const Subject& subject, const Query& query) {
  const Endurance& e = endurance(subject, query);
  if (rule_ == GiveUp::never || !e.always_broke()) return Worker::capacity;
  const auto left = [](std::uint64_t most, std::uint64_t now) { return most - std::min(most, now); };
  return std::max(left(most_broken_in_row, broken_in_row_[&subject]), left(least_broken_of_query, e.broke));
}

void Dispatcher::count(const Subject& subject, const Query& query, std::span<const Answer> answers) {
  Endurance& e = endurance_[{&subject, &query}];
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const Answer& a = answers[i];
    ++e.asked;
    if (!workers_.was_sent(subject, i)) continue;
    e.late += a.late();
    const bool broke = a.status == Answer::Status::broke;
    ++(broke ? e.broke : e.answered);
    broken_in_row_[&subject] = broke ? broken_in_row_[&subject] + 1 : 0;
  }
  if (std::string why = workers_.lost(subject); !why.empty() && rule_ != GiveUp::never) lost_[&subject] = why;
}

void Dispatcher::ask(std::span<const Subject* const> subjects, std::span<const Case> cases,
                     const std::function<void()>& meanwhile,
                     const std::function<void(const Subject&, std::span<const Answer>)>& take) {
  if (cases.empty()) return;
  const Query& query = *cases.front().query;
  std::vector<const Subject*> asked;
  for (const Subject* s : subjects) {
    if (is_given_up(*s, query)) {
      pass_over(*s, query, cases.size());
      if (const auto lost = lost_.find(s); lost != lost_.end()) endurance_[{s, &query}].lost = lost->second;
    } else {
      asked.push_back(s);
      workers_.send(*s, cases);
    }
  }
  if (meanwhile) meanwhile();
  for (const Subject* s : asked) {
    const std::span<const Answer> answers = workers_.receive(*s, most_broken(*s, query));
    count(*s, query, answers);
    if (const auto lost = lost_.find(s); lost != lost_.end()) endurance_[{s, &query}].lost = lost->second;
    take(*s, answers);
  }
}

}  // namespace nearmiss

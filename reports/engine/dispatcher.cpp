#include "reports/engine/dispatcher.hpp"

#include <algorithm>

namespace nearmiss {

bool Dispatcher::is_given_up(const Subject& subject, const Query& query) {
  return rule_ == GiveUp::when_often_late && lateness(subject, query).gives_up();
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
    } else {
      asked.push_back(s);
      workers_.send(*s, cases);
    }
  }
  if (meanwhile) meanwhile();
  for (const Subject* s : asked) {
    const std::span<const Answer> answers = workers_.receive(*s);
    Lateness& l = lateness_[{s, &query}];
    l.asked += answers.size();
    l.late += std::uint64_t(std::count_if(answers.begin(), answers.end(), [](const Answer& a) { return a.late(); }));
    take(*s, answers);
  }
}

}  // namespace nearmiss

#include "corpus/relations/follow_ups.hpp"

#include <algorithm>
#include <cmath>

namespace nearmiss {

std::string_view name_of(Agreement a) {
  switch (a) {
    case Agreement::same: return "same";
    case Agreement::numbers_differ: return "numbers differ";
    case Agreement::decisions_differ: return "decisions differ";
  }
  return "?";
}

namespace metamorphic {

namespace {

Agreement compare(const Query& query, const Answer& a, const Answer& b) {
  if (a.status != b.status || a.status != Answer::Status::answered) return Agreement::same;  // nothing to compare
  if (a.yes != b.yes) return Agreement::decisions_differ;
  for (std::size_t i = 0; i < query.outputs.size(); ++i) {
    const bool neither_is_a_number = std::isnan(a.values[i]) && std::isnan(b.values[i]);
    if (a.gives(i) && b.gives(i) && a.values[i] != b.values[i] && !neither_is_a_number)
      return Agreement::numbers_differ;
  }
  return Agreement::same;
}

}  // namespace

FollowUps counterpart(Case other, std::function<Answer(const Answer&)> image) {
  const Query& query = *other.query;
  return {{std::move(other)},
          [&query, image](const Answer& own, std::span<const Answer> others) {
            return compare(query, own.status == Answer::Status::answered ? image(own) : own, others[0]);
          },
          std::move(image),
          true,
          true};
}

FollowUps ordered(std::vector<Case> others, std::function<Agreement(const Answer&, std::span<const Answer>)> compare) {
  return {std::move(others),
          [compare = std::move(compare)](const Answer& own, std::span<const Answer> answers) {
            const auto answered = [](const Answer& a) { return a.status == Answer::Status::answered; };
            if (!answered(own) || !std::all_of(answers.begin(), answers.end(), answered)) return Agreement::same;
            return compare(own, answers);
          },
          {},
          true,
          true};
}

bool valid(const Case& c) {
  return std::all_of(c.values.begin(), c.values.end(),
                     [&](double x) { return std::isfinite(x) && representable(x, c.scalar); }) &&
         !c.query->broken(c.values);
}

std::optional<FollowUps> counterpart_if_valid(Case other, std::function<Answer(const Answer&)> image) {
  if (!valid(other)) return std::nullopt;
  return counterpart(std::move(other), std::move(image));
}

double slack(Scalar scalar, double a, double b) { return 4 * (ulp(a, scalar) + ulp(b, scalar)); }

}  // namespace metamorphic
}  // namespace nearmiss

#include "reports/triage/hypotheses/predictions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <boost/math/distributions/binomial.hpp>
#include <cmath>

#include "reports/findings/severity.hpp"
#include "reports/triage/causes/shares.hpp"

namespace nearmiss {

namespace {

using Contradiction = std::optional<Evidence>;

/// A change at a far smaller or larger scale is that of a constant that keeps such numbers out.
constexpr int furthest_scale = 32;

/// The first scan in which the finding ends.
const ScaleScan* ending_scan(AskedCases& asked, std::size_t groups) {
  const auto& scans = asked.scans();
  const auto end = scans.begin() + std::ptrdiff_t(std::min(groups, scans.size()));
  const auto found = std::find_if(scans.begin(), end, [](const ScaleScan& s) {
    return s.has_clean_flip() && std::abs(s.flip->right) <= furthest_scale;
  });
  return found == end ? nullptr : &*found;
}

Contradiction depends_on_scale(AskedCases& asked) {
  constexpr std::size_t lengths_and_velocities = 2;
  const ScaleScan* s = ending_scan(asked, lengths_and_velocities);
  if (s == nullptr) return std::nullopt;
  return Evidence{fmt::format("All {} were multiplied by powers of two.", s->group->name),
                  fmt::format("The finding is there with 2^{}, and the answer is right with 2^{}.", s->flip->wrong,
                              s->flip->right)};
}

Contradiction stays_at_every_scale(AskedCases& asked) {
  if (ending_scan(asked, asked.scans().size()) != nullptr) return std::nullopt;
  return Evidence{"The numbers of the case were multiplied by powers of two.",
                  fmt::format("The finding stays from 2^-{0} to 2^{0}.", furthest_scale)};
}

/// A subject behind pipes has one rounding mode. Rounding errors change with the last bits of the inputs, too.
Contradiction depends_on_last_bits(AskedCases& asked) {
  const std::vector<Trial>& near = asked.neighbours();
  const std::size_t right = count(near, Outcome::right), all = count_answered(near);
  if (all == 0 || nearly_all(all - right, all)) return std::nullopt;
  return Evidence{fmt::format("{} cases were asked whose numbers are a few ulps away.", all),
                  fmt::format("{} are right.", right)};
}

Contradiction depends_on_rounding(AskedCases& asked) {
  const std::vector<Trial>& all = asked.roundings();
  if (all.empty()) return depends_on_last_bits(asked);
  const std::size_t right = count(all, Outcome::right);
  if (right == 0) return std::nullopt;
  return Evidence{"The case was asked in the four rounding modes.", fmt::format("It is right in {}.", right)};
}

/// Others that may have another cause count where they are proved to be more than a few.
Contradiction is_right_in_a_mode(AskedCases& asked) {
  const std::size_t own = count(asked.roundings(), Outcome::right);
  const auto& others = asked.similar_roundings();
  const auto right = std::size_t(std::count_if(
      others.begin(), others.end(), [](const std::vector<Trial>& modes) { return count(modes, Outcome::right) > 0; }));
  if (own == 0 && proved_at_least(right, others.size()) <= 1 - share_of_nearly_all) return std::nullopt;
  return Evidence{
      "The case and others with the finding were asked in the four rounding modes.",
      fmt::format("The case is right in {}, and {} others are right in one.", own, of_text(right, others.size()))};
}

/// Rounding errors that differ by less than a quarter are those of one rounding.
Contradiction is_untouched_by_rounding(AskedCases& asked) {
  constexpr double alike = 1.25;
  const std::vector<Trial>& near = asked.neighbours();
  for (const auto* list : {&asked.roundings(), &near}) {
    if (count(*list, Outcome::right) > 0) return std::nullopt;
    const auto errors = asked.errors_of(*list);
    if (errors && errors->second >= alike * errors->first) return std::nullopt;
  }
  if (count_answered(near) == 0) return std::nullopt;
  return Evidence{fmt::format("{} cases were asked whose numbers are a few ulps away{}.", count_answered(near),
                              asked.roundings().empty() ? "" : ", and the case in the four rounding modes"),
                  "None is right, and none has another error."};
}

/// No formula of the queries has a higher degree than 8: that of the discriminant of a point that meets a cylinder,
/// which is a product of two products of two squared lengths. So numbers between 2^-16 and 2^16 leave no range, not
/// even that of a float.
Contradiction stays_in_range(AskedCases& asked) {
  constexpr int degree = 8, range_of_floats = 128;
  const auto& values = asked.question().values;
  const bool is_extreme = std::any_of(values.begin(), values.end(), [](double x) {
    return x != 0 && degree * std::abs(std::ilogb(x)) >= range_of_floats;
  });
  if (is_extreme) return std::nullopt;
  return Evidence{
      "The magnitudes of the numbers were compared with the ranges of types.",
      fmt::format("Each lies between 2^-{0} and 2^{0}: no product of {1} of them leaves the range of a float.",
                  range_of_floats / degree, degree)};
}

/// Rounding moves what is computed by shares of epsilon of its largest term, and a root halves the digits. A few roots
/// of a few terms of the digits of a float lose no more.
Contradiction is_no_error_of_rounding(AskedCases& asked) {
  constexpr double terms = 16;
  const double most = terms * std::sqrt(unit_roundoff(Scalar::float32));
  const Trials& trials = asked.trials();
  const ErrorSize size = error_size(asked.question(), trials.in_full(trials.base()));
  if (size.relative <= most) return std::nullopt;
  return Evidence{"The error was compared with the errors that rounding may have.",
                  fmt::format("It is {}, and the root of the epsilon of a float, {} times, is {}.", size_text(size),
                              terms, share_text(most))};
}

/// Of the answers at the `count` nearest scales on one side of the flip, those that are not as the side has them.
std::size_t exceptions(const ScaleScan& s, bool on_wrong_side, std::size_t count) {
  const int direction = (s.flip->right > s.flip->wrong) == on_wrong_side ? -1 : 1;
  const int begin = on_wrong_side ? s.flip->wrong : s.flip->right;
  std::vector<const ScaleScan::At*> side;
  for (const ScaleScan::At& a : s.trials) {
    if ((a.k - begin) * direction >= 0 && a.trial.outcome != Outcome::none) side.push_back(&a);
  }
  std::sort(side.begin(), side.end(),
            [&](const auto* a, const auto* b) { return std::abs(a->k - begin) < std::abs(b->k - begin); });
  side.resize(std::min(side.size(), count));
  return std::size_t(std::count_if(
      side.begin(), side.end(), [&](const auto* a) { return (a->trial.outcome == Outcome::right) == on_wrong_side; }));
}
/// A comparison with a constant has one border. Of 16 answers that are right or wrong by chance, so few are exceptions
/// in 17 of 2^16 cases.
Contradiction has_several_borders(AskedCases& asked) {
  constexpr std::size_t on_a_side = 8, most_exceptions = 1;
  for (const ScaleScan& s : asked.scans()) {
    if (!s.has_clean_flip()) continue;
    if (exceptions(s, true, on_a_side) + exceptions(s, false, on_a_side) <= most_exceptions) continue;
    return Evidence{fmt::format("All {} were multiplied by powers of two.", s.group->name),
                    fmt::format("Right and wrong ones alternate near 2^{}: no constant divides them.", s.flip->wrong)};
  }
  return std::nullopt;
}

/// Two borders of the subject and two at the ends of the scalar's range. Answers that are right or wrong by chance
/// alternate more often.
Contradiction has_many_borders(AskedCases& asked) {
  constexpr std::size_t borders = 4;
  for (const ScaleScan& s : asked.scans()) {
    if (!s.has_clean_flip()) continue;
    std::size_t changes = 0;
    std::optional<bool> before;
    for (const ScaleScan::At& a : s.trials) {
      if (a.trial.outcome == Outcome::none) continue;
      const bool is_right = a.trial.outcome == Outcome::right;
      changes += before && *before != is_right;
      before = is_right;
    }
    if (changes <= borders) continue;
    return Evidence{fmt::format("All {} were multiplied by powers of two.", s.group->name),
                    fmt::format("Right and wrong answers alternate {} times.", changes)};
  }
  return std::nullopt;
}

/// A comparison with a constant has one border. Seen from a few ulps away, the border is a plane: of two opposite moves
/// at least one stays on the side of the case. So at least half of the nearby cases must be wrong; those with another
/// exact decision say nothing. Contradicted where chance leaves so few wrong in fewer than one of 2^16 cases.
Contradiction is_lost_nearby(AskedCases& asked) {
  constexpr double chance = 0x1p-16, half = 0.5;
  std::size_t same = 0, all = 0;
  for (const Trial& t : asked.neighbours()) {
    if (t.outcome == Outcome::none || t.finding.truth_yes != asked.trials().base().finding.truth_yes) continue;
    ++all, same += t.outcome != Outcome::right;
  }
  if (all == 0 || cdf(boost::math::binomial(double(all), half), double(same)) >= chance) return std::nullopt;
  return Evidence{fmt::format("{} cases were asked whose numbers are a few ulps away.", all),
                  fmt::format("{} are wrong: a border would leave half of them on its side.", same)};
}

/// The constant that ends the finding of other cases ends it here: for the same numbers, on the same side, and where
/// the largest of them is as large as there, up to the factor by which the others differ, or by which lengths of one
/// scene may.
Contradiction ends_elsewhere(const BorderOfScale& border, AskedCases& asked) {
  constexpr double lengths_of_a_scene = 0x1p10;
  const auto& scans = asked.scans();
  const auto s =
      std::find_if(scans.begin(), scans.end(), [&](const ScaleScan& x) { return x.group->name == border.group; });
  if (s == scans.end() || !s->flip) {
    return Evidence{fmt::format("All {} of the case were multiplied by powers of two.", border.group),
                    "The answer is right at no scale."};
  }
  const bool wrong_below = s->flip->right > s->flip->wrong;
  const double largest = largest_of(asked.question(), *s->group) * std::exp2(s->flip->wrong);
  const double factor = std::max(lengths_of_a_scene, border.high / border.low);
  const bool is_near = largest <= factor * border.low && border.high <= factor * largest;
  if (wrong_below == border.wrong_below && is_near) return std::nullopt;
  return Evidence{
      fmt::format("All {} of the case were multiplied by powers of two.", border.group),
      fmt::format("Answers are wrong {} the border, where the largest of them is {:.2g}; in the other case, "
                  "they are wrong {} one between {:.2g} and {:.2g}.",
                  wrong_below ? "below" : "above", largest, border.wrong_below ? "below" : "above", border.low,
                  border.high)};
}

struct Test {
  Prediction prediction;
  Contradiction (*contradiction)(AskedCases&);
};
constexpr std::array tests{Test{Prediction::at_every_scale, depends_on_scale},
                           Test{Prediction::in_every_rounding, depends_on_rounding},
                           Test{Prediction::in_every_mode, is_right_in_a_mode},
                           Test{Prediction::changes_by_rounding, is_untouched_by_rounding},
                           Test{Prediction::extreme_numbers, stays_in_range},
                           Test{Prediction::small_error, is_no_error_of_rounding},
                           Test{Prediction::two_borders, has_many_borders},
                           Test{Prediction::one_border, has_several_borders},
                           Test{Prediction::ends_at_a_scale, stays_at_every_scale},
                           Test{Prediction::one_side_nearby, is_lost_nearby}};

}  // namespace

std::optional<Evidence> contradiction_of(const Named& cause, AskedCases& asked) {
  const auto against = [&](Evidence found) {
    found.result += fmt::format(" This speaks against the cause '{}'.", name_of(cause.kind));
    return found;
  };
  if (cause.border) {
    if (auto found = ends_elsewhere(*cause.border, asked)) return against(std::move(*found));
  }
  for (const Test& test : tests) {
    const auto& made = cause.predictions;
    if (std::find(made.begin(), made.end(), test.prediction) == made.end()) continue;
    auto found = test.contradiction(asked);
    if (found) return against(std::move(*found));
  }
  return std::nullopt;
}

}  // namespace nearmiss

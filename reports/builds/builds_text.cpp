#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "corpus/storage/codec.hpp"
#include "reports/builds/builds.hpp"
#include "reports/findings/report.hpp"
#include "reports/findings/report_text.hpp"
#include "reports/findings/text.hpp"

namespace nearmiss {

namespace {

using Json = nlohmann::ordered_json;

Json number_json(double x) { return std::isfinite(x) ? Json(x) : Json(number_text(x)); }

Json numbers_json(const FirstDifference& d) {
  Json all = Json::array();
  for (const DifferentNumber& n : d.difference.numbers) {
    all.push_back({{"number", d.question.query->outputs[n.output].name},
                   {"base", number_json(n.base)},
                   {"other", number_json(n.other)},
                   {"ulps", n.ulps ? Json(*n.ulps) : Json(nullptr)}});
  }
  return all;
}

Json judged_json(const Case& question, const JudgedAnswer& j) {
  return {{"answer", answer_to_json(*question.query, j.answer)},
          {"right", j.is_right},
          {"finding", finding_to_json(question, j.finding)}};
}

Json first_json(const FirstDifference& d) {
  return {{"index", d.found.index},
          {"outside", d.is_outside},
          {"case", case_to_json(d.found)},
          {"minimised", case_to_json(d.question)},
          {"differs_in", name_of(d.difference.kind)},
          {"numbers", numbers_json(d)},
          {"base", judged_json(d.question, d.base)},
          {"other", judged_json(d.question, d.other)},
          {"truth", truth_to_json(*d.question.query, d.question.scalar, d.truth)}};
}

/// "0.5 = 0x1p-1": the shortest decimal of the scalar that reads back as the number, and its bits.
std::string exact_text(double x, Scalar scalar) {
  return std::isfinite(x) ? fmt::format("{} = {:a}", number_text(x, scalar), x) : number_text(x);
}

std::string ulps_text(const DifferentNumber& n) {
  if (!n.ulps) return "-";
  return *n.ulps == 0 ? "sign of zero" : count_text(*n.ulps);
}

std::string status_text(const Answer& a, const Query& query, Scalar scalar) {
  if (a.status == Answer::Status::broke) return fmt::format("broke: {}", one_line(a.reason()));
  if (a.status == Answer::Status::cannot_answer) return fmt::format("cannot answer: {}", one_line(a.reason()));
  return answer_text(query, a, scalar);
}

std::string answers_text(const ComparedBuild& c) {
  const FirstDifference& d = *c.first;
  const Scalar scalar = d.question.scalar;
  if (d.difference.numbers.empty()) {
    return table_text({{"BUILD", "ANSWER"},
                       {c.base->name, status_text(d.base.answer, *c.query, scalar)},
                       {c.other->name, status_text(d.other.answer, *c.query, scalar)}},
                      "  ");
  }
  std::vector<std::vector<std::string>> rows{{"NUMBER", c.base->name, c.other->name, "ULPS"}};
  for (const DifferentNumber& n : d.difference.numbers) {
    rows.push_back(
        {c.query->outputs[n.output].name, exact_text(n.base, scalar), exact_text(n.other, scalar), ulps_text(n)});
  }
  return table_text(rows, "  ");
}

std::string case_line(const Case& c) {
  std::string numbers;
  for (std::size_t i = 0; i < c.values.size(); ++i)
    numbers += fmt::format("{}{} {}", i == 0 ? "" : ", ", c.name(i), number_text(c.values[i], c.scalar));
  return wrapped_text(numbers, "  ");
}

}  // namespace

std::string name_of(const ComparedBuild& c) { return fmt::format("{}-{}", c.query->name, c.other->name); }

namespace {

/// As the verdict of a replay says it.
std::string fault_text(const JudgedAnswer& j) {
  if (j.answer.status != Answer::Status::answered) return "has no answer";
  return j.finding.is_proved() ? "is wrong" : "has another decision, not proved to differ by more than is allowed";
}

}  // namespace

std::string right_text(const ComparedBuild& c) {
  const JudgedAnswer &base = c.first->base, &other = c.first->other;
  if (base.is_right != other.is_right) {
    return base.is_right ? fmt::format("{} is right, and {} {}", c.base->name, c.other->name, fault_text(other))
                         : fmt::format("{} is right, and {} {}", c.other->name, c.base->name, fault_text(base));
  }
  if (!base.is_right) return "Neither is right";
  const double of_base = base.finding.forward_ulps, of_other = other.finding.forward_ulps;
  if (of_base == of_other) return "Both are right";
  return fmt::format("Both are right; {} is nearer to the exact answer", (of_base < of_other ? c.base : c.other)->name);
}

Json compared_to_json(const ComparedBuild& c) {
  return {{"query", c.query->name}, {"base", c.base->name},
          {"other", c.other->name}, {"scalar", name_of(c.base->scalar)},
          {"asked", c.asked},       {"different", c.different},
          {"outside", c.outside},   {"first", c.first ? first_json(*c.first) : Json(nullptr)}};
}

std::string difference_text(const ComparedBuild& c) {
  const FirstDifference& d = *c.first;
  return fmt::format("{}: {} differs from {} in {} of {}, first in case {}. The simplest such case:\n{}{}",
                     c.query->name, c.other->name, c.base->name, count_text(c.different), plural_text(c.asked, "case"),
                     d.found.index, case_line(d.question), answers_text(c)) +
         wrapped_text(fmt::format("{}: {}.", right_text(c), truth_text(*c.query, d.truth)), "  ");
}

}  // namespace nearmiss

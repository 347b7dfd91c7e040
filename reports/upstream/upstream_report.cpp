#include "reports/upstream/upstream_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <regex>

#include "corpus/files/errors.hpp"
#include "corpus/storage/codec.hpp"
#include "reports/findings/encoded.hpp"
#include "reports/findings/pretty_json.hpp"
#include "reports/findings/report_text.hpp"
#include "reports/findings/text.hpp"
#include "reports/findings/version.hpp"
#include "reports/picture/text_picture.hpp"
#include "reports/upstream/emit_test.hpp"

namespace nearmiss {

namespace {

/// The last names of absolute paths.
std::string without_folders(const std::string& text) {
  static const std::regex path("(^|[\\s'\"(:])/(?:[^\\s/'\"():]+/)+");
  return std::regex_replace(text, path, "$1");
}

std::string title(const Report& r) {
  const std::string line = headline(r);
  return in_markdown(fmt::format("{}: {}", r.version, without_folders(line.substr(0, line.find(", by more than")))));
}

std::string environment(const Report& r, const Subject& subject) {
  const std::string& how = subject.offering(r.question.query->name).how;
  std::string text = "| | |\n|---|---|\n";
  text += fmt::format("| library | {} |\n| asked as | `{}`{} |\n", in_markdown(r.version), r.subject,
                      how.empty() ? "" : ": " + in_markdown(how));
  text += fmt::format("| numbers | {} |\n| compiler | {} |\n| platform | {} |\n", name_of(r.question.scalar),
                      in_markdown(compiler()), in_markdown(platform()));
  return text + fmt::format("| found by | Nearmiss {} |\n", version());
}

std::string scene(const Report& r, const std::string& image) {
  std::string text =
      image.empty() ? ""
                    : fmt::format("![The scene, the exact answer and the given one](<{}>)\n\n", in_markdown(image));
  text += markdown_block(pretty_json(case_to_json(r.question)["inputs"]), "json");
  const std::string picture = text_picture(r);
  return picture.empty() ? text : text + "\n" + markdown_block(picture, "text");
}

/// The largest position or size of the scene.
double extent_of(const Case& question) {
  double extent = 0;
  for (std::size_t i = 0; i < question.values.size(); ++i) {
    const Role role = question.role(i);
    if (role == Role::position || role == Role::size) extent = std::max(extent, std::abs(question.values[i]));
  }
  return extent;
}

/// How far the worst number is off, in its unit and of the scene; empty for a wrong decision.
std::string amount(const Report& r) {
  const MemberFinding* head = r.finding.headline_member();
  if (head == nullptr || head->member < 0 || head->worst < 0 || !(head->forward_absolute > 0)) return "";
  const Field& field = r.question.query->outputs[std::size_t(head->worst)];
  const std::string off = fmt::format("`{}` is off by at least {:.3g}", field.name, head->forward_absolute);
  const double extent = extent_of(r.question);
  if (!is_length(field.role) || !(extent > 0)) return off + ".\n";
  return fmt::format("{}, which is {:.3g} % of the largest position or size, {:.3g}.\n", off,
                     100 * head->forward_absolute / extent, extent);
}

std::string truth(const Report& r) {
  std::string text = fmt::format("Exactly, {}", truth_text(*r.question.query, r.truth));
  text += fmt::format(" ({}).", r.truth.decided_by == Stage::exact ? "decided in exact arithmetic"
                                                                   : "decided in interval arithmetic, a proof");
  const std::size_t others = r.truth.alternatives.size();
  if (others > 1) text += fmt::format(" {} answers are equally right; this is one of them.", count_text(others));
  if (r.truth.margin_at_least > 0) {
    text += fmt::format(" The decision is the same for all inputs within {} of the given ones.",
                        amount_text(r.truth.margin_at_least, r.question.scalar));
  }
  return text + "\n";
}

/// By the same bound as the answer that is reported.
std::string verdict_on(const Opinion& o, double allowed) {
  const Finding& f = o.finding;
  if (f.verdict == Verdict::broke || f.verdict == Verdict::cannot_answer) return std::string(name_of(f.verdict));
  const bool differs = f.disagreement != Disagreement::none && (!f.backward || f.backward->above > allowed);
  return differs ? std::string(name_of(f.disagreement)) : "right, within the same bound";
}

std::string referees(const Report& r) {
  if (r.referees.empty()) return "";
  const double allowed = allowed_backward_error(r.standard, r.question.scalar);
  std::string text = "## Other libraries\n\n| library | answer | |\n|---|---|---|\n";
  for (const Opinion& o : r.referees) {
    text +=
        fmt::format("| {} (`{}`) | {} | {} |\n", in_markdown(o.version), o.referee,
                    in_markdown(answer_text(*r.question.query, o.answer, r.question.scalar)), verdict_on(o, allowed));
  }
  return text + "\n";
}

std::string answer(const Report& r) {
  if (r.finding.verdict == Verdict::broke)
    return "None: " + in_markdown(without_folders(one_line(r.finding.clause))) + ".\n";
  std::string text = in_markdown(answer_text(*r.question.query, r.answer, r.question.scalar));
  for (std::size_t i = 0; i < r.question.query->outputs.size(); ++i) {
    if (!is_part(*r.question.query, r.answer, i)) continue;
    text += fmt::format("\n* `{}` = {}", r.question.query->outputs[i].name,
                        value_text(r.answer.values[i], r.question.scalar));
  }
  return text + "\n";
}

}  // namespace

std::string upstream_report(const Report& r, const Subject& subject, const std::string& picture) {
  if (!is_bad(r.finding)) throw BadInput(fmt::format("{}: nothing is to be reported of its answer", subject.name));
  const EmittedTest test = emit_test(r, subject);
  std::string text = fmt::format("# {}\n\n{}\n\n", title(r), in_markdown(without_folders(explanation(r))));
  text += environment(r, subject) + "\n";
  text += "## The scene\n\n" + scene(r, picture) + "\n";
  text += "## The answer\n\n" + answer(r) + "\n";
  text += "## What is right\n\n" + truth(r) + amount(r) + "\n";
  text += fmt::format("## A program that shows it\n\n{}\n{}\n", markdown_block(without_folders(test.build), "sh"),
                      markdown_block(without_folders(test.text), test.extension == "mjs" ? "js" : test.extension));
  return text + referees(r);
}

}  // namespace nearmiss

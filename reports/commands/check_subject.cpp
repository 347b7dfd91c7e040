#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "corpus/files/errors.hpp"
#include "oracles/requirements.hpp"
#include "reports/commands/command.hpp"
#include "reports/commands/options.hpp"
#include "reports/engine/interrupt.hpp"
#include "reports/engine/progress.hpp"
#include "reports/findings/pretty_json.hpp"
#include "reports/findings/text.hpp"
#include "reports/triage/examination/subject_check.hpp"

namespace nearmiss {

namespace {

using Json = nlohmann::ordered_json;

Json checked_json(const CheckedQuery& c) {
  Json j{{"query", c.query->name},  {"asked", c.asked}, {"right", c.right},
         {"wrong", c.wrong},        {"broke", c.broke}, {"without_answer", c.without_answer},
         {"not_asked", c.not_asked}};
  if (!c.misreading) return j;
  Json names = Json::array();
  for (const Reading* r : c.misreading->readings) names.push_back(r->name);
  j["misreading"] = {{"readings", names}, {"explained", c.misreading->explained}};
  return j;
}

class CheckSubjectCommand : public Command {
 public:
  Manual manual() const override {
    return {
        "check-subject",
        "ask a new subject ordinary cases, and tell which input or answer it takes for another",
        {"For a library that was just connected. Each query that the subject offers is asked its stored seeds, which "
         "people derived by hand, and 64 generated cases of moderate numbers. Where answers are wrong, other meanings "
         "of "
         "the inputs and of the answer are tried, alone and in pairs: full extents in place of half extents, a "
         "quaternion "
         "that begins with w, a normal that points the other way, a distance in place of a time, a start in contact "
         "that "
         "is a miss, and all others that 'explain' knows. A meaning is told where it explains wrong answers and "
         "makes no right one wrong.",
         "Such a meaning is a mistake of the adapter, or a convention of the library. Mend or convert it in the "
         "adapter "
         "before a run: otherwise most findings are about it.",
         "--json prints one object for programs: {\"subjects\": {NAME: [{\"query\", \"asked\", \"right\", \"wrong\", "
         "\"broke\", \"without_answer\", \"not_asked\", \"misreading\": {\"readings\": [NAME], \"explained\"}}]}}; "
         "\"misreading\" is "
         "left "
         "out where there is none."},
        {{"0", "Every answer is right, as far as can be proved."},
         {"1", "Wrong answers, or a subject that broke."},
         {"2", "It could not run, or it was interrupted. One line on standard error states the reason."},
         internal_error_status()},
        {{"nearmiss check-subject --subject fcl", "Every query of FCL."},
         {"nearmiss check-subject --plugin ./libskim.so --subject skim --query moving_point_sphere",
          "One query of a plugin."}}};
  }
  void declare(CLI::App& app) override {
    selection_.declare_subjects(app);
    selection_.declare_queries(app);
    add_measure(app, measure_);
    app.add_flag("--json", json_, "Print JSON")->disable_flag_override();
  }
  int run(const CLI::App&) override {
    judge_by(measure_, nullptr);
    selection_.check_offered();
    catch_interrupts();
    for (const Subject* s : selection_.subjects()) check(*s);
    if (json_) say("{}", pretty_json({{"subjects", checked_}}));
    if (interrupted()) throw BadInput("interrupted");
    return found_ ? 1 : 0;
  }

 private:
  void check(const Subject& subject) {
    std::string text;
    std::size_t asked = 0, fine = 0;
    Json all = Json::array();
    for (const Query* q : selection_.queries()) {
      if (interrupted()) return;
      if (subject.offering(q->name).answer == nullptr) continue;
      progress_.set_activity(fmt::format("checking {}", subject.name));
      progress_.show(asked, std::nullopt, std::nullopt, std::nullopt);
      const CheckedQuery c = check_query(*q, subject, workers_);
      if (interrupted()) return;
      ++asked, fine += c.is_fine();
      all.push_back(checked_json(c));
      if (!c.is_fine()) text += checked_text(c, subject.scalar);
    }
    if (asked == 0) return;
    found_ = found_ || fine < asked;
    checked_[subject.name] = std::move(all);
    if (!json_)
      say("{}: {} of {} answered without a mistake\n{}", subject.name, fine, plural_text(asked, "query"), text);
  }

  Selection selection_;
  std::optional<double> measure_;
  bool json_ = false, found_ = false;
  Json checked_ = Json::object();
  Workers workers_{[] { return !interrupted(); }};
  Progress progress_;
};

}  // namespace

std::unique_ptr<Command> check_subject_command() { return std::make_unique<CheckSubjectCommand>(); }

}  // namespace nearmiss

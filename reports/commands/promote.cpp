#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "corpus/storage/codec.hpp"
#include "corpus/storage/store.hpp"
#include "oracles/confirmed.hpp"
#include "oracles/requirements.hpp"
#include "reports/commands/command.hpp"
#include "reports/commands/options.hpp"
#include "reports/engine/output.hpp"
#include "reports/engine/relation_report.hpp"
#include "reports/engine/replay.hpp"
#include "reports/engine/run_folder.hpp"
#include "reports/findings/pretty_json.hpp"
#include "reports/findings/text.hpp"

namespace nearmiss {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t shortest_note = 10;

/// Accepts what a file of a stored case may be called.
CLI::Validator file_name() {
  return CLI::Validator(
      [](const std::string& name) -> std::string {
        const bool good =
            !name.empty() && name.size() <= 80 && name.front() != '-' && std::ranges::all_of(name, [](char c) {
              return ('a' <= c && c <= 'z') || ('0' <= c && c <= '9') || c == '-';
            });
        return good ? "" : fmt::format("'{}' must have small letters, digits and hyphens", one_line(name, 60));
      },
      "");
}

CLI::Validator long_enough() {
  return CLI::Validator(
      [](const std::string& note) -> std::string {
        const auto is_blank = [](char c) { return c == ' ' || c == '\t' || c == '\n'; };
        const auto blanks = std::size_t(std::ranges::count_if(note, is_blank));
        return note.size() - blanks >= shortest_note ? "" : "it must say what went wrong, in a sentence";
      },
      "");
}

class PromoteCommand : public Command {
 public:
  Manual manual() const override {
    return {
        "promote",
        "store the case of a finding, with what is expected of its subject",
        {"FILE is a report, such as 'nearmiss minimise' writes, or a case. The case becomes the file "
         "regressions/QUERY/NAME.json in the folder of stored cases, with the note. Its expectation is the verdict on "
         "the "
         "subject's answer of now, and the disagreement: those of the report's subject, and of each --subject. From "
         "then "
         "on tests and nights ask the case, and tell when an answer is no longer what is expected: a finding that is "
         "fixed, or one that has come back.",
         "A file whose exact decision is no has a name that begins with miss or apart; any other name begins with "
         "neither. "
         "A case that is stored already, and a name that is taken, are errors."},
        {{"0", "The case is stored."},
         {"2", "It could not be stored. One line on standard error says why."},
         internal_error_status()},
        {{"nearmiss promote small/moving_sphere_box/fcl-false-miss-*.json --name fcl-flat-box --note \"FCL misses a "
          "box "
          "without thickness.\"",
          "Store a minimised finding."}}};
  }
  void declare(CLI::App& app) override {
    app.add_option("FILE", file_, "A report or a case file")->required()->type_name("");
    app.add_option("--name", name_, "The name of the stored file, without .json. Default: SUBJECT-FAULT")
        ->type_name("NAME")
        ->check(file_name());
    app.add_option("--note", note_,
                   "What went wrong, in a sentence; where it was reported, at its end: \"Report: URL\"")
        ->type_name("TEXT")
        ->required()
        ->check(long_enough());
    add_exact(app);
    selection_.declare_subjects(app);
  }
  int run(const CLI::App&) override {
    settle_run_of(file_);
    const nlohmann::json j = parse_json(read_file(file_), file_);
    const Case question = case_of(j, file_);
    if (read_relation_case(j, file_))
      throw BadInput(fmt::format("{}: it has several related cases; one can be stored", file_));
    refuse_where_stored(question);
    std::string first_fault;
    const nlohmann::ordered_json expected = expectations(question, subjects_for(j), first_fault);
    const fs::path file = target(question, first_fault);
    if (fs::exists(file)) throw BadInput(fmt::format("{} is there already; choose another --name", file.string()));
    nlohmann::ordered_json stored = case_to_json(question);
    stored.erase("origin");
    stored["note"] = note_;
    stored["expected"] = expected;
    make_folder(file.parent_path());
    write_file(file, pretty_json(stored));
    say("{}\n", path_text(file));
    return 0;
  }

 private:
  /// That of the report first, then the chosen ones.
  std::vector<const Subject*> subjects_for(const nlohmann::json& j) const {
    std::vector<const Subject*> all;
    if (const auto of_report = subject_of_report(j, file_)) all.push_back(*of_report);
    if (!selection_.subject.empty()) {
      for (const Subject* s : selection_.subjects()) {
        if (std::find(all.begin(), all.end(), s) == all.end()) all.push_back(s);
      }
    }
    if (all.empty()) throw BadInput(fmt::format("{}: it is no report, so --subject is needed", file_));
    return all;
  }
  nlohmann::ordered_json expectations(const Case& question, const std::vector<const Subject*>& subjects,
                                      std::string& first_fault) {
    nlohmann::ordered_json expected = nlohmann::ordered_json::array();
    for (const Subject* s : subjects) {
      const std::optional<Case> same = in_scalar(question, s->scalar);
      const Offering& offering = s->offering(question.query->name);
      if (offering.answer == nullptr || !same || !unmet_by(*same, offering.required).empty()) {
        throw BadInput(fmt::format("{}: {} cannot be asked this case", file_, s->name));
      }
      const Finding f =
          confirmed(*same, workers_.ask(*s, *same), s->standard_for(question.query->name), Detail::verdict);
      if (first_fault.empty()) first_fault = fault_of(f);
      expected.push_back({{"subject", s->name}, {"verdict", name_of(f.verdict)}});
      if (f.disagreement != Disagreement::none) expected.back()["disagreement"] = name_of(f.disagreement);
      first_subject_ = first_subject_.empty() ? s->name : first_subject_;
    }
    return expected;
  }
  fs::path target(const Case& question, const std::string& fault) const {
    const bool yes = exact_decision(question);
    const std::string no = question.query->kind == Kind::impact ? "miss" : "apart";
    const std::string name = !name_.empty() ? name_ : (yes ? "" : no + "-") + first_subject_ + "-" + fault;
    const bool says_no = name.starts_with("miss") || name.starts_with("apart");
    if (yes == says_no) {
      throw BadInput(fmt::format("the name {} must {} with miss or apart: the exact decision is {}", name,
                                 yes ? "not begin" : "begin", yes ? "yes" : "no"));
    }
    return corpus_folder() / "regressions" / question.query->name / (name + ".json");
  }
  static void refuse_where_stored(const Case& question) {
    for (const StoredCase& s : stored_cases(*question.query)) {
      if (s.question.values == question.values && s.question.scalar == question.scalar) {
        throw BadInput(fmt::format("the case is stored already, in {}", s.file.string()));
      }
    }
  }

  std::string file_, name_, note_, first_subject_;
  Selection selection_;
  Workers workers_;
};

}  // namespace

std::unique_ptr<Command> promote_command() { return std::make_unique<PromoteCommand>(); }

}  // namespace nearmiss

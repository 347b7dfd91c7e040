#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "corpus/storage/codec.hpp"
#include "reports/commands/command.hpp"
#include "reports/commands/options.hpp"
#include "reports/engine/output.hpp"
#include "reports/findings/pretty_json.hpp"
#include "reports/triage/comparison/run_diff.hpp"

namespace nearmiss {

namespace {

class DiffCommand : public Command {
 public:
  Manual manual() const override {
    return {"diff",
            "compare the findings of two runs",
            {"BEFORE and AFTER are run folders. Findings of the same query, subject, fault, member of the answer and "
             "clause are one kind. The table says which kinds are new, gone, worse (the proved bound has at least "
             "doubled) or known, with their numbers and their share of the cases that the subject was asked. Kinds of "
             "queries or subjects that one of the runs did not ask are left out.",
             "Nothing is asked: a kind is gone where the later run did not find it. 'nearmiss triage --baseline' asks "
             "the cases again and says what is fixed."},
            {{"0", "No kind is new or worse."},
             {"1", "A kind is new or worse."},
             {"2", "A folder is no run folder, or the file cannot be written. One line on standard error says why."}},
            {{"nearmiss diff reports/runs/monday reports/runs/tuesday", "What a day has changed."}}};
  }
  void declare(CLI::App& app) override {
    app.add_option("BEFORE", before_, "The earlier run folder")->required()->type_name("");
    app.add_option("AFTER", after_, "The later run folder")->required()->type_name("");
    app.add_option("--json", json_, "Also write the comparison to this file as JSON")->type_name("FILE");
  }
  int run(const CLI::App&) override {
    if (!json_.empty()) check_can_write(json_);
    const std::vector<KindInRuns> kinds = compare_runs(before_, after_);
    if (!json_.empty()) write_file(json_, pretty_json(diff_to_json(before_, after_, kinds)));
    say("{}", diff_text(after_, kinds));
    return std::any_of(kinds.begin(), kinds.end(), [](const KindInRuns& k) {
      return k.change == KindInRuns::Change::fresh || k.change == KindInRuns::Change::worse;
    });
  }

 private:
  std::string before_, after_, json_;
};

}  // namespace

std::unique_ptr<Command> diff_command() { return std::make_unique<DiffCommand>(); }

}  // namespace nearmiss

#include <fmt/format.h>

#include <limits>

#include "corpus/files/errors.hpp"
#include "reports/commands/command.hpp"
#include "reports/commands/options.hpp"
#include "reports/engine/interrupt.hpp"
#include "reports/engine/progress.hpp"
#include "reports/engine/run.hpp"
#include "reports/page/trade_page.hpp"
#include "reports/trade/trade.hpp"

namespace nearmiss {

namespace {

constexpr std::uint64_t default_trade_cases = 1000, most_trade_cases = 10'000'000;
constexpr std::uint64_t default_repeats = 5, most_repeats = 1000;

class TradeCommand : public Command {
 public:
  Manual manual() const override {
    return {
        "trade",
        "measure the time and the errors of subjects on the same cases: the price of accuracy",
        {"Asks each chosen subject the same cases of each chosen query. The judge proves errors: missed and phantom "
         "contacts and how deep they are, the distance of each number from the exact one, and the backward error. Then "
         "the calls are timed, in the process of each subject.",
         "Times are nanoseconds of single calls with typed inputs, without the decoding of cases. Each call is made in "
         "25 rounds after a warm-up, in a fixed shuffled order, on one processor where the system allows it; the "
         "time "
         "of a case is the median of its rounds, and of --repeats repeats in which the subjects take turns. A plugin "
         "is "
         "timed with the decoding of its numbers, a program behind pipes by round trips; trade.json names this. A call "
         "is not timed where the subject has no answer.",
         "The folder receives trade.json, trade.csv and, where the build found the Debian package node-d3, the page "
         "trade.html with the price curves. In the table, ERROR is the "
         "largest proved error of the inputs: how far they have to move to make the worst answer right, in the unit of "
         "the scene or as a share of the largest number. MEETS: the subject answered each case, and no answer is "
         "proved wrong by more "
         "than is tolerable. Generated cases are those of float. Cases fit the preconditions of all chosen subjects "
         "together."},
        {{"0", "The figures were measured, whatever they are."},
         {"2", "Wrong arguments, nothing to measure, an output that cannot be written, or it was interrupted."},
         internal_error_status()},
        {{"nearmiss trade driving", "The queries and the requirements of a scene."},
         {"nearmiss trade --query moving_sphere_box", "All subjects that offer the query."},
         {"nearmiss trade -q sphere_box_overlap -s collide-fast-float -s fcl --cases 1e5 --out trade",
          "Two subjects, with enough cases to see one in 10^5."}}};
  }
  void declare(CLI::App& app) override {
    app.add_option("SCENE", scene_, "A scene of 'nearmiss scene list', or its file. Default: generated cases")
        ->type_name("");
    selection_.declare_subjects(app);
    selection_.declare_queries(app);
    add_whole_number(app, "-n,--cases", cases_, fmt::format("Cases of each query. Default: {}", default_trade_cases), 1,
                     most_trade_cases);
    add_whole_number(app, "--repeats", repeats_, fmt::format("Repeats of each time. Default: {}", default_repeats), 1,
                     most_repeats);
    add_whole_number(app, "--seed", seed_, "The seed of the cases. Default: 1", 0,
                     std::numeric_limits<std::uint64_t>::max());
    add_positive_number(app, "--tolerance", tolerance_,
                        fmt::format("Without a scene: the largest tolerable backward error, as a share of the largest "
                                    "number of each kind. Default: {:g}",
                                    Measure::usual),
                        "E", 1);
    add_output_folder(app, out_, "The folder. Default: reports/runs/TIME-SEED of the source tree");
  }
  int run(const CLI::App&) override {
    selection_.check_offered();
    const TradeSource source = chosen_source();
    const std::vector<const Query*> queries = chosen_queries();
    check_measurable(queries);
    const std::uint64_t seed = seed_.value_or(1);
    const std::filesystem::path folder = out_.empty() ? new_run_folder(seed) : std::filesystem::path(out_);
    catch_interrupts();
    Trade trade({typed_command_line(), folder, source, queries, selection_.subjects(), seed,
                 cases_.value_or(default_trade_cases), unsigned(repeats_.value_or(default_repeats))});
    trade.measure();
    trade.write();
    if (can_write_trade_pages()) write_trade_page(folder / "trade.json", folder / "trade.html");
    say("{}\n", trade.text());
    if (interrupted()) say_on_stderr("nearmiss: interrupted: the trade lacks queries\n");
    return trade.exit_code();
  }

 private:
  TradeSource chosen_source() {
    if (scene_.empty()) {
      return generated_cases(
          relative_tolerance(tolerance_.value_or(Measure::usual), tolerance_ ? "--tolerance" : "the usual measure"));
    }
    if (tolerance_) throw BadInput("--tolerance: the scene states what it requires");
    loaded_ = std::make_shared<const scenes::Scene>(scenes::load_scene(scene_));
    return scene_cases(loaded_);
  }
  /// The chosen queries, or those of the scene.
  std::vector<const Query*> chosen_queries() const {
    if (!loaded_) return selection_.queries();
    if (selection_.query.empty()) return loaded_->all_queries();
    for (const Query* q : selection_.queries()) {
      if (loaded_->find(*q) == nullptr)
        throw BadInput(fmt::format("--query {}: the scene {} does not ask it", q->name, loaded_->name));
    }
    return selection_.queries();
  }

  void check_measurable(const std::vector<const Query*>& queries) const {
    for (const Query* q : queries) {
      for (const Subject* s : selection_.subjects()) {
        if (!(s->offering(q->name).answer == nullptr)) return;
      }
    }
    throw BadInput("nothing to measure: none of the subjects offers a query of the scene");
  }

  Selection selection_;
  std::optional<std::uint64_t> cases_, repeats_, seed_;
  std::optional<double> tolerance_;
  std::string scene_, out_;
  std::shared_ptr<const scenes::Scene> loaded_;
};

}  // namespace

std::unique_ptr<Command> trade_command() { return std::make_unique<TradeCommand>(); }

}  // namespace nearmiss

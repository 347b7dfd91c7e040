#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "corpus/storage/codec.hpp"
#include "oracles/confirmed.hpp"
#include "reports/commands/command.hpp"
#include "reports/commands/options.hpp"
#include "reports/engine/interrupt.hpp"
#include "reports/engine/progress.hpp"
#include "reports/findings/text.hpp"
#include "reports/page/page.hpp"
#include "reports/page/page_data.hpp"
#include "reports/page/trade_page.hpp"

namespace nearmiss {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

class RenderCommand : public Command {
 public:
  Manual manual() const override {
    return {
        "render",
        "write a page of the findings, with pictures",
        {"FOLDER holds a triage, a run, or several runs. The page is one HTML file that needs no network: a table of "
         "the "
         "signatures, and for each of them the picture of its scene down to the last bit, the error as a function of "
         "each number, what plays no part, the cause with its evidence, the referees, and the command that replays it.",
         "With triage.json in FOLDER or in FOLDER/triage, the page shows that triage. Without it the page shows the "
         "run in "
         "FOLDER, with one row for each query, subject and fault, or the newest run among its subfolders. Several runs "
         "in subfolders "
         "make a trend.",
         "A file trade.json in FOLDER or in one of its subfolders is a view of the page: the price curves of each "
         "query "
         "and the performance profile. In a FOLDER without findings it gets a page of its own, trade.html beside it.",
         "For the plots the subject of each shown report is asked again with each number moved, the most severe "
         "first, for at most --seconds. Reports are added in the same order until the page has 18 MB; the table has "
         "all of them."},
        {{"0", "The page is written. A report that cannot be read is named in it."},
         {"2",
          "The folder holds no findings, the page cannot be written, this build lacks node-d3 or libjs-three, or the "
          "command was interrupted; then the page is written with the reports that were read."},
         {std::to_string(InternalError::exit_code),
          "An internal error: the judge contradicts itself on a case of a plot. The page "
          "is written and names its report."}},
        {{"nearmiss render reports/runs/nightly", "Writes index.html there."},
         {"nearmiss render reports/runs --out page.html", "The newest run, with the trend of all."}}};
  }
  void declare(CLI::App& app) override {
    app.add_option("FOLDER", folder_, "A folder with triage.json, with index.json, or of such folders")
        ->required()
        ->type_name("");
    declare_foreign_subjects(app);
    app.add_option("--out", out_, "The page. Default: index.html in FOLDER")->type_name("FILE");
    app.add_option("--seconds", seconds_, "The most time to ask subjects for the plots; 0: no plots. Default: 60")
        ->type_name("S")
        ->check(number_from(0, 1e6));
  }
  int run(const CLI::App&) override {
    catch_interrupts();
    const bool has_page = has_findings();
    if (!has_page && write_trades()) return 0;
    check_page_can_be_written();  // before the work
    const fs::path file = out_.empty() ? fs::path(folder_) / "index.html" : fs::path(out_);
    PageData data(folder_, fs::absolute(file).parent_path());
    check_can_write(file);
    add_reports(data);
    write_file(file, page_with(data.to_json()));
    say("{} in {} ({:.1f} MB)\n", plural_text(data.signatures(), "signature"), path_text(file),
        double(fs::file_size(file)) / 1e6);
    if (interrupted()) say_on_stderr("nearmiss: interrupted: the page lacks reports\n");
    if (data.internal_errors() > 0)
      say_on_stderr("nearmiss: the judge contradicts itself; the page names the reports\n");
    return data.internal_errors() > 0 ? InternalError::exit_code : interrupted() ? 2 : 0;
  }

 private:
  /// Writes the pages of the trades of the folder, the first to --out. False where it has none.
  bool write_trades() const {
    const std::vector<fs::path> trades = trades_in(folder_);
    for (const fs::path& file : trades) {
      const fs::path page = out_.empty() || file != trades.front() ? usual_trade_page(file) : fs::path(out_);
      write_trade_page(file, page);
      say("1 trade in {} ({:.1f} MB)\n", path_text(page), double(fs::file_size(page)) / 1e6);
    }
    return !trades.empty();
  }
  /// Whether the folder has a triage or a run, also among its subfolders.
  bool has_findings() const {
    const auto has = [](const fs::path& f) { return fs::exists(f / "index.json") || fs::exists(f / "triage.json"); };
    if (has(folder_)) return true;
    std::error_code none;
    const auto entries = fs::directory_iterator(folder_, none);
    return std::any_of(begin(entries), end(entries), [&](const auto& e) { return has(e.path()); });
  }
  void add_reports(PageData& data) {
    Workers workers([] { return !interrupted(); });
    Progress progress;
    progress.set_activity("drawing");
    const Clock::time_point until =
        Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds_));
    const auto has_time = [&] { return !interrupted() && Clock::now() < until; };
    data.add_reports(most_page_data, workers, has_time, [&](std::size_t done) {
      progress.show(done, data.signatures(), std::nullopt, 0);
      return !interrupted();
    });
  }

  std::string folder_, out_;
  double seconds_ = 60;
};

}  // namespace

std::unique_ptr<Command> render_command() { return std::make_unique<RenderCommand>(); }

}  // namespace nearmiss

#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <nlohmann/json.hpp>
#include <thread>

#include "corpus/files/line_reader.hpp"
#include "corpus/storage/codec.hpp"
#include "oracles/judge.hpp"
#include "reports/commands/command.hpp"
#include "reports/commands/options.hpp"
#include "reports/engine/output.hpp"
#include "reports/engine/replay.hpp"
#include "reports/findings/report.hpp"

namespace nearmiss {

namespace {

/// Threads that read blocks of lines, answer each line with a line, and print the answers in the order of the lines.
/// What was read is answered before more is awaited, so that a program can ask and wait for the answer.
class LineAnswers {
 public:
  /// The answer to the line at that place, "FILE:3". Called by several threads.
  using AnswerTo = std::function<std::string(std::string_view line, const std::string& where)>;

  LineAnswers(const std::vector<std::string>& files, AnswerTo answer_to)
      : reader_(files), answer_to_(std::move(answer_to)) {}

  /// After the answers before it are printed, throws what a line, the reading or the printing threw.
  void print(unsigned threads) {
    std::vector<std::thread> all;
    for (unsigned i = 0; i < threads; ++i) all.emplace_back([this] { work(); });
    for (std::thread& t : all) t.join();
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  /// The answers to a block, up to a line that failed.
  struct Answered {
    std::string text;
    std::exception_ptr failure;
  };

  void work() {
    for (;;) {
      std::unique_lock reading(reading_);
      std::optional<LineBlock> block;
      Answered answered;
      try {
        if (!at_end_) block = reader_.next();
        at_end_ = !block;
      } catch (...) {
        answered.failure = std::current_exception();
        at_end_ = true;
      }
      if (!block && !answered.failure) return;
      const std::uint64_t number = read_++;
      reading.unlock();
      if (block) answered = answers_to(*block);
      print_in_turn(number, answered);
    }
  }
  Answered answers_to(const LineBlock& block) const {
    Answered a;
    block.for_each_line([&](std::string_view line, const std::string& where) {
      try {
        a.text += answer_to_(line, where) + "\n";
      } catch (...) {
        a.failure = std::current_exception();
      }
      return !a.failure;
    });
    return a;
  }
  void print_in_turn(std::uint64_t number, const Answered& a) {
    std::unique_lock printing(printing_);
    turn_.wait(printing, [&] { return printed_ == number; });
    try {
      if (!failure_) print_now(a);
    } catch (...) {
      failure_ = std::current_exception();
    }
    if (failure_) reader_.stop();
    ++printed_;
    turn_.notify_all();
  }
  void print_now(const Answered& a) {
    if (!a.text.empty()) {
      say_text(a.text);
      flush_output();
    }
    failure_ = a.failure;
  }

  LineReader reader_;
  const AnswerTo answer_to_;
  std::mutex reading_, printing_;
  std::condition_variable turn_;
  bool at_end_ = false;
  std::uint64_t read_ = 0, printed_ = 0;  ///< blocks
  std::exception_ptr failure_;            ///< the first one in the order of the lines
};

/// A line is a case as a file holds it, apart from the scalar, which may be missing.
Case case_of_line(std::string_view line, const std::string& where, std::string_view scalar) {
  nlohmann::json j;
  try {
    j = parse_json(line, where);
  } catch (const BadInput& e) {
    if (nlohmann::json::accept(line)) throw;
    throw BadInput(fmt::format("{}; each line must hold one whole case", e.what()));
  }
  if (j.is_object() && !j.contains("scalar")) j["scalar"] = scalar;
  return case_of(j, where);
}

class TruthCommand : public Command {
 public:
  Manual manual() const override {
    return {"truth",
            "write the exact answers to cases, for the tests of any program",
            {"Each line of a FILE, or of standard input, holds one case as JSON, in the form of a case file "
             "(docs/reference/case-files.md); blank lines are skipped. One line of JSON is written for each case, in "
             "the same order: the decision, every right answer with an enclosure [low, high] of each of its numbers, "
             "and the margin to the nearest flip of the decision, in epsilon of the case's scalar. docs/truth.md has "
             "examples, and reports/truth.schema.json describes the lines.",
             "Answers to lines that have arrived are written before more lines are awaited: a program can keep the "
             "command running, and ask one case at a time.",
             "The first line that is no valid case ends the command, after the answers to the lines before it."},
            {{"0", "Every case was answered."},
             {"2",
              "A file cannot be read, a line is no valid case, or an answer cannot be written. One line on standard "
              "error states the file, the line and the reason."}},
            {{"nearmiss truth cases.jsonl", "The answers to the cases of a file."},
             {"echo '{\"query\": \"sphere_sphere_overlap\", \"values\": [0, 0, 0, 1, 2, 0, 0, 1]}' | nearmiss truth",
              "One case; its numbers in a row."},
             {"nearmiss truth --digits 50 cases.jsonl", "Also decimals with 50 digits."}}};
  }
  void declare(CLI::App& app) override {
    app.add_option("FILE", files_, "Cases, one a line; - is standard input. Default: standard input")->type_name("");
    add_whole_number(app, "--digits", digits_,
                     "Also write each number as a decimal of N significant digits, correctly rounded; one with fewer "
                     "digits is exact",
                     1, most_digits);
    app.add_option("--scalar", scalar_,
                   "The scalar of cases that state none: float or double. Default: double. It sets the unit of the "
                   "margin, and which numbers a decimal can mean")
        ->type_name("SCALAR")
        ->check(CLI::Validator(
            [](const std::string& t) {
              return t == "float" || t == "double" ? "" : "'" + t + "' is no scalar; it must be float or double";
            },
            ""));
    add_exact(app);
    add_whole_number(app, "-j,--jobs", jobs_, "The number of threads. Default: the number of processors", 1,
                     most_threads);
  }
  int run(const CLI::App&) override {
    LineAnswers answers(files_.empty() ? std::vector<std::string>{"-"} : files_,
                        [this](std::string_view line, const std::string& where) { return answer(line, where); });
    answers.print(unsigned(jobs_.value_or(std::max(1u, std::thread::hardware_concurrency()))));
    return 0;
  }

 private:
  static constexpr std::uint64_t most_digits = 1000, most_threads = 256;

  std::string answer(std::string_view line, const std::string& where) const {
    const Case question = case_of_line(line, where, scalar_);
    const Truth truth = digits_ ? truth_in_digits(question, int(*digits_)) : truth_of(question);
    return truth_line_to_json(question, truth, digits_.has_value()).dump();
  }

  std::vector<std::string> files_;
  std::optional<std::uint64_t> digits_, jobs_;
  std::string scalar_ = "double";
};

}  // namespace

std::unique_ptr<Command> truth_command() { return std::make_unique<TruthCommand>(); }

}  // namespace nearmiss

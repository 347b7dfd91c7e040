#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <span>
#include <thread>

#include "corpus/files/errors.hpp"
#include "corpus/files/files.hpp"
#include "corpus/generator/generator.hpp"
#include "impl/subject/provenance.hpp"
#include "reports/commands/command.hpp"
#include "reports/commands/options.hpp"
#include "reports/engine/interrupt.hpp"
#include "reports/engine/output.hpp"
#include "reports/engine/replay.hpp"
#include "reports/engine/run.hpp"
#include "reports/engine/sweep.hpp"
#include "reports/findings/text.hpp"

namespace nearmiss {

namespace {

constexpr std::uint64_t most_threads = 1024;

std::optional<float> parsed_float(const std::string& text) {
  float value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

void add_float(CLI::App& app, const std::string& name, std::optional<float>& value, const std::string& description) {
  app.add_option_function<std::string>(
         name, [&value](const std::string& t) { value = parsed_float(t); }, description)
      ->type_name("FLOAT")
      ->check(CLI::Validator(
          [](const std::string& t) { return parsed_float(t) ? "" : fmt::format("'{}' is not a finite float", t); },
          ""));
}

class SweepCommand : public Command {
 public:
  Manual manual() const override {
    return {
        "sweep",
        "send one number of a case through every float, and check every decision of the tiers of collide",
        {"Takes a case and one of its numbers, such as a radius or a coordinate. The number runs through every finite "
         "float, 4,278,190,080 of them, without those that break a rule of the query. Each chosen tier of collide "
         "answers every one of these cases, and each decision is compared with the exact one. So the result holds for "
         "all floats of this slice: it is exhaustive, not sampled. Without --case the case is a generated one whose "
         "exact decision changes near its own value of the number.",
         "The exact decisions come from few proofs. The oracle's intervals enclose the answers to all cases of a range "
         "of the number at once; a range that they cannot decide is halved, and the exact stage decides single floats. "
         "No decision is assumed to change only once.",
         "The claim is about decisions, about numbers that are not finite, and about times before the start. Times, "
         "depths and places are not compared with the exact ones. Each answer with a wrong decision or such a number "
         "goes to the judge, and counts as a violation where the judge proves that it breaks the tier's contract.",
         "Tiers are asked in the process of this command, in tens of nanoseconds, so that only the tiers of collide of "
         "scalar float can be swept. A folder receives sweep.json, which is written about twice a second, and the "
         "reports findings/QUERY/SUBJECT-FAULT-ID.json of two violations of each tier: at the lowest float, and the "
         "worst. The same command with the folder of an interrupted or killed sweep as --out goes on where it ended.",
         "The table has a row for each tier. FALSE HIT, FALSE MISS: wrong decisions, also those within the contract. "
         "NOT FINITE: answers with a NaN, or with an infinity other than the time of a miss. OUTSIDE: answers of these "
         "kinds to which the contract does not apply. BACKWARD: the largest proved bound on how far inputs would have "
         "to move to make one of these answers right, in units of float's epsilon. NS/FLOAT: the time for one float, "
         "without the judge. The last lines have one sentence for each tier. It ends with (exhaustive) only where "
         "every "
         "valid float was asked."},
        judging_exit_status(),
        {{"nearmiss sweep --query sphere_sphere_overlap --number sphere1.radius", "A generated case, all float tiers."},
         {"nearmiss sweep --case touch.json --number box.half.x --subject collide-fast-float --jobs 1 --out slice",
          "A case of your own; the same line goes on after an interrupt."},
         {"nearmiss sweep --query moving_sphere_sphere --number velocity.x --from -1 --to 1", "Only a part."}}};
  }

  void declare(CLI::App& app) override {
    app.add_option("-q,--query", query_, "The query of a generated case")->type_name("QUERY")->check(known_query());
    app.add_option("--number", number_, "The number of the inputs that is swept, such as sphere.radius")
        ->type_name("NAME")
        ->required();
    app.add_option("--case", file_, "The file of a case or a report, in place of a generated case")->type_name("FILE");
    add_exact(app);
    add_float(app, "--from", from_, "Sweep only floats from this one on; the result is then not exhaustive");
    add_float(app, "--to", to_, "Sweep only floats up to this one; the result is then not exhaustive");
    app.add_option("-s,--subject", subject_,
                   "Only this tier; may be given several times. Default: all tiers of scalar float")
        ->type_name("SUBJECT")
        ->expected(1)
        ->take_all()
        ->allow_extra_args(false)
        ->check(known_subject());
    add_whole_number(app, "--seed", seed_, "The seed of the generated case. Default: 1", 0,
                     std::numeric_limits<std::uint64_t>::max());
    add_whole_number(app, "-j,--jobs", jobs_, "The number of threads. Default: the number of processors", 1,
                     most_threads);
    add_output_folder(app, out_, "The folder. Default: reports/runs/TIME-SEED of the source tree");
  }

  int run(const CLI::App&) override {
    if (own_subjects_in_process().empty()) become_program_with_tiers();
    Slice slice = chosen_slice();
    const auto [begin, end] = chosen_range();
    std::vector<Subject> subjects = chosen_subjects(slice.query());
    catch_interrupts();
    Sweep sweep({typed_command_line(), out_.empty() ? new_run_folder(seed()) : std::filesystem::path(out_),
                 std::move(slice), std::move(subjects), begin, end, jobs()});
    sweep.run();
    say("{}\n{}\n", sweep.table(), sweep.summary());
    if (const auto why = sweep.shortfall()) say_on_stderr(fmt::format("nearmiss: {}\n", *why));
    return sweep.exit_code();
  }

 private:
  /// Replaces this program by the one that has the tiers of collide in its process, with the same arguments.
  [[noreturn]] static void become_program_with_tiers() {
    const std::string program =
        (std::filesystem::read_symlink("/proc/self/exe").parent_path() / "nearmiss-sweep").string();
    std::string line = read_file("/proc/self/cmdline");
    std::vector<char*> arguments;
    for (std::size_t at = 0; at < line.size(); at = line.find('\0', at) + 1) arguments.push_back(line.data() + at);
    arguments.push_back(nullptr);
    execv(program.c_str(), arguments.data());
    throw BadInput(
        fmt::format("sweep: it is a program of its own, {}: {}; './nearmiss sweep' in the source tree builds it",
                    program, std::strerror(errno)));
  }
  std::uint64_t seed() const { return seed_.value_or(1); }
  unsigned jobs() const { return unsigned(jobs_.value_or(std::max(1u, std::thread::hardware_concurrency()))); }

  Slice chosen_slice() const {
    if (file_.empty() && query_.empty())
      throw BadInput("--query or --case is missing; 'nearmiss help sweep' shows both");
    if (file_.empty()) return generated_slice(*find_query(query_));
    const Case question = read_case_or_report(file_);
    if (!query_.empty() && query_ != question.query->name) {
      throw BadInput(fmt::format("{}: its query is {}, not {}", file_, question.query->name, query_));
    }
    const std::size_t number = index_of_number(*question.query);
    const std::optional<Case> in_float = in_scalar(question, Scalar::float32);
    if (!in_float) throw BadInput(fmt::format("{}: float cannot hold each of its numbers exactly", file_));
    return Slice(*in_float, number);
  }
  Slice generated_slice(const Query& query) const {
    const std::size_t number = index_of_number(query);
    const Slice any(generate(query, Scalar::float32, seed(), 0), number);  // refuses what is no float
    const std::optional<Case> c = touching_case(query, number, seed());
    if (c) return Slice(*c, number);
    throw BadInput(
        fmt::format("--number {}: with seed {} no generated case of {} changes its decision by it; give a "
                    "--case",
                    number_, seed(), query.name));
  }
  std::size_t index_of_number(const Query& query) const {
    if (!decides(query.kind))
      throw BadInput(fmt::format("{} decides nothing: it has no yes or no to sweep", query.name));
    std::vector<std::string> names;
    for (const Field& f : std::span(query.inputs).first(query.numbers_before_lists())) names.push_back(f.name);
    const auto found = std::find(names.begin(), names.end(), number_);
    if (found != names.end()) return std::size_t(found - names.begin());
    throw BadInput(fmt::format("--number: {} has no number '{}'; it has {}", query.name, one_line(number_, 100),
                               list_text(names)));
  }
  /// Positions of floats; a bound of 0 includes both zeros.
  std::pair<std::uint64_t, std::uint64_t> chosen_range() const {
    const std::uint64_t begin = from_ ? position_of(*from_ == 0 ? -0.0f : *from_) : 0;
    const std::uint64_t end = to_ ? position_of(*to_ == 0 ? 0.0f : *to_) + 1 : finite_floats;
    if (begin >= end) throw BadInput("--from is above --to");
    return {begin, end};
  }
  std::vector<Subject> chosen_subjects(const Query& query) const {
    for (const std::string& name : subject_) check_can_be_swept(name, query);
    std::vector<Subject> all = own_subjects_in_process();
    std::erase_if(all, [&](const Subject& s) {
      const bool asked = subject_.empty() || std::find(subject_.begin(), subject_.end(), s.name) != subject_.end();
      return !asked || s.scalar != Scalar::float32 || s.offering(query.name).answer == nullptr;
    });
    if (all.empty()) throw BadInput(fmt::format("nothing to sweep: no tier of scalar float offers {}", query.name));
    return all;
  }
  static void check_can_be_swept(const std::string& name, const Query& query) {
    const std::vector<Subject> own = own_subjects_in_process();
    const auto found = std::find_if(own.begin(), own.end(), [&](const Subject& s) { return s.name == name; });
    if (found == own.end()) {
      throw BadInput(
          fmt::format("--subject {}: a sweep asks subjects in its own process, which a crash would end; only "
                      "the tiers of collide are asked so",
                      name));
    }
    const Subject& s = *found;
    if (s.scalar != Scalar::float32) {
      throw BadInput(fmt::format("--subject {}: it computes in double, and a sweep goes through every float", name));
    }
    if (s.offering(query.name).answer == nullptr) {
      throw BadInput(
          fmt::format("--subject {}: it does not offer {}: {}", name, query.name, s.offering(query.name).how));
    }
  }

  std::string query_, number_, file_, out_;
  std::vector<std::string> subject_;
  std::optional<float> from_, to_;
  std::optional<std::uint64_t> seed_, jobs_;
};

}  // namespace

std::unique_ptr<Command> sweep_command() { return std::make_unique<SweepCommand>(); }

}  // namespace nearmiss

#include "reports/triage/comparison/bisect.hpp"

#include <fmt/format.h>
#include <stdlib.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>
#include <system_error>

#include "corpus/files/errors.hpp"
#include "corpus/files/file_value.hpp"
#include "corpus/storage/codec.hpp"
#include "impl/host/supervisor.hpp"
#include "reports/findings/text.hpp"

namespace nearmiss {

namespace {

namespace fs = std::filesystem;

/// A program that has ended.
struct Ended {
  int code = -1;
  std::string output;  ///< standard output and error, or standard output alone where it went to a file
};

/// The last line that is not empty.
std::string last_words(const std::string& text) {
  std::istringstream in(text);
  std::string last;
  for (std::string line; std::getline(in, line);) {
    if (line.find_first_not_of(" \t\r") != std::string::npos) last = line;
  }
  return one_line(last, 200);
}

/// Programs that work in a working tree of a revision; removes the tree at the end.
class Checkout {
 public:
  explicit Checkout(const fs::path& repository) : repository_(repository) {
    std::string name = (fs::temp_directory_path() / "nearmiss-bisect-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw std::system_error(errno, std::generic_category(), name);
    folder_ = name;
    const Ended added = git(repository_, {"worktree", "add", "--detach", tree().string()});
    if (added.code == 0) return;
    remove();
    throw BadInput(fmt::format("{}: git cannot check it out: {}", repository_.string(), last_words(added.output)));
  }
  ~Checkout() { remove(); }
  Checkout(const Checkout&) = delete;
  Checkout& operator=(const Checkout&) = delete;

  Ended git(const std::vector<std::string>& words) const { return git(tree(), words); }
  /// The hash of a revision, as the repository's own working tree names it.
  std::string hash_of(const std::string& revision) const {
    const Ended found = git(repository_, {"rev-parse", "--verify", "--quiet", revision + "^{commit}"});
    if (found.code != 0) throw BadInput(fmt::format("{}: it has no revision '{}'", repository_.string(), revision));
    return found.output.substr(0, found.output.find('\n'));
  }
  /// Runs a shell command at the top of the tree. With `quiet`, only standard output is returned.
  Ended shell(const std::string& command, bool quiet) const {
    const fs::path out = folder_ / "out";
    const std::string script = quiet ? fmt::format("{{ {}\n}} >{}", command, shell_quoted(out.string())) : command;
    Ended ended = run({"sh", "-c", fmt::format("cd {} && {}", shell_quoted(tree().string()), script)}, folder_ / "log");
    if (quiet && fs::exists(out) && ended.code <= 1) ended.output = read_file(out.string());
    return ended;
  }
  /// "abc1234" and the first line of the message, of the revision that is checked out.
  std::pair<std::string, std::string> commit() const {
    const std::string line = git({"log", "-1", "--format=%h %s"}).output;
    const std::size_t space = line.find(' ');
    return {line.substr(0, space), one_line(line.substr(space + 1, line.find('\n') - space - 1), 100)};
  }

 private:
  fs::path tree() const { return folder_ / "tree"; }
  static Ended run(const std::vector<std::string>& words, const fs::path& log) {
    Program program;
    program.arguments = words;
    program.log = log.string();
    SupervisedProcess child(program, Confinement::none());
    while (!child.has_ended(1000)) {
    }
    return {child.exit_code().value_or(-1), fs::exists(log) ? read_file(log.string()) : ""};
  }
  Ended git(const fs::path& where, const std::vector<std::string>& words) const {
    std::vector<std::string> all{"git", "-C", where.string()};
    all.insert(all.end(), words.begin(), words.end());
    return run(all, folder_ / "git");
  }
  void remove() noexcept {
    try {
      git(repository_, {"worktree", "remove", "--force", tree().string()});
      fs::remove_all(folder_);
      git(repository_, {"worktree", "prune"});
    } catch (const std::exception&) {  // what is left is a temporary folder
    }
  }

  fs::path repository_, folder_;
};

/// What a report of the replay says, where the revision may be of another version.
struct Said {
  std::string verdict, disagreement;
  /// "false miss", "broke" or "agrees".
  const std::string& in_a_word() const { return disagreement == "none" ? verdict : disagreement; }
};

Said said_in(const nlohmann::json& reports) {
  const FileValue finding = FileValue(reports, "the replay").items().at(0).at("finding");
  return {finding.at("verdict").text(), finding.at("disagreement").text()};
}

class Bisector {
 public:
  Bisector(const Bisection& b, const std::function<void(const BisectionStep&)>& tell)
      : b_(b), tell_(tell), tree_(b.repository) {}

  FirstWithFinding find(const std::function<bool()>& stopped) {
    const std::string good = tree_.hash_of(b_.good), bad = tree_.hash_of(b_.bad);
    expect(bad, b_.bad, Seen::present);
    expect(good, b_.good, Seen::absent);
    checked({"bisect", "start", bad, good});
    while (result_.commits.empty() && !stopped()) {
      const BisectionStep step = examine();
      const char* word = step.seen == Seen::present ? "bad" : step.seen == Seen::absent ? "good" : "skip";
      result_.commits = first_in(tree_.git({"bisect", word}).output);
    }
    tree_.git({"bisect", "reset"});
    return std::move(result_);
  }

 private:
  void checked(const std::vector<std::string>& words) const {
    const Ended ended = tree_.git(words);
    if (ended.code != 0) throw BadInput(fmt::format("git {}: {}", words[0], last_words(ended.output)));
  }
  /// Examines the revision that is checked out.
  BisectionStep examine() {
    const auto [commit, subject] = tree_.commit();
    BisectionStep step{commit, subject, Seen::unknown, ""};
    look(step);
    result_.steps.push_back(step);
    tell_(step);
    return step;
  }
  void look(BisectionStep& step) const {
    if (!b_.build.empty()) {
      const Ended built = tree_.shell(b_.build, false);
      if (built.code != 0) {
        step.why = "it cannot be built: " + last_words(built.output);
        return;
      }
    }
    const Ended replayed = tree_.shell(b_.replay, true);
    const nlohmann::json reports = nlohmann::json::parse(replayed.output, nullptr, false);
    if (replayed.code > 1 || replayed.code < 0 || !reports.is_array() || reports.empty()) {
      step.why = "the case cannot be asked: " + last_words(replayed.output);
      return;
    }
    try {
      const Said said = said_in(reports);
      step.why = said.in_a_word();
      const bool same = said.verdict == b_.verdict && said.disagreement == b_.disagreement;
      step.seen = same ? Seen::present : Seen::absent;
    } catch (const BadInput& e) {
      step.why = fmt::format("the case cannot be asked: {}", e.what());
    }
  }
  void expect(const std::string& hash, const std::string& revision, Seen seen) {
    checked({"checkout", "--detach", hash});
    const BisectionStep step = examine();
    if (step.seen == seen) return;
    throw BadInput(fmt::format("revision {} ({}) {}: {}", revision, step.revision,
                               step.seen == Seen::unknown  ? "cannot be examined"
                               : step.seen == Seen::absent ? "does not have the finding"
                                                           : "has the finding already",
                               step.why));
  }
  /// The commits that git names at the end: one, or all that it cannot tell apart.
  static std::vector<std::string> first_in(const std::string& output) {
    std::istringstream in(output);
    std::vector<std::string> commits;
    bool several = false;
    for (std::string line; std::getline(in, line);) {
      const std::size_t end = line.find(" is the first bad commit");
      if (end != std::string::npos) return {line.substr(0, end)};
      several = several || line.starts_with("The first bad commit could be any of:");
      const bool is_commit = line.size() == 40 && line.find_first_not_of("0123456789abcdef") == std::string::npos;
      if (several && is_commit) commits.push_back(line);
    }
    return commits;
  }

  const Bisection& b_;
  const std::function<void(const BisectionStep&)>& tell_;
  Checkout tree_;
  FirstWithFinding result_;
};

}  // namespace

std::string_view name_of(Seen s) {
  switch (s) {
    case Seen::absent: return "without the finding";
    case Seen::present: return "with the finding";
    case Seen::unknown: return "unknown";
  }
  return "?";
}

FirstWithFinding bisect(const Bisection& b, const std::function<void(const BisectionStep&)>& tell,
                        const std::function<bool()>& stopped) {
  return Bisector(b, tell).find(stopped);
}

}  // namespace nearmiss

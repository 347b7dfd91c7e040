/// One climb: the search for the largest error of one kind that one subject makes on one query.
///
/// A climb asks cases in rounds. It begins with the worst cases known and with generated ones. From the worst of them
/// it climbs: each round proposes neighbours of the case (corpus/search/neighbours.hpp) and moves to the one with the
/// largest error. A hill counts as climbed when several rounds found nothing worse. The next hill begins at another bad
/// case, at a case that differs in many numbers from the top of an earlier hill, or at new generated cases.
///
/// Only errors that the judge proved count. A forward error has no bound where a query is badly conditioned: there the
/// search finds cases that are ever closer to a flip. That is what it is for.
#pragma once

#include <compare>
#include <cstdint>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "corpus/storage/store.hpp"
#include "impl/subject/subject.hpp"
#include "oracles/error_kind.hpp"

namespace nearmiss {

class Climb {
 public:
  /// Where the cases come from.
  enum class Source {
    neighbours,  ///< a climb
    generator,   ///< generated cases alone: random sampling, to compare a climb with
  };
  struct Settings {
    const Query* query;
    const Subject* subject;  ///< offers the query
    ErrorKind kind;
    std::uint64_t seed;
    Source source = Source::neighbours;
    std::vector<Case> known{};          ///< bad cases to begin at; those that are not exact in the scalar are left out
    std::optional<WorstCase> stored{};  ///< the stored worst case of this query, subject and kind
  };
  /// Deterministic: the same settings, sizes of rounds and findings give the same cases.
  explicit Climb(Settings settings);

  const Query& query() const { return *settings_.query; }
  const Subject& subject() const { return *settings_.subject; }
  ErrorKind kind() const { return settings_.kind; }
  /// The detail that findings for take() need: the exact forward error also leads to backward errors.
  static constexpr Detail detail = Detail::forward;

  /// The cases of the next round, at most `most`: valid, exact in the subject's scalar. They stay until the next call.
  std::span<const Case> propose(std::size_t most);
  /// Takes the finding on case `i` of the round, by the subject's own standard. A case without a comparable answer
  /// (out of domain, not asked, broken, late) is never a step.
  void take(std::size_t i, const Answer& answer, const Finding& f);
  /// Ends the round. Findings that were not taken, say after an interrupt, count for nothing.
  void end_round();

  /// The worst case so far, with error_of(). Its error never decreases. Empty where no error was proved.
  const std::optional<WorstCase>& record() const { return record_; }
  /// True where the record's answer is proved to differ by more than the subject's contract, or the measure, allows.
  bool record_is_violation() const { return record_is_violation_; }
  /// The stored worst case's error by today's subject and judge; 0 where nothing is proved any more. Empty without a
  /// stored case, and before it was asked.
  std::optional<double> stored_now() const { return stored_now_; }
  const std::optional<WorstCase>& stored() const { return settings_.stored; }
  std::uint64_t asked() const { return asked_; }  ///< cases with a finding
  std::uint64_t proposed() const { return proposed_count_; }
  std::uint64_t hills() const { return hills_; }  ///< hills climbed to their top
  /// True after a round without any finding: the subject was given up.
  bool is_over() const { return over_; }

  double seconds = 0;  ///< time that the climb has taken so far; of its driver

 private:
  /// Orders cases. Most answers have no proved backward error: the guide orders them, and is never a record.
  struct Height {
    double error = 0;  ///< proved
    double guide = 0;  ///< of a backward climb: the larger, the sooner an error may be proved nearby
    auto operator<=>(const Height&) const = default;
    bool clearly_above(const Height& other) const;
  };
  struct Place {
    Case question;
    Height height;
  };
  enum class Phase { known, scout, kick, hill };
  /// What leads a backward climb where nothing is proved: the estimated backward error of the numbers, or the nearness
  /// of the decision's flip, where a decision may be wrong.
  enum class Guide { numbers, decision };

  void propose_generated(std::size_t count);
  void propose_kicks(std::size_t count);
  void propose_steps(std::size_t count);
  void fit_proposed();
  std::optional<Height> height_of(const Case& c, const Answer& answer, const Finding& f) const;
  double guide_of(const Case& c, const Answer& answer, const Finding& f) const;
  Height backward_height(const Case& c, const Answer& answer, const Finding& f) const;
  void keep(const Case& c, const Height& h);
  void compare_with_record(const Case& c, const Answer& answer, const Finding& f);
  void end_steps();
  void end_hill();
  void begin_hill();
  void look_for_starts();

  Settings settings_;
  Phase phase_ = Phase::known;
  Guide guide_ = Guide::numbers;
  std::vector<Case> proposed_;
  std::uint64_t taken_ = 0, asked_ = 0, proposed_count_ = 0, hills_ = 0;
  std::uint64_t next_generated_ = 0;
  std::mt19937_64 random_;  ///< the same numbers on every machine
  bool over_ = false;
  bool kicks_next_ = true;

  Place here_;
  std::vector<double> before_;  ///< the numbers of the case before the last step up; empty at the start of a hill
  bool rising_ = false;         ///< the last round led up
  Height milestone_;            ///< the height that a climb has to clear before its patience ends
  int rounds_below_milestone_ = 0;
  std::vector<Place> found_;   ///< the worst cases of the round, the worst first
  std::vector<Place> starts_;  ///< where hills may begin, the worst last
  std::vector<Place> tops_;    ///< the worst tops of hills, the worst first
  std::optional<WorstCase> record_;
  bool record_is_violation_ = false;
  std::optional<double> stored_now_;
};

}  // namespace nearmiss

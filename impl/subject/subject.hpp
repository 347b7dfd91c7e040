/// A subject: a library, or one configuration of it, that answers cases.
#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <collide/contract.hpp>

#include "impl/catalogue/answer.hpp"
#include "impl/subject/standard.hpp"

namespace nearmiss {

enum class Offer {
  answers,         ///< the library has this operation
  by_equivalence,  ///< the library has another operation to which the query can be reduced
  not_offered,
};

inline std::string_view name_of(Offer o) {
  return o == Offer::answers ? "answers" : o == Offer::by_equivalence ? "by equivalence" : "not offered";
}

/// The function that answers a query, with a context where it needs one. Trivially copyable, so that it can be passed
/// to a host process in shared memory.
class AnswerFunction {
 public:
  using Plain = Answer (*)(std::span<const double> inputs);
  using WithContext = Answer (*)(const void* context, std::span<const double> inputs);

  AnswerFunction() = default;
  template <class F>
    requires std::convertible_to<F, Plain>
  AnswerFunction(F plain) : plain_(plain) {}
  /// `context` must live as long as the subject (see Subject::context).
  AnswerFunction(WithContext function, const void* context) : with_context_(function), context_(context) {}

  Answer operator()(std::span<const double> inputs) const {
    return plain_ != nullptr ? plain_(inputs) : with_context_(context_, inputs);
  }
  bool operator==(std::nullptr_t) const { return plain_ == nullptr && with_context_ == nullptr; }

 private:
  Plain plain_ = nullptr;
  WithContext with_context_ = nullptr;
  const void* context_ = nullptr;
};

/// The numbers of some cases, one case behind the other.
struct CaseNumbers {
  std::span<const double> values;
  std::span<const std::uint32_t> begins;  ///< where each case begins in `values`, and the end of the last one

  std::size_t size() const { return begins.size() - 1; }
  std::span<const double> operator[](std::size_t i) const {
    return values.subspan(begins[i], begins[i + 1] - begins[i]);
  }
};

struct TimedRounds;
/// Measures calls of the subject's typed function for the cases of a batch (impl/subject/timed_calls.hpp).
using TimeFunction = void (*)(const CaseNumbers& numbers, TimedRounds& rounds);

/// What a subject offers for one query.
struct Offering {
  std::string query;
  Offer offer = Offer::not_offered;
  std::string how;  ///< the equivalent operation, or why the query is not offered
  collide::Contract contract{};
  AnswerFunction answer{};              ///< nullptr where the query is not offered
  Preconditions required{};             ///< a case that does not meet them is not asked
  std::vector<Declaration> declared{};  ///< its conventions
  std::uint32_t position = 0;           ///< index among the offers in the host's hello
  bool decides = true;        ///< false for a query without a decision: the decision that a host sends is then ignored
  std::uint32_t outputs = 0;  ///< numbers in an answer of a host; 0: unknown
  struct Counts {
    int inputs, outputs;
  };
  std::optional<Counts> counts{};  ///< the numbers of inputs and outputs that the host states
  TimeFunction time = nullptr;     ///< nullptr: its calls can be timed only through `answer`; known only in the host

  /// Adds them to its conventions, each once. One that only restricts the cases is a precondition as well.
  void declare(const std::vector<Declaration>& more) {
    for (const Declaration& d : more) {
      const auto is_same = [&](const Declaration& e) { return e.convention == d.convention; };
      if (std::none_of(declared.begin(), declared.end(), is_same)) declared.push_back(d);
      if (d.convention == Convention::unit_directions) required.add(Precondition::unit_direction);
    }
  }
};

/// A program that answers in place of a function of this process (docs/reference/protocol.md).
struct HostProgram {
  /// How batches are transferred: in shared memory, or through pipes.
  enum class Batches { shared, binary, json };

  std::vector<std::string> arguments;  ///< the file of the program first
  Batches batches = Batches::shared;
  int version = 0;              ///< of the protocol that it speaks; 0: not yet known
  std::string hello{};          ///< its hello from the first start; empty: not yet known
  bool asks_for_names = false;  ///< the names of all numbers are sent to it before the first batch
};

struct Subject {
  std::string name;
  std::string version;
  Scalar scalar = Scalar::float64;
  bool referee = false;  ///< also gives a second opinion on the findings of others
  std::vector<Offering> offerings;
  std::string plugin{};   ///< the plugin's file; empty for any other subject
  std::string command{};  ///< the command line, which runs from any folder; empty for any other subject
  std::shared_ptr<const HostProgram> host{};  ///< the program that answers; nullptr: functions of this process answer
  std::shared_ptr<const void> context{};      ///< keeps the context of its functions alive
  bool own = false;                           ///< belongs to this project (impl/subject/provenance.hpp)
  bool started = true;                        ///< false: only its name is known (subjects_at_hand)

  const Offering& offering(std::string_view query) const {
    static const Offering none{"", Offer::not_offered, "unknown query", {}, {}};
    for (const Offering& o : offerings) {
      if (o.query == query) return o;
    }
    return none;
  }
  /// The bound for its answers to the query, its contract or, where it promises nothing, the measure; its
  /// preconditions; and what it declares.
  Standard standard_for(std::string_view query) const;
  /// The conventions by which its answers to the query are judged: its own and those of declare(), or those of
  /// declare_as_reported().
  std::vector<Declaration> declared_for(std::string_view query) const;
};

/// Every subject of this build, in the order of the calls of nearmiss_add_subject, then the subjects of add_subject().
/// Subjects of this build that are
/// programs of their own are built, where the launcher started this program, and started when they are first needed: by
/// this function all of them. Throws BadSubject (impl/host/hosts.hpp).
const std::vector<Subject>& subjects();
/// The names of subjects(), without building or starting one.
std::vector<std::string> subject_names();
/// subjects() without building one: those that are not built are not started, and their offerings say how to build
/// them.
const std::vector<Subject>& subjects_at_hand();
/// The installed engines (impl/host/engines.hpp), started. They are none of subjects(): an engine is asked only where
/// it is named. Throws BadSubject.
const std::vector<Subject>& engines_at_hand();
/// The subjects and engines with these names, in the order of subjects(), engines last. They are built and started
/// together. Names of no subject are left out.
std::vector<const Subject*> subjects_named(std::span<const std::string> names);
/// The subjects that give second opinions on the findings of others (nearmiss_add_subject with REFEREE).
std::vector<const Subject*> referees();
/// Adds a subject for the rest of the process. Invalidates pointers into subjects().
void add_subject(Subject subject);
/// The bound for subjects that promise nothing, for inputs of any size: `error` bounds the backward error, relative to
/// the largest number of each group, and the distance of a normal's length from 1. One measure holds for all subjects.
struct Measure {
  /// Ten thousand steps over the extent of a scene. It decides which differences are reported, not which are right.
  static constexpr double usual = 1e-4;

  double error = usual;
  bool for_all = false;  ///< also replaces contracts
};
const Measure& measure();
/// Sets the measure for the rest of the process.
void set_measure(const Measure& m);
/// Declares a convention of a subject for the rest of the process: of all its queries that the convention concerns, or
/// of the named one. The subject need not be started yet.
void declare(const std::string& subject, std::string_view query, const Declaration& declaration);
/// The conventions with which a report was judged.
struct ReportedConventions {
  std::string subject, query;
  std::vector<Declaration> declared;
};
/// Until the next call, answers of that subject to that query are judged by these and those of declare(), in place of
/// what the subject declares now. Empty: by what each subject declares.
void declare_as_reported(std::optional<ReportedConventions> reported);
/// nullptr where no subject has that name. A subject of this build is built and started where needed.
const Subject* find_subject(std::string_view name);
/// Whether a subject or an installed engine has that name. Builds and starts none.
bool is_subject(std::string_view name);

}  // namespace nearmiss

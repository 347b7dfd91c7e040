/// A subject: something that answers cases.
#pragma once

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
  by_equivalence,  ///< the library has another one that the query can be brought to
  not_offered,
};

inline std::string_view name_of(Offer o) {
  return o == Offer::answers ? "answers" : o == Offer::by_equivalence ? "by equivalence" : "not offered";
}

/// How a subject is asked: a function, and what it works on where it is not the adapter of this build. Plain bytes,
/// so that a worker process can be told.
class AnswerFunction {
 public:
  using Plain = Answer (*)(std::span<const double> inputs);
  using WithContext = Answer (*)(const void* context, std::span<const double> inputs);

  AnswerFunction() = default;
  template <class F>
    requires std::convertible_to<F, Plain>
  AnswerFunction(F plain) : plain_(plain) {}
  /// `context` lives as long as the subject (Subject::context).
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

/// What a subject has for one query.
struct Offering {
  std::string query;
  Offer offer = Offer::not_offered;
  std::string how;  ///< by which equivalence, or why not
  collide::Contract contract{};
  AnswerFunction answer{};     ///< nullptr where it is not offered
  Preconditions required{};    ///< it is asked no case outside of them
  std::uint32_t position = 0;  ///< among the offers of a host's hello
  bool decides = true;         ///< false for a query without a yes or no: what a host says there means nothing
  std::uint32_t outputs = 0;   ///< numbers of an answer, where a host must give them; 0: unknown
  struct Counts {
    int inputs, outputs;
  };
  std::optional<Counts> counts{};  ///< of numbers, as whoever offers it believes
};

/// A program that is asked in place of a function of this one (docs/protocol.md).
struct HostProgram {
  /// How cases and answers travel: in shared memory, or through pipes.
  enum class Batches { shared, binary, json };

  std::vector<std::string> arguments;  ///< the program's file first
  Batches batches = Batches::shared;
  std::string hello{};  ///< the line that it said of itself when it was first started; empty: not yet known
};

struct Subject {
  std::string name;
  std::string version;
  Scalar scalar = Scalar::float64;
  bool own = false;      ///< belongs to this project (impl/subject/provenance.hpp)
  bool referee = false;  ///< also gives a second opinion on the findings of others
  std::vector<Offering> offerings;
  std::string plugin{};   ///< the file that it was loaded from; empty for a subject of this build
  std::string command{};  ///< the command line that is asked, as it runs from any folder; empty for any other
  std::shared_ptr<const HostProgram>
      host{};                             ///< the program that is it, or loads it; nullptr: functions of this program
  std::shared_ptr<const void> context{};  ///< what its functions work on, where that has to live as long

  const Offering& offering(std::string_view query) const {
    static const Offering none{"", Offer::not_offered, "unknown query", {}, {}};
    for (const Offering& o : offerings) {
      if (o.query == query) return o;
    }
    return none;
  }
  /// What its answers to the query are held to: its contract or, where it promises nothing, the measure; and what it
  /// requires.
  Standard standard_for(std::string_view query) const;
};

/// Every subject of this build, in the order in which CMake was told of them, then those that were added.
const std::vector<Subject>& subjects();
/// For the rest of the process. Pointers into subjects() that were taken before do not stay valid.
void add_subject(Subject subject);
/// The measure of what promises nothing: a backward error of at most so much, relative to the largest number of each
/// group, and normals whose length is off by at most so much, for inputs of any size. One for all subjects.
struct Measure {
  /// Ten thousand steps over the extent of a scene. It says which differences are told, not which are right.
  static constexpr double usual = 1e-4;

  double error = usual;
  bool for_all = false;  ///< in place of contracts too
};
const Measure& measure();
/// For the rest of the process.
void set_measure(const Measure& m);
/// nullptr when there is none of that name.
const Subject* find_subject(std::string_view name);

}  // namespace nearmiss

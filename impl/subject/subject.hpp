/// A subject: something that answers cases.
#pragma once

#include <concepts>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <collide/contract.hpp>

#include "impl/subject/answer.hpp"

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
  /// `context` lives as long as the process.
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
  AnswerFunction answer{};  ///< nullptr where it is not offered
};

struct Subject {
  std::string name;
  std::string version;
  Scalar scalar = Scalar::float64;
  bool referee = false;  ///< also gives a second opinion on the findings of others
  std::vector<Offering> offerings;
  std::string plugin{};  ///< the file that it was loaded from; empty for a subject of this build

  const Offering& offering(std::string_view query) const {
    static const Offering none{"", Offer::not_offered, "unknown query", {}, {}};
    for (const Offering& o : offerings) {
      if (o.query == query) return o;
    }
    return none;
  }
};

/// Every subject of this build, in the order in which CMake was told of them, then those that were added.
const std::vector<Subject>& subjects();
/// For the rest of the process. Pointers into subjects() that were taken before do not stay valid.
void add_subject(Subject subject);
/// From now on every subject promises, in place of its own contracts, a backward error of at most `error`, relative to
/// the largest number of each group, for inputs of any size: one measure for all.
void hold_all_to(double error);
/// True after hold_all_to.
bool held_to_one_measure();
/// nullptr when there is none of that name.
const Subject* find_subject(std::string_view name);

}  // namespace nearmiss

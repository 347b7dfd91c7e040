/// A subject: something that answers cases.
#pragma once

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

/// What a subject has for one query.
struct Offering {
  std::string query;
  Offer offer = Offer::not_offered;
  std::string how;  ///< by which equivalence, or why not
  collide::Contract contract{};
  Answer (*answer)(std::span<const double> inputs) = nullptr;
};

struct Subject {
  std::string name;
  std::string version;
  Scalar scalar = Scalar::float64;
  bool referee = false;  ///< also gives a second opinion on the findings of others
  std::vector<Offering> offerings;

  const Offering& offering(std::string_view query) const {
    static const Offering none{"", Offer::not_offered, "unknown query", {}, nullptr};
    for (const Offering& o : offerings) {
      if (o.query == query) return o;
    }
    return none;
  }
};

/// Every subject of this build, in the order in which CMake was told of them.
const std::vector<Subject>& subjects();
/// nullptr when there is none of that name.
const Subject* find_subject(std::string_view name);

}  // namespace nearmiss

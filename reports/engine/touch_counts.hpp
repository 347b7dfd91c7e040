/// Counts the answers to exact touches. Whether touching is contact (closed) or not (strict) is a convention, which a
/// library should apply in all queries alike.
#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "impl/subject/subject.hpp"
#include "oracles/judge.hpp"

namespace nearmiss {

/// A number of exact touches, and the number of answers that are yes.
struct TouchCount {
  std::uint64_t touches = 0, yes = 0;
  double share() const { return touches == 0 ? 0 : double(yes) / double(touches); }
};

class TouchCounts {
 public:
  /// Counts an answer if the case is an exact touch. `known` caches whether it is one.
  void count(const Case& question, const Subject& subject, const Answer& answer, const Finding& f,
             std::optional<bool>& known);

  /// A subject for which touching is contact in some queries but not in others.
  struct Inconsistent {
    const Subject* subject;
    std::vector<std::string> closed, strict;  ///< queries
  };
  std::vector<Inconsistent> inconsistent() const;
  /// A line for each subject and query with a no to an exact touch, by share of yes, lowest first, with the counts by
  /// feature; at most twelve lines; empty where all answers are yes.
  std::string text() const;
  nlohmann::ordered_json to_json() const;

  /// A query counts as closed or strict where it has at least `enough` exact touches and all but the share `exceptions`
  /// of its answers are equal.
  static constexpr std::uint64_t enough = 50;
  static constexpr double exceptions = 0.02;

 private:
  struct Key {
    const Subject* subject;
    const Query* query;
    auto operator<=>(const Key&) const = default;
  };
  std::map<Key, std::map<std::string, TouchCount>> by_feature_;
};

}  // namespace nearmiss

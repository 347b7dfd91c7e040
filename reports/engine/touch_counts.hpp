/// Exact touches, counted: closed or strict is a convention, and one library should have one.
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

/// Of so many exact touches, so many answers are yes.
struct TouchCount {
  std::uint64_t touches = 0, yes = 0;
  double share() const { return touches == 0 ? 0 : double(yes) / double(touches); }
};

class TouchCounts {
 public:
  /// Counts an answer to a case that is an exact touch. `known` remembers, for the case, whether it is one.
  void count(const Case& question, const Subject& subject, const Answer& answer, const Finding& f,
             std::optional<bool>& known);

  /// A subject for which touching is contact in some queries and none in others.
  struct Inconsistent {
    const Subject* subject;
    std::vector<std::string> closed, strict;  ///< queries
  };
  std::vector<Inconsistent> inconsistent() const;
  /// A line for each subject and query that does not answer yes to all exact touches, the fewest yes first, with its
  /// features; at most twelve; empty where there is none.
  std::string text() const;
  nlohmann::ordered_json to_json() const;

  /// A query counts as closed, or as strict, where it has at least so many exact touches and all but this share of its
  /// answers are alike.
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

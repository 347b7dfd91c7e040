/// Reads answers derived by hand from the files of properties/hand_derived/; the README.md there has the format.
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "impl/catalogue/answer.hpp"
#include "impl/catalogue/query.hpp"

namespace nearmiss {

/// One answer to inputs of a query, and whether it is right.
struct HandDerived {
  const Query* query;
  std::string name;
  std::vector<double> inputs;
  bool right;
  Answer answer;      ///< `given` has the members that the line states
  std::string where;  ///< "moving_sphere_box.txt:12"

  /// The word of the name before the first underscore: "touch" of "touch_graze".
  std::string class_name() const { return name.substr(0, name.find('_')); }
};

/// What the file of one query states.
struct HandDerivedFile {
  std::set<std::string> classes;  ///< for which the file must have right answers
  std::vector<HandDerived> answers;
  std::vector<std::string> errors;  ///< "FILE:LINE: what is wrong", one for each wrong line, which is skipped
};

/// Parses the text of one file. `file` is its name in errors.
HandDerivedFile parse_hand_derived(const Query& query, std::string_view file, std::string_view text);

/// Every file QUERY.txt of a folder, by the query's name. A file of no query and a query without a file are errors.
std::map<std::string, HandDerivedFile> read_hand_derived(const std::string& folder);

}  // namespace nearmiss

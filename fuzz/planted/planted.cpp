/// The plugin with planted mistakes: answers of `collide`, tier Accurate, with the mistakes of one round, that of the
/// environment variable NEARMISS_PLANTED_ROUND or the first.
#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <string>

#include "fuzz/planted/planting.hpp"

namespace nearmiss::planted {

std::vector<Mistake>& mistakes() {
  static std::vector<Mistake> all;
  return all;
}

namespace {

/// The name of a round's plugin. A report's id depends on it, and so do the reports that are explained and the scores.
constexpr const char* names[] = {
    "planted",          "planted-later",   "planted-blind",      "planted-unseen",     "planted-fifth",
    "planted-sixth",    "planted-seventh", "planted-eighth",     "planted-ninth",      "planted-tenth",
    "planted-eleventh", "planted-twelfth", "planted-thirteenth", "planted-fourteenth", "planted-fifteenth"};

/// The first where the variable names none.
int chosen_round() {
  const char* given = std::getenv("NEARMISS_PLANTED_ROUND");
  return given == nullptr ? 1 : std::clamp(std::atoi(given), 1, int(std::size(names)));
}

std::vector<nearmiss_offer> offers_of(int round) {
  std::vector<nearmiss_offer> offers;
  for (const Mistake& m : mistakes()) {
    if (m.round == round) offers.push_back(m.offer);
  }
  return offers;
}

std::string table() {
  std::string text;
  for (const Mistake& m : mistakes()) {
    text += std::to_string(m.round) + '\t' + std::string(m.query) + '\t';
    text += std::string(m.where == Where::ordinary ? "ordinary" : "degenerate") + '\t';
    text += std::string(m.what) + '\t' + std::string(m.causes) + '\t' + names[m.round - 1] + '\n';
  }
  return text;
}

}  // namespace
}  // namespace nearmiss::planted

extern "C" const nearmiss_plugin* nearmiss_plugin_entry() {
  using namespace nearmiss::planted;
  static const int round = chosen_round();
  static const std::vector<nearmiss_offer> offers = offers_of(round);
  static const nearmiss_plugin plugin{NEARMISS_PLUGIN_VERSION, names[round - 1], "1",
                                      NEARMISS_DOUBLE,         offers.size(),    offers.data()};
  return &plugin;
}

/// The table: a line for each mistake, its members and the name of its round's plugin separated by tabs.
extern "C" const char* nearmiss_planted_table() {
  static const std::string text = nearmiss::planted::table();
  return text.c_str();
}

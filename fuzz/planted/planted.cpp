/// The plugin "planted": answers of `collide`, tier Accurate, with the mistakes of one round, that of the environment
/// variable NEARMISS_PLANTED_ROUND or the first.
#include <cstdlib>
#include <string>

#include "fuzz/planted/planting.hpp"

namespace nearmiss::planted {

std::vector<Mistake>& mistakes() {
  static std::vector<Mistake> all;
  return all;
}

namespace {

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
    text += std::string(m.what) + '\t' + std::string(m.causes) + '\n';
  }
  return text;
}

}  // namespace
}  // namespace nearmiss::planted

extern "C" const nearmiss_plugin* nearmiss_plugin_entry() {
  const char* round = std::getenv("NEARMISS_PLANTED_ROUND");
  static const std::vector<nearmiss_offer> offers =
      nearmiss::planted::offers_of(round != nullptr ? std::atoi(round) : 1);
  static const nearmiss_plugin plugin{NEARMISS_PLUGIN_VERSION, "planted",     "1",
                                      NEARMISS_DOUBLE,         offers.size(), offers.data()};
  return &plugin;
}

/// The table: a line for each mistake, its members separated by tabs.
extern "C" const char* nearmiss_planted_table() {
  static const std::string text = nearmiss::planted::table();
  return text.c_str();
}

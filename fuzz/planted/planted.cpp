/// The plugin with planted mistakes: answers of `collide`, tier Accurate, with the mistakes of one round, that of the
/// environment variable NEARMISS_PLANTED_ROUND or the first. NEARMISS_PLANTED_ADDED=ROUND:QUERY adds the mistake of
/// another round to the answers to one query: its answer is given where it is not the right one.
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

/// The answers to a query with two mistakes.
struct TwoMistakes {
  nearmiss_answer_function known = nullptr, added = nullptr, right = nullptr;
  std::size_t numbers = 0;  ///< of an answer
};
TwoMistakes two_mistakes;

bool are_the_same(const nearmiss_answer& a, const nearmiss_answer& b) {
  return a.yes == b.yes && std::equal(a.values, a.values + two_mistakes.numbers, b.values);
}

int answer_by_two(const double* numbers, std::size_t count, nearmiss_answer* to) {
  nearmiss_answer added = *to, right = *to;
  two_mistakes.added(numbers, count, &added);
  two_mistakes.right(numbers, count, &right);
  if (are_the_same(added, right)) return two_mistakes.known(numbers, count, to);
  *to = added;
  return NEARMISS_ANSWERED;
}

const Mistake* find(int round, const std::string& query) {
  const auto found = std::find_if(mistakes().begin(), mistakes().end(),
                                  [&](const Mistake& m) { return m.round == round && m.query == query; });
  return found == mistakes().end() ? nullptr : &*found;
}

/// Where nothing is named, or no such mistake, the offers stay as they are.
void add_mistake(std::vector<nearmiss_offer>& offers) {
  const char* given = std::getenv("NEARMISS_PLANTED_ADDED");
  const std::string named = given == nullptr ? "" : given;
  const std::size_t colon = named.find(':');
  if (colon == std::string::npos) return;
  const Mistake* added = find(std::atoi(named.c_str()), named.substr(colon + 1));
  for (nearmiss_offer& o : offers) {
    if (added == nullptr || added->query != o.query) continue;
    two_mistakes = {o.answer, added->offer.answer, right_answer_to(o.query), std::size_t(o.outputs)};
    o.answer = answer_by_two;
  }
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
  static const std::vector<nearmiss_offer> offers = [] {
    std::vector<nearmiss_offer> all = offers_of(round);
    add_mistake(all);
    return all;
  }();
  static const nearmiss_plugin plugin{NEARMISS_PLUGIN_VERSION, names[round - 1], "1",
                                      NEARMISS_DOUBLE,         offers.size(),    offers.data()};
  return &plugin;
}

/// The table: a line for each mistake, its members and the name of its round's plugin separated by tabs.
extern "C" const char* nearmiss_planted_table() {
  static const std::string text = nearmiss::planted::table();
  return text.c_str();
}

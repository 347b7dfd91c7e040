#include "impl/catalogue/case.hpp"

namespace nearmiss {

namespace {

/// Where the numbers of the entry begin.
auto begin_of(Case& c, std::size_t list, std::size_t entry) {
  const std::size_t count = c.query->lists.place_of_count(list, c.values);
  return c.values.begin() + std::ptrdiff_t(count + 1 + entry * c.query->lists[list].numbers);
}

}  // namespace

bool erase_entry(Case& c, std::size_t list, std::size_t entry) {
  const CountedInput& of = c.query->lists[list];
  if (c.query->lists.count_of(list, c.values) == of.least) return false;
  const auto begin = begin_of(c, list, entry);
  c.values.erase(begin, begin + std::ptrdiff_t(of.numbers));
  c.values[c.query->lists.place_of_count(list, c.values)] -= 1;
  return true;
}

bool repeat_entry(Case& c, std::size_t list, std::size_t entry) {
  const CountedInput& of = c.query->lists[list];
  if (c.query->lists.count_of(list, c.values) == of.most) return false;
  const auto begin = begin_of(c, list, entry);
  const std::vector<double> numbers(begin, begin + std::ptrdiff_t(of.numbers));
  c.values.insert(begin + std::ptrdiff_t(of.numbers), numbers.begin(), numbers.end());
  c.values[c.query->lists.place_of_count(list, c.values)] += 1;
  return true;
}

}  // namespace nearmiss

#include "corpus/generator/generator.hpp"

#include <algorithm>
#include <bitset>
#include <deque>
#include <stdexcept>

#include "corpus/generator/case_builder.hpp"

namespace nearmiss {

namespace {

constexpr std::size_t most_mutators = 64;

std::uint64_t hash(std::string_view text) {  // FNV-1a
  std::uint64_t h = 0xcbf29ce484222325;
  for (unsigned char c : text) h = (h ^ c) * 0x100000001b3;
  return h;
}

bool is_movable(Role role) { return role == Role::position || role == Role::velocity || role == Role::direction; }

/// The plan of a case, made once per thread for cases of the same query and counts.
const Plan& plan_of(const Case& c) {
  static thread_local std::deque<Plan> plans;
  const Field* fields = c.fields().data();
  for (const Plan& p : plans) {
    if (p.fields.data() == fields) return p;
  }
  return plans.emplace_back(*c.query, c.values);
}

/// Whether all numbers are within the magnitudes that generator.hpp states.
bool moderate(const CaseBuilder& d) {
  const double largest = std::ldexp(1.0, d.orders(18, 60)), smallest = 1 / largest;
  for (const auto& group : d.plan.numbers) {
    double m = 0;
    for (std::size_t i : group) m = std::max(m, std::abs(d[i]));
    if (m > largest || (m > 0 && m < smallest)) return false;
  }
  return true;
}

void apply(CaseBuilder& d, const std::bitset<most_mutators>& chosen, std::vector<std::string_view>& names) {
  const std::span<const Mutator> table = mutators();
  for (std::size_t i = 0; i < table.size(); ++i) {
    if (chosen[i] && table[i].apply(d)) names.push_back(table[i].name);
  }
}

std::size_t count_of_ordinary_mutators() {
  static const auto count =
      std::size_t(std::count_if(mutators().begin(), mutators().end(), [](const Mutator& m) { return !m.extreme; }));
  return count;
}

std::bitset<most_mutators> choose(Random& random, int count, std::size_t among) {
  std::bitset<most_mutators> chosen;
  for (; count > 0; --count) chosen.set(random.below(among));
  return chosen;
}

/// Chooses one of the extreme mutators.
std::bitset<most_mutators> choose_extreme(Random& random) {
  std::bitset<most_mutators> chosen;
  const std::size_t ordinary = count_of_ordinary_mutators();
  chosen.set(ordinary + random.below(mutators().size() - ordinary));
  return chosen;
}

/// Half of the mutated cases start on a grid, where touches and ties are exact.
std::bitset<most_mutators> choose_for_new_case(Random& random) {
  constexpr std::size_t small_lattice = 0, dyadic_grid = 1;
  auto chosen = choose(random, random.between(1, 4), count_of_ordinary_mutators());
  if (random.one_in(2)) chosen.set(random.one_in(3) ? dyadic_grid : small_lattice);
  return chosen;
}

bool attempt(Case& c, const Plan& plan, Random& random) {
  c.moves.clear();
  CaseBuilder builder(plan, c.scalar, random, c.values);
  draw_scene(builder);
  if (random.one_in(2)) apply(builder, choose_for_new_case(random), c.moves);
  if (!moderate(builder)) return false;
  constexpr std::size_t one_extreme_in = 40;
  if (random.one_in(one_extreme_in)) apply(builder, choose_extreme(random), c.moves);
  const bool finite = std::all_of(c.values.begin(), c.values.end(), [](double x) { return std::isfinite(x); });
  return finite && !c.query->broken(c.values);
}

}  // namespace

Plan::Plan(const Query& q, std::span<const double> values)
    : query(&q), fields(q.fields_of(values)), name_hash(hash(q.name)) {
  const Operands& parts = q.operands_of(values);
  for (std::size_t i = 0; i < fields.size(); ++i) numbers[std::size_t(fields[i].role)].push_back(i);
  for (const InputMember& m : parts.members) {
    if (m.role == Role::count) continue;
    if (m.role == Role::rotation) {
      rotations.push_back(m.begin);
    } else if (m.is_vector() && is_movable(m.role)) {
      movable.push_back(m.begin);
      (m.role == Role::position ? positions : m.role == Role::velocity ? velocities : directions).push_back(m.begin);
    } else {
      auto& list = m.role == Role::size ? sizes : lone;
      for (std::size_t k = 0; k < m.count; ++k) list.push_back(m.begin + k);
    }
  }
  for (const Operand& operand : parts) {
    bodies.push_back(operand);
    if (!operand.positions.empty()) operands.push_back(operand);
    if (operand.shape == Shape::aabox)
      upper.insert(upper.end(), {operand.begin + 3, operand.begin + 4, operand.begin + 5});
  }
}

[[gnu::noinline]] double rounded_to(Scalar scalar, double x) {
  return scalar == Scalar::float32 ? double(float(x)) : x;
}

void CaseBuilder::step_ulps(std::size_t i, int ulps) {
  const double toward = ulps > 0 ? HUGE_VAL : -HUGE_VAL;
  for (int k = std::abs(ulps); k > 0; --k) {
    values_[i] =
        is_float() ? double(std::nextafter(float(values_[i]), float(toward))) : std::nextafter(values_[i], toward);
  }
}

void CaseBuilder::repair() {
  const auto all_zero = [&](std::size_t begin, std::size_t n) {
    return std::all_of(&values_[begin], &values_[begin] + n, [](double x) { return x == 0; });
  };
  for (std::size_t v : plan.directions) {
    const std::size_t k = random.below(3);
    if (all_zero(v, 3)) set(v + k, random.sign());
  }
  for (std::size_t begin : plan.rotations) {
    if (all_zero(begin, 4)) set(begin + 3, 1);
  }
  for (std::size_t i : plan.upper) {  // an axis-aligned box: the three numbers before are its lower corner
    const double lower = values_[i - 3], upper = values_[i];
    if (upper < lower) set(i - 3, upper), set(i, lower);
  }
}

namespace {

/// A few entries are more often drawn than many: they show the same branches, and are easier to read.
std::size_t draw_count(const CountedInput& list, Random& random) {
  const std::size_t some = std::min(list.most, list.least + 8);
  return list.least + random.below((random.one_in(4) ? list.most : some) - list.least + 1);
}

/// Zeros, with a drawn count for each list.
void draw_counts(Case& c, Random& random) {
  const CountedInputs& lists = c.query->lists;
  c.values.assign(c.query->most_numbers(), 0);
  for (std::size_t k = 0; k < lists.size(); ++k)
    c.values[lists.place_of_count(k, c.values)] = double(draw_count(lists[k], random));
  c.values.resize(c.query->numbers_of(c.values));
}

}  // namespace

void generate(Case& into, const Query& query, Scalar scalar, std::uint64_t seed, std::uint64_t index) {
  // Each part passes through the mixer, so that streams of neighbouring seeds are unrelated.
  Random random(Random(Random(seed).bits() ^ hash(query.name) ^ std::uint64_t(scalar)).bits() ^ Random(index).bits());
  into.query = &query;
  into.scalar = scalar;
  into.values.resize(query.numbers_of({}));
  if (!query.lists.empty()) draw_counts(into, random);
  const Plan& plan = plan_of(into);
  into.origin = "generator";
  into.seed = seed;
  into.index = index;
  constexpr int attempts = 1000;
  for (int i = 0; i < attempts; ++i) {
    if (attempt(into, plan, random)) return;
  }
  throw std::logic_error("generator: no valid case of " + std::string(query.name) + " in 1000 attempts");
}

Case generate(const Query& query, Scalar scalar, std::uint64_t seed, std::uint64_t index) {
  Case c;
  generate(c, query, scalar, seed, index);
  return c;
}

namespace {

constexpr MutatorName entry_mutators[] = {
    {"drop-vertex", "a shape of any number of vertices has one less", false},
    {"repeat-vertex", "it has a vertex twice", false},
    {"add-vertex", "it has one more, on the line through two others or beside one", false},
};

/// Moves the entry of a list to a place on the line through another entry, or a little away.
void move_entry(Case& c, std::size_t list, std::size_t entry, std::size_t other, Random& random) {
  const std::size_t numbers = c.query->lists[list].numbers;
  double* const to = &c.values[c.query->lists.place_of_count(list, c.values) + 1 + entry * numbers];
  const double* const along = to + (std::ptrdiff_t(other) - std::ptrdiff_t(entry)) * std::ptrdiff_t(numbers);
  const double share = 0.125 * random.between(-8, 16);
  const bool is_alone = other == entry;
  for (std::size_t k = 0; k < numbers; ++k)
    to[k] = rounded_to(c.scalar, is_alone ? to[k] + random.uniform(-1, 1) : to[k] + share * (along[k] - to[k]));
}

/// Changes the count of a list.
void change_entries(Case& c, Random& random) {
  const std::size_t list = random.below(c.query->lists.size());
  const std::size_t count = c.query->lists.count_of(list, c.values), entry = random.below(count);
  const std::size_t change = random.below(std::size(entry_mutators));
  if (change == 0 ? !erase_entry(c, list, entry) : !repeat_entry(c, list, entry)) return;
  if (change == 2) move_entry(c, list, entry + 1, random.below(count + 1), random);
  c.moves.push_back(entry_mutators[change].name);
}

}  // namespace

void mutate(Case& c, std::uint64_t seed) {
  Random random(seed);
  const std::vector<double> before = c.values;
  const std::size_t moves_before = c.moves.size();
  constexpr int attempts = 16;
  for (int i = 0; i < attempts; ++i) {
    if (!c.query->lists.empty() && random.one_in(2)) change_entries(c, random);
    CaseBuilder builder(plan_of(c), c.scalar, random, c.values);
    apply(builder, choose(random, random.between(1, 3), mutators().size()), c.moves);
    if (c.moves.size() > moves_before && !c.query->broken(c.values)) return;
    c.values = before;
    c.moves.resize(moves_before);
  }
}

std::span<const MutatorName> mutator_names() {
  static const std::vector<MutatorName> names = [] {
    std::vector<MutatorName> all;
    for (const Mutator& m : mutators()) all.push_back({m.name, m.what, m.extreme});
    return all;
  }();
  return names;
}

namespace {

bool has_mutator(const Case& c, bool Mutator::*kind) {
  return std::ranges::any_of(
      mutators(), [&](const Mutator& m) { return m.*kind && std::ranges::find(c.moves, m.name) != c.moves.end(); });
}

}  // namespace

bool has_extreme_mutator(const Case& c) { return has_mutator(c, &Mutator::extreme); }
bool has_feature_mutator(const Case& c) { return has_mutator(c, &Mutator::of_features); }

std::string_view known_mutator(std::string_view name) {
  for (const Mutator& m : mutators()) {
    if (m.name == name) return m.name;
  }
  for (const MutatorName& m : entry_mutators) {
    if (m.name == name) return m.name;
  }
  return {};
}

}  // namespace nearmiss

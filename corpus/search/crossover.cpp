#include "corpus/search/crossover.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <mutex>
#include <numeric>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "corpus/generator/case_builder.hpp"
#include "corpus/search/float_order.hpp"
#include "corpus/storage/store.hpp"
#include "oracles/judge.hpp"

namespace nearmiss {

namespace {

constexpr int most_attempts = 16;

bool is_valid(const Case& c) {
  return std::all_of(c.values.begin(), c.values.end(), [](double x) { return std::isfinite(x); }) &&
         !c.query->broken(c.values);
}

/// Lets `change` alter the case until it is another valid case. Restores it if every attempt fails.
template <class Change>
bool attempt_change(Case& c, Change change) {
  const std::vector<double> before = c.values;
  for (int i = 0; i < most_attempts; ++i) {
    change();
    if (c.values != before && is_valid(c)) return true;
    c.values = before;
  }
  return false;
}

// Parts of a case.

enum class PartKind { number, vector, operand };

/// Consecutive inputs of a query.
struct Range {
  std::size_t begin, count;
};

/// The part of that kind that contains input `at`.
Range part_around(const Case& c, std::size_t at, PartKind kind) {
  if (kind == PartKind::number || c.role(at) == Role::count) return {at, 1};
  const Operand* const operand = c.operands().of_number(at);
  if (kind == PartKind::operand && operand != nullptr) return {operand->begin, operand->count};
  const InputMember& member = c.operands().member_of(at);
  return {member.begin, member.count};
}

bool has_count(std::span<const Field> fields, Range part) {
  return std::any_of(&fields[part.begin], &fields[part.begin] + part.count,
                     [](const Field& f) { return f.role == Role::count; });
}

bool have_same_roles(std::span<const Field> fields, Range a, std::span<const Field> others, Range b) {
  return a.count == b.count && std::equal(&fields[a.begin], &fields[a.begin] + a.count, &others[b.begin],
                                          [](const Field& f, const Field& g) { return f.role == g.role; });
}

/// Another part of the kind that has the same roles; the part itself if the one drawn has not.
Range draw_like(Random& random, const Case& c, Range part, PartKind kind) {
  const Range drawn = part_around(c, random.below(c.values.size()), kind);
  return have_same_roles(c.fields(), part, c.fields(), drawn) ? drawn : part;
}

bool can_vary(Role role) { return !is_discrete(role); }

/// Finds where the decision flips as one number of the case varies.
class FlipSearch {
 public:
  FlipSearch(Case& c, std::size_t number, bool decision)
      : case_(c), number_(number), from_(c.values[number]), decision_(decision) {}

  /// Sets the number to one of the two neighbours between which the decision flips, or to a number up to 3 ulps beyond.
  bool run(Random& random) {
    const auto other = bracket(random);
    const bool found = other && bisect(order(from_), order(*other));
    if (found) settle(random);
    if (!found) case_.values[number_] = from_;
    return found;
  }

 private:
  std::int64_t order(double x) const { return order_of(case_.scalar, x); }
  bool set(double x) {
    case_.values[number_] = x;
    return is_valid(case_);
  }
  bool set_order(std::int64_t n) { return set(of_order(case_.scalar, n)); }

  double largest_of_role() const {
    double most = 0;
    for (std::size_t i = 0; i < case_.values.size(); ++i) {
      if (case_.role(i) == case_.role(number_)) most = std::max(most, std::abs(case_.values[i]));
    }
    return most > 0 ? most : 1;
  }
  /// A number with the other decision.
  std::optional<double> bracket(Random& random) {
    constexpr int first = -10, last = 6, by = 2;
    const double scale = random.sign() * largest_of_role();
    for (int exponent = first; exponent <= last; exponent += by) {
      for (const double side : {1.0, -1.0}) {
        const double x = rounded_to(case_.scalar, from_ + side * std::ldexp(scale, exponent));
        if (set(x) && exact_decision(case_) != decision_) return x;
      }
    }
    return std::nullopt;
  }
  /// Brings `same_` and `other_` together: neighbours, of which only the first has the decision at the start.
  bool bisect(std::int64_t same, std::int64_t other) {
    while (std::max(same, other) - 1 != std::min(same, other)) {
      const std::int64_t middle = std::midpoint(same, other);
      if (!set_order(middle)) return false;
      (exact_decision(case_) == decision_ ? same : other) = middle;
    }
    same_ = same, other_ = other;
    return true;
  }
  void settle(Random& random) {
    const std::int64_t end = random.one_in(2) ? same_ : other_;
    const std::int64_t outward = end == same_ ? same_ - other_ : other_ - same_;
    if (!set_order(end + outward * random.between(0, 3))) set_order(end);
  }

  Case& case_;
  const std::size_t number_;
  const double from_;
  const bool decision_;
  std::int64_t same_ = 0, other_ = 0;
};

// Stored cases.

using NumbersByRole = std::map<Role, std::vector<double>>;

NumbersByRole numbers_of(const std::vector<StoredCase>& all) {
  NumbersByRole numbers;
  for (const StoredCase& stored : all) {
    const Case& c = stored.question;
    for (std::size_t i = 0; i < c.values.size(); ++i) numbers[c.role(i)].push_back(c.values[i]);
  }
  for (auto& [role, list] : numbers) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  return numbers;
}

/// The numbers of the query's stored cases, read once. The reference stays valid.
const NumbersByRole& stored_numbers(const Query& query) {
  static std::mutex mutex;
  static std::map<std::string, NumbersByRole, std::less<>> known;
  const std::lock_guard lock(mutex);
  const auto found = known.find(query.name);
  if (found != known.end()) return found->second;
  return known.emplace(query.name, numbers_of(stored_cases(query))).first->second;
}

}  // namespace

bool cross(Case& into, const Case& other, std::uint64_t seed) {
  if (into.query != other.query) return false;
  const std::span<const Field> fields = into.fields(), others = other.fields();
  Random random(seed);
  return attempt_change(into, [&] {
    const auto kind = PartKind(random.below(3));
    const Range to = part_around(into, random.below(fields.size()), kind);
    const Range from = random.one_in(4) ? draw_like(random, into, to, kind) : to;
    // Lists of different lengths have no place in common.
    if (from.begin + from.count > others.size() || has_count(fields, to)) return;
    if (!into.query->lists.empty() && !have_same_roles(fields, to, others, from)) return;
    for (std::size_t i = 0; i < to.count; ++i) {
      into.values[to.begin + i] = rounded_to(into.scalar, other.values[from.begin + i]);
    }
  });
}

bool snap_to_touching(Case& c, std::uint64_t seed) {
  if (!decides(c.query->kind)) return false;
  Random random(seed);
  std::vector<std::size_t> numbers;
  for (std::size_t i = 0; i < c.values.size(); ++i) {
    if (can_vary(c.role(i))) numbers.push_back(i);
  }
  const bool decision = exact_decision(c);
  constexpr int most_numbers = 4;
  for (int tried = 0; tried < most_numbers && !numbers.empty(); ++tried) {
    const auto drawn = numbers.begin() + std::ptrdiff_t(random.below(numbers.size()));
    if (FlipSearch(c, *drawn, decision).run(random)) return true;
    numbers.erase(drawn);
  }
  return false;
}

bool take_number_of_stored_case(Case& c, std::uint64_t seed) {
  const NumbersByRole& stored = stored_numbers(*c.query);
  if (stored.empty()) return false;
  Random random(seed);
  return attempt_change(c, [&] {
    const std::size_t i = random.below(c.values.size());
    if (c.role(i) == Role::count) return;
    const auto numbers = stored.find(c.role(i));
    if (numbers != stored.end()) c.values[i] = rounded_to(c.scalar, random.pick(numbers->second));
  });
}

}  // namespace nearmiss

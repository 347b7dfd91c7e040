#include "reports/advice/remedies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>

#include "oracles/judge.hpp"

namespace nearmiss {

namespace {

constexpr int sampled_cases = 100;  ///< of which a cell and a unit are chosen
constexpr int parts_of_step = 8;

double in_scalar_of(const Case& c, double x) { return c.scalar == Scalar::float32 ? double(float(x)) : x; }

/// The first number of each position.
std::vector<std::size_t> positions_of(const Query& query) {
  std::vector<std::size_t> all;
  for (const Operand& o : query.operands) all.insert(all.end(), o.positions.begin(), o.positions.end());
  return all;
}

/// The largest size of the case, or difference of a coordinate of two positions.
double reach_of_positions(const Case& c, const std::vector<std::size_t>& positions) {
  double reach = 0;
  for (const std::size_t a : positions) {
    for (const std::size_t b : positions) {
      for (std::size_t k = 0; k < 3; ++k) reach = std::max(reach, std::abs(c.values[a + k] - c.values[b + k]));
    }
  }
  for (std::size_t i = 0; i < c.values.size(); ++i) {
    if (c.role(i) == Role::size) reach = std::max(reach, std::abs(c.values[i]));
  }
  return reach;
}

std::vector<Case> sample_of(const TradeSource& source, const Query& query, std::uint64_t seed) {
  std::vector<Case> cases(sampled_cases);
  for (std::size_t i = 0; i < cases.size(); ++i) source.draw(cases[i], query, seed, i, {});
  return cases;
}

/// Moves the origin by -corner, and planes with it.
void move_origin(Case& c, const std::array<double, 3>& corner) {
  for (const Operand& o : c.operands()) {
    for (const std::size_t i : o.positions) {
      for (std::size_t k = 0; k < 3; ++k) c.values[i + k] = in_scalar_of(c, c.values[i + k] - corner[k]);
    }
    if (!o.offset) continue;
    double& offset = c.values[*o.offset];
    for (std::size_t k = 0; k < 3; ++k) offset += c.values[*o.direction + k] * corner[k];
    offset = in_scalar_of(c, offset);
  }
}

/// The source with each case changed. Where the changed case breaks a rule of the query, another one is drawn.
TradeSource changed_source(const TradeSource& source, std::function<void(Case&)> change) {
  constexpr std::uint64_t beyond_all_cases = std::uint64_t{1} << 40;
  constexpr std::uint64_t attempts = 100;
  TradeSource changed = source;
  changed.draw = [draw = source.draw, change = std::move(change)](Case& into, const Query& query, std::uint64_t seed,
                                                                  std::uint64_t index, Preconditions required) {
    for (std::uint64_t again = 0; again < attempts; ++again) {
      draw(into, query, seed, index + again * beyond_all_cases, required);
      Case other = into;
      change(other);
      if (query.broken(other.values)) continue;
      into = std::move(other);
      return;
    }
  };
  return changed;
}

std::optional<Remedy> re_centred(const TradeSource& source, const Query& query, std::uint64_t seed) {
  const std::vector<std::size_t> positions = positions_of(query);
  if (positions.empty()) return std::nullopt;
  double reach = 0, far = 0;
  for (const Case& c : sample_of(source, query, seed)) {
    reach = std::max(reach, reach_of_positions(c, positions));
    far = std::max(far, largest_length(c));
  }
  if (!(reach > 0)) return std::nullopt;
  const double cell = std::exp2(std::ceil(std::log2(reach)));
  if (far < 2 * cell) return std::nullopt;  // the origin is in the middle already
  const auto change = [first = positions.front(), cell](Case& c) {
    std::array<double, 3> corner{};
    for (std::size_t k = 0; k < 3; ++k) corner[k] = std::floor(c.values[first + k] / cell) * cell;
    move_origin(c, corner);
  };
  return Remedy{"re-centre the origin",
                fmt::format("keep positions relative to the corner of a cell of {:g} {}", cell, source.tolerance.unit),
                changed_source(source, change)};
}

std::optional<Remedy> split_step(const TradeSource& source, const Query& query, double step) {
  const Operand& mover = query.operands[0];
  if (!mover.velocity) return std::nullopt;
  const double part = step / parts_of_step;
  const Layout::Part* time = query.layout.at(Role::time);
  const InputMember* limit = query.operands.at(Role::time);
  const auto change = [time, limit, part, place = mover.positions[0], velocity = *mover.velocity](Case& c) {
    const Truth truth = truth_of(c);
    double contact = 0;
    if (truth.yes && !truth.alternatives.empty() && time != nullptr)
      contact = truth.alternatives.front().values[time->begin].low;
    const double begin = std::clamp(std::floor(contact / part), 0.0, double(parts_of_step - 1)) * part;
    for (std::size_t k = 0; k < 3; ++k) {
      double& x = c.values[place + k];
      x = in_scalar_of(c, x + begin * c.values[velocity + k]);
    }
    if (limit != nullptr) c.values[limit->begin] = in_scalar_of(c, part);
  };
  return Remedy{"split the step", fmt::format("make {} steps of {:g} s of each step", parts_of_step, part),
                changed_source(source, change)};
}

/// The unit in which `length` is nearest to 1, apart from the scene's own.
const scenes::Unit& unit_for(double length_in_metres, const std::string& own) {
  const scenes::Unit* best = nullptr;
  const auto far_from_one = [&](const scenes::Unit& u) { return std::abs(std::log(length_in_metres / u.metres)); };
  for (const scenes::Unit& u : scenes::known_units()) {
    if (u.name != own && (best == nullptr || far_from_one(u) < far_from_one(*best))) best = &u;
  }
  return *best;
}

double metres_of(const std::string& unit) {
  for (const scenes::Unit& u : scenes::known_units()) {
    if (u.name == unit) return u.metres;
  }
  return 1;
}

std::optional<Remedy> in_another_unit(const TradeSource& source, const Query& query, std::uint64_t seed) {
  std::vector<double> lengths;
  for (const Case& c : sample_of(source, query, seed)) lengths.push_back(largest_length(c));
  const auto middle = lengths.begin() + std::ptrdiff_t(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  if (!(*middle > 0)) return std::nullopt;
  const double metres = metres_of(source.tolerance.unit);
  const scenes::Unit& unit = unit_for(*middle * metres, source.tolerance.unit);
  const double factor = metres / unit.metres;
  const auto change = [factor](Case& c) {
    for (std::size_t i = 0; i < c.values.size(); ++i) {
      const Role role = c.role(i);
      if (role == Role::position || role == Role::velocity || role == Role::size || role == Role::offset)
        c.values[i] = in_scalar_of(c, c.values[i] * factor);
    }
  };
  Remedy r{"another unit", fmt::format("compute in {}", unit.name), changed_source(source, change)};
  r.source.tolerance.unit = std::string(unit.name);
  r.source.tolerance.error *= factor;
  r.source.tolerance.missed_depth *= factor;
  return r;
}

}  // namespace

std::vector<Remedy> remedies_for(const TradeSource& source, const Query& query, std::uint64_t seed) {
  std::vector<Remedy> all;
  if (auto r = re_centred(source, query, seed)) all.push_back(std::move(*r));
  if (auto r = split_step(source, query, source.step)) all.push_back(std::move(*r));
  if (auto r = in_another_unit(source, query, seed)) all.push_back(std::move(*r));
  return all;
}

}  // namespace nearmiss

#include "properties/derivation.hpp"

#include <cmath>

namespace nearmiss::derived {

namespace {

mp_bitcnt_t bits_now = usual_bits;
/// The precision of numbers that are created without one.
const bool default_is_set = (mpf_set_default_prec(usual_bits), true);

}  // namespace

mp_bitcnt_t bits() { return bits_now; }
void set_bits(mp_bitcnt_t n) {
  bits_now = n;
  mpf_set_default_prec(n);
}

bool is_zero(const R& x) {
  long exponent = 0;
  mpf_get_d_2exp(&exponent, x.get_mpf_t());
  return sgn(x) == 0 || exponent < -long(bits()) * 5 / 8;
}
double rounded(const R& x) { return is_zero(x) ? 0 : x.get_d(); }
double rounded(const Q& x) { return x.get_d(); }

V Choice::direction() const {
  V v{1, 0, 0};
  if (!is_free()) return v;
  do {
    for (Q& x : v) x = below(4) == 0 ? Q(below(3) - 1) : Q(below((1 << 21) + 1) - (1 << 20), 1 << 20);
  } while (square_of(v) == 0);
  return v;
}

V Choice::between(const std::vector<V>& points) const {
  V p = points.front();
  for (std::size_t i = 1; i < points.size(); ++i) p = add(p, sub(points[i], p), share());
  return p;
}

std::optional<V> Choice::in_cone(const std::vector<V>& along, const std::vector<V>& against) const {
  if (!is_free()) return std::nullopt;
  std::vector<V> beside;  // orthogonal to each other
  const auto across = [&](V x) {
    for (const V& b : beside) x = add(x, b, -dot(x, b) / square_of(b));
    return x;
  };
  const auto leave_out = [&](const V& x) {
    if (const V rest = across(x); square_of(rest) != 0) beside.push_back(rest);
  };
  for (const V& a : along) leave_out(a);
  const std::size_t held = beside.size();
  constexpr int tries = 24;
  for (int i = 0; i < tries; ++i) {
    beside.resize(held);
    if (!against.empty() && below(3) == 0) leave_out(among(against));
    const V m = across(direction());
    if (square_of(m) == 0) continue;
    for (const V& candidate : {m, scaled(m, -1)}) {
      if (std::all_of(against.begin(), against.end(), [&](const V& b) { return dot(candidate, b) <= 0; }))
        return candidate;
    }
  }
  return std::nullopt;
}

VR RefBox::world(const VR& local) const {
  VR x;
  for (int k = 0; k < 3; ++k)
    x[k] = real(axes[0][k]) * local[0] + real(axes[1][k]) * local[1] + real(axes[2][k]) * local[2];
  return x;
}

Derivation derivation_of(const Query& query) {
  for (const auto table : {of_shapes(), of_boxes(), of_grid(), of_moving_points(), of_moving_spheres()}) {
    for (const Derived& d : table) {
      if (query.name == d.query) return d.derivation;
    }
  }
  return nullptr;
}
std::vector<NamedQuery> derived_queries() {
  std::vector<NamedQuery> all = every_query();
  std::erase_if(all, [](const NamedQuery& q) { return derivation_of(*q.query) == nullptr; });
  return all;
}

Case lattice_case(const Query& query, Scalar scalar, int range, std::mt19937_64& random) {
  const auto below = [&](int n) { return int(random() % std::uint64_t(n)); };
  Case c{&query, scalar, {}, "lattice", 0, 0, {}};
  do {
    c.values.clear();
    const bool aligned = below(2) == 0;
    for (const Field& f : query.inputs) {
      int x = below(2 * range + 1) - range;
      if (f.role == Role::size) x = below(3);
      if (f.role == Role::flag) x = below(2);
      if (f.role == Role::index) x = below(16) - 1;  // drawn again if the query has fewer
      if (f.role == Role::rotation && aligned) x = f.name.ends_with("w") ? 1 : 0;
      c.values.push_back(x);
    }
  } while (query.broken(c.values));
  return c;
}

}  // namespace nearmiss::derived

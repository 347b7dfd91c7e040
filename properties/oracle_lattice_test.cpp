/// The oracle against slow, obvious derivations on small integer lattices, where touches, ties and
/// degenerate shapes are common. The derivations share no code with the oracle: rationals of gmpxx,
/// pieces of the motion instead of regions, roots in 512 bits.
#include "properties/lattice.hpp"

#include <cstdlib>
#include <random>
#include <set>
#include <string_view>

namespace nearmiss::lattice {
namespace {

/// Time of impact, piece by piece between the crossings of the face planes.
Reference reference_moving_sphere_box(Reader r) {
  const V p = r.vector();
  const Q radius = r.number();
  const V v = r.vector();
  const RefBox box(r);
  const V s = box.local(sub(p, box.center)), w = box.local(v);
  Q outside = -radius * radius, slope = 0;
  bool strictly_inside = true;
  for (int i = 0; i < 3; ++i) {
    const Q e = excess(s[i], box.half[i]);
    outside += e * e;
    slope += e * w[i];
    strictly_inside = strictly_inside && abs(s[i]) < box.half[i];
  }
  if (outside < 0) return yes(0.0);
  if (outside == 0 && radius > 0) return slope <= 0 ? yes(0.0) : no();
  if (outside == 0) {
    if (strictly_inside) return no();
    for (int i = 0; i < 3; ++i) {
      if (s[i] == box.half[i] && w[i] <= 0) return yes(0.0);
      if (s[i] == -box.half[i] && w[i] >= 0) return yes(0.0);
    }
    return no();
  }
  std::vector<Q> crossings{0};
  for (int i = 0; i < 3; ++i) {
    if (w[i] == 0) continue;
    for (const int side : {-1, 1}) {
      if (const Q t = (side * box.half[i] - s[i]) / w[i]; t > 0) crossings.push_back(t);
    }
  }
  std::sort(crossings.begin(), crossings.end());
  for (std::size_t k = 0; k < crossings.size(); ++k) {
    const bool last = k + 1 == crossings.size();
    const Q from = crossings[k], middle = last ? Q(from + 1) : Q((from + crossings[k + 1]) / 2);
    Q a = 0, b = 0, c = -radius * radius;
    for (int i = 0; i < 3; ++i) {
      const Q x = s[i] + w[i] * middle;
      if (abs(x) <= box.half[i]) continue;
      const Q e = x > 0 ? Q(s[i] - box.half[i]) : Q(s[i] + box.half[i]);
      a += w[i] * w[i], b += w[i] * e, c += e * e;
    }
    if (a == 0) {
      if (c <= 0) return yes(from.get_d());
      continue;
    }
    const Q d = b * b - a * c;
    if (d < 0) continue;
    // Is the root within [from, to]? (-b - a t)^2 against d, on the falling branch.
    const auto root_beyond = [&](const Q& t) { const Q x = -b - a * t; return x >= 0 ? cmp(Q(x * x), d) : -1; };
    if (root_beyond(from) >= 0 && (last || root_beyond(crossings[k + 1]) <= 0)) return yes(root_of(a, b, d));
  }
  return no();
}

Reference reference_moving_point_sphere(Reader r) {
  const V p = r.vector(), v = r.vector(), center = r.vector();
  const Q radius = r.number();
  const bool solid = r.number() != 0;
  const V m = sub(p, center);
  const Q a = dot(v, v), b = dot(m, v), c = dot(m, m) - radius * radius, d = b * b - a * c;
  if (c <= 0 && solid) return yes(0.0);
  if (a == 0) return no();
  if (c <= 0) return yes(root_of(a, b, d, +1));
  if (b >= 0 || d < 0) return no();
  return yes(root_of(a, b, d));
}

/// The hit point against the planes through the edges.
Reference reference_moving_point_triangle(Reader r) {
  const V p = r.vector(), v = r.vector();
  const std::array<V, 3> corner{r.vector(), r.vector(), r.vector()};
  const V n = cross(sub(corner[1], corner[0]), sub(corner[2], corner[0]));
  const Q toward = dot(n, v), height = dot(n, sub(p, corner[0]));
  if (toward >= 0 || height < 0) return no();
  const Q t = height / -toward;
  const V x{p[0] + v[0] * t, p[1] + v[1] * t, p[2] + v[2] * t};
  for (int i = 0; i < 3; ++i) {
    if (dot(n, cross(sub(corner[(i + 1) % 3], corner[i]), sub(x, corner[i]))) < 0) return no();
  }
  return yes(t.get_d());
}

/// Depth, negative when apart.
Reference reference_sphere_box_penetration(Reader r) {
  const V p = r.vector();
  const Q radius = r.number();
  const RefBox box(r);
  const V s = box.local(sub(p, box.center));
  Q distance2 = 0, inside = box.half[0] - abs(s[0]);
  for (int i = 0; i < 3; ++i) {
    const Q e = excess(s[i], box.half[i]);
    distance2 += e * e;
    inside = std::min(inside, Q(box.half[i] - abs(s[i])));
  }
  if (distance2 == 0) return yes(Q(radius + inside).get_d());
  return {radius * radius >= distance2, {mpf_class(mpf_class(radius, 512) - sqrt(mpf_class(distance2, 512))).get_d()}};
}

/// The foot of the perpendicular, or the nearer end; ends compared by their distances.
Reference reference_closest_point_segment(Reader r) {
  const V a = r.vector(), b = r.vector(), p = r.vector();
  const V d = sub(b, a);
  const Q length2 = dot(d, d);
  const auto distance2 = [&](const V& x) { return dot(sub(x, p), sub(x, p)); };
  V best = distance2(a) <= distance2(b) ? a : b;
  if (length2 != 0) {
    const Q t = dot(sub(p, a), d) / length2;
    const V foot{a[0] + d[0] * t, a[1] + d[1] * t, a[2] + d[2] * t};
    if (t > 0 && t < 1 && distance2(foot) < distance2(best)) best = foot;
  }
  return yes(best[0].get_d(), best[1].get_d(), best[2].get_d());
}

/// Points with half-space n . x <= d kept; a polygon may be a segment or a point.
std::vector<V> clipped(const std::vector<V>& polygon, const V& n, const Q& d) {
  std::vector<V> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const V &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const Q ha = dot(n, a) - d, hb = dot(n, b) - d;
    if (ha <= 0) kept.push_back(a);
    if ((ha < 0 && hb > 0) || (ha > 0 && hb < 0)) {
      const Q t = ha / (ha - hb);
      kept.push_back({a[0] + (b[0] - a[0]) * t, a[1] + (b[1] - a[1]) * t, a[2] + (b[2] - a[2]) * t});
    }
  }
  return kept;
}

V corner_of(const RefBox& b, int sx, int sy, int sz) {
  V x = b.center;
  const Q s[3] = {b.half[0] * sx, b.half[1] * sy, b.half[2] * sz};
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) x[k] += b.axes[i][k] * s[i];
  }
  return x;
}

/// Boxes meet where a face of the first, clipped to the second, leaves something, or where the second
/// lies within the first.
Reference reference_box_box_overlap(Reader r) {
  const RefBox a(r), b(r);
  for (int axis = 0; axis < 3; ++axis) {
    for (const int side : {-1, 1}) {
      std::vector<V> face;
      for (const auto& [u, v] : {std::pair{-1, -1}, {-1, 1}, {1, 1}, {1, -1}}) {
        int s[3];
        s[axis] = side, s[(axis + 1) % 3] = u, s[(axis + 2) % 3] = v;
        face.push_back(corner_of(a, s[0], s[1], s[2]));
      }
      for (int i = 0; i < 3; ++i) {
        const V back{-b.axes[i][0], -b.axes[i][1], -b.axes[i][2]};
        const Q at = dot(b.axes[i], b.center);
        face = clipped(clipped(face, b.axes[i], at + b.half[i]), back, b.half[i] - at);
      }
      if (!face.empty()) return yes();
    }
  }
  const V c = a.local(sub(b.center, a.center));
  return {abs(c[0]) <= a.half[0] && abs(c[1]) <= a.half[1] && abs(c[2]) <= a.half[2], {}};
}

/// The velocity's part along u turned round: v - 2 (v . u) u / |u|^2, over |v|.
Reference reference_bounce_direction(Reader r) {
  const V center = r.vector();
  r.number();  // the radius plays no part
  const V v = r.vector();
  const Q time = r.number();
  const V location = r.vector(), normal = r.vector();
  V u;
  for (int i = 0; i < 3; ++i) u[i] = center[i] + v[i] * time - location[i];
  if (u == V{0, 0, 0}) u = normal;
  const Q speed2 = dot(v, v);
  if (speed2 == 0) return yes(0.0, 0.0, 0.0);
  const Q along = 2 * dot(v, u) / dot(u, u);
  const mpf_class speed = sqrt(mpf_class(speed2, 512));
  Reference reference{true, {}};
  for (int i = 0; i < 3; ++i) reference.values.push_back(mpf_class(mpf_class(Q(v[i] - along * u[i]), 512) / speed).get_d());
  return reference;
}

/// A lattice case: small integers, half of the quaternions axis-aligned.
Case lattice_case(const Query& query, int range, std::mt19937_64& random) {
  const auto below = [&](int n) { return int(random() % std::uint64_t(n)); };
  Case c{&query, Scalar::float64, {}, "lattice", 0, 0, {}};
  do {
    c.values.clear();
    const bool aligned = below(2) == 0;
    for (const Field& f : query.inputs) {
      int x = below(2 * range + 1) - range;
      if (f.role == Role::size) x = below(3);
      if (f.role == Role::flag) x = below(2);
      if (f.role == Role::index) x = below(16) - 1;  // asked again where the query has fewer
      if (f.role == Role::rotation && aligned) x = f.name.ends_with("w") ? 1 : 0;
      c.values.push_back(x);
    }
  } while (query.broken(c.values));
  return c;
}

/// Different cases of each query. CI asks about fewer; the nightly job about NEARMISS_LATTICE_CASES.
int cases_per_query() {
  const char* told = std::getenv("NEARMISS_LATTICE_CASES");
  return told != nullptr ? std::stoi(told) : 45000;
}

struct Compared {
  int cases = 0, hits = 0;
  std::string difference;  ///< the first; empty where there is none
};

/// Compares decisions, and the reference's numbers to one unit in the last place, of so many different cases; of fewer
/// where the lattice has hardly more.
Compared compare(const char* name, Derivation derivation, int range, int cases) {
  const Query& query = *find_query(name);
  std::mt19937_64 random(20240601 + unsigned(range));
  const std::vector<double> still(query.inputs.size(), 0.0);
  std::set<std::vector<double>> asked;
  Compared all;
  for (int draw = 0; draw < 4 * cases && all.cases < cases; ++draw) {
    const Case c = lattice_case(query, range, random);
    if (!asked.insert(c.values).second) continue;
    const Reference reference = derivation(Reader(c.values));
    Answer about;
    about.yes = reference.yes;
    about.given = (std::uint64_t{1} << reference.values.size()) - 1;
    std::copy(reference.values.begin(), reference.values.end(), about.values.begin());
    ++all.cases;
    all.hits += about.yes;
    const Enclosure exact = query.oracle.exact(c.values, about, c.scalar, nullptr);
    const Enclosure interval = query.oracle.interval(c.values, still, about, c.scalar);
    const bool same = exact.may_be_yes == about.yes && exact.may_be_no != about.yes && exact.may_match;
    const bool enclosed = (about.yes ? interval.may_be_yes : interval.may_be_no) && interval.may_match;
    if (same && enclosed) continue;
    all.difference = same ? "the interval stage excludes the truth: " : "the exact stage differs: ";
    for (const double x : c.values) all.difference += std::to_string(int(x)) + " ";
    all.difference += "reference " + testing::PrintToString(reference.values) + " " + std::to_string(reference.yes);
    return all;
  }
  return all;
}

}  // namespace

TEST_P(OracleOnLattice, AgreesWithAnIndependentDerivation) {
  const auto [name, derivation] = GetParam();
  const int wanted = cases_per_query();
  int asked = 0;
  for (const int range : {1, 2, 3}) {
    const Compared compared = compare(name, derivation, range, (wanted - asked) / (4 - range));
    ASSERT_EQ(compared.difference, "") << name << ", range " << range;
    asked += compared.cases;
    if (!decides(find_query(name)->kind)) continue;
    const double share = double(compared.hits) / compared.cases;
    EXPECT_GT(share, 0.01) << "the lattice has hardly any contacts at range " << range;
    EXPECT_LT(share, 0.99) << "the lattice has hardly any misses at range " << range;
  }
  EXPECT_GE(asked, wanted);
}

/// Every query has a derivation: each of the files that instantiate this suite has some of them.
TEST(Lattice, HasADerivationForEveryQuery) {
  const testing::UnitTest& all = *testing::UnitTest::GetInstance();
  std::set<std::string> derived;
  for (int i = 0; i < all.total_test_suite_count(); ++i) {
    const testing::TestSuite& suite = *all.GetTestSuite(i);
    if (!std::string_view(suite.name()).ends_with("/OracleOnLattice")) continue;
    for (int k = 0; k < suite.total_test_count(); ++k) {
      const std::string test = suite.GetTestInfo(k)->name();
      derived.insert(test.substr(test.find('/') + 1));
    }
  }
  for (const Query& query : catalogue()) EXPECT_TRUE(derived.contains(std::string(query.name))) << query.name;
}

INSTANTIATE_TEST_SUITE_P(
    Queries, OracleOnLattice,
    testing::Values(std::tuple{"closest_point_segment", &reference_closest_point_segment},
                    std::tuple{"box_box_overlap", &reference_box_box_overlap},
                    std::tuple{"bounce_direction", &reference_bounce_direction},
                    std::tuple{"moving_sphere_box", &reference_moving_sphere_box},
                    std::tuple{"moving_point_sphere", &reference_moving_point_sphere},
                    std::tuple{"moving_point_triangle", &reference_moving_point_triangle},
                    std::tuple{"sphere_box_penetration", &reference_sphere_box_penetration}),
    [](const auto& test) { return std::string(std::get<0>(test.param)); });

}  // namespace nearmiss::lattice

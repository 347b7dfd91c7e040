/// A batch has the bits of the single queries in the tier `Fast`: whatever its instructions, size and place in memory,
/// and whatever the arguments.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include "corpus/generator/generator.hpp"
#include "corpus/storage/store.hpp"
#include "impl/adapters/collide_batch.hpp"
#include "nearmiss/collide_functions.hpp"
#include "properties/support.hpp"
#if !defined(__clang_analyzer__)  // which does not end within five minutes
namespace nearmiss {
namespace {

constexpr collide::Simd every_simd[] = {collide::Simd::none, collide::Simd::sse2, collide::Simd::avx2};

/// The bits of each number of an answer; one pattern for all NaN.
template <class A>
std::vector<std::uint64_t> bits_of_answer(const A& answer) {
  std::vector<std::uint64_t> bits;
  collide::for_each_leaf(answer, [&](const auto& leaf, collide::Role) {
    const double number = double(leaf);
    bits.push_back(std::isnan(number) ? ~std::uint64_t{0} : std::bit_cast<std::uint64_t>(number));
  });
  bits.push_back(answer.yes());
  return bits;
}

template <class T>
T special_number(std::mt19937_64& random) {
  using limits = std::numeric_limits<T>;
  constexpr T most = limits::max(), least = limits::min(), tiny = limits::denorm_min(), eps = limits::epsilon();
  constexpr T infinity = limits::infinity();
  const T numbers[] = {T(0),
                       T(-0.0),
                       T(1),
                       T(-1),
                       tiny,
                       -tiny,
                       least,
                       -least,
                       most,
                       most / 2,
                       -most / 4,
                       infinity,
                       -infinity,
                       eps,
                       1 + eps,
                       1 - eps,
                       T(2),
                       T(-2),
                       std::sqrt(least),
                       std::sqrt(most),
                       -std::sqrt(most),
                       limits::quiet_NaN()};
  return numbers[random() % std::size(numbers)];
}
template <class T>
T number_of_any_magnitude(std::mt19937_64& random) {
  using Bits = std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>;
  return std::bit_cast<T>(Bits(random()));
}
/// A number of few bits, for touches and ties.
template <class T>
T lattice_number(std::mt19937_64& random) {
  return T(int(random() % 9) - 4) / 2;
}

/// Replaces some numbers of the inputs. What replaces them depends on the index, so that blocks mix usual and other
/// lanes.
template <class Q>
void make_unusual(Q& q, std::uint64_t index, std::mt19937_64& random) {
  collide::for_each_leaf(q, [&](auto& leaf, collide::Role) {
    using Leaf = std::remove_reference_t<decltype(leaf)>;
    if constexpr (collide::MachineNumber<Leaf>) {
      switch (index % 6) {
        case 1: leaf = random() % 8 == 0 ? special_number<Leaf>(random) : leaf; break;
        case 2: leaf = special_number<Leaf>(random); break;
        case 3: leaf = number_of_any_magnitude<Leaf>(random); break;
        case 4: leaf = lattice_number<Leaf>(random); break;
        default: break;
      }
    } else {
      if (index % 6 == 4) leaf = random() % 2 == 0;
    }
  });
}

/// Generated, stored and unusual inputs of a query.
template <class Q>
std::vector<Q> inputs_of_batch(const Query& query, Scalar scalar, std::size_t generated) {
  std::vector<Q> all;
  for (const StoredCase& s : stored_cases(query)) {
    if (s.question.scalar == scalar) all.push_back(inputs_from<Q>(s.question.values.data()));
  }
  std::mt19937_64 random(stream(31));
  for (std::uint64_t i = 0; i < generated; ++i) {
    all.push_back(inputs_from<Q>(generate(query, scalar, stream(30), i).values.data()));
    make_unusual(all.back(), i, random);
  }
  return all;
}

template <class Q>
struct BatchAndSingles {
  adapters::CollideBatch<Q> batch;
  std::vector<std::vector<std::uint64_t>> expected;

  BatchAndSingles(const Query& query, Scalar scalar, std::size_t generated) {
    for (const Q& q : inputs_of_batch<Q>(query, scalar, generated)) {
      batch.push_back(q);
      expected.push_back(bits_of_answer(adapters::ask_collide<collide::Fast>(q)));
    }
  }
  /// The index of the first wrong answer from `first`; `last` if there is none.
  std::size_t first_wrong(std::size_t first, std::size_t last) const {
    while (first < last && bits_of_answer(batch[first]) == expected[first]) ++first;
    return first;
  }
};

template <template <class> class Inputs, class T>
void expect_bits_of_singles(const Query& query, Scalar scalar) {
  BatchAndSingles<Inputs<T>> all(query, scalar, 20000);
  for (const collide::Simd simd : every_simd) {
    for (std::size_t i = 0; i < all.batch.size(); ++i) all.batch.put(i, {});
    all.batch.answer(simd);
    const std::size_t wrong = all.first_wrong(0, all.batch.size());
    ASSERT_EQ(wrong, all.batch.size()) << query.name << ' ' << name_of(scalar) << " simd " << int(simd);
  }
}

/// Every size up to twice a block and one more, from every place in a block; the answers beside the batch stay.
template <template <class> class Inputs, class T>
void expect_bits_of_singles_in_any_part(const Query& query, Scalar scalar) {
  constexpr std::size_t block = 32 / sizeof(T), most = 2 * block + 1;
  BatchAndSingles<Inputs<T>> all(query, scalar, 4 * most);
  const auto nothing = bits_of_answer(typename Inputs<T>::Answer{});
  for (const collide::Simd simd : every_simd) {
    for (std::size_t first = 0; first <= block; ++first) {
      for (std::size_t count = 0; count <= most; ++count) {
        for (std::size_t i = 0; i < all.batch.size(); ++i) all.batch.put(i, {});
        all.batch.answer(first, count, simd);
        ASSERT_EQ(all.first_wrong(first, first + count), first + count) << query.name << " size " << count;
        for (std::size_t i = 0; i < all.batch.size(); ++i) {
          if (i >= first && i < first + count) continue;
          ASSERT_EQ(bits_of_answer(all.batch[i]), nothing) << query.name << " size " << count << " writes beside it";
        }
      }
    }
  }
}

struct BatchedQuery {
  const char* query;
  void (*in_float)(const Query&, Scalar);
  void (*in_double)(const Query&, Scalar);
  void (*parts_in_float)(const Query&, Scalar);
  void (*parts_in_double)(const Query&, Scalar);
};
std::ostream& operator<<(std::ostream& out, const BatchedQuery& a) { return out << a.query; }

class Batch : public testing::TestWithParam<BatchedQuery> {};

TEST_P(Batch, HasTheBitsOfSingleQueries) {
  const Query& query = *find_query(GetParam().query);
  GetParam().in_float(query, Scalar::float32);
  GetParam().in_double(query, Scalar::float64);
}

TEST_P(Batch, HasTheBitsOfSingleQueriesInAnyPart) {
  const Query& query = *find_query(GetParam().query);
  GetParam().parts_in_float(query, Scalar::float32);
  GetParam().parts_in_double(query, Scalar::float64);
}

#define NEARMISS_BATCHED_QUERY(name)                                                                             \
  BatchedQuery{#name, expect_bits_of_singles<inputs::name, float>, expect_bits_of_singles<inputs::name, double>, \
               expect_bits_of_singles_in_any_part<inputs::name, float>,                                          \
               expect_bits_of_singles_in_any_part<inputs::name, double>},
constexpr BatchedQuery batched_queries[] = {NEARMISS_BATCH_QUERIES(NEARMISS_BATCHED_QUERY)};
#undef NEARMISS_BATCHED_QUERY

INSTANTIATE_TEST_SUITE_P(Batches, Batch, testing::ValuesIn(batched_queries), testing::PrintToStringParamName());

TEST(BatchArguments, OfDifferentSizesAreRefused) {
  const collide::Soa<collide::Sphere<float>> two(2), three(3);
  collide::Soa<collide::Decision<float>> answers(3);
  EXPECT_THROW(collide::batch::sphere_sphere_overlap(two.view(), three.view(), answers.span()), std::invalid_argument);
  EXPECT_THROW(collide::batch::sphere_sphere_overlap(three.view(), two.view(), answers.span()), std::invalid_argument);
  EXPECT_NO_THROW(collide::batch::sphere_sphere_overlap(three.view(), three.view(), answers.span()));
}

TEST(BatchArguments, OfSizeZeroAreAnswered) {
  const collide::SoaView<collide::Sphere<double>> none;
  EXPECT_NO_THROW(collide::batch::sphere_sphere_overlap(none, none, collide::SoaSpan<collide::Decision<double>>()));
}

TEST(StructureOfArrays, KeepsEveryLeaf) {
  using Contacts = collide::CornerContacts<float>;  // flags, numbers and an array of structs
  static_assert(collide::leaf_count<Contacts> == 4 + 8 * 4);
  static_assert(collide::leaf_count<collide::RayHit<double>> == 5 && collide::leaf_count<double> == 1);
  collide::Soa<Contacts> soa;
  for (int i = 0; i < 100; ++i) {
    Contacts contacts;
    contacts.depth = float(i), contacts.corners[7] = {true, {1, 2, float(-i)}};
    soa.push_back(contacts);
  }
  ASSERT_EQ(soa.size(), 100u);
  EXPECT_EQ(soa[99].corners[7].point.z, -99.F);
  EXPECT_EQ(soa.array<0>()[40], 40.F);
  EXPECT_TRUE(soa[3].corners[7].behind && !soa[3].corners[6].behind);
  soa.resize(200);
  EXPECT_EQ(soa[40].depth, 40.F);
  EXPECT_EQ(soa[199].depth, 0.F);
}

}  // namespace
}  // namespace nearmiss
#endif

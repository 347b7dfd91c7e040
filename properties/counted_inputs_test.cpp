/// Lists of counted members: which numbers a case has, and that no other number exists anywhere: in the fields, the
/// bytes, a file, the memory that a host reads, and the simplest case.
#include <gtest/gtest.h>

#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "corpus/files/errors.hpp"
#include "corpus/search/shrink.hpp"
#include "corpus/storage/codec.hpp"
#include "impl/catalogue/inputs.hpp"
#include "impl/catalogue/make_query.hpp"
#include "impl/host/replies.hpp"
#include "impl/host/worker.hpp"

namespace nearmiss {
namespace {

/// Two lists with numbers before, between and behind them.
template <class T>
struct TwoLists {
  using Answer = collide::Decision<T>;

  struct Cloud {
    collide::Counted<collide::Vec3<T>, 12> vertices{};
    T radius{};
    static constexpr auto members() {
      return std::tuple(collide::member("vertices", &Cloud::vertices, Role::position),
                        collide::member("radius", &Cloud::radius, Role::size));
    }
  };

  T limit{};
  Cloud one{}, two{};
  bool solid{};

  static constexpr auto members() {
    return std::tuple(collide::member("limit", &TwoLists::limit, Role::time), collide::member("one", &TwoLists::one),
                      collide::member("two", &TwoLists::two), collide::member("solid", &TwoLists::solid, Role::flag));
  }
  static constexpr Traits traits{};
};

const Query& two_lists() {
  static const Query query = make_query<TwoLists<double>>(query_id("two_lists"), "two_lists");
  return query;
}

/// Of two and of three vertices.
Case small_case() {
  return {&two_lists(),
          Scalar::float64,
          {9, 2, 1, 2, 3, 4, 5, 6, 0.5, 3, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0.25, 1},
          "",
          0,
          0,
          {}};
}

std::vector<std::string> names_of(const Case& c) {
  std::vector<std::string> names;
  for (const Field& f : c.fields()) names.push_back(f.name);
  return names;
}

TEST(CountedInputs, ACaseOwnsItsFields) {
  const Query& q = two_lists();
  ASSERT_EQ(q.lists.size(), 2u);
  EXPECT_EQ(q.lists[0], (CountedInput{"one.vertices", 1, 3, 1, 12}));
  EXPECT_EQ(q.lists[1], (CountedInput{"two.vertices", 6, 3, 1, 12}));
  EXPECT_EQ(q.inputs.size(), 12u) << "the fewest entries";
  EXPECT_EQ(q.most_numbers(), 12u + 2 * 11 * 3);
  const Case c = small_case();
  EXPECT_EQ(q.broken(c.values), std::nullopt);
  ASSERT_EQ(c.fields().size(), c.values.size());
  EXPECT_EQ(c.name(1), "one.vertices.count");
  EXPECT_EQ(c.role(1), Role::count);
  EXPECT_EQ(c.name(7), "one.vertices.1.z");
  EXPECT_EQ(c.role(7), Role::position);
  EXPECT_EQ(c.name(8), "one.radius");
  EXPECT_EQ(c.name(9), "two.vertices.count");
  EXPECT_EQ(c.name(18), "two.vertices.2.z");
  EXPECT_EQ(c.name(20), "solid");
  EXPECT_EQ(c.fields().data(), Case(c).fields().data()) << "described once";
}

TEST(CountedInputs, CountsThatDoNotFitAreBroken) {
  const auto broken = [](std::size_t number, double count) {
    Case c = small_case();
    c.values[number] = count;
    const auto invalid = two_lists().broken(c.values);
    return invalid ? invalid->text() : "";
  };
  EXPECT_EQ(broken(1, 0), "one.vertices.count is 0: it must be a whole number from 1 to 12");
  EXPECT_EQ(broken(1, 13), "one.vertices.count is 13: it must be a whole number from 1 to 12");
  EXPECT_EQ(broken(9, 2.5), "two.vertices.count is 2.5: it must be a whole number from 1 to 12");
  EXPECT_EQ(broken(9, NAN), "two.vertices.count is nan: it must be a whole number from 1 to 12");
  EXPECT_NE(broken(9, 2), "") << "more numbers than are counted";
  EXPECT_NE(broken(9, 4), "") << "fewer";
  EXPECT_NE(two_lists().broken({}), std::nullopt);
}

TEST(CountedInputs, EntriesAreLeftOutAndRepeated) {
  Case c = small_case();
  ASSERT_TRUE(erase_entry(c, 0, 0));
  EXPECT_EQ(c.values, (std::vector<double>{9, 1, 4, 5, 6, 0.5, 3, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0.25, 1}));
  EXPECT_FALSE(erase_entry(c, 0, 0)) << "its last one";
  ASSERT_TRUE(repeat_entry(c, 1, 1));
  EXPECT_EQ(c.values, (std::vector<double>{9, 1, 4, 5, 6, 0.5, 4, 1, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 1, 0.25, 1}));
  EXPECT_EQ(two_lists().broken(c.values), std::nullopt);
  while (repeat_entry(c, 1, 0)) EXPECT_EQ(two_lists().broken(c.values), std::nullopt);
  EXPECT_EQ(c.values[6], 12);
  EXPECT_EQ(names_of(c).back(), "solid");
}

TEST(CountedInputs, BytesHaveTheirNumbersAndNoOthers) {
  for (const Scalar scalar : {Scalar::float32, Scalar::float64}) {
    Case c = small_case();
    c.scalar = scalar;
    const std::vector<std::uint8_t> bytes = case_to_bytes(c);
    EXPECT_EQ(bytes.size(), 1 + 3 + 18 * (scalar == Scalar::float32 ? 4u : 8u));
    const auto back = case_from_bytes(two_lists(), bytes);
    ASSERT_TRUE(back);
    EXPECT_EQ(back->values, c.values);
    EXPECT_FALSE(case_from_bytes(two_lists(), std::span(bytes).first(bytes.size() - 1)));
  }
}

/// A fuzzer sets any byte.
TEST(CountedInputs, EachByteIsACountThatTheListCanHave) {
  std::vector<std::uint8_t> bytes(1 + 8 * two_lists().most_numbers());
  bytes[0] = 1;
  for (int byte = 0; byte < 256; ++byte) {
    bytes[1 + 8] = std::uint8_t(byte);
    const auto c = case_from_bytes(two_lists(), bytes);
    ASSERT_TRUE(c) << byte;
    EXPECT_EQ(two_lists().broken(c->values), std::nullopt) << byte;
    EXPECT_TRUE(byte < 1 || byte > 12 || c->values[1] == byte) << byte;
  }
}

TEST(CountedInputs, AFileHasAListOfPoints) {
  const nlohmann::ordered_json inputs = fields_to_json(small_case().fields(), small_case().values);
  EXPECT_EQ(inputs.dump(),
            "{\"limit\":9.0,\"one\":{\"vertices\":[[1.0,2.0,3.0],[4.0,5.0,6.0]],\"radius\":0.5},"
            "\"two\":{\"vertices\":[[1.0,0.0,0.0],[0.0,1.0,0.0],[0.0,0.0,1.0]],\"radius\":0.25},\"solid\":true}");
}

TEST(CountedInputs, AreShownInCppAsAList) {
  EXPECT_NE(case_to_cpp(small_case()).find(".vertices = {.count = 2, .entries = {{{1.0, 2.0, 3.0}, {4.0, 5.0, 6.0}}}}"),
            std::string::npos)
      << case_to_cpp(small_case());
}

TEST(CountedInputs, TheSimplestCaseHasFewVertices) {
  const auto keeps = [](const Case& c) {
    double most = 0;
    for (std::size_t i = 0; i < c.values.size(); ++i) {
      if (c.name(i).ends_with(".y") && c.role(i) == Role::position) most = std::max(most, c.values[i]);
    }
    return most >= 5;
  };
  const Case simplest = shrink(small_case(), keeps);
  EXPECT_EQ(two_lists().broken(simplest.values), std::nullopt);
  EXPECT_EQ(simplest.values.size(), 12u) << "one vertex each";
  EXPECT_TRUE(keeps(simplest));
}

/// The sum of the numbers, and how many there were.
Answer sum(std::span<const double> inputs) {
  Answer a;
  a.count = 2;
  for (const double x : inputs) a.values[0] += x;
  a.values[1] = double(inputs.size());
  return a;
}

TEST(CountedInputs, AHostGetsEachCaseWithItsLength) {
  std::vector<double> values;
  std::vector<std::uint32_t> lengths;
  std::vector<double> sums;
  constexpr std::size_t cases = 2 * Worker::capacity + 7;
  for (std::size_t i = 0; i < cases; ++i) {
    lengths.push_back(std::uint32_t(1 + i * 31 % 150));
    sums.push_back(0);
    for (std::size_t k = 0; k < lengths.back(); ++k) values.push_back(double(i + k)), sums.back() += double(i + k);
  }
  Worker worker;
  const std::vector<Answer> answers = worker.ask({"sum", Offer::answers, "", {}, sum}, values, lengths);
  ASSERT_EQ(answers.size(), cases);
  for (std::size_t i = 0; i < cases; ++i) {
    EXPECT_EQ(answers[i].values[0], sums[i]) << i;
    EXPECT_EQ(answers[i].values[1], double(lengths[i])) << i;
  }
}

TEST(CountedInputs, AProgramIsToldTheNamesOfEntries) {
  const auto expected = nlohmann::json::parse(R"({"query": "two_lists", "decides": true, "outputs": [], "inputs": [
      "limit", {"list": "one.vertices", "entry": ["x", "y", "z"]}, "one.radius",
      {"list": "two.vertices", "entry": ["x", "y", "z"]}, "two.radius", "solid"]})");
  EXPECT_EQ(wire::names_of_numbers(two_lists()), expected);
}

TEST(CountedInputs, AProgramGetsEachCaseWithItsLength) {
  const std::vector<double> values{7, 2, 1, 2, 1, 3};
  const std::vector<std::uint32_t> begins{1, 4, 6};
  const CaseNumbers cases{values, begins};
  EXPECT_EQ(wire::json_request("two_lists", 5, cases),
            "{\"query\": \"two_lists\", \"first\": 5, \"cases\": [[2, 1, 2], [1, 3]]}\n");
  const std::string bytes = wire::binary_request(4, 5, cases);
  std::uint32_t head[6];
  double numbers[5];
  ASSERT_EQ(bytes.size(), sizeof head + sizeof numbers);
  std::memcpy(head, bytes.data(), sizeof head);
  std::memcpy(numbers, bytes.data() + sizeof head, sizeof numbers);
  const std::vector<std::uint32_t> expected{4, 2, 5, 5, 3, 2};
  EXPECT_EQ(std::vector<std::uint32_t>(head, head + 6), expected);
  EXPECT_EQ(std::vector<double>(numbers, numbers + 5), std::vector<double>(values.begin() + 1, values.end()));
  const std::string first_version = wire::binary_request(4, 5, cases, wire::version_without_lengths);
  EXPECT_EQ(first_version, std::string("\4\0\0\0\2\0\0\0\5\0\0\0\0\0\0\0", 16) + bytes.substr(sizeof head));
}

}  // namespace
}  // namespace nearmiss

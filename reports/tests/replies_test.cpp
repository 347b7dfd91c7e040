/// What a program's replies in JSON mean, and which are refused.
#include "impl/host/replies.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace nearmiss::wire {
namespace {

constexpr std::uint64_t first_two = 3;

Taken taken(const std::string& line, std::uint64_t gives = ~std::uint64_t{0}, std::uint64_t of_misses = 0) {
  return take_json(line + "\n", {4, 3, gives, of_misses});
}

TEST(Reply, WithNullForANumberThatTheOfferGivesIsNotFinite) {
  const Taken t = taken(R"({"case": 4, "yes": true, "values": [1, null, 3]})");
  ASSERT_EQ(t.error, "");
  EXPECT_TRUE(t.answer.gives(1));
  EXPECT_TRUE(std::isnan(t.answer.values[1]));
}

TEST(Reply, WithNullForANumberThatTheOfferDoesNotGiveLeavesItOut) {
  const Taken t = taken(R"({"case": 4, "yes": true, "values": [1, null, null]})", first_two);
  ASSERT_EQ(t.error, "");
  EXPECT_TRUE(t.answer.gives(0) && t.answer.gives(1));
  EXPECT_FALSE(t.answer.gives(2));
}

TEST(Reply, WithANumberThatTheOfferDoesNotGiveIsRefused) {
  const Taken t = taken(R"({"case": 4, "yes": true, "values": [1, 2, 3]})", first_two);
  EXPECT_EQ(t.error, "number 3, which is not among what its offer \"gives\"");
  EXPECT_TRUE(t.names_its_case);
}

TEST(Reply, WithTheWordNoneLeavesTheNumberOut) {
  const Taken t = taken(R"({"case": 4, "yes": true, "values": [1, "none", 3]})");
  ASSERT_EQ(t.error, "");
  EXPECT_FALSE(t.answer.gives(1));
}

TEST(Reply, ThatIsAMissHasOnlyNumbersThatMissesHave) {
  const Taken t = taken(R"({"case": 4, "yes": false, "values": [null, null, null]})", ~std::uint64_t{0}, 1);
  ASSERT_EQ(t.error, "");
  EXPECT_TRUE(t.answer.gives(0)) << "a depth";
  EXPECT_TRUE(std::isnan(t.answer.values[0]));
  EXPECT_FALSE(t.answer.gives(1));
}

TEST(Reply, WithAMemberTwiceIsRefused) {
  for (const char* line : {R"({"case": 4, "yes": true, "yes": true})", R"({"yes": false, "case": 4, "y\u0065s": true})",
                           R"({"case": 4, "case": 4, "yes": true})"}) {
    EXPECT_NE(taken(line).error.find("twice in one object"), std::string::npos) << line;
  }
  EXPECT_EQ(taken(R"({"case": 4, "cannot": "it has \": and {\"yes\": 1, \"yes\": 2}"})").error, "");
}

TEST(Reply, ThatIsWrongSaysWhetherItNamesItsCase) {
  EXPECT_TRUE(taken(R"({"case": 4, "yes": 1})").names_its_case);
  EXPECT_FALSE(taken(R"({"case": 5, "yes": true})").names_its_case);
  EXPECT_FALSE(taken("noise").names_its_case);
}

TEST(Hello, IsComparedByWhatItSays) {
  const std::string first = R"({"name": "x", "offers": [{"query": "q", "contract": {"backward": 8}}]})";
  EXPECT_EQ(difference_between(first, first), std::nullopt);
  EXPECT_EQ(difference_between(first, R"({"offers": [{"contract": {"backward": 8}, "query": "q"}], "name": "x"})"),
            std::nullopt);
  EXPECT_EQ(difference_between(first, R"({"name": "y", "offers": [{"query": "q", "contract": {"backward": 8}}]})"),
            "name was \"x\" and is \"y\"");
  EXPECT_EQ(difference_between(first, R"({"name": "x", "offers": [{"query": "q", "contract": {"backward": 9}}]})"),
            "offers/0/contract/backward was 8 and is 9");
  EXPECT_EQ(difference_between(first, R"({"name": "x", "offers": [{"query": "q"}]})"),
            "offers/0/contract was {\"backward\":8} and is missing");
  EXPECT_EQ(difference_between(first, "noise"), "it is no JSON: noise");
}

TEST(Offer, GivesTheOutputsOfItsListOrAll) {
  const Query& query = *find_query("moving_point_sphere");
  EXPECT_EQ(bits_of_output(query, "time"), 1u);
  EXPECT_EQ(bits_of_output(query, "location"), 14u);
  EXPECT_EQ(bits_of_output(query, "location.y"), 4u);
  EXPECT_EQ(bits_of_output(query, "loc"), 0u);
  EXPECT_EQ(given_by_offers(R"({"offers": [{"query": "moving_point_sphere"},
                               {"query": "moving_point_sphere", "gives": ["time", "location"]}]})"),
            (std::vector<std::uint64_t>{~std::uint64_t{0}, 15}));
}

}  // namespace
}  // namespace nearmiss::wire

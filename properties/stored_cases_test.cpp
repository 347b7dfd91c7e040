/// Every stored case agrees with its file name and its expectations.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

#include "corpus/storage/codec.hpp"
#include "corpus/storage/store.hpp"
#include "impl/host/worker.hpp"
#include "oracles/confirmed.hpp"
#include "properties/support.hpp"

namespace nearmiss {
namespace {

class StoredCases : public testing::TestWithParam<NamedQuery> {};

bool fits(const Case& c, Scalar scalar) {
  return std::all_of(c.values.begin(), c.values.end(), [&](double x) { return representable(x, scalar); });
}

TEST_P(StoredCases, HoldAtLeastSixSeeds) { EXPECT_GE(count_seeds(*GetParam().query), 6u); }

TEST_P(StoredCases, SayWhatTheyAreAbout) {
  for (const StoredCase& s : stored_cases(*GetParam().query)) {
    EXPECT_GE(s.note.size(), 10u) << s.file;
    EXPECT_FALSE(s.expected.empty()) << s.file;
  }
}

/// miss-*.json and apart-*.json are a "no" of the exact oracle, all others a "yes".
TEST_P(StoredCases, AreNamedAfterTheTruth) {
  int yes = 0, no = 0;
  for (const StoredCase& s : stored_cases(*GetParam().query)) {
    const std::string name = s.file.filename().string();
    const bool expected = !name.starts_with("miss") && !name.starts_with("apart");
    EXPECT_EQ(truth_is_yes(s.question), expected) << s.file;
    ++(expected ? yes : no);
  }
  EXPECT_GT(yes, 0);
  const Kind kind = GetParam().query->kind;
  if (decides(kind)) {
    EXPECT_GT(no, 0);
  }
}

/// Our own subjects run in this process, where a sanitizer sees them; others may crash, and some cases are stored for
/// that.
Finding found(const Case& c, const Subject& subject, Worker& worker) {
  if (subject.own) return examined(c, subject);
  const Offering& offering = subject.offering(c.query->name);
  const std::vector<Answer> answers = worker.ask(offering, c.values, c.values.size());
  return confirmed(c, answers.front(), subject.standard_for(c.query->name), Detail::verdict);
}

/// An open bug is a stored case that expects the violation: it fails here on the day it is fixed.
TEST_P(StoredCases, MeetTheirExpectations) {
  const Query& query = *GetParam().query;
  Worker worker;
  for (const StoredCase& s : stored_cases(query)) {
    for (const Expected& e : s.expected) {
      const Subject* subject = find_subject(e.subject);
      if (subject == nullptr) {
        // A library that this build lacks, a plugin or a command. A name of our own must be one of a tier.
        EXPECT_FALSE(e.subject.starts_with("collide")) << s.file << " expects something of " << e.subject;
        fmt::print("{}: skipped: subject {} is not loaded\n", s.file.filename().string(), e.subject);
        continue;
      }
      Case c = s.question;
      ASSERT_TRUE(fits(c, subject->scalar)) << s.file << ": " << e.subject << " cannot hold its numbers";
      c.scalar = subject->scalar;
      ASSERT_NE(subject->offering(query.name).answer, nullptr) << s.file << ": " << e.subject << " does not offer it";
      const Finding f = found(c, *subject, worker);
      EXPECT_EQ(name_of(f.verdict), e.verdict) << s.file << ", " << e.subject << ": " << f.clause;
      if (!e.disagreement.empty()) {
        EXPECT_EQ(name_of(f.disagreement), e.disagreement) << s.file << ", " << e.subject;
      }
    }
  }
}

TEST_P(StoredCases, ComeBackFromJson) {
  for (const StoredCase& s : stored_cases(*GetParam().query)) {
    const Case back = case_from_json(parse_json(case_to_json(s.question).dump(), "text"), "text");
    EXPECT_EQ(back.values, s.question.values) << s.file;
  }
}

/// Whatever the rule is for the cases of users.
TEST(StoredCase, IsReadExactly) {
  ASSERT_EQ(decimals_of_users(), Decimals::nearest);
  const std::string file = testing::TempDir() + "/nearmiss-stored-" + std::to_string(::getpid()) + ".json";
  write_file(file, R"({"query": "sphere_sphere_overlap", "scalar": "float", "values": [0.1, 0, 0, 1, 2, 0, 0, 1],
                       "note": "0.1 is no float"})");
  EXPECT_THROW(read_stored_case(file), BadInput);
  std::filesystem::remove(file);
  const std::uint64_t before = rounded_numbers().count;
  std::size_t read = 0;
  for (const Query& q : catalogue()) read += stored_cases(q).size() + worst_cases(q).size();
  EXPECT_GT(read, catalogue().size());
  EXPECT_EQ(rounded_numbers().count, before);
}

INSTANTIATE_FOR_EVERY_QUERY(Every, StoredCases, testing::ValuesIn(every_query()), testing::PrintToStringParamName());

}  // namespace
}  // namespace nearmiss

/// A host of another build is refused before its answers are misread.
#include "impl/host/shared_layout.hpp"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "impl/host/hosts.hpp"
#include "impl/host/serve.hpp"

namespace nearmiss {
namespace {

/// The hello that a host of this build would send for a subject without offers.
std::string hello_without_offers() {
  Subject s;
  s.name = "some-library";
  s.version = "1";
  return hello_of(s);
}

TEST(SharedLayout, OfThisBuildIsAccepted) {
  EXPECT_EQ(subject_from_hello("a host", hello_without_offers(), {{"host"}}).name, "some-library");
}

TEST(SharedLayout, OfAnotherBuildIsRefusedInOneLine) {
  std::string hello = hello_without_offers();
  const std::string own = shared_layout(catalogue());
  hello.replace(hello.find(own), own.size(), shared_layout(catalogue().first(1)));
  try {
    subject_from_hello("a host", hello, {{"host"}});
    FAIL() << "accepted: " << hello;
  } catch (const BadSubject& e) {
    EXPECT_STREQ(
        e.what(),
        "a host: its host is of another build than this program; build all of it again, and check that nothing "
        "else builds or copies there");
  }
}

TEST(SharedLayout, ThatIsNotStatedIsRefused) {
  std::string hello = hello_without_offers();
  const std::string member = "\"layout\":\"" + shared_layout(catalogue()) + "\",";
  hello.erase(hello.find(member), member.size());
  EXPECT_THROW(subject_from_hello("a host", hello, {{"host"}}), BadSubject);
}

/// Each way in which two builds may differ about a query.
TEST(SharedLayout, DependsOnTheQueries) {
  const std::vector<Query> ours(catalogue().begin(), catalogue().end());
  const std::string own = shared_layout(ours);
  std::vector<Query> other = ours;
  std::swap(other[0], other[1]);
  EXPECT_NE(shared_layout(other), own) << "another order";
  other = ours;
  std::swap(other[0].inputs.front(), other[0].inputs.back());
  EXPECT_NE(shared_layout(other), own) << "another order of inputs";
  other = ours;
  other[0].outputs.pop_back();
  EXPECT_NE(shared_layout(other), own) << "an output less";
  EXPECT_EQ(shared_layout(ours), own);
}

}  // namespace
}  // namespace nearmiss

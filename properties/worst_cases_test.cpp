/// Every stored worst case (corpus/worst/) still has the error that its file states.
#include <gtest/gtest.h>

#include "corpus/storage/store.hpp"
#include "oracles/requirements.hpp"
#include "properties/support.hpp"

namespace nearmiss {
namespace {

class WorstCases : public testing::TestWithParam<NamedQuery> {};

/// A subject that became better, or worse, fails here until `nearmiss run --climb --update-worst` has measured it
/// again.
TEST_P(WorstCases, HaveTheErrorOfTheirFile) {
  for (const WorstCase& w : worst_cases(*GetParam().query)) {
    const Subject* s = find_subject(w.subject);
    if (s == nullptr) continue;  // not built here
    EXPECT_TRUE(s->own) << w.subject;
    const Standard standard = s->standard_for(GetParam().query->name);
    const double now = error_of(w.question, ask_here(*s, w.question), standard, w.kind).value_or(0);
    EXPECT_EQ(now, w.error) << worst_case_file(*w.question.query, w.subject, w.kind).string() << ": " << w.subject
                            << " changed; measure again: nearmiss run --climb --update-worst --cases 2000 --query "
                            << GetParam().query->name << " --subject " << w.subject;
    EXPECT_LT(now, w.kind == ErrorKind::forward ? standard.contract.forward : standard.contract.backward)
        << w.subject << " breaks its contract";
  }
}

INSTANTIATE_FOR_EVERY_QUERY(Every, WorstCases, testing::ValuesIn(every_query()), testing::PrintToStringParamName());

}  // namespace
}  // namespace nearmiss

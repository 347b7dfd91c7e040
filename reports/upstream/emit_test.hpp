/// Turns a finding into a test for the library itself: one source file that needs only that library.
#pragma once

#include <string>

#include "reports/findings/report.hpp"
#include "reports/upstream/right_answers.hpp"

namespace nearmiss {

struct EmittedTest {
  std::string text;
  std::string extension;  ///< "cpp", "c" or "mjs"
  std::string build;      ///< the compiler's command line
};

/// The test asks the library in the same way as its adapter. It fails where a finding is proved against the report's
/// answer, and passes with a right answer. Throws BadInput where the subject cannot be asked outside of Nearmiss, or
/// where its answer is no finding and no right answer either.
///
/// `file` is the name of the test in the compiler's command line; empty: "test.cpp", "test.c" or
/// "finding.test.mjs".
EmittedTest emit_test(const Report& r, const Subject& subject, const std::string& file = "");

/// "within 1e-4 of the largest number in its group (…)": what the test of the report allows, in words.
std::string allowance_text(const Report& r, const RightAnswers& right);

}  // namespace nearmiss

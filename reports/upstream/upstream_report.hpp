/// A report to the authors of a library.
#pragma once

#include <string>

#include "reports/findings/report.hpp"

namespace nearmiss {

/// Markdown: the verdict, the environment, the numbers and a picture, the given and the exact answer with its proof, a
/// program that needs that library alone, and the answers of other libraries. No folder of this machine is in it.
/// `picture` is the name of an image beside the text that it shows; empty: none. Throws BadInput where emit_test()
/// does, and where nothing is to be found against the answer.
std::string upstream_report(const Report& r, const Subject& subject, const std::string& picture = "");

}  // namespace nearmiss

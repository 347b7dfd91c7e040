/// Stored cases: seeds and regressions, one JSON file each, in corpus/seeds/<query>/ and
/// corpus/regressions/<query>/.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "corpus/errors.hpp"
#include "impl/catalogue/case.hpp"

namespace nearmiss {

/// What a stored case says about a subject's answer; kept with the case, so that an open bug is a
/// green test that turns red the day it is fixed.
struct Expected {
  std::string subject;
  std::string verdict;       ///< name_of(Verdict)
  std::string disagreement;  ///< name_of(Disagreement); may be empty
};

struct StoredCase {
  Case question;
  std::filesystem::path file;
  std::string note;  ///< what the case is about, or where it was reported
  std::vector<Expected> expected;
};

/// A case file with its "note" and "expected": [{"subject", "verdict", "disagreement"}], all optional
/// but subject and verdict. Throws BadInput: unreadable, not a case, or words that the judge never says.
StoredCase read_stored_case(const std::filesystem::path& file);

/// Every stored case of the query, seeds first, in order of file name. Throws BadInput for a file that
/// is no case of this query.
std::vector<StoredCase> stored_cases(const Query& query);
/// Number of files in the query's folder of seeds.
std::size_t count_seeds(const Query& query);
/// The folder corpus/ of this build: the environment variable NEARMISS_CORPUS, or the one that CMake knew.
std::filesystem::path corpus_folder();

}  // namespace nearmiss

/// Stored cases: seeds and regressions, one JSON file each, in corpus/seeds/<query>/ and corpus/regressions/<query>/;
/// and the worst cases known of our own subjects, in corpus/worst/<query>/<subject>-<error>.json.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "corpus/files/errors.hpp"
#include "impl/catalogue/case.hpp"
#include "oracles/error_kind.hpp"

namespace nearmiss {

/// The expected finding for a subject's answer. It is stored with the case, so that an open bug is a green test that
/// turns red on the day it is fixed.
struct Expected {
  std::string subject;
  std::string verdict;       ///< name_of(Verdict)
  std::string disagreement;  ///< name_of(Disagreement); may be empty
};

struct StoredCase {
  Case question;
  std::filesystem::path file;
  std::string note;  ///< the purpose of the case, or where it was reported
  std::vector<Expected> expected;
};

/// Reads a case file with its "note" and "expected": [{"subject", "verdict", "disagreement"}]; all fields but subject
/// and verdict are optional. Throws BadInput if the file is unreadable, no case, or has a verdict or disagreement that
/// the judge never gives.
StoredCase read_stored_case(const std::filesystem::path& file);

/// Every stored case of the query, seeds first, ordered by file name. Throws BadInput for a file that is no case of
/// this query.
std::vector<StoredCase> stored_cases(const Query& query);
/// The number of files in the query's folder of seeds.
std::size_t count_seeds(const Query& query);

/// The worst case known of a subject: the case with the largest proved error of one kind that a search has found. The
/// true maximum may be larger.
struct WorstCase {
  Case question;
  std::string subject;
  ErrorKind kind = ErrorKind::forward;
  double error = 0;  ///< error_of() the subject's answer, in unit_of(kind); above 0
};

/// The file of a worst case: corpus/worst/QUERY/SUBJECT-KIND.json.
std::filesystem::path worst_case_file(const Query& query, const std::string& subject, ErrorKind kind);
/// Reads a case file with "worst": {"subject", "kind", "error", "unit"}. Throws BadInput where it is none.
WorstCase read_worst_case(const std::filesystem::path& file);
nlohmann::ordered_json worst_case_to_json(const WorstCase& w);
/// Every stored worst case of the query, ordered by file name. Throws BadInput for a file that is none, or whose name
/// is not that of its query, subject and kind.
std::vector<WorstCase> worst_cases(const Query& query);

/// The folder corpus/ of this build: the environment variable NEARMISS_CORPUS, or the folder that CMake set.
std::filesystem::path corpus_folder();

}  // namespace nearmiss

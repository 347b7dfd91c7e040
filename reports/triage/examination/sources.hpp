/// Reads the reports that are to be triaged, from run folders, folders of reports, and single files.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "impl/subject/subject.hpp"
#include "reports/engine/variant_counts.hpp"
#include "reports/findings/finding_kind.hpp"
#include "reports/triage/examination/sample.hpp"

namespace nearmiss {

/// A report in a file, as far as it is needed to ask its subject again.
struct FiledReport {
  std::filesystem::path file;
  std::string id;
  Case question;
  const Subject* subject = nullptr;
  SceneMeasure measure;
  bool is_counted = false;  ///< its finding is among the counts of its run's index
};

struct Sources {
  std::vector<std::string> names;      ///< as given
  std::vector<FiledReport> reports;    ///< each id once, in the order of files
  std::vector<CountedVariant> counts;  ///< of all indexes
  Sample sample;                       ///< of all indexes
  /// Files that could not be used, each with the reason: truncated, of another program, of an older schema, about a
  /// subject that is not loaded.
  std::vector<std::pair<std::string, std::string>> skipped;
};

/// Reads every report of the named files and folders. A folder with an index.json is a run folder: its reports are
/// those of findings/. Any other folder is searched to its bottom. Folders named "triage" are left out, because triage
/// writes them. Throws BadInput for a name of nothing.
Sources read_sources(const std::vector<std::string>& names);

/// A line on standard error for each skipped file; after ten, how many more there are.
void name_skipped(const Sources& sources);

}  // namespace nearmiss

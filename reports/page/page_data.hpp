/// The data of the page of a triage or of a run: its signatures, the trend, and its reports with their pictures.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "reports/findings/workers.hpp"

namespace nearmiss {

/// Reads a folder for its page: triage.json where there is one; otherwise the index.json of a run, with one signature
/// for each query, subject and fault; otherwise the newest run among the folder's subfolders. Several runs make a
/// trend.
class PageData {
 public:
  /// `page_folder` is that of the page, for its links. Throws BadInput for a folder without a run or a triage, and for
  /// one whose files cannot be read.
  PageData(std::filesystem::path folder, std::filesystem::path page_folder);

  std::size_t signatures() const { return signatures_.size(); }
  /// Reports at which the judge contradicted itself; they are named under "skipped".
  std::size_t internal_errors() const { return internal_errors_; }

  /// Reads the worst and the simplest report of each signature, the most severe first, and adds their pictures, until
  /// the data of the page has `byte_limit`. The plots of errors ask the reports' subjects, as long as `has_time` says;
  /// a subject that this build does not have is not asked. `tick` is called with the number of signatures that are
  /// done; false ends the reading. A report that cannot be read is named under "skipped".
  void add_reports(std::size_t byte_limit, Workers& workers, const std::function<bool()>& has_time,
                   const std::function<bool(std::size_t)>& tick);

  /// The data as reports/page.schema.json describes them.
  nlohmann::ordered_json to_json() const;

 private:
  using Json = nlohmann::ordered_json;

  void read_triage(const std::filesystem::path& file);
  void read_run(const std::filesystem::path& run);
  void read_trend();
  void sort_signatures();
  /// The report with its picture and its plots as text; "null" where it cannot be read.
  std::string report_text(const std::string& path, Workers& workers, const std::function<bool()>& has_time);
  std::filesystem::path file_of(const std::string& path) const;
  /// A link of the page to a file.
  std::string link_to(const std::filesystem::path& file) const;
  Json details_of(const Json& signature) const;
  Json extremes() const;

  std::filesystem::path folder_, page_folder_, run_;  ///< paths of reports are relative to `run_`
  Json summary_, trend_ = Json::array(), trades_ = Json::array(), skipped_ = Json::array();
  std::vector<Json> signatures_;  ///< in the form of triage.json
  std::vector<Json> reports_;     ///< of the first signatures: {"worst", "simplest"}; the second may be null: the same
  std::size_t internal_errors_ = 0;
  std::map<std::string, bool> ours_;  ///< by subject: is_ours()
};

}  // namespace nearmiss

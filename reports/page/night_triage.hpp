/// The end of a night: its findings, grouped into signatures and compared with the last night, and their page.
#pragma once

#include <chrono>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "reports/triage/triage.hpp"

namespace nearmiss {

class NightTriage {
 public:
  struct Settings {
    std::filesystem::path folder;                 ///< of the night
    std::optional<std::filesystem::path> before;  ///< triage.json of the last night
    std::chrono::duration<double> time;           ///< the most time to examine findings and to ask for the plots
  };
  /// Triages the folder and writes triage/triage.json and, where this build can, index.html there. A file of the last
  /// night that cannot be read is named on standard error, and every signature is new. Throws IoError.
  explicit NightTriage(const Settings& settings);

  /// True where a subject whose night it is has a new or a worse signature.
  bool is_regression() const;
  /// For the subjects whose night it is and for the others: how many signatures are new, worse, known and fixed, then
  /// the most severe of the new and worse ones, a few lines. The last line names the page.
  std::string text() const;
  /// The counts and the files, relative to the folder: "triage" in reports/run.schema.json.
  nlohmann::ordered_json to_json() const;
  /// Where the judge contradicted itself while the page was made.
  std::size_t internal_errors() const { return internal_errors_; }

 private:
  void compare(const Settings& settings, const TriageSettings& how, Workers& workers);
  void write_page(const Settings& settings, Workers& workers);
  std::size_t count(bool ours, SignatureChange change) const;
  std::string counts_text(bool ours) const;
  std::string changed_text(bool ours) const;

  std::filesystem::path folder_;
  bool compared_ = false;  ///< with a last night
  std::string no_page_;    ///< why there is none; empty where there is one
  std::size_t internal_errors_ = 0;
  Triage triage_;
};

/// triage.json of the last night: that of the folder itself; otherwise, where `siblings` is given, that of the newest
/// run folder in it, whose names begin with their time. Empty where there is none.
std::optional<std::filesystem::path> last_triage(const std::filesystem::path& folder,
                                                 const std::optional<std::filesystem::path>& siblings);

}  // namespace nearmiss

/// Compares the findings of a night with those of earlier nights in the same run folder.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <set>
#include <string>
#include <vector>

#include "reports/engine/run_folder.hpp"

namespace nearmiss {

/// What became of a kind of finding: of a query, a subject and a fault.
enum class Change {
  fresh,  ///< no earlier night has a report of the kind
  worse,  ///< the proved bound is at least twice that of every earlier report
  known,  ///< earlier nights have reports of the kind
  fixed,  ///< earlier nights have reports, and tonight the subject answers their cases without such a finding
};
std::string_view name_of(Change c);

struct ChangedKind {
  Change change;
  bool ours;            ///< of a subject whose night it is: of this project, of NEARMISS_ADD, a plugin or a command
  WrittenReport worst;  ///< tonight's worst report; for `fixed` the earlier one
};

class NightChanges {
 public:
  /// The reports of earlier nights, and those that were written tonight. `again`: the files of earlier reports whose
  /// cases were asked again tonight, so that a kind without a finding tonight is fixed.
  NightChanges(const std::vector<WrittenReport>& earlier, const std::vector<WrittenReport>& tonight,
               const std::set<std::string>& again);

  std::vector<ChangedKind> of(bool ours, Change change) const;
  /// True where a subject whose night it is has a new or a worse kind of finding.
  bool is_regression() const;
  /// Two lines: the subjects whose night it is, and the others.
  std::string text(const std::filesystem::path& folder) const;
  /// {"ours": {"new", "worse", "known", "fixed"}, "others": …}, each a list of kinds with their worst report.
  nlohmann::ordered_json to_json() const;

 private:
  std::vector<ChangedKind> kinds_;
};

/// True for a subject whose night it is.
bool is_ours(const std::string& subject);
/// The names of the subjects whose night it is, separated by commas; the tiers of collide together are "collide".
std::string names_of_ours();

/// Moves the reports of fixed kinds from findings/ to fixed/ of the run folder, so that a later night does not compare
/// with them. Leaves a file that cannot be moved.
void put_aside_fixed(const NightChanges& changes, const std::vector<WrittenReport>& earlier,
                     const std::filesystem::path& folder);

}  // namespace nearmiss

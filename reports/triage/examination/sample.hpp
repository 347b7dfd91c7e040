/// What runs asked and found: what the rates of findings are computed from.
#pragma once

#include <chrono>
#include <compare>
#include <cstdint>
#include <functional>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "corpus/files/file_value.hpp"
#include "corpus/generator/feature_regions.hpp"
#include "reports/engine/variant_counts.hpp"
#include "reports/engine/wrong_cases.hpp"
#include "reports/findings/finding_kind.hpp"

namespace nearmiss {

/// Findings that are counted together: of a query, a subject and a fault, in cases of the same regions.
struct FindingClass {
  std::string query, subject, fault;
  std::string breakage;  ///< for a subject that broke: kind_of_breakage()
  FeatureRegions regions;

  auto operator<=>(const FindingClass&) const = default;
};
FindingClass class_of(const FindingKind& kind, FeatureRegions regions);

/// Findings among so many judged cases.
struct FindingRate {
  std::uint64_t findings = 0, cases = 0;
};

/// The counts of all runs of a triage. Empty where reports came without an index.
struct Sample {
  struct Asked {
    std::uint64_t cases = 0;  ///< that were judged
    std::uint64_t drawn = 0;  ///< of the generator: also those that were not judged
    /// Those with a wrong answer. Empty in an index of an older version, and where the subject was given up.
    std::optional<WrongCases> wrong{};
  };
  std::map<std::pair<std::string, std::string>, Asked> asked;  ///< by query and subject
  std::map<FindingClass, std::uint64_t> findings;
  /// The seed of a run whose cases are all the generator's, so that they can be drawn again. Empty where cases depend
  /// on answers, on files or on a scene, and for several runs.
  std::optional<std::uint64_t> seed;
  std::string version;  ///< of Nearmiss, whose generator it is

  bool empty() const { return asked.empty(); }
  std::uint64_t asked_of(const std::string& query, const std::string& subject) const;
  /// The findings of a kind in cases that lie in these regions and perhaps in others.
  FindingRate rate_of(const FindingKind& kind, FeatureRegions regions) const;
  /// All findings of a subject in the answers to a query.
  FindingRate rate_of(const std::string& query, const std::string& subject) const;
  /// Adds the index of a run. Throws BadInput.
  void add(const FileValue& index);
};

/// True where the cases of a sample can be drawn again by this version.
bool can_be_drawn_again(const Sample& s);

/// The answers of now to the cases of a sample.
struct AskedAgain {
  Sample sample;          ///< empty where not all were asked
  bool is_whole = false;  ///< false where the time was over before the last case, or an interrupt came
  /// Cases that the subject answered right and that are wrong now. Late answers are none.
  std::vector<Case> wrong_now;
  std::uint64_t right_now = 0;  ///< the number of cases that it answered wrong and that are right now
};

/// Asks a subject the cases of a sample again. Empty where they cannot be asked.
std::optional<AskedAgain> asked_again(const Sample& sample, const std::string& query, const Subject& subject,
                                      std::chrono::steady_clock::time_point until, const std::function<void()>& tick);

nlohmann::ordered_json sample_to_json(const Sample& sample);
/// Throws BadInput.
Sample sample_from_json(const FileValue& j);

}  // namespace nearmiss

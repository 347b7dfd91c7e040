/// Where the judge contradicts itself during a run: told, kept and counted, never a finding.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "impl/subject/subject.hpp"
#include "oracles/confirmed.hpp"

namespace nearmiss {

class InternalErrors {
 public:
  /// The first few cases go to internal-errors/QUERY-SUBJECT-ID.json in this folder, which is made for the first.
  explicit InternalErrors(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// confirmed(). Empty where the judge contradicts itself: that is added.
  std::optional<Finding> judged(const Case& question, const Subject& subject, const Answer& answer,
                                const Standard& standard, Detail detail);
  /// Counts it. Of the first few one line on standard error has both words, and the case is a file that 'nearmiss
  /// replay' takes. Throws IoError where it cannot be written.
  void add(const Subject& subject, const InternalError& error);

  std::uint64_t count() const { return count_; }
  /// "; 2 internal errors, see FOLDER"; empty where there is none.
  std::string text() const;
  /// How many, and those that were kept.
  nlohmann::ordered_json to_json() const;

 private:
  static constexpr std::size_t most_kept = 8;
  struct Kept {
    std::string file, query, subject, words;
  };
  std::filesystem::path folder_;
  std::uint64_t count_ = 0;
  std::vector<Kept> kept_;
};

}  // namespace nearmiss

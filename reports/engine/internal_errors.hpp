/// Reports, stores and counts internal errors, where the judge contradicts itself. They are never findings.
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
  /// Stores the first few cases as internal-errors/QUERY-SUBJECT-ID.json in this folder.
  explicit InternalErrors(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// confirmed(); empty, after add(), where the judge contradicts itself.
  std::optional<Finding> judged(const Case& question, const Subject& subject, const Answer& answer,
                                const Standard& standard, Detail detail, const SecondLook& needs_second = {});
  /// Counts the error. For the first few it prints one line with both findings to standard error, and stores the case
  /// as a file for 'nearmiss replay'. Throws IoError where the file cannot be written.
  void add(const Subject& subject, const InternalError& error);

  std::uint64_t count() const { return count_; }
  /// "; 2 internal errors, see FOLDER"; empty where there is none.
  std::string text() const;
  /// The count and the stored errors.
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

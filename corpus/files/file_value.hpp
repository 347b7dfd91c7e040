/// Values of a JSON file, read with a check: each error names the file, the place of the value, the value and the rule.
#pragma once

#include <cstdint>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "corpus/files/errors.hpp"

namespace nearmiss {

/// A value of a file and its place there. The file's JSON must outlive it. Every member throws BadInput where the value
/// is not of the form that its name says.
class FileValue {
 public:
  /// The whole file.
  FileValue(const nlohmann::json& whole, const std::string& file);
  FileValue(nlohmann::json&& whole, const std::string& file) = delete;

  const nlohmann::json& json() const { return *value_; }
  const std::string& file() const { return *file_; }
  bool is_null() const;

  /// A member that must be there.
  FileValue at(std::string_view name) const;
  /// A member that may be missing.
  std::optional<FileValue> find(std::string_view name) const;
  std::vector<FileValue> items() const;
  std::vector<std::pair<std::string, FileValue>> members() const;

  std::string text() const;
  std::vector<std::string> texts() const;
  bool flag() const;
  /// A whole number from 0 to 2^64 - 1, such as a seed.
  std::uint64_t whole() const;
  /// A whole number from 0 to 2^53: sums of counts do not overflow.
  std::uint64_t count() const;
  double number() const;
  double not_negative() const;
  /// Empty for null.
  std::optional<double> number_or_null() const;
  /// Hexadecimal digits, at most sixteen.
  std::uint64_t hexadecimal() const;
  /// The member "schema" must be this number.
  void expect_schema(int version) const;

  /// Throws BadInput: "FILE: PLACE is VALUE: it must be RULE".
  [[noreturn]] void fail(std::string_view rule) const;

 private:
  FileValue(const nlohmann::json& value, std::shared_ptr<const std::string> file, std::string place);
  std::string name_of_place() const;

  const nlohmann::json* value_;
  std::shared_ptr<const std::string> file_;
  std::string place_;  ///< "signatures[3].id"; empty for the whole file
};

}  // namespace nearmiss

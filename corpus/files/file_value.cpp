#include "corpus/files/file_value.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "impl/subject/printable.hpp"

namespace nearmiss {

namespace {

constexpr std::size_t most_of_a_value = 60, most_of_a_name = 60;

/// The value as JSON, cut to fit into a line.
std::string value_in_words(const nlohmann::json& j) {
  if (j.is_object()) return "an object";
  if (j.is_array()) return "an array";
  std::string text = j.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
  if (text.size() > most_of_a_value) text = text.substr(0, most_of_a_value - 3) + "...";
  return text;
}

std::string cut_name(std::string_view name) {
  return printable(name.size() > most_of_a_name ? std::string(name.substr(0, most_of_a_name - 3)) + "..."
                                                : std::string(name));
}

}  // namespace

FileValue::FileValue(const nlohmann::json& whole, const std::string& file)
    : FileValue(whole, std::make_shared<const std::string>(file), "") {}

FileValue::FileValue(const nlohmann::json& value, std::shared_ptr<const std::string> file, std::string place)
    : value_(&value), file_(std::move(file)), place_(std::move(place)) {}

bool FileValue::is_null() const { return value_->is_null(); }

std::string FileValue::name_of_place() const { return place_.empty() ? "the file" : place_; }

void FileValue::fail(std::string_view rule) const {
  throw BadInput(fmt::format("{}: {} is {}: it must be {}", *file_, name_of_place(), value_in_words(*value_), rule));
}

FileValue FileValue::at(std::string_view name) const {
  if (auto found = find(name)) return *std::move(found);
  throw BadInput(fmt::format("{}: {}{}{} is missing", *file_, place_, place_.empty() ? "" : ".", name));
}

std::optional<FileValue> FileValue::find(std::string_view name) const {
  if (!value_->is_object()) fail("an object");
  const auto found = value_->find(name);
  if (found == value_->end()) return std::nullopt;
  return FileValue(*found, file_, place_.empty() ? std::string(name) : fmt::format("{}.{}", place_, name));
}

std::vector<FileValue> FileValue::items() const {
  if (!value_->is_array()) fail("an array");
  std::vector<FileValue> all;
  all.reserve(value_->size());
  for (std::size_t i = 0; i < value_->size(); ++i)
    all.push_back(FileValue((*value_)[i], file_, fmt::format("{}[{}]", place_, i)));
  return all;
}

std::vector<std::pair<std::string, FileValue>> FileValue::members() const {
  if (!value_->is_object()) fail("an object");
  std::vector<std::pair<std::string, FileValue>> all;
  for (const auto& item : value_->items()) {
    std::string place = place_.empty() ? cut_name(item.key()) : fmt::format("{}.{}", place_, cut_name(item.key()));
    all.emplace_back(item.key(), FileValue(item.value(), file_, std::move(place)));
  }
  return all;
}

std::string FileValue::text() const {
  if (!value_->is_string()) fail("a text");
  return value_->get<std::string>();
}

std::vector<std::string> FileValue::texts() const {
  std::vector<std::string> all;
  for (const FileValue& item : items()) all.push_back(item.text());
  return all;
}

bool FileValue::flag() const {
  if (!value_->is_boolean()) fail("true or false");
  return value_->get<bool>();
}

std::uint64_t FileValue::whole() const {
  if (!value_->is_number_unsigned()) fail("a whole number that is not negative");
  return value_->get<std::uint64_t>();
}

std::uint64_t FileValue::count() const {
  constexpr std::uint64_t most = std::uint64_t{1} << 53;
  if (!value_->is_number_unsigned() || value_->get<std::uint64_t>() > most) fail("a whole number from 0 to 2^53");
  return value_->get<std::uint64_t>();
}

double FileValue::number() const {
  if (!value_->is_number()) fail("a number");
  return value_->get<double>();
}

double FileValue::not_negative() const {
  if (!value_->is_number() || value_->get<double>() < 0) fail("a number that is not negative");
  return value_->get<double>();
}

std::optional<double> FileValue::number_or_null() const {
  if (is_null()) return std::nullopt;
  if (!value_->is_number()) fail("a number or null");
  return value_->get<double>();
}

std::uint64_t FileValue::hexadecimal() const {
  constexpr std::size_t most_digits_of_64_bits = 16;
  const std::string digits = value_->is_string() ? value_->get<std::string>() : "";
  const bool whole = !digits.empty() && digits.size() <= most_digits_of_64_bits &&
                     digits.find_first_not_of("0123456789abcdef") == std::string::npos;
  if (!whole) fail("a text of one to sixteen hexadecimal digits");
  return std::stoull(digits, nullptr, 16);
}

void FileValue::expect_schema(int version) const {
  const FileValue schema = at("schema");
  if (!schema.json().is_number_integer() || schema.json() != version) schema.fail(fmt::format("{}", version));
}

}  // namespace nearmiss

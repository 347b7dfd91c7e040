#include "reports/tests/schema.hpp"

#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validation_results.hpp>
#include <valijson/validator.hpp>

#include "corpus/files/source_folder.hpp"
#include "corpus/storage/codec.hpp"

namespace nearmiss {

namespace {

/// Read once by a process: a test validates thousands of reports.
const valijson::Schema& schema_named(const std::string& name) {
  static std::map<std::string, valijson::Schema> read;
  const auto [at, is_new] = read.try_emplace(name);
  if (is_new) {
    const nlohmann::json text = nlohmann::json::parse(read_file(source_folder() + "/reports/" + name));
    valijson::SchemaParser(valijson::SchemaParser::kDraft7)
        .populateSchema(valijson::adapters::NlohmannJsonAdapter(text), at->second);
  }
  return at->second;
}

}  // namespace

std::string complaints(const nlohmann::json& document, const std::string& schema_name) {
  valijson::ValidationResults results;
  valijson::Validator validator(valijson::Validator::kStrongTypes);
  if (validator.validate(schema_named(schema_name), valijson::adapters::NlohmannJsonAdapter(document), &results))
    return "";
  std::string all;
  for (valijson::ValidationResults::Error e; results.popError(e);) {
    all += fmt::format("{}: {}\n", fmt::join(e.context, ""), e.description);
  }
  return all;
}

}  // namespace nearmiss

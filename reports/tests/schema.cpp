#include "reports/tests/schema.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validation_results.hpp>
#include <valijson/validator.hpp>

#include "corpus/files/source_folder.hpp"
#include "corpus/storage/codec.hpp"

namespace nearmiss {

std::string complaints(const nlohmann::json& document, const std::string& schema_name) {
  const nlohmann::json text = nlohmann::json::parse(read_file(source_folder() + "/reports/" + schema_name));
  valijson::Schema schema;
  valijson::SchemaParser(valijson::SchemaParser::kDraft7)
      .populateSchema(valijson::adapters::NlohmannJsonAdapter(text), schema);
  valijson::ValidationResults results;
  valijson::Validator validator(valijson::Validator::kStrongTypes);
  if (validator.validate(schema, valijson::adapters::NlohmannJsonAdapter(document), &results)) return "";
  std::string all;
  for (valijson::ValidationResults::Error e; results.popError(e);) {
    all += fmt::format("{}: {}\n", fmt::join(e.context, ""), e.description);
  }
  return all;
}

}  // namespace nearmiss

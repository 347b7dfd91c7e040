#include "corpus/storage/store.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "corpus/files/source_folder.hpp"
#include "corpus/storage/codec.hpp"
#include "oracles/judge.hpp"

namespace nearmiss {

namespace {

using nlohmann::json;
namespace fs = std::filesystem;

std::vector<fs::path> json_files(const fs::path& folder) {
  std::vector<fs::path> files;
  if (!fs::is_directory(folder)) return files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

fs::path seeds_of(const Query& query) { return corpus_folder() / "seeds" / query.name; }

/// The names of an enumeration that counts from 0 to `last`.
template <class Enum>
bool is_name_of(const std::string& word, Enum last) {
  for (int i = 0; i <= int(last); ++i) {
    if (word == name_of(Enum(i))) return true;
  }
  return false;
}

std::string word(const json& expectation, const char* name, const std::string& where, const std::string& path) {
  const auto found = expectation.find(name);
  if (found == expectation.end()) return {};
  if (!found->is_string())
    throw BadInput(fmt::format("{}: {}.{} is {}: it must be a string", where, path, name, found->dump()));
  return found->get<std::string>();
}

Expected expectation_from(const json& j, const std::string& where, const std::string& path) {
  const auto fail = [&](std::string_view member, const std::string& value, std::string_view rule) {
    throw BadInput(fmt::format("{}: {}{} is {}: it must be {}", where, path, member, value, rule));
  };
  if (!j.is_object()) fail("", j.dump(), "an object");
  for (const auto& item : j.items()) {
    if (item.key() != "subject" && item.key() != "verdict" && item.key() != "disagreement") {
      throw BadInput(fmt::format("{}: {}.{} is unknown", where, path, item.key()));
    }
  }
  Expected e{word(j, "subject", where, path), word(j, "verdict", where, path), word(j, "disagreement", where, path)};
  if (e.subject.empty()) throw BadInput(fmt::format("{}: {}.subject is missing", where, path));
  if (!is_name_of(e.verdict, Verdict::broke)) fail(".verdict", '"' + e.verdict + '"', "a verdict of the judge");
  if (!e.disagreement.empty() && !is_name_of(e.disagreement, Disagreement::not_unit)) {
    fail(".disagreement", '"' + e.disagreement + '"', "a disagreement that the judge tells apart");
  }
  return e;
}

ErrorKind kind_from(const std::string& kind, const std::string& unit, const std::string& where) {
  for (const ErrorKind k : error_kinds) {
    if (kind == name_of(k) && unit == unit_of(k)) return k;
  }
  throw BadInput(
      fmt::format("{}: worst.kind is \"{}\" and worst.unit \"{}\": they must be \"forward\" and \"ulps\", or "
                  "\"backward\" and \"epsilon\"",
                  where, kind, unit));
}

}  // namespace

fs::path corpus_folder() {
  const char* value = std::getenv("NEARMISS_CORPUS");
  if (value == nullptr || *value == '\0') return source_folder() + "/corpus";
  if (!fs::is_directory(value)) throw BadInput(fmt::format("NEARMISS_CORPUS is {}: there is no such folder", value));
  return value;
}

StoredCase read_stored_case(const fs::path& file) {
  const std::string where = file.string();
  const json j = parse_json(read_file(file), where);
  StoredCase stored{case_from_json(j, where), file, {}, {}};
  if (stored.question.origin.empty()) {
    stored.question.origin = (file.parent_path().filename() / file.filename()).string();
  }
  if (const auto note = j.find("note"); note != j.end()) {
    if (!note->is_string()) throw BadInput(fmt::format("{}: note is {}: it must be a string", where, note->dump()));
    stored.note = note->get<std::string>();
  }
  if (const auto expected = j.find("expected"); expected != j.end()) {
    if (!expected->is_array()) {
      throw BadInput(fmt::format("{}: expected is {}: it must be an array", where, expected->dump()));
    }
    for (std::size_t i = 0; i < expected->size(); ++i) {
      stored.expected.push_back(expectation_from((*expected)[i], where, fmt::format("expected[{}]", i)));
    }
  }
  return stored;
}

std::vector<StoredCase> stored_cases(const Query& query) {
  std::vector<StoredCase> all;
  for (const fs::path& folder : {seeds_of(query), corpus_folder() / "regressions" / query.name}) {
    for (const fs::path& file : json_files(folder)) {
      all.push_back(read_stored_case(file));
      const Query& own = *all.back().question.query;
      if (own.name != query.name) {
        throw BadInput(fmt::format("{}: query is \"{}\": it must be that of its folder", file.string(), own.name));
      }
    }
  }
  return all;
}

fs::path worst_case_file(const Query& query, const std::string& subject, ErrorKind kind) {
  return corpus_folder() / "worst" / query.name / fmt::format("{}-{}.json", subject, name_of(kind));
}

WorstCase read_worst_case(const fs::path& file) {
  const std::string where = file.string();
  const json j = parse_json(read_file(file), where);
  WorstCase w{case_from_json(j, where), {}, {}, 0};
  const auto worst = j.find("worst");
  if (worst == j.end() || !worst->is_object()) throw BadInput(fmt::format("{}: worst must be an object", where));
  for (const auto& item : worst->items()) {
    if (item.key() != "subject" && item.key() != "kind" && item.key() != "error" && item.key() != "unit")
      throw BadInput(fmt::format("{}: worst.{} is unknown", where, item.key()));
  }
  w.subject = word(*worst, "subject", where, "worst");
  w.kind = kind_from(word(*worst, "kind", where, "worst"), word(*worst, "unit", where, "worst"), where);
  const auto error = worst->find("error");
  const bool is_error = error != worst->end() && error->is_number() && error->get<double>() > 0;
  if (!is_error) throw BadInput(fmt::format("{}: worst.error must be a number above 0", where));
  w.error = error->get<double>();
  return w;
}

nlohmann::ordered_json worst_case_to_json(const WorstCase& w) {
  nlohmann::ordered_json j = case_to_json(w.question);
  j["worst"] = {{"subject", w.subject}, {"kind", name_of(w.kind)}, {"error", w.error}, {"unit", unit_of(w.kind)}};
  return j;
}

std::vector<WorstCase> worst_cases(const Query& query) {
  std::vector<WorstCase> all;
  for (const fs::path& file : json_files(corpus_folder() / "worst" / query.name)) {
    const WorstCase& w = all.emplace_back(read_worst_case(file));
    if (file != worst_case_file(*w.question.query, w.subject, w.kind))
      throw BadInput(fmt::format("{}: the file must be named after its query, subject and kind", file.string()));
  }
  return all;
}

std::size_t count_seeds(const Query& query) { return json_files(seeds_of(query)).size(); }

}  // namespace nearmiss

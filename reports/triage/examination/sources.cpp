#include "reports/triage/examination/sources.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>

#include "corpus/files/file_value.hpp"
#include "corpus/storage/codec.hpp"
#include "reports/engine/progress.hpp"
#include "reports/engine/replay.hpp"
#include "reports/engine/run_folder.hpp"
#include "reports/findings/finding_kind.hpp"
#include "reports/findings/report.hpp"
#include "reports/findings/text.hpp"
#include "reports/findings/workers.hpp"

namespace nearmiss {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* index_name = "index.json";

/// The reason why JSON is no report that can be triaged; empty where it is one.
std::string complaint(const json& j) {
  if (!j.is_object() || !j.contains("finding") || !j.contains("id")) return "it is no report";
  const json version = j.value("schema", json());
  if (version != report_schema_version) {
    return fmt::format("its schema is {}; reports of schema {} can be triaged", one_line(version.dump(), 20),
                       report_schema_version);
  }
  const auto is = [&](const char* member, std::string_view word) {
    return j["finding"].is_object() && j["finding"].contains(member) && j["finding"][member] == word;
  };
  if (j.contains("relation") && is("disagreement", "none") && !is("verdict", name_of(Verdict::broke))) {
    return "its finding lies in the relation of several cases, and the answer to its own case is right";
  }
  return "";
}

/// The subject of a report. Throws BadInput where there is none here.
const Subject* named_subject(const FileValue& report) {
  (void)report.at("subject").at("name").text();
  return *subject_of_report(report.json(), report.file());
}

class Reader {
 public:
  void read(const std::string& name) {
    std::error_code error;
    sources.names.push_back(name);
    if (fs::is_directory(name, error)) {
      read_folder(name);
    } else if (fs::is_regular_file(name, error)) {
      read_file_of_report(name);
    } else {
      throw BadInput(fmt::format("{}: no such file or folder", one_line(name, 300)));
    }
  }
  Sources sources;

 private:
  void skip(const fs::path& file, const std::string& why) { sources.skipped.emplace_back(file.string(), why); }

  void read_folder(const fs::path& folder) {
    std::error_code error;
    if (fs::is_regular_file(folder / index_name, error)) {
      settle_run(folder);
      read_index(folder / index_name);
      if (fs::is_directory(folder / "findings", error)) read_below(folder / "findings");
    } else {
      read_below(folder);
    }
  }
  void read_below(const fs::path& folder) {
    std::vector<fs::path> entries;
    std::error_code error;
    for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
      entries.push_back(at->path());
    }
    if (error) skip(folder, error.message());
    std::sort(entries.begin(), entries.end());
    for (const fs::path& e : entries) {
      if (fs::is_directory(e, error)) {
        if (e.filename() != "triage" && !fs::is_symlink(e, error)) read_folder(e);
      } else if (e.extension() == ".json") {
        read_file_of_report(e);
      }
    }
  }
  void read_index(const fs::path& file) try {
    const json index = parse_json(read_file(file), file.string());
    const FileValue whole(index, file.string());
    whole.expect_schema(run_schema_version);
    std::vector<CountedVariant> variants = variants_in(whole);
    sources.sample.add(whole);
    if (!variants.empty()) note_counted(whole);
    std::move(variants.begin(), variants.end(), std::back_inserter(sources.counts));
  } catch (const BadInput& e) {
    skip(file, without_name(file, e.what()));
  }
  void read_file_of_report(const fs::path& file) try {
    const json j = parse_json(read_file(file), file.string());
    if (const std::string why = complaint(j); !why.empty()) return skip(file, why);
    const FileValue report(j, file.string());
    (void)kind_in_report(report);  // refuses what a baseline could not read
    FiledReport r{file, report.at("id").text(), case_of(j, file.string()), nullptr, measure_of(j, file.string())};
    r.subject = named_subject(report);
    const std::optional<Case> same = in_scalar(r.question, r.subject->scalar);
    if (!same || r.subject->offering(r.question.query->name).answer == nullptr)
      return skip(file, fmt::format("{} cannot be asked this case", r.subject->name));
    r.question = *same;
    r.is_counted = counted_.contains(r.id);
    if (ids_.insert(r.id).second) sources.reports.push_back(std::move(r));
  } catch (const BadInput& e) {
    skip(file, without_name(file, e.what()));
  }
  /// The reports of the run itself, not those of earlier ones in its folder.
  void note_counted(const FileValue& index) {
    for (const FileValue& r : index.at("reports").items()) {
      const std::optional<FileValue> earlier = r.find("earlier");
      if (!earlier || !earlier->flag()) counted_.insert(r.at("id").text());
    }
  }
  /// Errors of codecs begin with the file.
  static std::string without_name(const fs::path& file, const std::string& what) {
    const std::string beginning = file.string() + ": ";
    return what.starts_with(beginning) ? what.substr(beginning.size()) : what;
  }

  std::set<std::string> ids_;
  std::set<std::string> counted_;  ///< ids of reports whose findings an index counts
};

}  // namespace

Sources read_sources(const std::vector<std::string>& names) {
  Reader reader;
  for (const std::string& name : names) reader.read(name);
  return std::move(reader.sources);
}

void name_skipped(const Sources& sources) {
  constexpr std::size_t named = 10;
  for (std::size_t i = 0; i < sources.skipped.size() && i < named; ++i) {
    const auto& [file, why] = sources.skipped[i];
    say_on_stderr(fmt::format("nearmiss: skipped {}: {}\n", one_line(file), one_line(why)));
  }
  if (sources.skipped.size() > named) {
    say_on_stderr(fmt::format("nearmiss: and {} more\n", sources.skipped.size() - named));
  }
}

}  // namespace nearmiss

#include "reports/engine/run_folder.hpp"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "corpus/files/errors.hpp"
#include "corpus/storage/codec.hpp"
#include "reports/engine/folder_lock.hpp"
#include "reports/engine/run.hpp"
#include "reports/findings/breakage.hpp"
#include "reports/findings/pretty_json.hpp"
#include "reports/findings/report.hpp"
#include "reports/findings/text.hpp"

namespace nearmiss {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* index_name = "index.json";

/// Every file below a folder, without following links to folders.
std::vector<fs::path> files_below(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::recursive_directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    if (at->is_regular_file(error)) files.push_back(at->path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// True where the beginning of an index has the state "running". Reads only the beginning, because indexes may be many
/// and large. False for a file of another user.
bool may_be_running(const fs::path& index) {
  struct stat file {};
  if (::stat(index.c_str(), &file) != 0 || !S_ISREG(file.st_mode) || file.st_uid != ::geteuid()) return false;
  std::array<char, 256> head{};
  std::ifstream(index, std::ios::binary).read(head.data(), head.size());
  return std::string_view(head.data(), head.size())
             .find(fmt::format("\"state\": \"{}\"", name_of(RunState::running))) != std::string_view::npos;
}

std::optional<WrittenReport> report_in(const fs::path& folder, const fs::path& file) {
  const Json j = Json::parse(read_file(file), nullptr, false);
  if (!j.is_object() || !j.contains("finding") || !j.contains("id")) return std::nullopt;
  WrittenReport w{fs::relative(file, folder).generic_string(),
                  j.at("id"),
                  j.at("query"),
                  j.at("subject").at("name"),
                  j.at("finding").at("verdict"),
                  j.at("finding").at("disagreement"),
                  j.at("headline")};
  if (w.verdict == name_of(Verdict::broke)) {
    const Json& answer = j.at("answer");
    const std::string reason = answer.at("reason");
    w.breakage = kind_of_breakage(reason, cause_in_report(reason, answer.value("late", false)));
  }
  if (const Json& backward = j.at("finding").at("backward"); backward.is_object())
    w.above = backward.at("above_epsilon");
  return w;
}

/// Turns the index of a killed run into that of an interrupted run.
void complete(Json& index, const fs::path& folder) {
  index["state"] = name_of(RunState::interrupted);
  std::set<std::string> listed;
  for (const Json& r : index.at("reports")) listed.insert(r.at("file").get<std::string>());
  for (const WrittenReport& w : reports_on_disk(folder)) {
    if (!listed.contains(w.file)) index["reports"].push_back(written_to_json(w));
  }
  index["summary"] = "interrupted without a chance to say so, " + std::to_string(index.at("reports").size()) +
                     " reports; counts are those of the last second but one: " + index.at("summary").get<std::string>();
}

}  // namespace

Json written_to_json(const WrittenReport& w) {
  Json j{{"file", w.file},
         {"id", w.id},
         {"query", w.query},
         {"subject", w.subject},
         {"verdict", w.verdict},
         {"disagreement", w.disagreement},
         {"breakage", w.breakage.empty() ? Json(nullptr) : Json(w.breakage)},
         {"backward_above_epsilon", w.above ? Json(*w.above) : Json(nullptr)},
         {"headline", w.headline}};
  if (w.earlier) j["earlier"] = true;
  return j;
}

std::vector<WrittenReport> reports_on_disk(const fs::path& folder) {
  std::vector<WrittenReport> all;
  for (const fs::path& file : files_below(folder / "findings")) {
    if (file.extension() != ".json") continue;
    try {
      if (auto w = report_in(folder, file)) all.push_back(std::move(*w));
    } catch (const BadInput&) {         // the file cannot be read
    } catch (const Json::exception&) {  // the file is not a report
    }
  }
  return all;
}

std::vector<std::string> vanished_from(const fs::path& folder, const std::vector<std::string>& files) {
  std::vector<std::string> vanished;
  for (const std::string& file : files) {
    std::error_code error;
    if (!fs::is_regular_file(folder / file, error)) vanished.push_back(file);
  }
  return vanished;
}

std::string vanished_text(const std::vector<std::string>& vanished, std::size_t of, const fs::path& folder) {
  if (vanished.empty()) return "";
  return fmt::format("{} of {} {} vanished from {}, the first is {}", count_text(vanished.size()),
                     plural_text(of, "report"), vanished.size() == 1 ? "has" : "have", path_text(folder),
                     vanished.front());
}

bool settle_run(const fs::path& folder) try {
  if (!may_be_running(folder / index_name)) return false;
  const FolderLock lock(folder);
  const std::string text = read_file(folder / index_name);  // the run may have ended since
  (void)parse_json(text, index_name);                       // refuses JSON that is nested too deep to print
  Json index = Json::parse(text);
  if (index.at("state") != name_of(RunState::running) || !index.at("reports").is_array()) return false;
  std::error_code error;
  for (const fs::path& file : files_below(folder)) {
    if (file.extension() == ".part") fs::remove(file, error);  // a partial file
  }
  complete(index, folder);
  write_file(folder / index_name, pretty_json(index));
  return true;
} catch (const ReportedError&) {  // locked, unreadable or not writable: the next command that needs it reports why
  return false;
} catch (const Json::exception&) {  // not an index of this version
  return false;
}

void settle_runs_below(const fs::path& parent) {
  std::error_code error;
  for (fs::directory_iterator at(parent, error), end; !error && at != end; at.increment(error)) {
    if (at->is_directory(error)) settle_run(at->path());
  }
}

void settle_run_of(const fs::path& file) {
  std::error_code error;
  fs::path folder = fs::weakly_canonical(file, error).parent_path();
  for (int up = 0; up < 3 && !error && folder.has_relative_path(); ++up, folder = folder.parent_path()) {
    if (fs::is_regular_file(folder / index_name, error)) {
      settle_run(folder);
      return;
    }
  }
}

}  // namespace nearmiss

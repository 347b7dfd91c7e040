#include "fuzz/violation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "corpus/storage/codec.hpp"
#include "fuzz/asked.hpp"
#include "fuzz/this_target.hpp"

namespace nearmiss::fuzz {

namespace {

bool aborts_always = false;

std::string description(const Subject& subject, const Finding& f) {
  std::string text = fmt::format("{}: {}", subject.name, name_of(f.verdict));
  if (f.disagreement != Disagreement::none) text += fmt::format(", {}", name_of(f.disagreement));
  if (!f.clause.empty()) text += fmt::format(" ({})", f.clause);
  if (f.backward) text += fmt::format(", backward error above {} epsilon", f.backward->above);
  return text;
}

std::string case_file(const Case& c, const std::string& note) {
  auto j = case_to_json(c);
  j["note"] = note;
  return j.dump(2) + '\n';
}

std::uint64_t content_hash(const Case& c) {  // FNV-1a
  std::uint64_t h = 0xcbf29ce484222325;
  for (std::uint8_t byte : case_to_bytes(c)) h = (h ^ byte) * 0x100000001b3;
  return h;
}

/// Most files for one kind of finding, so that one common bug does not fill the disk.
constexpr int most_files_of_a_kind = 100;

void store(const std::filesystem::path& folder, const Case& c, const Subject& subject, const Finding& f) {
  static std::map<std::string, int> written;
  int& count = written[fmt::format("{} {} {}", subject.name, name_of(f.disagreement), f.clause)];
  if (count == most_files_of_a_kind) return;
  ++count;
  const std::string name = fmt::format("{}-{}-{:016x}.json", c.query->name, subject.name, content_hash(c));
  try {
    make_folder(folder);
    write_file(folder / name, case_file(c, description(subject, f)));
  } catch (const IoError& e) {
    cannot_run(e.what());
  }
}

/// The frame of the query and the subject, or the one for any other subject.
const AbortFrame* frame_of(std::string_view query, const std::string& subject, std::string_view kind) {
  const AbortFrame* other = nullptr;
  for (const AbortFrame& f : abort_frames) {
    if (f.query != query || f.kind != kind) continue;
    if (f.subject == nullptr) other = &f;
    if (f.subject != nullptr && f.subject == subject) return &f;
  }
  return other;
}

[[noreturn]] void abort_with(const Case& c, const Subject& subject, const std::string& note, std::string kind) {
  std::replace(kind.begin(), kind.end(), ' ', '_');
  std::fprintf(stderr, "%s\n%s%s", note.c_str(), case_file(c, note).c_str(), case_to_cpp(c).c_str());
  if (const AbortFrame* frame = frame_of(c.query->name, subject.name, kind)) frame->abort();
  std::abort();
}

}  // namespace

void abort_on_violation() { aborts_always = true; }

void report(const Case& c, const Subject& subject, const Finding& f) {
  const char* folder = std::getenv("NEARMISS_FUZZ_REPORTS");
  const bool stores = folder != nullptr && *folder != '\0';
  if (stores) store(folder, c, subject, f);
  if (stores && !aborts_always) return;
  const bool broke = f.verdict == Verdict::broke;
  abort_with(c, subject, description(subject, f), broke ? "broke" : std::string(name_of(f.disagreement)));
}

void end_with(const InternalError& error, const Subject& subject) {
  abort_with(error.question(), subject, fmt::format("internal error: {}: {}", subject.name, error.what()),
             "internal_error");
}

}  // namespace nearmiss::fuzz

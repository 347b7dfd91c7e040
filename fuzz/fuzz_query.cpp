/// The fuzz target of the query fuzzed_query: bytes become a case, the tiers of `collide` answer it, and the judge
/// judges the answers. A violation aborts the process and prints the case. Built with NEARMISS_FUZZ_SUBJECTS, a target
/// asks the subjects of that list instead of the tiers.
///
/// NEARMISS_SUBJECTS       more subjects to ask, by name, separated by commas; "added": those of NEARMISS_ADD that
///                         offer this query
/// NEARMISS_PLUGINS        files of plugins to ask where they offer this query, separated by colons
/// NEARMISS_COMMANDS       command lines of programs to ask where they offer this query, one on each line
/// NEARMISS_FUZZ_REPORTS   a folder: each violation becomes a case file there, and the target goes on
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "corpus/codec.hpp"
#include "corpus/fit.hpp"
#include "fuzz/fuzzed_query.hpp"
#include "fuzz/mutation.hpp"
#include "impl/host/hosts.hpp"
#include "impl/subject/provenance.hpp"
#include "impl/subject/subject.hpp"
#include "oracles/confirmed.hpp"
#include "oracles/requirements.hpp"

namespace nearmiss {
namespace {

const Query& query() {
  static const Query& q = *find_query(fuzzed_query);
  return q;
}

[[noreturn]] void cannot_run(const std::string& why) {
  std::fprintf(stderr, "fuzz_%s: %s\n", fuzzed_query, why.c_str());
  std::exit(2);
}

#ifdef NEARMISS_FUZZ_SUBJECTS
constexpr const char* instead_of_tiers = NEARMISS_FUZZ_SUBJECTS;
#else
constexpr const char* instead_of_tiers = "";
#endif

/// The names in a list that is separated by commas.
std::vector<std::string> names_in(const char* list) {
  std::vector<std::string> names;
  for (std::string_view rest = list == nullptr ? "" : list; !rest.empty();) {
    const std::size_t comma = std::min(rest.find(','), rest.size());
    if (comma > 0) names.emplace_back(rest.substr(0, comma));
    rest.remove_prefix(std::min(comma + 1, rest.size()));
  }
  return names;
}

/// Every tier of `collide` or the subjects of NEARMISS_FUZZ_SUBJECTS, and the subjects, plugins and commands in the
/// environment, that answer this query. Prints their names to standard error, where `nearmiss nightly` reads them.
std::vector<const Subject*> asked_subjects() {
  try {
    load_subjects_of_environment();
  } catch (const BadSubject& e) {
    cannot_run(e.what());
  }
  std::vector<const Subject*> asked;
  const bool tiers = *instead_of_tiers == '\0';
  std::vector<std::string> names = names_in(instead_of_tiers);
  for (std::string& name : names_in(std::getenv("NEARMISS_SUBJECTS"))) names.push_back(std::move(name));
  const std::vector<std::string> added = added_subjects();
  const auto has = [](const std::vector<std::string>& all, const std::string& name) {
    return std::find(all.begin(), all.end(), name) != all.end();
  };
  for (const Subject& s : subjects()) {
    const bool chosen = (s.own && tiers) || s.host != nullptr || (has(names, "added") && has(added, s.name));
    if (chosen && s.offering(query().name).offer != Offer::not_offered) asked.push_back(&s);
  }
  for (const std::string& name : names) {
    if (name == "added") continue;
    const Subject* s = find_subject(name);
    if (s == nullptr) cannot_run(fmt::format("the subject \"{}\" was asked for, and it is none of this build", name));
    if (s->offering(query().name).offer == Offer::not_offered) {
      cannot_run(fmt::format("the subject \"{}\" was asked for, and it does not offer this query", name));
    }
    if (std::find(asked.begin(), asked.end(), s) == asked.end()) asked.push_back(s);
  }
  std::string line;
  for (const Subject* s : asked) line += " " + s->name;
  std::fprintf(stderr, "asks:%s\n", line.c_str());
  return asked;
}

Answer ask(const Subject& subject, const Case& c) try { return ask_here(subject, c); } catch (const std::exception& e) {
  return Answer::without(Answer::Status::broke, e.what());
}

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
  const std::string name = fmt::format("{}-{}-{:016x}.json", query().name, subject.name, content_hash(c));
  try {
    write_file(folder / name, case_file(c, description(subject, f)));
  } catch (const IoError& e) {
    cannot_run(e.what());
  }
}

/// Each kind of finding ends the process in a function of its own: a fleet of machines takes crashes with the same
/// innermost functions for one.
// clang-format off
#define NEARMISS_KINDS(KIND) \
  KIND(false_hit) KIND(false_miss) KIND(wrong_time) KIND(negative_time) KIND(wrong_place) \
  KIND(wrong_normal) KIND(wrong_depth) KIND(wrong_direction) KIND(wrong_weight) KIND(wrong_flag) \
  KIND(wrong_index) KIND(wrong_combination) KIND(off_surface) KIND(not_finite) KIND(not_unit)
// clang-format on
#define NEARMISS_ENDING(kind) \
  [[noreturn, gnu::noinline]] void found_##kind() { std::abort(); }
NEARMISS_KINDS(NEARMISS_ENDING)
[[noreturn, gnu::noinline]] void found_broken() { std::abort(); }

[[noreturn]] void end_as(Disagreement kind) {
#define NEARMISS_CALL(kind) \
  case Disagreement::kind: found_##kind();
  switch (kind) {
    NEARMISS_KINDS(NEARMISS_CALL)
    case Disagreement::none: break;  // an exception of the subject
  }
  found_broken();
}

void report(const Case& c, const Subject& subject, const Finding& f) {
  const char* folder = std::getenv("NEARMISS_FUZZ_REPORTS");
  if (folder != nullptr && *folder != '\0') return store(folder, c, subject, f);
  const std::string note = description(subject, f);
  std::fprintf(stderr, "%s\n%s%s", note.c_str(), case_file(c, note).c_str(), case_to_cpp(c).c_str());
  end_as(f.disagreement);
}

/// Aborts, so that the case becomes an artifact of this target. Judging the artifact repeats the error.
[[noreturn]] void end_with(const InternalError& error, const Subject& subject) {
  const std::string note = fmt::format("internal error: {}: {}", subject.name, error.what());
  std::fprintf(stderr, "%s\n%s", note.c_str(), case_file(error.question(), note).c_str());
  std::abort();
}

Finding judged(const Case& c, const Subject& subject) try {
  return confirmed(c, ask(subject, c), subject.standard_for(query().name), Detail::verdict);
} catch (const InternalError& error) {
  end_with(error, subject);
}

const std::vector<const Subject*>& asked() {
  static const std::vector<const Subject*> all = asked_subjects();
  return all;
}

void examine(const Case& c) {
  for (const Subject* s : asked()) {
    if (s->scalar != c.scalar) continue;
    Case inside = c;
    if (!fit(inside, s->offering(query().name).required)) continue;
    const Finding f = judged(inside, *s);
    if (f.is_proved() || f.verdict == Verdict::broke) report(inside, *s, f);
  }
}

}  // namespace
}  // namespace nearmiss

/// Returns -1 for bytes that are not a case: libFuzzer then does not add them to the corpus.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  auto c = nearmiss::case_from_bytes(nearmiss::query(), {data, size});
  if (!c) return -1;
  c->origin = "fuzz";
  nearmiss::examine(*c);
  return 0;
}

#ifdef NEARMISS_LIBFUZZER

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

/// Half of the mutations are the generator's mutators, which keep a case valid and bring it near a special
/// configuration; the others are libFuzzer's own mutations of bytes. Bytes that are not a case are replaced by a
/// generated case.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned int seed) {
  using namespace nearmiss;
  if (seed % 2 == 0 && case_from_bytes(query(), {data, size})) return LLVMFuzzerMutate(data, size, max_size);
  const std::vector<std::uint8_t> bytes = mutated_case(query(), {data, size}, seed);
  if (bytes.size() > max_size) return LLVMFuzzerMutate(data, size, max_size);
  std::copy(bytes.begin(), bytes.end(), data);
  return bytes.size();
}

/// Makes the list of subjects, which would otherwise count as coverage of the first case. Disables the length control
/// of libFuzzer: every case of a query has one of two lengths, so short inputs are never valid. For another engine,
/// whose main has other arguments, the file of options does this.
extern "C" int LLVMFuzzerInitialize([[maybe_unused]] int* argc, [[maybe_unused]] char*** argv) {
  nearmiss::asked();
#ifndef NEARMISS_FUZZING_ENGINE
  static std::vector<char*> arguments(*argv, *argv + *argc);
  static char no_length_control[] = "-len_control=0";
  arguments.insert(arguments.begin() + 1, no_length_control);
  *argc = static_cast<int>(arguments.size());
  arguments.push_back(nullptr);
  *argv = arguments.data();
#endif
  return 0;
}

#endif

/// The fuzz target of the query fuzzed_query: bytes become a case, the tiers of `collide` answer it, and the judge
/// judges the answers. A violation aborts the process and prints the case. Built with NEARMISS_FUZZ_SUBJECTS, a target
/// asks the subjects of that list instead of the tiers.
///
/// NEARMISS_SUBJECTS       more subjects to ask, by name, separated by commas; "added": those of NEARMISS_ADD that
///                         offer this query
/// NEARMISS_PLUGINS        files of plugins to ask where they offer this query, separated by colons
/// NEARMISS_COMMANDS       command lines of programs to ask where they offer this query, one on each line
/// NEARMISS_PROFILE        the profile.json of a scene: the target asks the profile's choice for the query alone, and
///                         takes only cases within the scene's ranges
/// NEARMISS_FUZZ_REPORTS   a folder: each violation becomes a case file there, and the target goes on
///
/// The argument --abort-on-violation aborts at a violation even where NEARMISS_FUZZ_REPORTS names a folder.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <vector>

#include "corpus/generator/fit.hpp"
#include "corpus/storage/codec.hpp"
#include "fuzz/asked.hpp"
#include "fuzz/fuzzed_query.hpp"
#include "fuzz/mutation.hpp"
#include "fuzz/profiled_scene.hpp"
#include "fuzz/violation.hpp"
#include "oracles/confirmed.hpp"
#include "oracles/exact/number_memory.hpp"
#include "oracles/requirements.hpp"

namespace nearmiss::fuzz {
namespace {

const Query& query() {
  static const Query& q = *find_query(fuzzed_query);
  return q;
}

Answer ask(const Asked& asked, const Case& c) try { return asked.answer(c.values); } catch (const std::exception& e) {
  return Answer::without(Answer::Status::broke, e.what());
}

Finding judged(const Asked& asked, const Case& c, const Answer& answer) try {
  return confirmed(c, answer, asked.standard, Detail::verdict);
} catch (const InternalError& error) {
  end_with(error, *asked.subject);
}

/// Larger for a larger proved backward error and, with equal ones, for a larger forward error. 0 where nothing is
/// proved.
double badness(const Finding& f) {
  const double backward = f.backward ? 1 + f.backward->above : 0;
  return 64 * std::log2(1 + backward) + std::log2(1 + std::min(f.forward_ulps, 0x1p200)) / 4;
}

/// Asks the subject and judges its answer. Returns how bad the answer is.
double examine(const Case& c, const Asked& asked) {
  const Answer answer = ask(asked, c);
  const Finding f = judged(asked, c, answer);
  if (f.is_proved() || f.verdict == Verdict::broke) report(c, *asked.subject, f);
  return badness(f);
}

void examine(const Case& c, const std::vector<Asked>& all) {
  double worst = 0;
  for (const Asked& asked : all) {
    if (asked.subject->scalar != c.scalar) continue;
    if (asked.standard.required.empty()) {
      worst = std::max(worst, examine(c, asked));
    } else if (Case inside = c; fit(inside, asked.standard.required)) {
      worst = std::max(worst, examine(inside, asked));
    }
  }
  remember(c, worst);
}

const std::vector<Asked>& all_asked() {
  static const std::vector<Asked> all = asked_subjects(query());
  return all;
}

const ProfiledScene* profiled() {
  static const ProfiledScene* const scene = ProfiledScene::of_environment(query());
  return scene;
}

/// The scalar of the profile's choice: cases of the other one would ask nothing.
Scalar profiled_scalar() { return all_asked().front().subject->scalar; }

/// Whether the case may be asked: without a profile, any; with one, a case of its scene.
bool is_wanted(const Case& c) {
  return profiled() == nullptr || (c.scalar == profiled_scalar() && profiled()->contains(c));
}

}  // namespace
}  // namespace nearmiss::fuzz

using namespace nearmiss;

/// Returns -1 for bytes that are not a case, or not one of the profile's scene: libFuzzer then does not add them to the
/// corpus.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  auto c = case_from_bytes(fuzz::query(), {data, size});
  if (!c || !fuzz::is_wanted(*c)) return -1;
  c->origin = "fuzz";
  fuzz::examine(*c, fuzz::all_asked());
  return 0;
}

#ifdef NEARMISS_LIBFUZZER

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

/// Copies the case to libFuzzer's buffer; 0 where it does not fit.
static std::size_t put(const Case& c, std::uint8_t* data, std::size_t max_size) {
  const std::vector<std::uint8_t> bytes = case_to_bytes(c);
  if (bytes.size() > max_size) return 0;
  std::copy(bytes.begin(), bytes.end(), data);
  return bytes.size();
}

static Case fresh(unsigned seed) {
  if (const fuzz::ProfiledScene* p = fuzz::profiled()) return p->fresh_case(fuzz::profiled_scalar(), seed);
  return fuzz::fresh_case(fuzz::query(), seed);
}

/// The bytes of a changed case, which a profile keeps in its scene; 0 where they do not fit.
static std::size_t put_changed(Case c, unsigned seed, std::uint8_t* data, std::size_t max_size) {
  if (const fuzz::ProfiledScene* p = fuzz::profiled()) p->bring_back(c, fuzz::profiled_scalar(), seed);
  return put(c, data, max_size);
}

/// libFuzzer's own mutation. What a profile's target makes of it is a case of the scene again.
static std::size_t mutate_bytes(std::uint8_t* data, std::size_t size, std::size_t max_size, unsigned seed) {
  const std::size_t mutated = LLVMFuzzerMutate(data, size, max_size);
  if (fuzz::profiled() == nullptr) return mutated;
  const auto c = case_from_bytes(fuzz::query(), {data, mutated});
  const std::size_t filled = put_changed(c ? *c : fresh(seed), seed, data, max_size);
  return filled != 0 ? filled : mutated;
}

/// A quarter of the mutations are libFuzzer's own mutations of bytes; the others change the case (fuzz/mutation.hpp).
/// Bytes that are not a case are replaced by a generated case.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned int seed) {
  auto c = case_from_bytes(fuzz::query(), {data, size});
  if (c && seed % 4 == 0) return mutate_bytes(data, size, max_size, seed);
  if (c) {
    fuzz::change(*c, seed);
  } else {
    c = fresh(seed);
  }
  const std::size_t filled = put_changed(*c, seed, data, max_size);
  return filled != 0 ? filled : LLVMFuzzerMutate(data, size, max_size);
}

extern "C" std::size_t LLVMFuzzerCustomCrossOver(const std::uint8_t* data1, std::size_t size1,
                                                 const std::uint8_t* data2, std::size_t size2, std::uint8_t* out,
                                                 std::size_t max_out, unsigned int seed) {
  auto c = case_from_bytes(fuzz::query(), {data1, size1});
  const auto other = case_from_bytes(fuzz::query(), {data2, size2});
  if (!c) return 0;
  if (other) fuzz::cross_over(*c, *other, seed);
  return put_changed(*c, seed, out, max_out);
}

/// Makes the list of subjects, which would otherwise count as coverage of the first case. Sets two of libFuzzer's
/// options before those of the command line. No length control: every case of a query has one of two lengths, so short
/// inputs are never valid. No counts of how often a branch is taken: loops over coordinates and digits make them vary
/// without a meaning, and libFuzzer would spend a fifth of the time on them. For another engine, whose main has other
/// arguments, the file of options does this.
extern "C" int LLVMFuzzerInitialize([[maybe_unused]] int* argc, [[maybe_unused]] char*** argv) {
  use_pool_for_numbers();
  fuzz::all_asked();
#ifndef NEARMISS_FUZZING_ENGINE
  static std::vector<char*> arguments;
  for (int i = 0; i < *argc; ++i) {
    if (std::strcmp((*argv)[i], "--abort-on-violation") == 0) {
      fuzz::abort_on_violation();
    } else {
      arguments.push_back((*argv)[i]);
    }
  }
  static char no_length_control[] = "-len_control=0", no_counts[] = "-use_counters=0";
  arguments.insert(arguments.begin() + 1, {no_length_control, no_counts});
  *argc = static_cast<int>(arguments.size());
  arguments.push_back(nullptr);
  *argv = arguments.data();
#endif
  return 0;
}

#endif

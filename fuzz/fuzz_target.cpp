/// The fuzz target this_target: bytes become a case, the tiers of `collide` answer it, and the judge judges the
/// answers. A violation aborts the process and prints the case. Built with NEARMISS_FUZZ_SUBJECTS, a target asks the
/// subjects of that list instead of the tiers.
///
/// NEARMISS_QUERIES        the queries of the target to ask, by name, separated by commas; without it, all
/// NEARMISS_SUBJECTS       more subjects to ask, by name, separated by commas; "added": those of NEARMISS_ADD. Each is
///                         asked the queries that it offers
/// NEARMISS_PLUGINS        files of plugins to ask what they offer, separated by colons
/// NEARMISS_COMMANDS       command lines of programs to ask what they offer, one on each line
/// NEARMISS_PROFILE        the profile.json of a scene: the target asks only queries of the profile, of each the
///                         profile's choice alone, and takes only cases within the scene's ranges
/// NEARMISS_FUZZ_REPORTS   a folder: each violation becomes a case file there, and the target goes on
///
/// The argument --abort-on-violation aborts at a violation even where NEARMISS_FUZZ_REPORTS names a folder.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <vector>

#include "corpus/generator/fit.hpp"
#include "corpus/storage/fuzz_target.hpp"
#include "fuzz/asked.hpp"
#include "fuzz/mutation.hpp"
#include "fuzz/this_target.hpp"
#include "fuzz/violation.hpp"
#include "oracles/confirmed.hpp"
#include "oracles/exact/number_memory.hpp"
#include "oracles/requirements.hpp"

namespace nearmiss::fuzz {
namespace {

const FuzzTarget& target() {
  static const FuzzTarget& t = *find_fuzz_target(this_target);
  return t;
}

const std::vector<AskedQuery>& all_asked() {
  static const std::vector<AskedQuery> all = asked_queries(target());
  return all;
}

/// nullptr for a query that is not asked.
const AskedQuery* asked(const Query& query) {
  const auto found =
      std::find_if(all_asked().begin(), all_asked().end(), [&](const AskedQuery& a) { return a.query == &query; });
  return found == all_asked().end() ? nullptr : &*found;
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

/// The scalar of the profile's choice: cases of the other one would ask nothing.
Scalar scalar_of(const AskedQuery& asked) { return asked.subjects.front().subject->scalar; }

/// The case of the bytes, where it may be asked: with a profile, a case of its scene.
std::optional<Case> wanted_case(std::span<const std::uint8_t> bytes) {
  std::optional<Case> c = target().case_of(bytes);
  const AskedQuery* const a = c ? asked(*c->query) : nullptr;
  if (a == nullptr) return std::nullopt;
  if (a->scene && (c->scalar != scalar_of(*a) || !a->scene->contains(*c))) return std::nullopt;
  return c;
}

}  // namespace
}  // namespace nearmiss::fuzz

using namespace nearmiss;

#ifdef NEARMISS_LIBFUZZER
Subject nearmiss::united(std::span<const SubjectFunction> functions) {
  Subject all = functions.front()();
  for (const SubjectFunction function : functions.subspan(1)) {
    for (Offering& o : function().offerings) all.offerings.push_back(std::move(o));
  }
  return all;
}
#endif

/// Returns -1 for bytes that are not a case, or not one of the profile's scene: libFuzzer then does not add them to the
/// corpus.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::optional<Case> c = fuzz::wanted_case({data, size});
  if (!c) return -1;
  c->origin = "fuzz";
  fuzz::examine(*c, fuzz::asked(*c->query)->subjects);
  return 0;
}

#ifdef NEARMISS_LIBFUZZER

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

/// Copies the case to libFuzzer's buffer; 0 where it does not fit.
static std::size_t put(const Case& c, std::uint8_t* data, std::size_t max_size) {
  const std::vector<std::uint8_t> bytes = fuzz::target().bytes_of(c);
  if (bytes.size() > max_size) return 0;
  std::copy(bytes.begin(), bytes.end(), data);
  return bytes.size();
}

/// A generated case of one of the queries, or a case of the profile's scene.
static Case fresh(unsigned seed) {
  const fuzz::AskedQuery& a = fuzz::all_asked()[seed / 2 % fuzz::all_asked().size()];
  return a.scene ? a.scene->fresh_case(fuzz::scalar_of(a), seed) : fuzz::fresh_case(*a.query, seed);
}

/// The bytes of a changed case, which a profile keeps in its scene; 0 where they do not fit.
static std::size_t put_changed(Case c, unsigned seed, std::uint8_t* data, std::size_t max_size) {
  const fuzz::AskedQuery* const a = fuzz::asked(*c.query);
  if (a == nullptr) return put(fresh(seed), data, max_size);
  if (a->scene) a->scene->bring_back(c, fuzz::scalar_of(*a), seed);
  return put(c, data, max_size);
}

/// libFuzzer's own mutation. What a profile's target makes of it is a case of the scene again.
static std::size_t mutate_bytes(std::uint8_t* data, std::size_t size, std::size_t max_size, unsigned seed) {
  const std::size_t mutated = LLVMFuzzerMutate(data, size, max_size);
  if (!fuzz::all_asked().front().scene) return mutated;
  const auto c = fuzz::target().case_of({data, mutated});
  const std::size_t filled = put_changed(c ? *c : fresh(seed), seed, data, max_size);
  return filled != 0 ? filled : mutated;
}

/// A quarter of the mutations are libFuzzer's own mutations of bytes; the others change the case (fuzz/mutation.hpp).
/// Bytes that are not a case are replaced by a generated case.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned int seed) {
  auto c = fuzz::target().case_of({data, size});
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
  auto c = fuzz::target().case_of({data1, size1});
  const auto other = fuzz::target().case_of({data2, size2});
  if (!c) return 0;
  if (other && other->query == c->query) {
    fuzz::cross_over(*c, *other, seed);
  } else {
    fuzz::change(*c, seed);
  }
  return put_changed(*c, seed, out, max_out);
}

/// Makes the list of subjects, which would otherwise count as coverage of the first case. Sets two of libFuzzer's
/// options before those of the command line. No length control: a case of a query has one of two lengths, so short
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

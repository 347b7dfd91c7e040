/// What a fuzz target has of its own; it shares everything else with the other targets. CMake writes a source for each
/// target, which defines SUBJECTS and uses the macro at the end.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <string_view>

namespace nearmiss {

/// The target's name (corpus/storage/fuzz_target.hpp).
extern const char* const this_target;

struct Subject;
using SubjectFunction = Subject (*)();
/// With libFuzzer: the subjects that are compiled for each query apart (PER_QUERY of nearmiss_add_subject), in the
/// order of their addition. Each has a function for each query of the target, which returns it with that query alone.
extern const std::span<const SubjectFunction> subjects_of_queries[];
/// The subject with the queries of all functions.
Subject united(std::span<const SubjectFunction> functions);

/// A function that aborts. Its name contains query, subject and kind of the finding, and is the frame of a stack trace
/// by which a fuzzing service tells findings apart.
struct AbortFrame {
  std::string_view query;
  const char* subject;  ///< the subject's name; nullptr: any other subject
  const char* kind;     ///< as name_of(Disagreement) with '_' for ' '; "broke"; "internal_error"
  void (*abort)();
};
extern const std::span<const AbortFrame> abort_frames;

}  // namespace nearmiss

/// Every kind of finding.
// clang-format off
#define NEARMISS_KINDS(X, query, subject, name)                                           \
  X(query, subject, name, false_hit) X(query, subject, name, false_miss)                  \
  X(query, subject, name, wrong_time) X(query, subject, name, negative_time)              \
  X(query, subject, name, wrong_place) X(query, subject, name, wrong_normal)              \
  X(query, subject, name, wrong_depth) X(query, subject, name, wrong_distance)            \
  X(query, subject, name, wrong_size) X(query, subject, name, wrong_direction)            \
  X(query, subject, name, wrong_weight) X(query, subject, name, wrong_flag)               \
  X(query, subject, name, wrong_index) X(query, subject, name, wrong_combination)         \
  X(query, subject, name, off_the_surface) X(query, subject, name, not_finite)            \
  X(query, subject, name, not_unit) X(query, subject, name, broke)                        \
  X(query, subject, name, internal_error)
// clang-format on

/// The compiler must neither merge the functions, which are alike, nor end them with a jump, which leaves no frame:
/// hence the statement that differs, and a call that is not known to end.
#define NEARMISS_ABORT_FUNCTION(query, subject, name, kind)        \
  extern "C" [[gnu::noinline]] void query##_##subject##_##kind() { \
    asm volatile("# " #query " " #subject " " #kind);              \
    nearmiss_abort();                                              \
    asm volatile("# the end of " #query " " #subject " " #kind);   \
  }
#define NEARMISS_ABORT_ENTRY(query, subject, name, kind) {#query, name, #kind, query##_##subject##_##kind},

#define NEARMISS_ABORT_FUNCTIONS(query, subject, name) NEARMISS_KINDS(NEARMISS_ABORT_FUNCTION, query, subject, name)
#define NEARMISS_ABORT_ENTRIES(query, subject, name) NEARMISS_KINDS(NEARMISS_ABORT_ENTRY, query, subject, name)

/// Exact numbers allocate much: without the stacks of all allocations and with a small quarantine of freed memory a
/// target runs twice as fast; the tests of the preset asan look for uses of a frame after
/// its return, which costs time here. ASAN_OPTIONS takes precedence.
#define NEARMISS_SANITIZER_OPTIONS                                                       \
  extern "C" const char* __asan_default_options() {                                      \
    return "malloc_context_size=0:quarantine_size_mb=8:detect_stack_use_after_return=0"; \
  }

/// SUBJECTS(X, query) calls X(query, identifier, name) for each subject; QUERIES(X) calls X(query) for each query.
#define NEARMISS_ABORT_FUNCTIONS_OF(query) \
  SUBJECTS(NEARMISS_ABORT_FUNCTIONS, query) NEARMISS_ABORT_FUNCTIONS(query, any_other_subject, nullptr)
#define NEARMISS_ABORT_ENTRIES_OF(query) \
  SUBJECTS(NEARMISS_ABORT_ENTRIES, query) NEARMISS_ABORT_ENTRIES(query, any_other_subject, nullptr)

#define NEARMISS_FUZZ_TARGET(name, QUERIES)                                         \
  const char* const nearmiss::this_target = #name;                                  \
  extern "C" [[gnu::noinline]] void nearmiss_abort() { std::abort(); }              \
  NEARMISS_SANITIZER_OPTIONS QUERIES(NEARMISS_ABORT_FUNCTIONS_OF) namespace {       \
    constexpr nearmiss::AbortFrame frames[] = {QUERIES(NEARMISS_ABORT_ENTRIES_OF)}; \
  }                                                                                 \
  const std::span<const nearmiss::AbortFrame> nearmiss::abort_frames = frames;

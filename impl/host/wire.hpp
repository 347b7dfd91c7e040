/// The wire format between the judge's process and a host: file descriptors, shared memory, message headers.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

#include "impl/host/arithmetic.hpp"
#include "impl/subject/subject.hpp"

namespace nearmiss::wire {

/// The version of the protocol in docs/reference/protocol.md, as the hello states it. A program may also speak the
/// first one, in which all cases of a query have the same count of numbers. (There is no second one: the versions are
/// those of nearmiss_plugin.h.)
inline constexpr int version = 3, version_without_lengths = 1;

/// The file descriptors of a host, beside the standard three.
enum File : int {
  from_judge = 3,
  to_judge = 4,
  shared_request = 5,  ///< shared memory that the host reads; only for hosts of this project
  shared_answers = 6,  ///< shared memory that the host writes; likewise
  plugin_folder = 7,   ///< of a plugin that the host's user cannot reach by its path
  plugin_file = 8,     ///< likewise
};

/// What a host that shares memory says after a batch. The second: something wrote over its answers, and it has written
/// them again.
inline constexpr std::string_view all_done = "d", all_done_and_overwritten = "w";

inline constexpr std::size_t capacity = 2048;             ///< most cases in a batch
inline constexpr std::size_t max_values = capacity * 64;  ///< most numbers in a batch
inline constexpr std::size_t most_shift = 1024;           ///< of the numbers of a request in shared memory
inline constexpr std::size_t max_hello = std::size_t{1} << 20;
inline constexpr std::size_t max_reason = 65535;

/// A batch of cases. The judge's process writes it before it wakes the host; the host has it mapped read-only.
struct SharedRequest {
  std::uint32_t offer;         ///< index among the offers of the hello
  std::uint32_t first, count;  ///< the host answers the cases [first, count)
  std::uint32_t batch;         ///< number of this request: an answer to an earlier one is never taken for its answer
  std::uint32_t numbers_at;    ///< where the numbers of its answers begin: below most_shift
  Rounding rounding;           ///< other than its_own: the answers also have the raised exceptions
  bool timed;                  ///< each answer has two numbers: nanoseconds of the case's call, and an AnswerStage
  AnswerFunction answer;       ///< replaces `offer` for a host that is a fork of this process
  std::array<std::uint32_t, capacity + 1> begins;  ///< where each case begins in `values`, and the end of the last one
  std::array<double, max_values> values;

  /// Those of the cases [from, end).
  CaseNumbers numbers(std::size_t from, std::size_t end) const {
    return {values, std::span(begins).subspan(from, end - from + 1)};
  }
};

/// How the calls of a timed batch were measured. The judge's process checks the numbers.
struct TimedBatch {
  double processor_nanoseconds;  ///< of a call, of calls in sequence: the thread's processor time of the median round
  std::uint32_t rounds;
  bool typed;   ///< calls of typed functions; otherwise the decoding of the inputs is part of the time
  bool pinned;  ///< the host stayed on one processor
};

/// The answers to a batch, written by the host while it works. Moving memory between cores is the largest cost of
/// isolation, so the numbers of all answers are packed without gaps. The judge's process checks every value.
struct SharedAnswers {
  struct Head {
    Answer::Status status;
    bool yes;
    std::uint8_t count;
    BreakCause cause;
    std::uint8_t raised;  ///< of a case that is asked in a given rounding
    std::uint32_t check;  ///< check_of() this answer: a write over the answers is noticed
    std::uint64_t given;
  };

  std::atomic<std::uint32_t> done;  ///< the cases before this one are answered
  std::array<Head, capacity> heads;
  std::array<double, capacity * Answer::capacity + most_shift> numbers;  ///< from the case `first` on
  std::array<decltype(Answer::why), capacity> reasons;                   ///< written only for cases without an answer
  TimedBatch timed;  ///< of a timed batch, once all its cases are done
};

/// A hash of an answer to a request, of its head (without the member `check`) and of its numbers.
inline std::uint32_t check_of(std::uint32_t batch, std::size_t number_of_case, const SharedAnswers::Head& head,
                              const double* numbers) {
  constexpr std::uint64_t odd = 0x9e3779b97f4a7c15u;
  std::uint64_t hash = odd * ((std::uint64_t{batch} << 32 | number_of_case) + 1);
  const auto add = [&](std::uint64_t word) {
    hash = (hash ^ word) * odd;
    hash ^= hash >> 32;
  };
  std::uint8_t status, yes, cause;
  std::memcpy(&status, &head.status, 1), std::memcpy(&yes, &head.yes, 1), std::memcpy(&cause, &head.cause, 1);
  add(std::uint64_t{status} | std::uint64_t{yes} << 8 | std::uint64_t{head.count} << 16 | std::uint64_t{cause} << 24 |
      std::uint64_t{head.raised} << 32);
  add(head.given);
  for (std::size_t i = 0; i < head.count; ++i) {
    std::uint64_t bits;
    std::memcpy(&bits, numbers + i, sizeof bits);
    add(bits);
  }
  return std::uint32_t(hash);
}

inline SharedAnswers::Head head_of(std::uint32_t batch, std::size_t number_of_case, const Answer& a,
                                   std::uint8_t raised) {
  SharedAnswers::Head head{a.status, a.yes, a.count, a.cause, raised, 0, a.given};
  head.check = check_of(batch, number_of_case, head, a.values.data());
  return head;
}

/// Writes the answer to a case; its numbers begin at `at`.
inline void put(SharedAnswers& into, std::size_t number_of_case, std::size_t at, const SharedAnswers::Head& head,
                const Answer& a) {
  std::copy_n(a.values.begin(), a.count, into.numbers.begin() + std::ptrdiff_t(at));
  into.heads[number_of_case] = head;
  if (a.status != Answer::Status::answered) into.reasons[number_of_case] = a.why;
}

/// The header of a binary batch. As many lengths follow as there are cases, each of 32 bits, and then the numbers of
/// all cases as doubles. Every reply names its case, so that a surplus or missing reply is never taken for the reply to
/// another case.
struct Request {
  std::uint32_t offer, count;
  std::uint32_t first;    ///< number of the first case; cases count from 0 since the program's start
  std::uint32_t numbers;  ///< of all cases; version_without_lengths: 0, and no lengths follow
};
/// The header of the reply to one case; the outputs follow as doubles, or `reason` bytes of text without an answer.
struct Reply {
  std::uint8_t status;  ///< 0: answered; 1: cannot answer
  std::uint8_t yes;     ///< 0 or 1
  std::uint16_t reason;
  std::uint32_t number;  ///< of the case
  std::uint64_t given;
};
static_assert(sizeof(Request) == 16 && sizeof(Reply) == 16);

/// Reads the answers [begin, end) to a request from shared memory and advances `begin`; `at` counts the numbers before
/// `begin`.
/// Returns false at the first answer that is malformed or was changed after it was written: `begin` is then its index,
/// and no later answer is read. `outputs` is the required count of numbers, or 0.
inline bool take(const SharedAnswers& from, std::uint32_t batch, std::size_t& begin, std::size_t end, std::size_t& at,
                 std::size_t outputs, Answer* into) {
  for (; begin < end; ++begin) {
    const SharedAnswers::Head head = from.heads[begin];
    std::atomic_signal_fence(
        std::memory_order_seq_cst);  // checked values are never read again: the host may change them
    const auto status = static_cast<std::uint8_t>(head.status);
    if (status > static_cast<std::uint8_t>(Answer::Status::broke) || head.count > Answer::capacity) return false;
    if (head.status == Answer::Status::answered && outputs > 0 && head.count != outputs) return false;
    Answer& a = into[begin];
    // A host that still answers knows one cause; the judge's process sees the others.
    std::uint8_t cause;
    std::memcpy(&cause, &head.cause, 1);
    const bool is_exception = cause == std::uint8_t(BreakCause::exception);
    a.cause = is_exception ? BreakCause::exception : BreakCause::other;
    a.status = head.status, a.given = head.given;
    unsigned char yes;
    std::memcpy(&yes, &head.yes, 1);
    a.yes = yes != 0;
    std::copy_n(from.numbers.begin() + std::ptrdiff_t(at), head.count, a.values.begin());
    if (head.count < a.count) std::fill(a.values.begin() + head.count, a.values.begin() + a.count, 0.0);
    a.count = head.count;
    if (check_of(batch, begin, head, a.values.data()) != head.check) return false;
    if (head.status == Answer::Status::answered) {
      a.why[0] = '\0';
    } else {
      a.why = from.reasons[begin];
    }
    at += head.count;
  }
  return true;
}

}  // namespace nearmiss::wire

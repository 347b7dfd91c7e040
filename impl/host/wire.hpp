/// What the judge's process and a host have in common: numbers of files, shared memory, frames.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "impl/subject/subject.hpp"

namespace nearmiss::wire {

/// Of the protocol that docs/protocol.md describes; the hello names it.
inline constexpr int version = 1;

/// Open in a host, beside the standard three.
enum File : int {
  from_judge = 3,
  to_judge = 4,
  shared_request = 5,  ///< shared memory, to be read; of hosts of this project alone
  shared_answers = 6,  ///< shared memory, to be written; likewise
};

inline constexpr std::size_t capacity = 2048;             ///< cases of a batch
inline constexpr std::size_t max_values = capacity * 64;  ///< numbers of a batch
inline constexpr std::size_t max_hello = std::size_t{1} << 20;
inline constexpr std::size_t max_reason = 65535;

/// Written by the judge before it wakes the host, which can only read it.
struct SharedRequest {
  std::uint32_t offer;  ///< position among the hello's offers
  std::uint32_t inputs;
  std::uint32_t first, count;  ///< the cases [first, count) are asked
  AnswerFunction answer;       ///< of a host that is a copy of this process, in place of an offer
  std::array<double, max_values> values;
};

/// Written by the host while it works. To move memory from one core to another is what isolation costs most, so an
/// answer takes no more of it than it has numbers, one behind the other. The judge believes none of it.
struct SharedAnswers {
  struct Head {
    Answer::Status status;
    bool yes;
    std::uint8_t count;
    BreakCause cause;
    std::uint64_t given;
  };

  std::atomic<std::uint32_t> done;  ///< those before it are answered
  std::array<Head, capacity> heads;
  std::array<double, capacity * Answer::capacity> numbers;  ///< of the case `first` onward
  std::array<decltype(Answer::why), capacity> reasons;      ///< of those without an answer; the others are not written
};

/// A batch in binary: the request is this, then count * inputs doubles. Every answer names its case, so that one too
/// many, or too few, is never taken for the answer to another.
struct Request {
  std::uint32_t offer, count;
  std::uint32_t first;  ///< number of the first case; they count up from 0 while the program runs
  std::uint32_t zero;
};
/// The reply to each case is this, then the outputs as doubles if it is answered, or else `reason` bytes of text.
struct Reply {
  std::uint8_t status;  ///< 0: answered; 1: cannot answer
  std::uint8_t yes;     ///< 0 or 1
  std::uint16_t reason;
  std::uint32_t number;  ///< of the case
  std::uint64_t given;
};
static_assert(sizeof(Request) == 16 && sizeof(Reply) == 16);

/// Takes the answers [begin, end) out of shared memory; `at` counts the numbers before `begin`. False where one of them
/// is none: nothing behind it is taken, and `begin` is its position. `outputs` is how many numbers an answer must have,
/// or 0.
inline bool take(const SharedAnswers& from, std::size_t& begin, std::size_t end, std::size_t& at, std::size_t outputs,
                 Answer* into) {
  for (; begin < end; ++begin) {
    const SharedAnswers::Head head = from.heads[begin];
    std::atomic_signal_fence(std::memory_order_seq_cst);  // what has been looked at is never read again: it may change
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

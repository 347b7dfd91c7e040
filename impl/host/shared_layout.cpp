#include "impl/host/shared_layout.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string_view>
#include <vector>

#include "impl/host/wire.hpp"

namespace nearmiss {

namespace {

/// The hash FNV-1a of 64 bits.
class LayoutHash {
 public:
  void add(std::uint64_t number) {
    for (int shift = 0; shift < 64; shift += 8) add_byte(std::uint8_t(number >> shift));
  }
  void add(std::string_view text) {
    add(std::uint64_t(text.size()));
    for (const char c : text) add_byte(std::uint8_t(c));
  }
  void add(std::span<const Field> fields) {
    add(std::uint64_t(fields.size()));
    for (const Field& f : fields) add(f.name), add(std::uint64_t(f.role));
  }
  void add(const CountedInput& list) {
    add(list.name);
    for (const std::size_t number : {list.at, list.numbers, list.least, list.most}) add(std::uint64_t(number));
  }
  std::string text() const {
    char digits[17];
    std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(hash_));
    return digits;
  }

 private:
  void add_byte(std::uint8_t byte) { hash_ = (hash_ ^ byte) * 0x100000001b3u; }
  std::uint64_t hash_ = 0xcbf29ce484222325u;
};

// offsetof is defined for them: none has a base, a virtual function or a reference.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Winvalid-offsetof"

void add_memory(LayoutHash& hash) {
  using wire::SharedAnswers, wire::SharedRequest, wire::TimedBatch;
  using Head = SharedAnswers::Head;
  for (const std::size_t number : {sizeof(SharedRequest),
                                   offsetof(SharedRequest, offer),
                                   offsetof(SharedRequest, first),
                                   offsetof(SharedRequest, count),
                                   offsetof(SharedRequest, batch),
                                   offsetof(SharedRequest, numbers_at),
                                   offsetof(SharedRequest, rounding),
                                   offsetof(SharedRequest, timed),
                                   offsetof(SharedRequest, answer),
                                   offsetof(SharedRequest, begins),
                                   offsetof(SharedRequest, values),
                                   sizeof(SharedAnswers),
                                   offsetof(SharedAnswers, done),
                                   offsetof(SharedAnswers, heads),
                                   offsetof(SharedAnswers, numbers),
                                   offsetof(SharedAnswers, reasons),
                                   offsetof(SharedAnswers, timed),
                                   sizeof(TimedBatch),
                                   offsetof(TimedBatch, processor_nanoseconds),
                                   offsetof(TimedBatch, rounds),
                                   offsetof(TimedBatch, typed),
                                   offsetof(TimedBatch, pinned),
                                   sizeof(Head),
                                   offsetof(Head, status),
                                   offsetof(Head, yes),
                                   offsetof(Head, count),
                                   offsetof(Head, cause),
                                   offsetof(Head, raised),
                                   offsetof(Head, check),
                                   offsetof(Head, given),
                                   Answer::capacity,
                                   wire::capacity,
                                   wire::max_values}) {
    hash.add(std::uint64_t(number));
  }
}

#pragma GCC diagnostic pop

void add_values(LayoutHash& hash) {
  for (const Answer::Status s : {Answer::Status::answered, Answer::Status::cannot_answer, Answer::Status::broke})
    hash.add(std::uint64_t(s));
  hash.add(std::uint64_t(BreakCause::exception));
  hash.add(std::uint64_t(Rounding::its_own));
}

}  // namespace

std::string shared_layout(std::span<const Query> queries) {
  LayoutHash hash;
  hash.add(std::uint64_t(wire::version));
  add_memory(hash);
  add_values(hash);
  for (const Query& q : queries) {
    hash.add(q.name), hash.add(q.inputs), hash.add(q.outputs);
    for (std::size_t k = 0; k < q.lists.size(); ++k) hash.add(q.lists[k]);
  }
  return hash.text();
}

}  // namespace nearmiss

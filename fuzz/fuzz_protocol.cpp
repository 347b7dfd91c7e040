/// Fuzzes the data that the judge's process reads from hosts: hellos, answers over pipes, answers in shared memory,
/// text for terminals. The reader may refuse any data, but must never accept invalid data: a failed demand() aborts.
///
/// The first byte selects the kind of data; for answers the second byte is the count of numbers in an answer.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string>
#include <string_view>

#include "fuzz/this_target.hpp"
#include "impl/catalogue/query.hpp"
#include "impl/host/hosts.hpp"
#include "impl/host/replies.hpp"
#include "impl/host/shared_layout.hpp"
#include "impl/host/wire.hpp"
#include "impl/subject/printable.hpp"

const char* const nearmiss::this_target = "protocol";

namespace nearmiss {
namespace {

/// Aborts unless `held`.
void demand(bool held, const char* what) {
  if (held) return;
  std::fprintf(stderr, "fuzz_protocol: %s\n", what);
  std::abort();
}

bool is_one_printable_line(std::string_view text) {
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7F) return false;
  }
  return printable(text) == text;
}

/// The hello with the layout of this build in the place of the word LAYOUT. Every other layout is refused at once.
std::string with_layout(std::string hello) {
  constexpr std::string_view word = "LAYOUT";
  if (const std::size_t at = hello.find(word); at != std::string::npos)
    hello.replace(at, word.size(), shared_layout(catalogue()));
  return hello;
}

void hear_hello(std::string_view text, HostProgram::Batches batches) {
  try {
    const Subject s = subject_from_hello("host", with_layout(std::string(text)), {{"host"}, batches});
    demand(!s.name.empty() && s.name.size() <= 64 && is_one_printable_line(s.name), "a name that is none");
    demand(is_one_printable_line(s.version), "a version that is not one line");
    demand(s.offerings.size() == catalogue().size(), "not an offering for each query");
    demand((batches == HostProgram::Batches::shared) == (s.host->batches == HostProgram::Batches::shared),
           "a program got shared memory, or a host of ours got pipes");
    for (const Offering& o : s.offerings) {
      demand(is_one_printable_line(o.how), "a reason that is not one line");
      demand((o.offer == Offer::not_offered) == (o.answer == nullptr), "an offer without a function");
      if (o.offer == Offer::not_offered) continue;
      demand(o.outputs == find_query(o.query)->outputs.size(), "another number of outputs");
      demand(o.contract.backward >= 0 && o.contract.forward >= 0 && o.contract.unit >= 0, "a bound below 0");
    }
  } catch (const BadSubject& e) {
    const std::string_view why = e.what();
    demand(why.starts_with("host: ") && why.size() < 2000, "a refusal of another form");
  }
}

void check(const Answer& a, std::size_t outputs) {
  demand(a.status == Answer::Status::answered || a.status == Answer::Status::cannot_answer,
         "an answer of another kind");
  if (a.status == Answer::Status::answered) demand(a.count == outputs, "another number of values");
  demand(a.reason().size() < sizeof a.why, "a reason without end");
}

void hear_replies(std::string_view bytes, std::size_t outputs,
                  wire::Taken (*take)(std::string_view, const wire::Due&)) {
  for (std::uint32_t number = 0; !bytes.empty(); ++number) {
    const wire::Taken taken = take(bytes, {number, outputs});
    if (taken.bytes == 0) {
      demand(printable(taken.error).size() < 2000, "an error without end");
      return;
    }
    demand(taken.error.empty() && taken.bytes <= bytes.size(), "more taken than there is");
    check(taken.answer, outputs);
    bytes.remove_prefix(taken.bytes);
  }
}

/// Fills the heads of shared memory with the bytes, and the reasons with the same bytes again. Every second case gets
/// the check of its content, as an honest host would write it, so that some answers are read.
void look_at_shared_memory(std::string_view bytes, std::size_t outputs) {
  static const auto memory = std::make_unique<wire::SharedAnswers>();
  static std::array<Answer, wire::capacity> into;
  constexpr std::size_t most = 64;
  constexpr std::uint32_t batch = 1;
  const std::size_t count = std::min(most, bytes.size() / sizeof(wire::SharedAnswers::Head));
  if (count > 0)
    std::memcpy(static_cast<void*>(memory->heads.data()), bytes.data(), count * sizeof(wire::SharedAnswers::Head));
  for (std::size_t i = 0, at_numbers = 0; i < count; ++i) {
    if (!bytes.empty()) memory->reasons[i].fill(bytes[i % bytes.size()]);
    wire::SharedAnswers::Head& head = memory->heads[i];
    if (head.count > Answer::capacity) break;  // no later answer is read
    if (bytes[i] % 2 == 0) head.check = wire::check_of(batch, i, head, memory->numbers.data() + at_numbers);
    at_numbers += head.count;
  }
  std::size_t begin = 0, at = 0;
  const bool all = wire::take(*memory, batch, begin, count, at, outputs, into.data());
  demand(begin <= count && (begin == count) == all, "a position beyond the end");
  demand(at <= begin * Answer::capacity, "more numbers than answers have");
  for (std::size_t i = 0; i < begin; ++i) {
    demand(into[i].count <= Answer::capacity, "an answer with too many numbers");
    demand(into[i].reason().size() <= sizeof into[i].why, "a reason without end");
  }
}

}  // namespace
}  // namespace nearmiss

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nearmiss;
  if (size < 2) return 0;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const std::size_t outputs = data[1] % (Answer::capacity + 1);
  switch (data[0]) {
    case 'h': hear_hello(text.substr(1), HostProgram::Batches::json); break;
    case 's': hear_hello(text.substr(1), HostProgram::Batches::shared); break;
    case 'j': hear_replies(text.substr(2), outputs, wire::take_json); break;
    case 'b': hear_replies(text.substr(2), outputs, wire::take_binary); break;
    case 'm': look_at_shared_memory(text.substr(2), outputs); break;
    default: demand(is_one_printable_line(printable(text)), "text that is not one printable line");
  }
  return 0;
}

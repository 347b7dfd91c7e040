#include "impl/host/serve.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "impl/host/built_in_host.hpp"
#include "impl/host/shared_layout.hpp"
#include "impl/host/timing.hpp"
#include "impl/subject/contained.hpp"
#include "impl/subject/floating_point.hpp"

namespace nearmiss {

namespace {

using Json = nlohmann::ordered_json;

bool write_all(int file, std::string_view text) {
  while (!text.empty()) {
    const ssize_t put = write(file, text.data(), text.size());
    if (put < 0 && errno == EINTR) continue;
    if (put <= 0) return false;
    text.remove_prefix(std::size_t(put));
  }
  return true;
}

bool wait_for_wake_up(int file) {
  char byte = 0;
  ssize_t got = 0;
  while ((got = read(file, &byte, 1)) < 0 && errno == EINTR) {
  }
  return got == 1;
}

/// null for a bound that promises nothing; invalid bounds (NaN, -inf) stay visible, so that the judge refuses them.
Json bound(double x) {
  if (std::isfinite(x)) return x;
  return std::isnan(x) ? Json("nan") : x > 0 ? Json(nullptr) : Json("-inf");
}

Json contract_to_json(const collide::Contract& c) {
  return {{"backward", bound(c.backward)},        {"forward", bound(c.forward)}, {"unit", bound(c.unit)},
          {"exact_decisions", c.exact_decisions}, {"lowest", c.lowest},          {"highest", c.highest}};
}

template <class T>
T* mapped(int file, int protection) {
  void* memory = mmap(nullptr, sizeof(T), protection, MAP_SHARED, file, 0);
  return memory == MAP_FAILED ? nullptr : static_cast<T*>(memory);
}

/// The answer in that rounding, and the exceptions that it raised.
Answer answer_in(Rounding rounding, const AnswerFunction& answer, std::span<const double> values,
                 std::uint8_t& raised) {
  const RoundingScope scope(rounding);
  std::feclearexcept(FE_ALL_EXCEPT);
  const Answer a = answer_or_broke([&] { return answer(values); });
  raised = raised_now();
  return a;
}

/// Keeps the answers of a batch in memory of the host's own, and writes them into the shared memory. So a wild write of
/// the subject over the shared memory is noticed, and the answers are written again.
class PublishedAnswers {
 public:
  explicit PublishedAnswers(wire::SharedAnswers& shared) : shared_(shared) {}

  void begin(const wire::SharedRequest& asked) {
    first_ = asked.first, batch_ = asked.batch, numbers_at_ = asked.numbers_at;
    heads_.clear(), numbers_.clear(), reasons_.clear();
  }
  /// True where the count of the answers, or the last one, is not as add() has written it. Asked after each call, it
  /// tells which one did it.
  bool is_end_overwritten() const {
    if (shared_.done.load(std::memory_order_relaxed) != first_ + heads_.size()) return true;
    return !heads_.empty() &&
           // The bits as they were written. NOLINTNEXTLINE(bugprone-suspicious-memory-comparison)
           std::memcmp(&heads_.back(), &shared_.heads[first_ + heads_.size() - 1], sizeof heads_.back()) != 0;
  }
  /// True where an answer is not as add() has written it.
  bool is_overwritten() const {
    const auto differ = [](const auto& kept, const auto* shared) {
      return !kept.empty() && std::memcmp(kept.data(), shared, kept.size() * sizeof kept.front()) != 0;
    };
    return differ(heads_, shared_.heads.data() + first_) || differ(numbers_, shared_.numbers.data() + numbers_at_);
  }
  void restore() {
    std::copy(heads_.begin(), heads_.end(), shared_.heads.begin() + std::ptrdiff_t(first_));
    std::copy(numbers_.begin(), numbers_.end(), shared_.numbers.begin() + std::ptrdiff_t(numbers_at_));
    for (const auto& [i, why] : reasons_) shared_.reasons[i] = why;
  }
  void add(const Answer& a, std::uint8_t raised) {
    const std::size_t i = first_ + heads_.size(), at = numbers_at_ + numbers_.size();
    heads_.push_back(wire::head_of(batch_, i, a, raised));
    numbers_.insert(numbers_.end(), a.values.begin(), a.values.begin() + a.count);
    if (a.status != Answer::Status::answered) reasons_.emplace_back(i, a.why);
    wire::put(shared_, i, at, heads_.back(), a);
    shared_.done.store(std::uint32_t(i + 1), std::memory_order_release);
  }

 private:
  wire::SharedAnswers& shared_;
  std::size_t first_ = 0, numbers_at_ = 0;
  std::uint32_t batch_ = 0;
  std::vector<wire::SharedAnswers::Head> heads_;
  std::vector<double> numbers_;
  std::vector<std::pair<std::size_t, decltype(Answer::why)>> reasons_;
};

void answer_batch(const AnswerFunction& answer, const wire::SharedRequest& asked, PublishedAnswers& answered) {
  const std::size_t count = asked.count;
  answered.begin(asked);
  for (std::size_t i = asked.first; i < count; ++i) {
    const std::span<const double> values = asked.numbers(i, i + 1)[0];
    std::uint8_t raised = 0;
    Answer a = asked.rounding == Rounding::its_own ? answer_or_broke([&] { return answer(values); })
                                                   : answer_in(asked.rounding, answer, values, raised);
    if (answered.is_end_overwritten()) {
      answered.restore();
      a = Answer::without(Answer::Status::broke, "wrote over the memory that holds its answers");
    }
    answered.add(a, raised);
  }
}

}  // namespace

void serve(int from_judge, int to_judge, const wire::SharedRequest& asked, wire::SharedAnswers& answered,
           std::span<const OfferedFunctions> offers) {
  PublishedAnswers published(answered);
  while (wait_for_wake_up(from_judge)) {
    const OfferedFunctions offer = offers.empty() ? OfferedFunctions{asked.answer} : offers[asked.offer];
    if (asked.timed) {
      time_batch(offer, asked, answered);
    } else {
      answer_batch(offer.answer, asked, published);
    }
    const bool is_overwritten = !asked.timed && published.is_overwritten();
    if (is_overwritten) published.restore();
    if (!write_all(to_judge, is_overwritten ? wire::all_done_and_overwritten : wire::all_done)) return;
  }
}

std::string hello_of(const Subject& subject) {
  Json j{{"nearmiss", wire::version},         {"name", subject.name},         {"version", subject.version},
         {"scalar", name_of(subject.scalar)}, {"batches", "shared"},          {"layout", shared_layout(catalogue())},
         {"offers", Json::array()},           {"not_offered", Json::object()}};
  for (const Offering& o : subject.offerings) {
    if (o.offer == Offer::not_offered) {
      j["not_offered"][o.query] = o.how;
      continue;
    }
    Json requires_names = Json::array();
    for (const Precondition p : all_preconditions) {
      if (o.required.has(p)) requires_names.push_back(name_of(p));
    }
    Json offer{{"query", o.query},
               {"by_equivalence", o.offer == Offer::by_equivalence},
               {"how", o.how},
               {"contract", contract_to_json(o.contract)},
               {"requires", requires_names}};
    for (const Declaration& d : o.declared)
      offer["declares"].push_back({{"convention", name_of(d.convention)}, {"sentence", d.sentence}});
    if (o.counts) offer["inputs"] = o.counts->inputs, offer["outputs"] = o.counts->outputs;
    j["offers"].push_back(std::move(offer));
  }
  return j.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string refusal(const std::string& why) {
  return Json{{"nearmiss", wire::version}, {"refused", why}}.dump(-1, ' ', false, Json::error_handler_t::replace) +
         "\n";
}

int send_refusal(const std::string& why) { return write_all(wire::to_judge, refusal(why)) ? 0 : 1; }

void begin_host() {
  for (const int file : {wire::from_judge, wire::to_judge, wire::shared_request, wire::shared_answers,
                         wire::plugin_folder, wire::plugin_file})
    fcntl(file, F_SETFD, FD_CLOEXEC);
  if (std::getenv("NEARMISS_UNDUMPABLE") != nullptr) prctl(PR_SET_DUMPABLE, 0);
}

int run_built_in_host(Subject (*subject)(), StageTallyFunction stages) {
  begin_host();
  FloatingPointModes::standard().set();  // a library may have changed them when it was loaded
  return run_host(subject(), stages);
}

int run_host(const Subject& subject, StageTallyFunction stages) {
  const auto* asked = mapped<const wire::SharedRequest>(wire::shared_request, PROT_READ);
  auto* answered = mapped<wire::SharedAnswers>(wire::shared_answers, PROT_READ | PROT_WRITE);
  if (asked == nullptr || answered == nullptr) {
    std::fputs("this program is a part of nearmiss, which starts it where a subject is to be asked\n", stderr);
    return 2;
  }
  std::vector<OfferedFunctions> offers;
  for (const Offering& o : subject.offerings) {
    if (o.offer != Offer::not_offered) offers.push_back({o.answer, o.time, stages});
  }
  if (!write_all(wire::to_judge, hello_of(subject))) return 1;
  FloatingPointModes::standard().set();
  serve(wire::from_judge, wire::to_judge, *asked, *answered, offers);
  return 0;
}

}  // namespace nearmiss

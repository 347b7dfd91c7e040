#include "impl/host/serve.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <vector>

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

void answer_batch(const AnswerFunction& answer, const wire::SharedRequest& asked, wire::SharedAnswers& answered) {
  const std::size_t count = asked.count, inputs = asked.inputs;
  std::size_t used = 0;
  for (std::size_t i = asked.first; i < count; ++i) {
    const std::span<const double> values{asked.values.data() + i * inputs, inputs};
    std::uint8_t raised = 0;
    const Answer a = asked.rounding == Rounding::its_own ? answer_or_broke([&] { return answer(values); })
                                                         : answer_in(asked.rounding, answer, values, raised);
    answered.heads[i] = {a.status, a.yes, a.count, a.cause, raised, a.given};
    std::copy_n(a.values.begin(), a.count, answered.numbers.begin() + std::ptrdiff_t(used));
    if (a.status != Answer::Status::answered) answered.reasons[i] = a.why;
    used += a.count;
    answered.done.store(std::uint32_t(i + 1), std::memory_order_release);
  }
}

}  // namespace

void serve(int from_judge, int to_judge, const wire::SharedRequest& asked, wire::SharedAnswers& answered,
           std::span<const OfferedFunctions> offers) {
  while (wait_for_wake_up(from_judge)) {
    const OfferedFunctions offer = offers.empty() ? OfferedFunctions{asked.answer} : offers[asked.offer];
    if (asked.timed) {
      time_batch(offer, asked, answered);
    } else {
      answer_batch(offer.answer, asked, answered);
    }
    if (!write_all(to_judge, "d")) return;
  }
}

std::string hello_of(const Subject& subject) {
  Json j{{"nearmiss", wire::version},         {"name", subject.name},    {"version", subject.version},
         {"scalar", name_of(subject.scalar)}, {"batches", "shared"},     {"layout", shared_layout(catalogue())},
         {"referee", subject.referee},        {"offers", Json::array()}, {"not_offered", Json::object()}};
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

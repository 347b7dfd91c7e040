/// A tier of `collide` as a program (docs/reference/protocol.md, in binary), so that builds by any compiler, for any
/// processor, can be compared: `subject TIER SCALAR NAME`. `make` beside it compiles it with the chosen queries and,
/// where COMPILED_TIERS is defined, with the tiers Decisive and Certified.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#if defined(COMPILED_TIERS)
#include "impl/adapters/collide_all_tiers.hpp"
#else
#include "impl/adapters/collide_tiers.hpp"
#endif
#include "chosen_functions.hpp"  // written by `make`: nearmiss/collide_functions/QUERY.hpp of each chosen query

namespace {

using nearmiss::Answer;

struct Offer {
  const char* query;
  Answer (*answer)(const double* numbers);
  collide::Contract contract;
};

/// Without the attribute flatten of the adapter, with which GCC contracts (impl/collide/README.md).
template <class Tier, class Q>
Offer offer_of(const char* query) {
  return {query,
          [](const double* numbers) {
            return nearmiss::erase(nearmiss::adapters::ask_collide<Tier>(nearmiss::inputs_from<Q>(numbers)));
          },
          nearmiss::adapters::CollideFunction<Q>::template contract<Tier>()};
}

template <class Tier, class T>
std::vector<Offer> offers_in() {
  return {
#define NEARMISS_QUERY(query) offer_of<Tier, nearmiss::inputs::query<T>>(#query),
#include "chosen.def"  // written by `make`
#undef NEARMISS_QUERY
  };
}

template <class Tier>
std::vector<Offer> offers_in(std::string_view scalar) {
  return scalar == "float" ? offers_in<Tier, float>() : offers_in<Tier, double>();
}

std::vector<Offer> offers_of(std::string_view tier, std::string_view scalar) {
  if (tier == "fast") return offers_in<collide::Fast>(scalar);
  if (tier == "accurate") return offers_in<collide::Accurate>(scalar);
#if defined(COMPILED_TIERS)
  if (tier == "decisive") return offers_in<collide::Decisive>(scalar);
  if (tier == "certified") return offers_in<collide::Certified>(scalar);
#endif
  return {};
}

std::string bound_text(double x) {
  if (!std::isfinite(x)) return "null";
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", x);
  return text;
}

std::string contract_text(const collide::Contract& c) {
  return "{\"backward\": " + bound_text(c.backward) + ", \"forward\": " + bound_text(c.forward) +
         ", \"unit\": " + bound_text(c.unit) + ", \"exact_decisions\": " + (c.exact_decisions ? "true" : "false") +
         ", \"lowest\": " + std::to_string(c.lowest) + ", \"highest\": " + std::to_string(c.highest) + "}";
}

std::string hello_of(const std::vector<Offer>& offers, const std::string& name, const std::string& scalar) {
  std::string text = "{\"nearmiss\": 3, \"name\": \"" + name + "\", \"version\": \"" +
                     nearmiss::adapters::collide_version() + "\", \"scalar\": \"" + scalar +
                     "\", \"batches\": \"binary\", \"offers\": [";
  for (const Offer& o : offers) {
    if (&o != &offers.front()) text += ", ";
    text += "{\"query\": \"" + std::string(o.query) + "\", \"contract\": " + contract_text(o.contract) + "}";
  }
  return text + "]}\n";
}

struct Batch {
  std::uint32_t offer, count, first, numbers;
};
struct Reply {
  std::uint8_t status, yes;
  std::uint16_t reason;
  std::uint32_t number;
  std::uint64_t given;
};

template <class T>
bool read_all(std::vector<T>& into, std::size_t count, std::FILE* from) {
  into.resize(count);
  return std::fread(into.data(), sizeof(T), count, from) == count;
}

void write_answer(const Answer& a, std::uint32_t number, std::FILE* to) {
  const Reply reply{std::uint8_t(a.status), a.yes, 0, number, a.given};
  std::fwrite(&reply, sizeof reply, 1, to);
  std::fwrite(a.values.data(), sizeof(double), a.count, to);
}

/// False where the batch is not whole.
bool answer_batch(const Batch& batch, const std::vector<Offer>& offers, std::FILE* cases, std::FILE* answers) {
  std::vector<std::uint32_t> lengths;
  std::vector<double> numbers;
  if (!read_all(lengths, batch.count, cases) || !read_all(numbers, batch.numbers, cases)) return false;
  const double* next = numbers.data();
  for (std::uint32_t i = 0; i < batch.count; ++i, next += lengths[i - 1])
    write_answer(offers[batch.offer].answer(next), batch.first + i, answers);
  return std::fflush(answers) == 0;
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  if (words.size() != 3) return std::fputs("subject TIER SCALAR NAME\n", stderr), 2;
  const std::vector<Offer> offers = offers_of(words[0], words[1]);
  std::FILE *cases = fdopen(3, "rb"), *answers = fdopen(4, "wb");
  if (cases == nullptr || answers == nullptr) return std::fputs("files 3 and 4 must be open\n", stderr), 2;
  std::fputs(hello_of(offers, words[2], words[1]).c_str(), answers);
  std::fflush(answers);
  for (Batch batch; std::fread(&batch, sizeof batch, 1, cases) == 1;) {
    if (!answer_batch(batch, offers, cases, answers)) return 1;
  }
  return 0;
}

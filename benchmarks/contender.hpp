/// A contender: one way to answer a query. The benchmarks time all contenders of a query on the same cases.
#pragma once

#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "benchmarks/timed_cases.hpp"
#include "impl/catalogue/answer.hpp"

namespace nearmiss::benchmarks {

class Contender {
 public:
  virtual ~Contender() = default;
  /// Makes the objects that exist before a call: shapes, poses, prepared operands. Not timed.
  virtual void prepare(const TimedCases& cases) = 0;
  /// Answers every case once, in the order of this pass.
  virtual void pass(std::size_t pass) = 0;
  virtual void ask(std::size_t index) = 0;
  virtual bool yes(std::size_t index) = 0;
  /// The share of cases that each stage answered, by name; empty for a contender without stages.
  virtual std::vector<std::pair<std::string, double>> stages() { return {}; }
};

/// The i-th case of a pass. Cases are in random order, and each pass uses another order, so that no branch predictor
/// can learn it. `cases` must be a power of two.
inline std::size_t case_in_pass(std::size_t i, std::size_t pass, std::size_t cases) {
  const std::size_t stride = 2 * (pass * 0x9e3779b97f4a7c15 >> 32) + 1;  // odd, and cases a power of two
  return (i * stride) & (cases - 1);
}

/// Registers a contender as the benchmark QUERY/LIBRARY/WAY/SCALAR.
void register_contender(std::string query, std::string library, std::string way, std::unique_ptr<Contender> contender);

/// Adds an entry to the context of the results: "FCL", "0.7.0".
void add_context(const std::string& what, const std::string& value);

/// The answer of a library other than collide: a decision, and a number where it has one.
struct LibraryAnswer {
  bool answer = false;
  double number = 0;
  bool yes() const { return answer; }
};

/// An optimization barrier: forces the compiler to compute the value, and to assume that all memory changed.
template <class T>
inline void keep(const T& value) {
  asm volatile("" : : "m"(value) : "memory");
}

/// A contender with cases of type Asked, which are made from Q, the inputs of a query, and answer by `ask()`. `Tier`
/// may count its stages.
template <class Asked, class Q, class Tier = void>
class ContenderOf final : public Contender {
 public:
  ~ContenderOf() override { clear(); }
  void prepare(const TimedCases& cases) override {
    clear();
    capacity_ = cases.size();
    cases_ = std::allocator<Placed>().allocate(capacity_);  // contiguous; a case need not be movable
    for (const auto& values : cases.values) std::construct_at(cases_ + size_++, inputs_from<Q>(values.data()));
  }
  void pass(std::size_t pass) override {
    const Placed* const cases = cases_;  // the loop is timed: locals avoid reading the members in each iteration
    const std::size_t size = size_;
    for (std::size_t i = 0; i < size; ++i) keep(cases[case_in_pass(i, pass, size)].asked.ask());
  }
  void ask(std::size_t index) override { keep(cases_[index].asked.ask()); }
  bool yes(std::size_t index) override { return cases_[index].asked.ask().yes(); }
  std::vector<std::pair<std::string, double>> stages() override {
    if constexpr (requires { Tier::counts(); }) {
      const auto before = Tier::counts();
      pass(0);
      const auto after = Tier::counts();
      const auto share = [&](auto stage) { return double(after.*stage - before.*stage) / double(size_); };
      using Counts = std::remove_cvref_t<decltype(after)>;
      return {
          {"filter", share(&Counts::filter)}, {"extended", share(&Counts::extended)}, {"exact", share(&Counts::exact)}};
    }
    return {};
  }

 private:
  /// A case at the start of a cache line, so that it occupies as few lines as possible.
  struct alignas(64) Placed {
    explicit Placed(const Q& q) : asked(q) {}
    Asked asked;
  };

  void clear() {
    if (cases_ == nullptr) return;
    std::destroy_n(cases_, size_);
    std::allocator<Placed>().deallocate(cases_, capacity_);
    cases_ = nullptr;
    size_ = 0;
  }
  Placed* cases_ = nullptr;
  std::size_t size_ = 0, capacity_ = 0;
};

}  // namespace nearmiss::benchmarks

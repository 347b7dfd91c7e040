/// The bound by which the judge accepts an answer: the subject's contract, or the measure where it promises nothing.
#pragma once

#include <collide/contract.hpp>

#include "impl/subject/precondition.hpp"

namespace nearmiss {

struct Standard {
  collide::Contract contract;
  bool promised = true;      ///< false: the bound is the measure, not a promise of the subject
  Preconditions required{};  ///< a case that is not proved to meet them is neither asked nor judged

  Standard(const collide::Contract& c = {}, bool is_promised = true, Preconditions r = {})
      : contract(c), promised(is_promised), required(r) {}
};

/// True for a contract that no answer can violate.
inline bool promises_nothing(const collide::Contract& c) {
  constexpr double none = collide::Contract::none;
  return c.backward == none && c.forward == none && c.unit == none && !c.exact_decisions;
}

/// True for a contract with exact decisions and a bound on how far each number is from an exact one.
inline bool promises_every_digit(const collide::Contract& c) {
  return c.exact_decisions && c.forward < collide::Contract::none;
}

}  // namespace nearmiss

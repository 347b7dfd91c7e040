/// What the judge holds an answer to: the subject's contract, or the measure where it promises nothing, and the
/// conventions that it declares.
#pragma once

#include <collide/contract.hpp>

#include "impl/subject/convention.hpp"
#include "impl/subject/precondition.hpp"

namespace nearmiss {

struct Standard {
  collide::Contract contract;
  bool promised = true;      ///< false: the bound is the measure, not a promise of the subject
  Preconditions required{};  ///< a case that is not proved to meet them is neither asked nor judged
  Conventions declared{};    ///< what the subject declares: the meaning by which its answers are judged

  Standard(const collide::Contract& c = {}, bool is_promised = true, Preconditions r = {}, Conventions d = {})
      : contract(c), promised(is_promised), required(r), declared(d) {}
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

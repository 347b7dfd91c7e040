/// What an answer is held to: a subject's own promise, or a measure that somebody applies to it.
#pragma once

#include <collide/contract.hpp>

#include "impl/subject/precondition.hpp"

namespace nearmiss {

struct Standard {
  collide::Contract contract;
  bool promised = true;      ///< false: the subject has not promised this
  Preconditions required{};  ///< a case that does not surely meet them is not asked, and never judged

  Standard(const collide::Contract& c = {}, bool is_promised = true, Preconditions r = {})
      : contract(c), promised(is_promised), required(r) {}
};

/// True for a contract that no answer can break.
inline bool promises_nothing(const collide::Contract& c) {
  constexpr double none = collide::Contract::none;
  return c.backward == none && c.forward == none && c.unit == none && !c.exact_decisions;
}

}  // namespace nearmiss

/// Answers instead of exceptions.
#pragma once

#include <exception>
#include <new>
#include <string>

#include "impl/subject/adapter.hpp"

namespace nearmiss {

/// The answer that `ask` returns; what it throws is the reason of a broken one.
template <class Ask>
Answer answer_or_broke(const Ask& ask) {
  try {
    return ask();
  } catch (const std::bad_alloc&) {
    return Answer::without(Answer::Status::broke, "memory limit reached");
  } catch (const std::exception& e) {
    return Answer::without(Answer::Status::broke, std::string(reason_prefix(BreakCause::exception)) + e.what(),
                           BreakCause::exception);
  } catch (...) {
    return Answer::without(Answer::Status::broke, "exception that is no std::exception", BreakCause::exception);
  }
}

/// An adapter of which no exception comes: for one that runs where nobody else could catch it.
template <class Adapter>
struct Contained : Adapter {
  template <class Q>
    requires requires(const Q& q) { Adapter::answer(q); }
  static Answer answer(const Q& q) {
    return answer_or_broke([&] { return erase(Adapter::answer(q)); });
  }
};

}  // namespace nearmiss

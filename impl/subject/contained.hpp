/// Turns exceptions of a subject into answers.
#pragma once

#include <exception>
#include <new>
#include <string>

#include "impl/subject/adapter.hpp"

namespace nearmiss {

/// The answer that `ask` returns, or an answer with the status `broke` and the exception as its reason.
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

/// An adapter that never throws: for adapters that run where no caller catches exceptions.
template <class Adapter>
struct Contained : Adapter {
  template <class Q>
    requires requires(const Q& q) { Adapter::answer(q); }
  static Answer answer(const Q& q) {
    return answer_or_broke([&] { return erase(Adapter::answer(q)); });
  }
};

}  // namespace nearmiss

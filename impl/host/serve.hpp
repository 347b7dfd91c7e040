/// A host's side of the wall: it answers batches until the judge hangs up.
#pragma once

#include <span>
#include <string>

#include "impl/host/wire.hpp"

namespace nearmiss {

/// Answers in shared memory, for as long as the judge is there. `offers` are those of the hello, or empty where the
/// request has the function itself.
void serve(int from_judge, int to_judge, const wire::SharedRequest& asked, wire::SharedAnswers& answered,
           std::span<const AnswerFunction> offers);

/// What a host says of its subject, as one line of JSON.
std::string hello_of(const Subject& subject);
/// In place of it: why there is no subject.
std::string refusal(const std::string& why);

/// The whole life of a host that this project started: says hello, then serves; returns its exit code.
int host(const Subject& subject);
/// The same for a subject of this build.
int host_of(Subject (*subject)());
/// Says why there is none.
int refuse(const std::string& why);

}  // namespace nearmiss

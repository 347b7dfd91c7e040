/// The server side of a host: answers batches until the judge closes the pipe.
#pragma once

#include <span>
#include <string>

#include "impl/host/wire.hpp"
#include "impl/subject/stages.hpp"

namespace nearmiss {

/// The functions of an offer.
struct OfferedFunctions {
  AnswerFunction answer;
  TimeFunction time = nullptr;
  StageTallyFunction stages = nullptr;
};

/// Answers batches in shared memory until the judge closes the pipe. `offers` are the offers of the hello; empty: the
/// request holds the function itself.
void serve(int from_judge, int to_judge, const wire::SharedRequest& asked, wire::SharedAnswers& answered,
           std::span<const OfferedFunctions> offers);

/// The hello of a subject, one line of JSON.
std::string hello_of(const Subject& subject);
/// The line in place of a hello that reports why there is no subject.
std::string refusal(const std::string& why);

/// What a host does first: its files are not for programs that its library starts with exec, and where no user and no
/// namespace separates it from other hosts it is not dumpable, so that they cannot open its files or its memory.
void begin_host();

/// The main function of a host of this project: sends the hello, then serves. Returns the exit code.
int run_host(const Subject& subject, StageTallyFunction stages = nullptr);
/// Sends a refusal(); returns the exit code.
int send_refusal(const std::string& why);

}  // namespace nearmiss

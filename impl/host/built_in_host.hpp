/// The main function of the host of a subject of this build. Apart from serve.hpp, because each of these programs
/// includes it and nothing else.
#pragma once

#include "impl/subject/stages.hpp"

namespace nearmiss {

struct Subject;

/// Creates the subject after the pipes are protected, sends its hello, then serves. Returns the exit code.
int run_built_in_host(Subject (*subject)(), StageTallyFunction stages = nullptr);

}  // namespace nearmiss

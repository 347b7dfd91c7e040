/// The query of a fuzz target: the one line that its targets do not share, written by CMake.
#pragma once

namespace nearmiss {
extern const char* const fuzzed_query;
}

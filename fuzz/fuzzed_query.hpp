/// The query of a fuzz target. CMake writes its definition, the only source that the targets do not share.
#pragma once

namespace nearmiss {
extern const char* const fuzzed_query;
}

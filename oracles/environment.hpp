/// The floating-point environment on which every result here rests.
#pragma once

#include <optional>
#include <string>

namespace nearmiss {

/// What is wrong with the arithmetic of this build on this machine, in one line; empty when nothing
/// is. Asked once at the start of every program. Works in any modes (impl/subject/floating_point.hpp) and leaves them.
std::optional<std::string> broken_environment();

}  // namespace nearmiss

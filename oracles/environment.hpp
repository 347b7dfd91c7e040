/// The floating-point environment that every result depends on.
#pragma once

#include <optional>
#include <string>

namespace nearmiss {

/// Checks the arithmetic of this build on this machine. Returns one line that names the first fault; empty if there is
/// none. Every program calls it once at its start. Works in any floating-point modes (impl/subject/floating_point.hpp)
/// and restores them.
std::optional<std::string> broken_environment();

}  // namespace nearmiss

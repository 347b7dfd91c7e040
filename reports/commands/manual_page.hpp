/// Prints the manual of the command line and of each command in the form of man pages.
#pragma once

#include <string>

#include "reports/commands/command.hpp"

namespace nearmiss {

std::string manual_page(const CLI::App& command, const Manual& manual);
/// The page of the whole program: its purpose and its commands.
std::string overview_page(const CLI::App& root);

}  // namespace nearmiss

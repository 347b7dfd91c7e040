/// Lets a host that has a user of its own reach the files that it is started with, where these lie in a folder that is
/// closed to other users: a clone in the superuser's home.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace nearmiss {

/// What must be exposed for these names and the current folder to be reached by every user: entries of folders that are
/// closed to other users. Names of no file need nothing.
std::vector<std::filesystem::path> hidden_paths(std::span<const std::string> names);

/// Makes the paths, of hidden_paths(), reachable in this process's own mount namespace: each closed folder above them
/// is covered with an empty one that has nothing but them. Needs the rights of the superuser. Returns 0 or an errno.
int expose(std::span<const std::filesystem::path> paths);

}  // namespace nearmiss

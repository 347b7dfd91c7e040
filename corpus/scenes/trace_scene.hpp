/// A scene from recorded cases.
#pragma once

#include <filesystem>
#include <vector>

#include "corpus/scenes/scene_file.hpp"

namespace nearmiss::scenes {

/// Writes the scene file, which must end with .json, and the cases beside it, as .jsonl. The extent and the mix are
/// those of the cases. What the scene requires is chosen from their sizes: a program's author replaces these numbers by
/// those that the program needs. `from` names the recording in the sources of numbers. Returns the scene as it reads
/// back. Throws BadInput for another name or for no case, and IoError.
Scene write_trace_scene(const std::filesystem::path& file, const std::vector<Case>& cases, const std::string& from);

}  // namespace nearmiss::scenes

/// The main of a fuzz target without libFuzzer: replays every file in the arguments and every file in folders in the
/// arguments. A .json file is a case file; any other file holds bytes. Exit code 0: all files replayed; 2: no file, or
/// a file that is not a case. A violation aborts.
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "corpus/storage/codec.hpp"
#include "corpus/storage/fuzz_target.hpp"
#include "fuzz/this_target.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace nearmiss {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> files_of(const fs::path& named) {
  if (!fs::is_directory(named)) return {named};
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(named)) {
    if (entry.is_regular_file()) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<std::uint8_t> bytes_of(const fs::path& file) {
  if (file.extension() == ".json") {
    const Case c = read_case(file);
    const FuzzTarget* const target = find_fuzz_target(this_target);
    if (target == nullptr || !target->asks(*c.query)) {
      throw BadInput(
          fmt::format("{}: query is \"{}\", which fuzz_{} does not ask", file.string(), c.query->name, this_target));
    }
    return target->bytes_of(c);
  }
  const std::string text = read_file(file);
  return {text.begin(), text.end()};
}

void replay(const fs::path& file) {
  const std::vector<std::uint8_t> bytes = bytes_of(file);
  if (LLVMFuzzerTestOneInput(bytes.data(), bytes.size()) != 0) {
    throw BadInput(
        fmt::format("{}: no case of {}: too few bytes, inputs that break a rule, or none of the profile's scene",
                    file.string(), this_target));
  }
}

}  // namespace
}  // namespace nearmiss

int main(int argc, char** argv) try {
  std::size_t replayed = 0;
  for (int i = 1; i < argc; ++i) {
    for (const auto& file : nearmiss::files_of(argv[i])) {
      nearmiss::replay(file);
      ++replayed;
    }
  }
  if (replayed == 0)
    throw nearmiss::BadInput(fmt::format("fuzz_{}: no files to replay; usage: FILE|FOLDER ...", nearmiss::this_target));
  std::printf("fuzz_%s: %zu cases replayed\n", nearmiss::this_target, replayed);
} catch (const std::exception& e) {
  std::fprintf(stderr, "%s\n", e.what());
  return 2;
}

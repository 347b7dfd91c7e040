/// Writes every stored case of a fuzz target's queries as bytes, for a fuzzer's corpus, and removes all other files in
/// the folder. Usage: seeds_to_bytes TARGET FOLDER, where TARGET is the target's name without fuzz_.
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>

#include "corpus/files/files.hpp"
#include "corpus/storage/fuzz_target.hpp"
#include "corpus/storage/store.hpp"

namespace nearmiss {
namespace {

std::size_t write_seeds(const FuzzTarget& target, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {  // files that a fuzzer added
    if (entry.is_regular_file()) std::filesystem::remove(entry.path());
  }
  std::size_t written = 0;
  for (const Query* q : target.queries) {
    for (const StoredCase& s : stored_cases(*q)) {
      const std::vector<std::uint8_t> bytes = target.bytes_of(s.question);
      const std::string name = fmt::format("{}-{}", q->name, s.file.stem().string());
      write_file(folder / name, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
      ++written;
    }
  }
  return written;
}

}  // namespace
}  // namespace nearmiss

int main(int argc, char** argv) try {
  using namespace nearmiss;
  if (argc != 3) throw BadInput("seeds_to_bytes: expects two arguments, TARGET and FOLDER");
  const FuzzTarget* target = find_fuzz_target(argv[1]);
  if (target == nullptr) throw BadInput(fmt::format("seeds_to_bytes: {} is no fuzz target", argv[1]));
  if (write_seeds(*target, argv[2]) == 0)
    throw BadInput(fmt::format("seeds_to_bytes: {} has no stored cases", argv[1]));
} catch (const std::exception& e) {
  std::fprintf(stderr, "%s\n", e.what());
  return 2;
}

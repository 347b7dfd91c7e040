/// Writes every stored case of a query as bytes, for a fuzzer's corpus, and removes all other files in the folder.
/// Usage: seeds_to_bytes QUERY FOLDER
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>

#include "corpus/storage/codec.hpp"
#include "corpus/storage/store.hpp"

namespace nearmiss {
namespace {

std::size_t write_seeds(const Query& query, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {  // files that a fuzzer added
    if (entry.is_regular_file()) std::filesystem::remove(entry.path());
  }
  const std::vector<StoredCase> stored = stored_cases(query);
  for (const StoredCase& s : stored) {
    const std::vector<std::uint8_t> bytes = case_to_bytes(s.question);
    write_file(folder / s.file.stem(), {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  }
  return stored.size();
}

}  // namespace
}  // namespace nearmiss

int main(int argc, char** argv) try {
  using namespace nearmiss;
  if (argc != 3) throw BadInput("seeds_to_bytes: expects two arguments, QUERY and FOLDER");
  const Query* query = find_query(argv[1]);
  if (query == nullptr) throw BadInput(fmt::format("seeds_to_bytes: {} is no query", argv[1]));
  if (write_seeds(*query, argv[2]) == 0) throw BadInput(fmt::format("seeds_to_bytes: {} has no stored cases", argv[1]));
} catch (const std::exception& e) {
  std::fprintf(stderr, "%s\n", e.what());
  return 2;
}

#include "reports/builds/collide_builds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <sstream>

#include "corpus/files/errors.hpp"
#include "corpus/files/source_folder.hpp"
#include "reports/findings/encoded.hpp"

namespace nearmiss {

namespace {

namespace fs = std::filesystem;

/// The words of `make` beside builds.txt, which says what they are.
std::string make_line(const fs::path& folder, std::span<const Query* const> queries,
                      std::span<const std::string> tiers) {
  const fs::path build = fs::read_symlink("/proc/self/exe").parent_path().parent_path();
  const bool all = std::any_of(tiers.begin(), tiers.end(), is_compiled);
  std::string line;
  for (const fs::path& word : {fs::path(source_folder()) / "impl/builds/make", build / "generated",
                               build / "impl/collide/source", fs::absolute(folder)})
    line += shell_quoted(word.string()) + " ";
  line += all ? "all" : "headers";
  for (const Query* q : queries) line += fmt::format(" {}", q->name);
  return line;
}

std::string output_of(const std::string& line) {
  std::FILE* pipe = popen(line.c_str(), "r");
  if (pipe == nullptr) throw BadInput("--collide: a shell cannot be started");
  std::string text;
  char part[4096];
  for (std::size_t n; (n = std::fread(part, 1, sizeof part, pipe)) > 0;) text.append(part, n);
  if (pclose(pipe) != 0) throw BadInput("--collide: a compiler failed; its messages are above");
  return text;
}

}  // namespace

bool is_compiled(const std::string& tier) { return tier == "decisive" || tier == "certified"; }

CollideBuilds build_collide(const fs::path& folder, std::span<const Query* const> queries,
                            std::span<const std::string> tiers) {
  CollideBuilds all;
  std::istringstream lines(output_of(make_line(folder, queries, tiers)));
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("built ")) {
      all.notes.push_back(line);
      continue;
    }
    std::istringstream words(line);
    CollideBuild b;
    std::string built, exact;
    words >> built >> b.name >> b.base >> exact >> std::ws;
    std::getline(words, b.command);
    if (b.base == "-") b.base.clear();
    b.has_every_tier = exact == "all";
    all.built.push_back(std::move(b));
  }
  return all;
}

std::string subject_of(const CollideBuild& build, const std::string& tier, const std::string& scalar) {
  return fmt::format("collide-{}-{}-{}", tier, scalar, build.name);
}

}  // namespace nearmiss

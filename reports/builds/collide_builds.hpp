/// Builds of collide by other compilers and flags, for other processors (impl/builds/builds.txt).
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "impl/catalogue/query.hpp"

namespace nearmiss {

inline constexpr const char* collide_tiers[] = {"fast", "accurate", "decisive", "certified"};

/// True for Decisive and Certified, which are a compiled library.
bool is_compiled(const std::string& tier);

struct CollideBuild {
  std::string name;
  std::string base;     ///< the name of the build with the same bits; empty for one that others are compared with
  std::string command;  ///< with the words TIER SCALAR SUBJECT behind it a program of the protocol
  bool has_every_tier = true;  ///< false: without Decisive and Certified
};

struct CollideBuilds {
  std::vector<CollideBuild> built;
  std::vector<std::string> notes;  ///< what is not installed
};

/// Has them built in the folder, with these queries. Progress and errors of compilers go to standard error. Throws
/// BadInput where a compiler fails.
CollideBuilds build_collide(const std::filesystem::path& folder, std::span<const Query* const> queries,
                            std::span<const std::string> tiers);

/// The name of the subject: "collide-fast-float-gcc-o2".
std::string subject_of(const CollideBuild& build, const std::string& tier, const std::string& scalar);

}  // namespace nearmiss

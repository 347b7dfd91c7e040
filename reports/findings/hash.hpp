/// Short identifiers of findings, the same in every run.
#pragma once

#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <string>
#include <string_view>

#include "impl/catalogue/case.hpp"

namespace nearmiss {

/// The FNV-1a hash, with a separator after each part.
class Fnv1a {
 public:
  void add(std::string_view bytes) {
    for (const unsigned char c : bytes) hash_ = (hash_ ^ c) * 0x100000001b3u;
    hash_ = (hash_ ^ 0xffu) * 0x100000001b3u;
  }
  /// Adds the bits of a number.
  void add(double x) { add(std::string_view(fmt::format("{:016x}", std::bit_cast<std::uint64_t>(x)))); }
  void add(const Case& c) {
    add(c.query->name);
    for (const double x : c.values) add(x);
  }
  std::uint64_t value() const { return hash_; }
  /// Twelve hexadecimal digits.
  std::string id() const { return fmt::format("{:012x}", hash_ >> 16); }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325u;
};

}  // namespace nearmiss

/// The retention rule for reports: of each kind the first few findings of each variant, and then findings at least
/// twice as bad as any kept before.
#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace nearmiss {

class Retention {
 public:
  /// How many of the first findings are kept: of each variant of a kind, and of all variants of a kind together.
  struct First {
    std::uint64_t of_a_variant, of_a_kind;
  };
  /// True where a finding of this kind and variant (any number) is kept. `above` is its proved bound, which orders the
  /// findings of a kind; 0 or negative: no bound.
  bool keep(const std::string& kind, std::uint64_t variant, double above, First first);
  /// The result of keep(), without keeping.
  bool would_keep(const std::string& kind, std::uint64_t variant, double above, First first) const;
  /// The same for a kind without variants.
  bool keep(const std::string& kind, double above, std::uint64_t first_few) {
    return keep(kind, 0, above, {first_few, first_few});
  }

 private:
  struct Kept {
    std::uint64_t count = 0;
    double worst = 0;
    std::map<std::uint64_t, std::uint64_t> variants;  ///< at most First::of_a_kind
  };
  std::map<std::string, Kept> kept_;
};

}  // namespace nearmiss

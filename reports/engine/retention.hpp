/// The retention rule for reports: of each kind the first few findings, and then findings at least twice as bad as any
/// kept before.
#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace nearmiss {

class Retention {
 public:
  /// True where a finding of this kind is kept. `above` is its proved bound, which orders the findings of a kind; 0 or
  /// negative: no bound.
  bool keep(const std::string& kind, double above, std::uint64_t first_few);

 private:
  struct Kept {
    std::uint64_t count = 0;
    double worst = 0;
  };
  std::map<std::string, Kept> kept_;
};

}  // namespace nearmiss

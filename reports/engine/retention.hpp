/// Which of many findings are kept as reports: of each kind the first few, and then those that are at least twice as
/// bad as any that was kept before.
#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace nearmiss {

class Retention {
 public:
  /// `above`: the proved bound by which two findings of a kind are compared; not above 0 where there is none.
  bool keep(const std::string& kind, double above, std::uint64_t first_few);

 private:
  struct Kept {
    std::uint64_t count = 0;
    double worst = 0;
  };
  std::map<std::string, Kept> kept_;
};

}  // namespace nearmiss

/// The rounding in which a subject is asked, and the floating-point exceptions that its answers raise.
#pragma once

#include <cfenv>
#include <cstdint>

namespace nearmiss {

/// `its_own` leaves the mode in which the subject usually runs.
enum class Rounding : std::uint8_t { its_own, to_nearest, downward, upward, toward_zero };

/// Exceptions of IEEE 754, as bits of a set.
enum Raised : std::uint8_t {
  raised_invalid = 1,
  raised_division_by_zero = 2,
  raised_overflow = 4,
  raised_underflow = 8,
  raised_inexact = 16
};
/// The exceptions whose flags are set in this thread.
inline std::uint8_t raised_now() {
  const int flags = std::fetestexcept(FE_ALL_EXCEPT);
  const auto bit = [&](int flag, Raised raised) { return (flags & flag) != 0 ? unsigned(raised) : 0u; };
  return std::uint8_t(bit(FE_INVALID, raised_invalid) | bit(FE_DIVBYZERO, raised_division_by_zero) |
                      bit(FE_OVERFLOW, raised_overflow) | bit(FE_UNDERFLOW, raised_underflow) |
                      bit(FE_INEXACT, raised_inexact));
}

/// Rounds in another direction for its lifetime.
class RoundingScope {
 public:
  explicit RoundingScope(Rounding r) {
    if (r != Rounding::its_own) std::fesetround(mode_of_c(r));
  }
  ~RoundingScope() { std::fesetround(before_); }
  RoundingScope(const RoundingScope&) = delete;
  RoundingScope& operator=(const RoundingScope&) = delete;

 private:
  static int mode_of_c(Rounding r) {
    switch (r) {
      case Rounding::downward: return FE_DOWNWARD;
      case Rounding::upward: return FE_UPWARD;
      case Rounding::toward_zero: return FE_TOWARDZERO;
      default: return FE_TONEAREST;
    }
  }

  int before_ = std::fegetround();
};

}  // namespace nearmiss

/// The modes of floating-point arithmetic: rounding, treatment of subnormal numbers, trapping exceptions. Any code of
/// the process may set them for its thread. A library that is linked with -ffast-math sets them when it is loaded.
#pragma once

#include <cfenv>
#include <cstring>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace nearmiss {

#if defined(__SSE2__)

/// The modes of a thread, without the flags of raised exceptions.
class FloatingPointModes {
 public:
  /// Rounding to nearest, subnormals kept, no traps: the default of IEEE 754, and of a new process.
  static constexpr FloatingPointModes standard() { return {0x1f80, 0x037f}; }
  static FloatingPointModes current() { return {_mm_getcsr() & ~flags, control_word()}; }
  /// Sets the modes for the rest of the thread.
  void set() const {
    asm volatile("fnclex" ::: "memory");  // the flag of an unmasked exception would trap at once
    asm volatile("fldcw %0" : : "m"(x87_));
    _mm_setcsr(mxcsr_);
  }
  bool operator==(const FloatingPointModes&) const = default;

 private:
  friend class FloatingPointScope;
  constexpr FloatingPointModes(unsigned mxcsr, unsigned short x87) : mxcsr_(mxcsr), x87_(x87) {}
  static unsigned short control_word() {
    unsigned short word = 0;
    asm volatile("fnstcw %0" : "=m"(word));
    return word;
  }

  static constexpr unsigned flags = 0x3f;
  unsigned mxcsr_;      ///< SSE: rounding, masks, flush to zero, denormals are zero
  unsigned short x87_;  ///< long double: rounding, masks, precision
};

/// Sets modes for its lifetime and then restores the thread's own modes and flags. One flag is not restored: that of an
/// x87 exception that was about to trap, because the compiler may place a wait anywhere and the wait would trap here.
/// Costs some 16 cycles where the modes are equal, and some 60 where they differ.
class FloatingPointScope {
 public:
  explicit FloatingPointScope(const FloatingPointModes& modes = FloatingPointModes::standard()) : mxcsr_(_mm_getcsr()) {
    unsigned short word;
    // One statement, because the compiler may place a wait between two.
    asm volatile(
        "fnstcw %[word]\n\t"
        "movw %[wanted], %%ax\n\t"
        "cmpw %[word], %%ax\n\t"
        "je 1f\n\t"
        "fnstenv %[all]\n\t"
        "fnclex\n\t"
        "fldcw %[wanted]\n\t"
        "1:"
        : [word] "=m"(word), [all] "=m"(x87_)
        : [wanted] "m"(modes.x87_)
        : "ax", "cc", "memory");
    other_x87_ = word != modes.x87_;
    other_mxcsr_ = (mxcsr_ & ~FloatingPointModes::flags) != modes.mxcsr_;
    if (other_mxcsr_) _mm_setcsr(modes.mxcsr_);
    asm volatile("" ::: "memory");  // no arithmetic before this
  }
  ~FloatingPointScope() {
    asm volatile("" ::: "memory");
    if (other_mxcsr_) _mm_setcsr(mxcsr_);
    if (!other_x87_) return;
    const unsigned masked = x87_.control & FloatingPointModes::flags;
    if (x87_.status & FloatingPointModes::flags & ~masked) x87_.status &= masked | ~about_to_trap;
    asm volatile("fldenv %0" : : "m"(x87_));
  }
  FloatingPointScope(const FloatingPointScope&) = delete;
  FloatingPointScope& operator=(const FloatingPointScope&) = delete;

 private:
  static constexpr unsigned about_to_trap = 0x80bf;  ///< bits of the status: busy, summary, the six exceptions
  unsigned mxcsr_;
  bool other_x87_, other_mxcsr_;
  struct {
    unsigned control, status, rest[5];
  } x87_;  ///< in the layout of fnstenv
};

#else

class FloatingPointModes {
 public:
  static FloatingPointModes standard() {
    const FloatingPointModes before = current();
    std::fesetenv(FE_DFL_ENV);
    const FloatingPointModes modes = current();
    before.set();
    return modes;
  }
  static FloatingPointModes current() {
    FloatingPointModes modes;
    std::fegetenv(&modes.environment_);
    return modes;
  }
  void set() const { std::fesetenv(&environment_); }
  bool operator==(const FloatingPointModes& other) const {
    return std::memcmp(&environment_, &other.environment_, sizeof environment_) == 0;
  }

 private:
  std::fenv_t environment_;
};

class FloatingPointScope {
 public:
  FloatingPointScope() {
    asm volatile("" ::: "memory");
    std::fesetenv(FE_DFL_ENV);
  }
  explicit FloatingPointScope(const FloatingPointModes& modes) { modes.set(); }
  ~FloatingPointScope() {
    asm volatile("" ::: "memory");
    before_.set();
  }
  FloatingPointScope(const FloatingPointScope&) = delete;
  FloatingPointScope& operator=(const FloatingPointScope&) = delete;

 private:
  FloatingPointModes before_ = FloatingPointModes::current();
};

#endif

}  // namespace nearmiss

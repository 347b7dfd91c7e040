/// The modes of floating-point arithmetic: rounding, what becomes of subnormal numbers, which exceptions trap. Any code
/// of the process may set them for its thread, and a library does so by being loaded where it is linked with
/// -ffast-math.
#pragma once

#include <cfenv>
#include <cstring>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace nearmiss {

#if defined(__SSE2__)

/// A thread's modes, without the flags of exceptions that were raised.
class FloatingPointModes {
 public:
  /// Rounding to nearest, subnormals kept, no traps: what IEEE 754 has by default, and a process begins with.
  static constexpr FloatingPointModes standard() { return {0x1f80, 0x037f}; }
  static FloatingPointModes current() { return {_mm_getcsr() & ~flags, control_word()}; }
  /// For the rest of the thread.
  void set() const {
    asm volatile("fnclex" ::: "memory");  // a flag of an exception that is to trap would trap at once
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

/// These modes for its lifetime; the thread's own come back afterwards, with their flags, except an exception of the
/// x87 unit that was about to trap: a compiler may place a wait wherever it likes, which would trap here. Some sixteen
/// cycles where the modes are the same, some sixty where they are not.
class FloatingPointScope {
 public:
  explicit FloatingPointScope(const FloatingPointModes& modes = FloatingPointModes::standard()) : mxcsr_(_mm_getcsr()) {
    unsigned short word;
    // One statement: between two, a compiler may place a wait.
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
  static constexpr unsigned about_to_trap = 0x80bf;  ///< of the status: busy, summary, the six exceptions
  unsigned mxcsr_;
  bool other_x87_, other_mxcsr_;
  struct {
    unsigned control, status, rest[5];
  } x87_;  ///< as fnstenv has it
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

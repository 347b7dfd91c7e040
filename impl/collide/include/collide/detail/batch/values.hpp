// The numbers and vectors of batches, and how blocks are loaded and stored.
//
// The files of this folder are included inside a namespace for each instruction set (detail/batch_sse2.hpp,
// detail/batch_avx2.hpp), which defines `Wide`; so they have no include guard.
#include <collide/detail/strict_begin.hpp>

/// In each lane: a where the mask is set, b elsewhere.
template <class T>
COLLIDE_BATCH_FUNCTION Wide<T> select(Wide<T> where, Wide<T> a, Wide<T> b) {
  return (a & where) | and_not(b, where);
}
template <class T>
COLLIDE_BATCH_FUNCTION Wide<T> absolute(Wide<T> a) {
  return and_not(a, Wide<T>::splat(T(-0.0)));
}
template <class T>
COLLIDE_BATCH_FUNCTION Wide<T> negated(Wide<T> a) {
  return a ^ Wide<T>::splat(T(-0.0));
}
template <class T>
COLLIDE_BATCH_FUNCTION Wide<T> every_lane() {
  return Wide<T>::splat(T(0)) == Wide<T>::splat(T(0));
}

template <class T>
struct WideVec3 {
  Wide<T> x, y, z;

  COLLIDE_BATCH_FUNCTION friend WideVec3 operator+(const WideVec3& a, const WideVec3& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  COLLIDE_BATCH_FUNCTION friend WideVec3 operator-(const WideVec3& a, const WideVec3& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  COLLIDE_BATCH_FUNCTION friend WideVec3 operator*(const WideVec3& a, Wide<T> s) { return {a.x * s, a.y * s, a.z * s}; }
  COLLIDE_BATCH_FUNCTION friend WideVec3 operator/(const WideVec3& a, Wide<T> s) { return {a.x / s, a.y / s, a.z / s}; }
  COLLIDE_BATCH_FUNCTION friend WideVec3 operator&(const WideVec3& a, Wide<T> mask) {
    return {a.x & mask, a.y & mask, a.z & mask};
  }
};
template <class T>
COLLIDE_BATCH_FUNCTION WideVec3<T> select(Wide<T> where, const WideVec3<T>& a, const WideVec3<T>& b) {
  return {select(where, a.x, b.x), select(where, a.y, b.y), select(where, a.z, b.z)};
}
template <class T>
COLLIDE_BATCH_FUNCTION Wide<T> dot(const WideVec3<T>& a, const WideVec3<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
COLLIDE_BATCH_FUNCTION WideVec3<T> cross(const WideVec3<T>& a, const WideVec3<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// a - a: 0 where a is finite, else NaN. The sum of such numbers is 0 where all are finite.
template <class T>
COLLIDE_BATCH_FUNCTION Wide<T> zero_if_finite(Wide<T> a) {
  return a - a;
}
template <class T>
COLLIDE_BATCH_FUNCTION Wide<T> zero_if_finite(const WideVec3<T>& a) {
  return (a.x - a.x) + (a.y - a.y) + (a.z - a.z);
}
/// A mask of the lanes in which every argument is finite.
template <class A, class... More>
COLLIDE_BATCH_FUNCTION auto are_finite(const A& a, const More&... more) {
  const auto sum = (zero_if_finite(a) + ... + zero_if_finite(more));
  return sum == decltype(sum){sum ^ sum};
}

template <class T>
struct WideBall {
  WideVec3<T> center;
  Wide<T> radius;
};
template <class T>
struct WidePlane {
  WideVec3<T> normal;
  Wide<T> offset;
};
template <class T>
struct WideBox {
  WideVec3<T> center, half, q;
  Wide<T> w;
};

/// Loads the arguments of a block, leaf after leaf.
template <class T>
struct Reader {
  const void* const* next;
  std::size_t at;

  COLLIDE_BATCH_FUNCTION Wide<T> number() { return Wide<T>::load(static_cast<const T*>(*next++) + at); }
  COLLIDE_BATCH_FUNCTION Wide<T> flag() { return Wide<T>::mask(static_cast<const bool*>(*next++) + at); }
  COLLIDE_BATCH_FUNCTION WideVec3<T> vec3() { return {number(), number(), number()}; }
  COLLIDE_BATCH_FUNCTION WideBall<T> ball() { return {vec3(), number()}; }
  COLLIDE_BATCH_FUNCTION WidePlane<T> plane() { return {vec3(), number()}; }
  COLLIDE_BATCH_FUNCTION WideBox<T> box() { return {vec3(), vec3(), vec3(), number()}; }
};

/// Stores the answers of a block, leaf after leaf.
template <class T>
struct Writer {
  void* const* next;
  std::size_t at;

  COLLIDE_BATCH_FUNCTION void number(Wide<T> n) { n.store(static_cast<T*>(*next++) + at); }
  COLLIDE_BATCH_FUNCTION void vec3(const WideVec3<T>& a) { number(a.x), number(a.y), number(a.z); }
  COLLIDE_BATCH_FUNCTION void flag(Wide<T> mask) {
    bool* const flags = static_cast<bool*>(*next++) + at;
    constexpr std::size_t n = Wide<T>::size < 4 ? Wide<T>::size : 4;
    for (std::size_t i = 0; i < Wide<T>::size; i += n) {
      // Copies bit k of the four to bit 8 k: 2^7 moves bit 1 there, 2^14 bit 2, 2^21 bit 3.
      const unsigned four = (unsigned(mask.bits()) >> i & 15U) * 0x204081U & 0x01010101U;
      std::memcpy(flags + i, &four, n);
    }
  }
  COLLIDE_BATCH_FUNCTION void impact(Wide<T> time, const WideVec3<T>& location, const WideVec3<T>& normal) {
    number(time), vec3(location), vec3(normal);
  }
};

/// The least squared length whose root keeps its digits.
template <class T>
inline constexpr T least_length2 = std::numeric_limits<T>::min() / std::numeric_limits<T>::epsilon();

/// The mask of squared lengths from which `unit` computes the direction directly.
template <class T>
COLLIDE_BATCH_FUNCTION Wide<T> in_range_of_unit(Wide<T> length2) {
  return (Wide<T>::splat(least_length2<T>) <= length2) &
         (length2 <= Wide<T>::splat(std::numeric_limits<T>::max() / T(16)));
}

/// Writes an impact where `hit` is set and a miss elsewhere, as `impact_where` of single queries does.
template <class T>
COLLIDE_BATCH_FUNCTION void write_impact_where(Wide<T> hit, Wide<T> time, const WideVec3<T>& location,
                                               const WideVec3<T>& normal, Writer<T>& out) {
  const Wide<T> none = and_not(Wide<T>::splat(std::numeric_limits<T>::infinity()), hit);
  out.impact(larger(none, time), location & hit, normal & hit);
}

#include <collide/detail/strict_end.hpp>

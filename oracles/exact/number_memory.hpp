/// Memory for the numbers of GMP and MPFR, with which the oracles compute.
#pragma once

#include <cstddef>
#include <vector>

namespace nearmiss {

/// Gives numbers a pool of their own. Exact numbers are small and short-lived, and malloc takes about a fifth of the
/// time of the exact stage; under the address sanitizer, which does not watch the pool, it takes far more. Call it
/// once, before any thread starts.
void use_pool_for_numbers();

/// Memory from the pool or, without one, from malloc, aligned for every type. Aborts where there is none.
void* allocate_number(std::size_t size);
/// Takes back memory of that size.
void release_number(void* p, std::size_t size);

/// The same for a standard container or CGAL.
template <class T>
struct NumberAllocator {
  using value_type = T;

  NumberAllocator() = default;
  template <class U>
  NumberAllocator(const NumberAllocator<U>&) {}

  T* allocate(std::size_t n) { return static_cast<T*>(allocate_number(n * sizeof(T))); }
  void deallocate(T* p, std::size_t n) { release_number(p, n * sizeof(T)); }
  friend bool operator==(const NumberAllocator&, const NumberAllocator&) { return true; }
};

/// A vector whose elements come from that memory.
template <class T>
using NumberVector = std::vector<T, NumberAllocator<T>>;

}  // namespace nearmiss

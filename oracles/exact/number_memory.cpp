#include "oracles/exact/number_memory.hpp"

#include <gmp.h>
#include <sys/mman.h>

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>

namespace nearmiss {

namespace {

/// The address space of the pool. The system provides a page at its first use.
constexpr std::size_t pool_size = std::size_t{1} << 30;
/// Blocks have whole multiples of this size; larger numbers than the largest block come from malloc.
constexpr std::size_t grain = 16, largest_block = 2048;

char* pool = nullptr;  // nullptr: the system gave no address space, and everything comes from malloc
std::atomic<std::size_t> pool_used{0};

struct Free {
  Free* next;
};
/// Of the model for programs and libraries that are loaded at start: the address is an addition, not a call.
[[gnu::tls_model("initial-exec")]] thread_local std::array<Free*, largest_block / grain + 1> free_blocks{};

bool is_in_pool(const void* p) { return pool != nullptr && std::uintptr_t(p) - std::uintptr_t(pool) < pool_size; }

/// At least one: a free block has to hold a pointer.
std::size_t grains_of(std::size_t size) { return size == 0 ? 1 : (size + grain - 1) / grain; }

/// nullptr where the pool has no such block.
void* take_block(std::size_t grains) {
  Free*& first = free_blocks[grains];
  if (first != nullptr) {
    Free* const block = first;
    first = block->next;
    return block;
  }
  const std::size_t at = pool_used.fetch_add(grains * grain);
  return at + grains * grain <= pool_size ? pool + at : nullptr;
}

[[noreturn]] void out_of_memory(std::size_t size) {
  std::fprintf(stderr, "no memory for a number of %zu bytes\n", size);
  std::abort();
}

void* reallocate(void* p, std::size_t old_size, std::size_t new_size) {
  if (is_in_pool(p) && grains_of(old_size) == grains_of(new_size)) return p;
  void* const moved = allocate_number(new_size);
  std::memcpy(moved, p, old_size < new_size ? old_size : new_size);
  release_number(p, old_size);
  return moved;
}

}  // namespace

void* allocate_number(std::size_t size) {
  if (pool != nullptr && size <= largest_block) {
    if (void* const block = take_block(grains_of(size))) return block;
  }
  void* const p = std::malloc(size);
  if (p == nullptr) out_of_memory(size);
  return p;
}

void release_number(void* p, std::size_t size) {
  if (!is_in_pool(p)) return std::free(p);
  Free*& first = free_blocks[grains_of(size)];
  first = new (p) Free{first};
}

void use_pool_for_numbers() {
  void* const space =
      mmap(nullptr, pool_size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (space != MAP_FAILED) pool = static_cast<char*>(space);
  mp_set_memory_functions(allocate_number, reallocate, release_number);
}

}  // namespace nearmiss

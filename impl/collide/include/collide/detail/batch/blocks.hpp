// A batch as a sequence of blocks.
// Included inside a namespace for each instruction set, as detail/batch/values.hpp says.
#include <collide/detail/strict_begin.hpp>

/// Answers all queries of a batch: blocks, the last of which may overlap the one before it. A batch smaller than a
/// block is answered one by one.
template <class Query, class T>
COLLIDE_BATCH_LOOP void answer_blocks(std::size_t count, const void* const* in, void* const* out, AnswerOne one) {
  constexpr std::size_t size = Wide<T>::size;
  constexpr int all = (1 << size) - 1;
  if (count < size) {
    for (std::size_t i = 0; i < count; ++i) one(i, in, out);
    return;
  }
  for (std::size_t next = 0; next < count; next += size) {
    const std::size_t at = next <= count - size ? next : count - size;
    Reader<T> reader{in, at};
    Writer<T> writer{out, at};
    const int left = all & ~block(Query(), reader, writer).bits();
    if (left == 0) continue;
    for (std::size_t i = 0; i < size; ++i) {
      if ((left >> i & 1) != 0) one(at + i, in, out);
    }
  }
}

#include <collide/detail/strict_end.hpp>

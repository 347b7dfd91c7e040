#include "impl/subject/isolated.hpp"

#include <dlfcn.h>

#include <stdexcept>

namespace nearmiss {

Subject isolated_subject(const char* file) {
  // A namespace of its own: the dynamic linker finds every name in the object and its libraries alone. RTLD_LOCAL would not
  // do, for names that must be unique in a process (a static variable of an inline function) are shared all the same.
  void* library = dlmopen(LM_ID_NEWLM, file, RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) throw std::runtime_error(std::string("a subject cannot be loaded: ") + dlerror());
  using Entry = const Subject* (*)();
  const auto entry = reinterpret_cast<Entry>(dlsym(library, "nearmiss_isolated_subject"));
  if (entry == nullptr) throw std::runtime_error(std::string(file) + ": it holds no subject");
  return *entry();  // a copy in memory of this side: theirs has an allocator of its own
}

}  // namespace nearmiss

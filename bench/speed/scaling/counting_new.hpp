// Replaces the global operator new and delete by ones that count. To be included by the one file of a program that has
// its main(): two inclusions do not link.
//
// Counted is what malloc gives (malloc_usable_size), which is a little more than what was asked for. Not counted: the
// stacks of threads, the pages of the program, and what C code takes from malloc itself.
#pragma once

#include <malloc.h>

#include <cstddef>
#include <cstdlib>
#include <new>

#include "speed/scaling/allocated.hpp"

namespace shortshot_bench::scaling {

inline void* counted(void* memory) {
  if (memory == nullptr) throw std::bad_alloc();
  note_allocated(malloc_usable_size(memory));
  return memory;
}

inline void count_and_free(void* memory) noexcept {
  if (memory != nullptr) note_freed(malloc_usable_size(memory));
  std::free(memory);
}

}  // namespace shortshot_bench::scaling

// The array and nothrow forms call these.
void* operator new(std::size_t size) { return shortshot_bench::scaling::counted(std::malloc(size == 0 ? 1 : size)); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  const auto align = static_cast<std::size_t>(alignment);
  return shortshot_bench::scaling::counted(std::aligned_alloc(align, (size + align) / align * align));
}
void operator delete(void* memory) noexcept { shortshot_bench::scaling::count_and_free(memory); }
void operator delete(void* memory, std::size_t) noexcept { shortshot_bench::scaling::count_and_free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { shortshot_bench::scaling::count_and_free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  shortshot_bench::scaling::count_and_free(memory);
}

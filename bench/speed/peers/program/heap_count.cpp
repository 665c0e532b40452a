// Replaces malloc for the whole program, PCL's libraries included, by the C library's own under a second name (glibc).
// While nothing is counted that costs a test of a flag.

#include "heap_count.hpp"

#include <malloc.h>

#include <atomic>
#include <cerrno>

extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* memory, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
void __libc_free(void* memory);
}

namespace {

std::atomic<bool> counting{false};
std::atomic<long> bytes_now{0};
std::atomic<long> bytes_most{0};

void* counted(void* memory) {
  if (counting && memory != nullptr) {
    const auto size = static_cast<long>(malloc_usable_size(memory));
    const long now = bytes_now += size;
    for (long most = bytes_most; now > most && !bytes_most.compare_exchange_weak(most, now);) {
    }
  }
  return memory;
}

void discount(void* memory) {
  if (counting && memory != nullptr) bytes_now -= static_cast<long>(malloc_usable_size(memory));
}

}  // namespace

extern "C" {

void* malloc(std::size_t size) noexcept { return counted(__libc_malloc(size)); }

void* calloc(std::size_t count, std::size_t size) noexcept { return counted(__libc_calloc(count, size)); }

void* realloc(void* memory, std::size_t size) noexcept {
  discount(memory);
  return counted(__libc_realloc(memory, size));
}

void* memalign(std::size_t alignment, std::size_t size) noexcept { return counted(__libc_memalign(alignment, size)); }

void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept {
  return counted(__libc_memalign(alignment, size));
}

int posix_memalign(void** memory, std::size_t alignment, std::size_t size) noexcept {
  *memory = counted(__libc_memalign(alignment, size));
  return *memory == nullptr ? ENOMEM : 0;
}

void free(void* memory) noexcept {
  discount(memory);
  __libc_free(memory);
}
}

namespace shortshot_bench::peers {

void start_counting_heap() {
  bytes_now = 0;
  bytes_most = 0;
  counting = true;
}

std::size_t peak_heap_bytes() {
  counting = false;
  return static_cast<std::size_t>(bytes_most);
}

}  // namespace shortshot_bench::peers

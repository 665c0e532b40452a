// What the programs need of a board: a way to print, and how deep the stack was. Hosts print by stdio.
#pragma once

#include <cstddef>
#include <cstdint>

#if defined(__unix__)
#include <cstdio>
#endif

namespace board {

#if defined(__unix__)

inline void print(const char* text) { std::fputs(text, stdout); }

#else

#if defined(__riscv)
extern "C" std::intptr_t semihost(std::intptr_t operation, const void* argument);
#else
inline std::intptr_t semihost(std::intptr_t operation, const void* argument) {
  register std::intptr_t r0 __asm__("r0") = operation;
  register const void* r1 __asm__("r1") = argument;
  __asm__ volatile("bkpt 0xab" : "+r"(r0) : "r"(r1) : "memory");
  return r0;
}
#endif

inline void print(const char* text) { semihost(4, text); }

extern "C" std::uint32_t ld_stack_bottom[];
inline constexpr std::uint32_t paint = 0xC0DEC0DEu;

/// Bytes of stack that call() takes below this function's own frame.
template <class Call>
[[gnu::noinline]] std::uint32_t stack_of(const Call& call) {
  std::uint32_t stack_pointer = 0;
#if defined(__riscv)
  __asm__ volatile("mv %0, sp" : "=r"(stack_pointer));
#else
  __asm__ volatile("mov %0, sp" : "=r"(stack_pointer));
#endif
  volatile std::uint32_t* const bottom = ld_stack_bottom;
  auto* const top = reinterpret_cast<volatile std::uint32_t*>(stack_pointer);
  for (volatile std::uint32_t* word = bottom; word < top; ++word) *word = paint;
  call();
  const volatile std::uint32_t* word = bottom;
  while (word < top && *word == paint) ++word;
  return static_cast<std::uint32_t>((top - word) * 4);
}

#endif

inline void print(std::uint64_t number) {
  char digits[21];
  char* first = digits + 20;
  *first = 0;
  do {
    *--first = static_cast<char>('0' + number % 10);
    number /= 10;
  } while (number != 0);
  print(first);
}

/// A line "KEY NAME NUMBER".
inline void print_fact(const char* key, const char* name, std::uint64_t number) {
  print(key);
  print(" ");
  print(name);
  print(" ");
  print(number);
  print("\n");
}

inline void print_hash(const char* name, std::uint32_t hash) {
  char digits[9] = {};
  for (int i = 0; i < 8; ++i) digits[i] = "0123456789abcdef"[hash >> (28 - 4 * i) & 15u];
  print("hash ");
  print(name);
  print(" ");
  print(digits);
  print("\n");
}

}  // namespace board

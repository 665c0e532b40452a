// The marks between which instructions are counted: the emulator's plugin, and valgrind, are told where they are.
#pragma once

#include "board.hpp"

extern "C" {
[[gnu::noinline]] inline void mark_begin() { __asm__ volatile("" ::: "memory"); }
[[gnu::noinline]] inline void mark_end() { __asm__ volatile("" ::: "memory"); }
}

/// Counts a call, and says so: a line "section NAME".
template <class Call>
void count_section(const char* name, const Call& call) {
  mark_begin();
  call();
  mark_end();
  board::print("section ");
  board::print(name);
  board::print("\n");
}

/* Start-up of an Armv7-M or Armv8-M core, in C: vector table, floating point on, .data, .bss, painted stack, main. The
 * value of main is the emulator's exit code, by semihosting; any fault ends it with 1. */
#include <stddef.h>
#include <stdint.h>

extern uint32_t ld_stack_bottom[], ld_stack_top[], ld_data_load[], ld_data_begin[], ld_data_end[], ld_bss_begin[],
    ld_bss_end[];
typedef void (*Function)(void);
extern Function ld_init_begin[], ld_init_end[];

int main(void);
void *__dso_handle __attribute__((weak)); /* wanted where a static object has a destructor */

static _Noreturn void end(uint32_t code) {
  const uint32_t block[2] = {0x20026u, code}; /* "application exit", and its code */
  register uint32_t operation __asm__("r0") = 0x20u;
  register const uint32_t *argument __asm__("r1") = block;
  for (;;) __asm__ volatile("bkpt 0xab" : "+r"(operation) : "r"(argument) : "memory");
}

/* What compilers call without being asked to: all that the library takes from elsewhere. Nothing of a C library is in
 * these images. */
typedef uint32_t Word __attribute__((may_alias, aligned(1)));

void *memset(void *to, int value, size_t count) {
  uint8_t *byte = to;
  const uint32_t word = (uint8_t)value * 0x01010101u;
  for (; count >= 16; count -= 16, byte += 16) {
    Word *const words = (Word *)byte;
    words[0] = words[1] = words[2] = words[3] = word;
  }
  for (; count > 0; --count) *byte++ = (uint8_t)value;
  return to;
}

void *memcpy(void *restrict to, const void *restrict from, size_t count) {
  uint8_t *byte = to;
  for (const uint8_t *other = from; count > 0; --count) *byte++ = *other++;
  return to;
}

/* Newlib's abort() and its like end here, too. */
void _exit(int code) { end((uint32_t)code); }

static void fault(void) { end(1u); }

_Noreturn void reset(void) {
#if defined(__ARM_FP) || defined(__ARM_FEATURE_MVE)
  *(volatile uint32_t *)0xE000ED88u |= 0xFu << 20; /* CPACR: full access to CP10 and CP11, before they are used */
  __asm__ volatile("dsb\n isb");
#endif
  const uint32_t *from = ld_data_load;
  for (uint32_t *to = ld_data_begin; to < ld_data_end;) *to++ = *from++;
  for (uint32_t *to = ld_bss_begin; to < ld_bss_end;) *to++ = 0u;
  const uint32_t *frame = __builtin_frame_address(0);
  for (uint32_t *to = ld_stack_bottom; to < frame - 32;) *to++ = 0xC0DEC0DEu;
  for (Function *f = ld_init_begin; f < ld_init_end; ++f) (*f)();
  end((uint32_t)main());
}

__attribute__((section(".vectors"), used)) static const void *const vectors[16] = {
    ld_stack_top, (void *)reset, (void *)fault, (void *)fault, (void *)fault, (void *)fault, (void *)fault,
    (void *)fault, 0, 0, 0, (void *)fault, (void *)fault, 0, (void *)fault, (void *)fault};

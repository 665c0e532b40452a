# One block for each target, a core and a compiler: its compiler command with the machine's flags, the binutils' prefix, the
# board (start-up file and linker script; none on hosts), how a program is run, and at which levels it is measured.

arm := arm-none-eabi-
qemu_arm = qemu-system-arm -M $1 -nographic -monitor none -serial none \
  -semihosting-config enable=on,target=native

m7_flags := -mthumb -mcpu=cortex-m7 -mfpu=fpv5-sp-d16 -mfloat-abi=hard

cxx_m3 := $(arm)g++ -mthumb -mcpu=cortex-m3 -mfloat-abi=soft
cxx_m4f := $(arm)g++ -mthumb -mcpu=cortex-m4 -mfpu=fpv4-sp-d16 -mfloat-abi=hard
cxx_m7 := $(arm)g++ $(m7_flags)
cxx_m7dp := $(arm)g++ -mthumb -mcpu=cortex-m7 -mfpu=fpv5-d16 -mfloat-abi=hard
cxx_m55 := $(arm)g++ -mthumb -mcpu=cortex-m55 -mfloat-abi=hard
machine_m3 := mps2-an385
machine_m4f := mps2-an386
machine_m7 := mps2-an500
machine_m7dp := mps2-an500
machine_m55 := mps3-an547
script_m3 := mps2.ld
script_m4f := mps2.ld
script_m7 := mps2.ld
script_m7dp := mps2.ld
script_m55 := mps3_an547.ld

# The standard headers of an Arm compiler as options for another one, which brings its own compiler's headers.
system_headers = $(shell $1 -E -x c++ - -v </dev/null 2>&1 | sed -n '/^.include </,/^End/s|^ \(/.*\)|\1|p' | \
  grep -v 'gcc/[^/]*/[0-9.]*/include[-a-z]*$$' | sed 's/^/-isystem/')

cxx_m7_clang = clang++ --target=thumbv7em-none-eabihf -mcpu=cortex-m7 -mfpu=fpv5-sp-d16 -mfloat-abi=hard \
  -fshort-enums $(m7_clang_headers)
machine_m7_clang := mps2-an500
script_m7_clang := mps2.ld
link_m7_clang := $(cxx_m7) -Wl,-z,noexecstack

define arm_board
prefix_$1 := $(arm)
start_$1 := armv7m.c
run_$1 := $(call qemu_arm,$(machine_$1))
libraries_$1 := -specs=nano.specs -specs=nosys.specs
endef
$(foreach t,m3 m4f m7 m7dp m55 m7_clang,$(eval $(call arm_board,$t)))
# The one function of libm that the library takes where there is no floating-point unit. Newlib's sqrtf() also sets
# errno, and with it come 100 bytes of .data; what it calls does not.
link_m3 := $(cxx_m3) -Wl,--defsym=sqrtf=__ieee754_sqrtf

# Debian's RISC-V compiler has no C++ library. Headers are all that is needed of one: Arm's. (With _zicsr in -march the
# linker would take libraries for 64 bits.)
cxx_rv32 = riscv64-unknown-elf-gcc -march=rv32imafc -mabi=ilp32f -misa-spec=2.2 --specs=picolibc.specs $(rv32_headers)
prefix_rv32 := riscv64-unknown-elf-
start_rv32 := rv32.S
script_rv32 := virt.ld
run_rv32 := qemu-system-riscv32 -M virt -bios none -nographic -monitor none -serial none \
  -semihosting-config enable=on,target=native
libraries_rv32 := -nodefaultlibs -lc -lgcc -Wl,--no-warn-rwx-segments

cxx_aarch64 := aarch64-linux-gnu-g++
cxx_aarch64_clang := clang++ --target=aarch64-linux-gnu
$(foreach t,aarch64 aarch64_clang,$(eval prefix_$t := aarch64-linux-gnu-)$(eval run_$t := qemu-aarch64)\
  $(eval link_$t := aarch64-linux-gnu-g++ -static))

# (Without SSE2 the library takes square roots by a builtin, which would call libm for its errno.)
cxx_x86_sse2 := g++
cxx_x86_avx2 := g++ -mavx2 -mfma
cxx_x86_scalar := g++ -U__SSE2__ -fno-math-errno
cxx_x86_clang := clang++

levels_m7 := Os O2 O3
targets_of_cores := m3 m4f m7 m7dp m55 rv32 aarch64
targets_of_hosts := x86_sse2 x86_scalar $(if $(shell grep -w avx2 /proc/cpuinfo | grep -w fma),x86_avx2)
targets_of_clang := m7_clang aarch64_clang x86_clang

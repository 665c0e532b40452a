# Start-up of a 32-bit RISC-V core: floating point on, .data, .bss, painted stack, main. The value of main is the emulator's
# exit code, by semihosting; any trap ends it with 1.

    .section .vectors, "ax"
    .globl _start
_start:
    .option push
    .option norelax
    la gp, __global_pointer$
    .option pop
    la sp, ld_stack_top
    la t0, trap
    csrw mtvec, t0
    li t0, 0x2000               # mstatus.FS: floating point on
    csrs mstatus, t0
    csrw fcsr, zero
    la t0, ld_data_begin
    la t1, ld_data_end
    la t2, ld_data_load
0:  bgeu t0, t1, 0f
    lw t3, 0(t2)
    sw t3, 0(t0)
    addi t0, t0, 4
    addi t2, t2, 4
    j 0b
0:  la t0, ld_bss_begin
    la t1, ld_bss_end
1:  bgeu t0, t1, 2f
    sw zero, 0(t0)
    addi t0, t0, 4
    j 1b
2:  la t0, ld_stack_bottom
    li t1, 0xC0DEC0DE
3:  bgeu t0, sp, 4f
    sw t1, 0(t0)
    addi t0, t0, 4
    j 3b
4:  call main
    j end

    .balign 4
trap:
    la sp, ld_stack_top
    li a0, 1
end:                            # the argument is a block: "application exit", and its code
    addi sp, sp, -16
    sw a0, 4(sp)
    li t0, 0x20026
    sw t0, 0(sp)
    li a0, 0x20
    mv a1, sp
    call semihost
5:  j 5b

    .section .text.semihost, "ax"
    .globl semihost
    .balign 16                  # the three instructions must lie in one page
semihost:
    .option push
    .option norvc
    slli x0, x0, 0x1f
    ebreak
    srai x0, x0, 7
    .option pop
    ret

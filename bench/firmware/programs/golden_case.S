/* The committed synthetic golden case, tests/golden/edge, as it lies in its files. */
#if defined(__linux__)
    .section .note.GNU-stack, "", %progbits
#endif
    .section .rodata.golden_case, "a"
#define QUOTED(text) #text
#define BYTES_OF(name) .incbin QUOTED(name.bin)
#define FILE(name) \
    .globl golden_##name; .globl golden_##name##_end; .balign 4; \
    golden_##name: BYTES_OF(name); golden_##name##_end:
FILE(points)
FILE(normals)
FILE(rgb)
FILE(keypoints)
FILE(frames)

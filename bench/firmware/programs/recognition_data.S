/* What firmware_recognition, or firmware_small_sensor, has written: a model, and views. */
#if defined(__linux__)
    .section .note.GNU-stack, "", %progbits
#endif
    .section .rodata.recognition, "a"
    .globl model_begin, model_end, views_begin
    .balign 4
model_begin:
    .incbin "model.bin"
model_end:
    .section .views, "a"
    .balign 4
views_begin:
    .incbin "views.bin"
    .balign 4

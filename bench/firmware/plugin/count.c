/* QEMU plugin: instructions between the functions mark_begin() and mark_end() of the emulated program, a line "count N"
 * for each time. Arguments: begin=ADDRESS,end=ADDRESS,out=FILE. Works in system and user emulation.
 * Debian has no qemu-plugin.h: what is used of it (version 1) is declared here. */
#include <inttypes.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef uint64_t qemu_plugin_id_t;
typedef struct qemu_info qemu_info_t;
struct qemu_plugin_tb;
struct qemu_plugin_insn;
enum { callback_reads_no_registers = 0, inline_add = 0 };
void qemu_plugin_register_vcpu_tb_trans_cb(qemu_plugin_id_t, void (*)(qemu_plugin_id_t, struct qemu_plugin_tb *));
void qemu_plugin_register_vcpu_insn_exec_cb(struct qemu_plugin_insn *, void (*)(unsigned, void *), int, void *);
void qemu_plugin_register_vcpu_insn_exec_inline(struct qemu_plugin_insn *, int, void *, uint64_t);
size_t qemu_plugin_tb_n_insns(const struct qemu_plugin_tb *);
struct qemu_plugin_insn *qemu_plugin_tb_get_insn(const struct qemu_plugin_tb *, size_t);
uint64_t qemu_plugin_insn_vaddr(const struct qemu_plugin_insn *);

#define EXPORTED __attribute__((visibility("default")))
EXPORTED int qemu_plugin_version = 1;

static uint64_t executed, executed_before, begin_address, end_address;
static FILE *out;

static void at_begin(unsigned cpu, void *data) {
  (void)cpu;
  (void)data;
  executed_before = executed;
}

static void at_end(unsigned cpu, void *data) {
  (void)cpu;
  (void)data;
  fprintf(out, "count %" PRIu64 "\n", executed - executed_before);
  fflush(out);
}

static void on_translation(qemu_plugin_id_t id, struct qemu_plugin_tb *block) {
  (void)id;
  const size_t size = qemu_plugin_tb_n_insns(block);
  for (size_t i = 0; i < size; ++i) {
    struct qemu_plugin_insn *instruction = qemu_plugin_tb_get_insn(block, i);
    const uint64_t address = qemu_plugin_insn_vaddr(instruction);
    qemu_plugin_register_vcpu_insn_exec_inline(instruction, inline_add, &executed, 1);
    if (address == begin_address || address == end_address) {
      qemu_plugin_register_vcpu_insn_exec_cb(instruction, address == begin_address ? at_begin : at_end,
                                             callback_reads_no_registers, NULL);
    }
  }
}

EXPORTED int qemu_plugin_install(qemu_plugin_id_t id, const qemu_info_t *info, int argc, char **argv) {
  (void)info;
  for (int i = 0; i < argc; ++i) {
    if (strncmp(argv[i], "begin=", 6) == 0) begin_address = strtoull(argv[i] + 6, NULL, 16);
    if (strncmp(argv[i], "end=", 4) == 0) end_address = strtoull(argv[i] + 4, NULL, 16);
    if (strncmp(argv[i], "out=", 4) == 0) out = fopen(argv[i] + 4, "w");
  }
  if (begin_address == 0 || end_address == 0 || out == NULL) {
    fprintf(stderr, "count: needs begin=ADDRESS,end=ADDRESS,out=FILE\n");
    return 1;
  }
  qemu_plugin_register_vcpu_tb_trans_cb(id, on_translation);
  return 0;
}

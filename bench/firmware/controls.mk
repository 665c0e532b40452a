# Negative controls on the M7: an image for each promise broken on purpose (tests/build/broken_promise.cpp), whose check
# must name the promise; where the linker script knows the promise too, linking must fail with its name; programs that do
# not end well, whose exit code must say so; and a build that fuses products and sums, whose hashes must differ.

control := m7
kernel_headers := $(wildcard $(root)/include/shortshot/*.hpp $(root)/include/shortshot/*/*.hpp)
control_cases := 1:no_heap 2:no_heap 3:no_exceptions 4:no_double 5:no_function-local_statics 6:no_printing \
  7:no_static_initializers 8:no_writable_constants 9:no_RTTI 11:no_fused_multiply-add
linker_cases := 3 7 8
case_of = $(word 1,$(subst :, ,$1))
promise_of = $(subst _, ,$(word 2,$(subst :, ,$1)))

# control_link(CASE): nothing calls what is broken, so the linker is told to keep it; make() of case 5 is nowhere.
control_link = $(call link,$(control)) -Wl,--unresolved-symbols=ignore-all $(B)/$(control)/start.o $$($(prefix_$(control))nm \
  --defined-only $(B)/control/$1.o | sed -n 's/.* [A-Z] \(.*broken.*\)/-Wl,-u,\1/p') $(B)/control/$1.o $(B)/control/$1.main.o $(libraries_$(control)) -o $(B)/control/$1.elf

# control_rule(CASE, PROMISE)
define control_rule
facts += $(B)/facts/control-$1.txt
$(B)/facts/control-$1.txt: $(root)/tests/build/broken_promise.cpp $(here)/programs/size.cpp $(B)/$(control)/start.o \
    $(check) $(headers) $(kernel_headers) | $(B)/facts/ $(B)/control/
	$(cxx_$(control)) -std=c++17 -O2 -w -I$(root)/include -DCASE=$1 -c $$< -o $(B)/control/$1.o
	$(cxx_$(control)) -std=c++17 -O2 -DCALLS= -c $(here)/programs/size.cpp -o $(B)/control/$1.main.o
	$$(call control_link,$1) >$(B)/control/$1.log 2>&1 || :
	$$(call control_link,$1) -Wl,--defsym=PROMISES=0
	{ printf '%s\n' 'program control' 'control $1' 'must_report $2' $(if $(filter $1,$(linker_cases)),'must_not_link $2'); \
	  sed -n 's/.*: promise: /linker /p' $(B)/control/$1.log; \
	  { $(call binutils,$(control)) $(check) --image $(B)/control/$1.elf || :; } | sed 's/^/check /'; } >$$@
endef

# ending_rule(NAME, CODE, STATEMENT): main() with that statement must end with that code.
define ending_rule
facts += $(B)/facts/control-$1.txt
$(B)/facts/control-$1.txt: $(B)/$(control)/start.o $(headers) | $(B)/facts/ $(B)/control/
	echo 'int main(void) { $3 }' | $(cxx_$(control)) -x c -O2 -c - -o $(B)/control/$1.o
	$(call link,$(control)) $(B)/$(control)/start.o $(B)/control/$1.o $(libraries_$(control)) -o $(B)/control/$1.elf
	$$(call run_plain,$(control),$(B)/control/$1.elf,$(B)/control/$1.out)
	{ printf '%s\n' 'program control' 'control $1' 'must_exit $2'; cat $(B)/control/$1.out; } >$$@
endef

# The library without what keeps the compiler from fusing.
define fused_rules
facts += $(B)/facts/control-fused.txt
$(B)/control/fused: $(here)/programs/bits.cpp $(B)/$(control)/O2/bits $(headers) | $(B)/control/
	$(call compile,$(control),O2) -U__ARM_FEATURE_FMA $(bits_options) -c $$< -o $$@.o
	$(call link,$(control)) $(B)/$(control)/start.o $$@.o $(B)/$(control)/O2/bits.case.o $(libraries_$(control)) -o $$@
$(B)/facts/control-fused.txt: $(B)/control/fused
	$$(call run_plain,$(control),$$<,$$<.out)
	{ printf '%s\n' 'program control' 'control fused' 'must differ'; cat $$<.out; } >$$@
endef

ifneq ($(filter $(control),$(TARGETS)),)
$(foreach c,$(control_cases),$(eval $(call control_rule,$(call case_of,$c),$(call promise_of,$c))))
$(eval $(call ending_rule,code,3,return 3;))
$(eval $(call ending_rule,fault,1,*(volatile int*)0xF0000000 = 1; return 0;))
$(eval $(fused_rules))
endif

# No floating-point exception, and nothing that depends on memory that nobody wrote: also where lanes reach beyond the end
# of a neighborhood.

find_program(valgrind valgrind)
mark_as_advanced(valgrind)

# everything(NAME FLAGS...)
function(everything name)
  add_executable(everything_${name} everything.cpp)
  target_link_libraries(everything_${name} PRIVATE shortshot_own)
  target_compile_options(everything_${name} PRIVATE -O2 -fno-sanitize=all ${ARGN})
endfunction()

everything(plain)
build_test(everything.raises_nothing everything_plain)
if(x86)
  everything(avx2 -mavx2 -mfma)
  build_test(everything.raises_nothing_with_avx2 "${here}/expect_code.sh" 0 $<TARGET_FILE:everything_avx2>)
endif()
if(valgrind)
  build_test(everything.reads_what_was_written "${valgrind}" -q --error-exitcode=9 $<TARGET_FILE:everything_plain>)
else()
  message(STATUS "build test everything.reads_what_was_written is left out: valgrind was not found")
endif()

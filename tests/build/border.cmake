# Translation units, and libraries, for different instruction sets in one program.

if(NOT x86)
  message(STATUS "build tests for several instruction sets are left out: this is no x86-64")
  return()
endif()

# code_namespace(RESULT FLAGS...): the inline namespace of the library's code compiled with these flags.
function(code_namespace result)
  execute_process(COMMAND "${CMAKE_CXX_COMPILER}" -std=c++17 -O2 ${ARGN} -E -P -x c++
      -include "${PROJECT_SOURCE_DIR}/include/shortshot/config.hpp" "${here}/border/code_namespace.in"
    OUTPUT_VARIABLE text COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCH "v[0-9]+_[0-9]+_[0-9a-f]+" name "${text}")
  set(${result} "${name}" PARENT_SCOPE)
endfunction()

set(flags_sse2 "")
set(flags_scalar -U__SSE2__)  # what simd.hpp asks for: the one-lane code of machines without SIMD, on this one
set(flags_avx2 -mavx2 -mfma)
set(flags_sse2_small -Os)
set(isa_objects "")
foreach(isa IN ITEMS sse2 scalar avx2 sse2_small)
  object(isa_${isa} border/isa_probe.cpp -DPROBE=describe_${isa} -fno-inline -ffp-contract=off  # the probe's own cloud
    ${flags_${isa}})
  code_namespace(code_${isa} ${flags_${isa}})
  list(APPEND isa_objects ${code_${isa}} $<TARGET_OBJECTS:isa_${isa}>)
endforeach()
add_executable(isas border/isas.cpp)
target_link_libraries(isas PRIVATE shortshot_own isa_sse2 isa_scalar isa_avx2 isa_sse2_small)
target_link_options(isas PRIVATE -no-pie)
build_test(isas.same_bits isas)
set_tests_properties(build.isas.same_bits PROPERTIES SKIP_RETURN_CODE 77)
set(check_code_namespace "${here}/border/check_code_namespace.sh")
build_test(isas.symbols "${check_code_namespace}" ${isa_objects})
build_test(isas.symbols_can_fail "${check_code_namespace}" ${code_avx2} $<TARGET_OBJECTS:isa_sse2>)
set_tests_properties(build.isas.symbols_can_fail PROPERTIES WILL_FAIL TRUE)

# Two libraries that hand each other supports, features, recognizers: linked in both orders, each of which makes the linker
# choose the other's copy of what both have in common.
set(small_avx2 -Os -mavx2 -mfma -mlzcnt)
add_library(border_plain STATIC border/library.cpp)
add_library(border_small_avx2 STATIC border/library.cpp)
target_compile_definitions(border_plain PRIVATE LIBRARY=plain)
target_compile_definitions(border_small_avx2 PRIVATE LIBRARY=small_avx2)
foreach(order IN ITEMS "plain;small_avx2" "small_avx2;plain")
  list(GET order 0 first)
  list(GET order 1 second)
  add_executable(border_${first}_first border/main.cpp)
  target_link_libraries(border_${first}_first PRIVATE shortshot_own)
  target_link_libraries(border_${first}_first PRIVATE border_${first} border_${second} Threads::Threads)
  build_test(border.${first}_first border_${first}_first)
  set_tests_properties(build.border.${first}_first PROPERTIES SKIP_RETURN_CODE 77)
endforeach()
foreach(library IN ITEMS border_plain border_small_avx2)
  target_link_libraries(${library} PRIVATE shortshot)
  target_compile_options(${library} PRIVATE ${SHORTSHOT_WARNINGS} -fno-sanitize=all)
endforeach()
target_compile_options(border_plain PRIVATE -O2)
target_compile_options(border_small_avx2 PRIVATE ${small_avx2})
code_namespace(code_small_avx2 ${small_avx2})
build_test(border.symbols "${check_code_namespace}" ${code_sse2} $<TARGET_FILE:border_plain> ${code_small_avx2}
  $<TARGET_FILE:border_small_avx2>)

# Each of these flags lets a compiler use other instructions: each makes another namespace.
set(flags "-O2;-mssse3;-msse4.2;-mpopcnt;-mavx;-mfma;-mf16c;-mbmi;-mbmi2;-mlzcnt;-mmovbe;-mavx2;-mavx512vl;-mavx512bw;-Os;-ffast-math")
set(seen "")
set(problem "")
foreach(flag IN LISTS flags)
  code_namespace(code ${flag})
  if(code IN_LIST seen)
    string(APPEND problem "${flag} ")
  endif()
  list(APPEND seen ${code})
endforeach()
build_test(border.flags_told_apart "${CMAKE_COMMAND}" -E compare_files --ignore-eol "${there}/flags_not_told_apart"
  "${there}/nothing")
file(WRITE "${there}/flags_not_told_apart" "${problem}")
file(WRITE "${there}/nothing" "")

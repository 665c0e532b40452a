# Included by CMakeLists.txt, after packages.cmake. The C interface: compiled as the page says, the page's examples, the
# bits of the C++ interface, what it refuses, and its CMake target. The library is compiled without optimization and for
# one instruction set, which are the same bits.

set(c_interface "${here}/c_interface")
set(to "${there}/c_interface")
set(quickly -O0 -DSHORTSHOT_NO_DISPATCH)
set(linked "-L${to}" -lshortshot "-Wl,-rpath,${to}")
program(gcc)

build_test(c_interface.page "${CMAKE_COMMAND}" "-DDOCUMENT=${PROJECT_SOURCE_DIR}/single_include/README.md"
  -DEXAMPLES=pose,recognize "-DOUTPUT_DIR=${to}" -P "${here}/extract_examples.cmake")
build_test(c_interface.library "${CMAKE_CXX_COMPILER}" -std=c++17 ${SHORTSHOT_WARNINGS} -Wsign-conversion ${quickly}
  -shared -fPIC -fvisibility=hidden -pthread "${PROJECT_SOURCE_DIR}/single_include/shortshot_c.cpp"
  -o "${to}/libshortshot.so")
depends(c_interface.library c_interface.page)  # which makes the folder

# The same bits as C++, and no exception where memory runs out.
build_test(c_interface.same_bits.compiled "${CMAKE_CXX_COMPILER}" -std=c++17 ${SHORTSHOT_WARNINGS} ${quickly}
  "${single_header_flag}" "${c_interface}/same_bits.cpp" ${linked} -o "${to}/same_bits")
depends(c_interface.same_bits.compiled c_interface.library)
build_test(c_interface.same_bits "${to}/same_bits" "${to}")
depends(c_interface.same_bits c_interface.same_bits.compiled)

# c_program(NAME SOURCE): compiled and linked by a compiler of C, which knows nothing of C++.
function(c_program name source)
  build_test(c_interface.${name}.compiled "${gcc_program}" -std=c99 -Wall -Wextra -pedantic -Werror "${single_header_flag}"
    "-DPROJECT_VERSION=\"${PROJECT_VERSION}\"" "${source}" ${linked} -o "${to}/${name}")
  depends(c_interface.${name}.compiled c_interface.library)
  build_test(c_interface.${name} "${to}/${name}")
  depends(c_interface.${name} c_interface.${name}.compiled)
endfunction()
if(gcc_program)
  c_program(errors "${c_interface}/errors.c")
  c_program(pose "${to}/pose.c")
  set_tests_properties(build.c_interface.pose PROPERTIES
    PASS_REGULAR_EXPRESSION "^ok: [0-9]+ key points")
endif()
if(python3_program)
  add_test(NAME build.c_interface.python COMMAND "${python3_program}" recognize.python WORKING_DIRECTORY "${to}")
  set_tests_properties(build.c_interface.python PROPERTIES LABELS build PASS_REGULAR_EXPRESSION "^bent at -0.2 0.2 1.0\n$")
  depends(c_interface.python c_interface.library)
endif()

# The CMake target, of a static library: from sources whose table is shorter, which compiles faster, and installed.
build_test(c_interface.trimmed "${CMAKE_COMMAND}" "-DSOURCE_DIR=${PROJECT_SOURCE_DIR}" "-DOUTPUT_DIR=${to}/trimmed"
  -P "${c_interface}/trim_table.cmake")
function(c_consumer name before)
  build_test(c_interface.${name} "${CMAKE_CTEST_COMMAND}" --build-and-test "${c_interface}" "${to}/${name}"
    --build-generator "${CMAKE_GENERATOR}" --build-options ${compiler} "-DMAIN=${to}/pose.c" ${ARGN} --test-command consumer)
  depends(c_interface.${name} c_interface.page c_interface.${before})
endfunction()
c_consumer(subdirectory trimmed "-DSHORTSHOT_SOURCE_DIR=${to}/trimmed" "-DCMAKE_CXX_FLAGS=-O0 -DSHORTSHOT_NO_DISPATCH")
build_test(c_interface.install "${CMAKE_COMMAND}" --install "${to}/subdirectory" --prefix "${to}/installed")
depends(c_interface.install c_interface.subdirectory)
c_consumer(from_installed install "-DCMAKE_PREFIX_PATH=${to}/installed" "-DFOUND_BELOW=${to}/installed")

# Included by CMakeLists.txt, after documents.cmake, whose examples are built here.

# ---- This project without a library that its tests need ---------------------------------------------------------------

# without_doctest(NAME MESSAGE OPTIONS...)
function(without_doctest name message)
  build_test(without_doctest.${name} "${CMAKE_COMMAND}" -S "${PROJECT_SOURCE_DIR}" -B "${there}/without_doctest/${name}"
    "-DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER}" -DCMAKE_DISABLE_FIND_PACKAGE_doctest=ON ${ARGN})
  set_tests_properties(build.without_doctest.${name} PROPERTIES PASS_REGULAR_EXPRESSION "${message}")
endfunction()
without_doctest(left_out "-- tests/unit is left out: doctest::doctest[^\n]* doctest-dev\\).*Build files have been written")
without_doctest(required "Error[^\n]*\n *tests/unit cannot be built: doctest::doctest" -DSHORTSHOT_REQUIRE_ALL_TESTS=ON)

# ---- Users' projects: an installation, and the sources as a subdirectory -------------------------------------------

set(prefix "${there}/installed")
build_test(install "${CMAKE_COMMAND}" --install "${PROJECT_BINARY_DIR}" --prefix "${prefix}")

# consumer(NAME BEFORE MAIN OPTIONS...): configures, builds and runs consumer/.
function(consumer name before main)
  build_test(consumer.${name} "${CMAKE_CTEST_COMMAND}" --build-and-test "${here}/consumer" "${there}/consumer/${name}"
    --build-generator "${CMAKE_GENERATOR}" --build-options "-DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER}"
    "-DCMAKE_CXX_FLAGS=-Wall -Wextra -Wconversion -Wsign-conversion -Werror" "-DMAIN=${main}" ${ARGN} --test-command consumer)
  depends(consumer.${name} ${before})
endfunction()
set(route "${here}/consumer/route.cpp")
set(quick_start "${there}/readme/quick_start_cmake.cpp")
set(no_leaves -DCMAKE_DISABLE_FIND_PACKAGE_nanoflann=ON -DCMAKE_DISABLE_FIND_PACKAGE_Eigen3=ON)
set(installed "-DCMAKE_PREFIX_PATH=${prefix}")
set(subdirectory "-DSHORTSHOT_SOURCE_DIR=${PROJECT_SOURCE_DIR}")
consumer(installed "install;readme" "${quick_start}" "${installed}")
consumer(installed_no_leaves install "${here}/consumer/no_leaves.cpp" "${installed}" ${no_leaves})
consumer(subdirectory "" "${route}" "${subdirectory}")
consumer(subdirectory_no_leaves "" "${here}/consumer/no_leaves.cpp" "${subdirectory}" ${no_leaves})

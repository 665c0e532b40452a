# Included by CMakeLists.txt, after projects.cmake. The routes on which the library comes to a user
# (packaging/README.md), each to its end: a program that is compiled and runs. Tools that are not there are left out, with
# a line that says so.

set(packaging "${PROJECT_SOURCE_DIR}/packaging")
set(packages "${here}/packages")
set(compiler "-DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER}")

# program(NAME): where it is, in the variable NAME_program; Debian's before others of that name.
function(program name)
  find_program(${name}_program ${name} HINTS /usr/bin)
  mark_as_advanced(${name}_program)
  if(NOT ${name}_program)
    message(STATUS "build tests of packages that need ${name} are left out: it was not found")
  endif()
endfunction()
foreach(name IN ITEMS python3 pkg-config dpkg git)
  program(${name})
endforeach()

# route(NAME BEFORE PREFIX): a program by find_package(), which must find what lies below PREFIX.
function(route name before prefix)
  consumer(${name} ${before} "${route}" "-DCMAKE_PREFIX_PATH=${prefix}" "-DFOUND_BELOW=${prefix}")
endfunction()

# ---- pkg-config ------------------------------------------------------------------------------------------------------

if(pkg-config_program)
  build_test(packages.pkg_config "${packages}/check_pkg_config.sh" "${prefix}" ${PROJECT_VERSION}
    "${CMAKE_CXX_COMPILER}" "${route}" "${there}/pkg_config")
  depends(packages.pkg_config install)
endif()

# ---- Debian's package, of a configuration that finds nothing but a compiler ------------------------------------------

build_test(packages.configured "${CMAKE_COMMAND}" --preset package -S "${PROJECT_SOURCE_DIR}" -B "${there}/package"
  ${compiler} "-DCMAKE_PROJECT_INCLUDE=${packages}/no_packages.cmake")
if(dpkg_program)
  build_test(packages.deb "${CMAKE_CPACK_COMMAND}" --config "${there}/package/CPackConfig.cmake" -B "${there}/deb")
  depends(packages.deb packages.configured)
  build_test(packages.deb.installed "${packages}/check_deb.sh" "${there}/deb" "${there}/deb/root" ${PROJECT_VERSION}
    "${PROJECT_SOURCE_DIR}/include/shortshot")
  depends(packages.deb.installed packages.deb)
  route(deb packages.deb.installed "${there}/deb/root/usr")
endif()

# ---- vcpkg, Conan, colcon --------------------------------------------------------------------------------------------

build_test(packages.vcpkg "${CMAKE_COMMAND}" "-DPORT_DIR=${packaging}/vcpkg/shortshot" "-DDIRECTORY=${there}/vcpkg"
  "-DOPTIONS=${compiler}" -P "${packages}/run_portfile.cmake")
route(vcpkg packages.vcpkg "${there}/vcpkg/package")

if(python3_program)
  build_test(packages.conan "${python3_program}" "${packages}/run_conanfile.py" "${packaging}/conan/conanfile.py"
    "${there}/conan" ${PROJECT_VERSION} ${compiler})
  route(conan packages.conan "${there}/conan/package/cmake")
endif()

# What colcon runs, with the arguments that colcon.pkg gives it.
file(READ "${PROJECT_SOURCE_DIR}/colcon.pkg" colcon)
string(JSON colcon GET "${colcon}" cmake-args)
string(REGEX MATCHALL "-D[A-Z_=]+" colcon "${colcon}")
build_test(packages.colcon.configured "${CMAKE_COMMAND}" -S "${PROJECT_SOURCE_DIR}" -B "${there}/colcon/build" ${colcon}
  ${compiler} "-DCMAKE_INSTALL_PREFIX=${there}/colcon/install")
build_test(packages.colcon "${CMAKE_COMMAND}" --build "${there}/colcon/build" --target install)
depends(packages.colcon packages.colcon.configured)
route(colcon packages.colcon "${there}/colcon/install")

# ---- FetchContent ----------------------------------------------------------------------------------------------------

if(git_program)
  build_test(packages.git "${packages}/make_git.sh" "${PROJECT_SOURCE_DIR}" "${there}/git/shortshot")
  consumer(fetch_content packages.git "${route}" "-DSHORTSHOT_GIT=file://${there}/git/shortshot")
endif()

# ---- Microcontrollers: ESP-IDF, Zephyr, Arduino ----------------------------------------------------------------------

# build_system(NAME SYSTEM OPTIONS...)
function(build_system name system)
  build_test(build_systems.${name} "${CMAKE_CTEST_COMMAND}" --build-and-test "${here}/build_systems"
    "${there}/build_systems/${name}" --build-generator "${CMAKE_GENERATOR}" --build-options ${compiler}
    -DCMAKE_CXX_STANDARD=17 -DSYSTEM=${system} "-DEXAMPLE=${page}/${system}.cmake" "-DMAIN=${page}/firmware.cpp"
    "-DSHORTSHOT_SOURCE_DIR=${PROJECT_SOURCE_DIR}" ${ARGN})
  depends(build_systems.${name} firmware_page)
endfunction()
foreach(system IN ITEMS esp_idf zephyr)
  build_system(${system} ${system})
  build_system(${system}_left_out ${system} -DLEFT_OUT=ON)
  set_tests_properties(build.build_systems.${system}_left_out PROPERTIES
    PASS_REGULAR_EXPRESSION "error: [^\n]*shortshot.hpp")
endforeach()

# Arduino's tools read a sketch with its comments, those of macros, too, before they compile it. No board is a Unix.
set(arduino "${there}/arduino/shortshot")
set(sketch -std=gnu++17 -U__unix__ "-I${arduino}/src" -x c++ -include "${packages}/Arduino.h"
  "${arduino}/examples/DescribePatch/DescribePatch.ino")
build_test(packages.arduino "${CMAKE_COMMAND}" "-DOUTPUT_DIR=${there}/arduino" -P "${packaging}/arduino/pack.cmake")
build_test(packages.arduino.read "${CMAKE_CXX_COMPILER}" -E -CC ${sketch} -o "${there}/arduino/sketch.cpp")
depends(packages.arduino.read packages.arduino)
build_test(packages.arduino.compiled "${CMAKE_CXX_COMPILER}" -std=gnu++17 -x c++ "${there}/arduino/sketch.cpp"
  "${packages}/arduino_main.cpp" -o "${there}/arduino/sketch")
depends(packages.arduino.compiled packages.arduino.read)
build_test(packages.arduino.runs "${there}/arduino/sketch")
depends(packages.arduino.runs packages.arduino.compiled)
set_tests_properties(build.packages.arduino.runs PROPERTIES PASS_REGULAR_EXPRESSION "^ok, microseconds: [0-9]+\n0\\.")
if(arm-none-eabi_compiler)
  build_test(packages.arduino.for_arm "${arm-none-eabi_compiler}" -Os ${no_runtime} ${cortex_m7} -c ${sketch}
    -o "${there}/arduino/sketch.o")
  depends(packages.arduino.for_arm packages.arduino)
endif()

# ---- What all of them say of the library -----------------------------------------------------------------------------

if(python3_program)
  execute_process(COMMAND "${python3_program}" -c "import yaml" RESULT_VARIABLE no_yaml ERROR_QUIET)
  if(no_yaml)
    message(STATUS "build test of manifests is left out: python3-yaml was not found")
  else()
    build_test(packages.manifests "${python3_program}" "${packages}/manifests.py" "${PROJECT_SOURCE_DIR}")
  endif()
endif()

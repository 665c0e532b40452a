# cmake -DPORT_DIR=... -DDIRECTORY=... [-DOPTIONS=...] -P run_portfile.cmake: what vcpkg does with a port, by stand-ins
# for the functions of vcpkg that the portfile calls, with real cmake, and vcpkg's rules for the outcome. The package is
# in DIRECTORY/package then.
cmake_minimum_required(VERSION 3.22)

get_filename_component(CURRENT_PORT_DIR "${PORT_DIR}" ABSOLUTE)
get_filename_component(PORT "${PORT_DIR}" NAME)
set(CURRENT_PACKAGES_DIR "${DIRECTORY}/package")
set(CURRENT_BUILDTREES_DIR "${DIRECTORY}/build")
file(REMOVE_RECURSE "${DIRECTORY}")

function(vcpkg_cmake_configure)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "SOURCE_PATH" "OPTIONS")
  if(NOT VCPKG_BUILD_TYPE STREQUAL "release" OR arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "only builds for release have a stand-in, with SOURCE_PATH and OPTIONS ${arg_UNPARSED_ARGUMENTS}")
  endif()
  execute_process(COMMAND "${CMAKE_COMMAND}" -S "${arg_SOURCE_PATH}" -B "${CURRENT_BUILDTREES_DIR}" ${arg_OPTIONS}
    ${OPTIONS} -DCMAKE_BUILD_TYPE=Release "-DCMAKE_INSTALL_PREFIX=${CURRENT_PACKAGES_DIR}" -DBUILD_SHARED_LIBS=OFF
    -DCMAKE_INSTALL_LIBDIR=lib -DCMAKE_INSTALL_BINDIR=bin OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
endfunction()

function(vcpkg_cmake_install)
  execute_process(COMMAND "${CMAKE_COMMAND}" --build "${CURRENT_BUILDTREES_DIR}" --target install OUTPUT_QUIET
    COMMAND_ERROR_IS_FATAL ANY)
endfunction()

function(vcpkg_fixup_pkgconfig)  # has nothing to do where paths are relative
  file(GLOB files "${CURRENT_PACKAGES_DIR}/share/pkgconfig/*.pc")
  if(NOT files)
    message(FATAL_ERROR "no file for pkg-config")
  endif()
  foreach(file IN LISTS files)
    file(READ "${file}" text)
    if(NOT text MATCHES "prefix=\\\${pcfiledir}/../..\n" OR text MATCHES "${DIRECTORY}")
      message(FATAL_ERROR "${file} has absolute paths")
    endif()
  endforeach()
endfunction()

include("${CURRENT_PORT_DIR}/portfile.cmake")

# ---- What vcpkg looks at when a port has been built ------------------------------------------------------------------

foreach(file IN ITEMS copyright ${PORT}Config.cmake usage)
  if(NOT EXISTS "${CURRENT_PACKAGES_DIR}/share/${PORT}/${file}")
    message(FATAL_ERROR "no share/${PORT}/${file}")
  endif()
endforeach()
file(GLOB_RECURSE files LIST_DIRECTORIES TRUE "${CURRENT_PACKAGES_DIR}/*")
foreach(file IN LISTS files)
  file(RELATIVE_PATH place "${CURRENT_PACKAGES_DIR}" "${file}")
  if(place MATCHES "^(debug|lib|bin)(/|$)" OR (place MATCHES "\\.cmake$" AND NOT place MATCHES "^share/${PORT}/"))
    message(FATAL_ERROR "vcpkg wants no ${place}")
  endif()
  file(GLOB entries "${file}/*")
  if(IS_DIRECTORY "${file}" AND NOT entries)
    message(FATAL_ERROR "vcpkg wants no empty folder: ${place}")
  endif()
endforeach()

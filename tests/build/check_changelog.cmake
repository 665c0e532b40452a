# cmake -DCHANGELOG=... -DVERSION=... -P check_changelog.cmake: is the first entry of the changelog this version's?
cmake_minimum_required(VERSION 3.22)

if(NOT EXISTS "${CHANGELOG}")
  message(FATAL_ERROR "there is no CHANGELOG.md")
endif()
file(READ "${CHANGELOG}" changelog)
if(NOT changelog MATCHES "\n## \\[?([0-9]+\\.[0-9]+\\.[0-9]+)")
  message(FATAL_ERROR "CHANGELOG.md has no entry: a line that begins with ## and a version")
endif()
if(NOT CMAKE_MATCH_1 STREQUAL VERSION)
  message(FATAL_ERROR "version.hpp says ${VERSION}, but the first entry of CHANGELOG.md is ${CMAKE_MATCH_1}")
endif()

# Takes the examples out of a document, so that what it shows is what the tests compile:
#   cmake -DDOCUMENT=... -DEXAMPLES=NAME,... -DOUTPUT_DIR=... -P extract_examples.cmake
# An example is a ```cpp, ```cmake, ```c or ```python block after a line <!-- example: NAME -->. It becomes
# OUTPUT_DIR/NAME.cpp, which includes the single header, and OUTPUT_DIR/NAME_cmake.cpp, which includes what the CMake
# targets offer; or OUTPUT_DIR/NAME.cmake, NAME.c, NAME.python.
cmake_minimum_required(VERSION 3.22)

set(most_lines 15)  # of code in the quick start: neither blank nor only a comment

get_filename_component(title "${DOCUMENT}" NAME)
if(NOT EXISTS "${DOCUMENT}")
  message(FATAL_ERROR "there is no ${title} to take examples from")
endif()
file(READ "${DOCUMENT}" document)
string(REPLACE "," ";" examples "${EXAMPLES}")

function(extract name result)
  set(marker "<!-- example: ${name} -->")
  string(FIND "${document}" "${marker}" begin)
  if(begin EQUAL -1)
    message(FATAL_ERROR "${title} has no line ${marker}")
  endif()
  string(SUBSTRING "${document}" ${begin} -1 rest)
  if(NOT rest MATCHES "^<!-- [a-z_: ]+ -->[ \n]*```(cpp|cmake|c|python)\n")
    message(FATAL_ERROR "${title}: no block ```cpp, ```cmake, ```c or ```python follows ${marker}")
  endif()
  set(language ${CMAKE_MATCH_1})
  string(LENGTH "${CMAKE_MATCH_0}" begin)
  string(SUBSTRING "${rest}" ${begin} -1 rest)
  string(FIND "${rest}" "\n```" end)
  if(end EQUAL -1)
    message(FATAL_ERROR "${title}: the example ${name} has no end")
  endif()
  math(EXPR end "${end} + 1")
  string(SUBSTRING "${rest}" 0 ${end} example)
  file(WRITE "${OUTPUT_DIR}/${name}.${language}" "${example}")
  if(language STREQUAL "cpp")
    string(REPLACE "\"shortshot.hpp\"" "<shortshot/shortshot.hpp>" for_cmake "${example}")
    file(WRITE "${OUTPUT_DIR}/${name}_cmake.cpp" "${for_cmake}")
  endif()
  set(${result} "${example}" PARENT_SCOPE)
endfunction()

foreach(name IN LISTS examples)
  extract(${name} ${name})
endforeach()
if(NOT "quick_start" IN_LIST examples)
  return()
endif()

string(REGEX REPLACE "[][;\\]" "x" lines "${quick_start}")  # what CMake's lists would interpret
string(REGEX MATCHALL "[^\n]+" lines "${lines}")
list(FILTER lines EXCLUDE REGEX "^ *(//.*)?$")
list(LENGTH lines count)
if(count GREATER most_lines)
  message(FATAL_ERROR "the README's quick start has ${count} lines of code; ${most_lines} are promised")
endif()
message(STATUS "quick start: ${count} lines of code")

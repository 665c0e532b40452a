# Takes the README's examples out of it, so that what it shows is what the tests compile:
#   cmake -DREADME=... -DOUTPUT_DIR=... -P extract_examples.cmake
# An example is a ```cpp block after a line <!-- example: NAME -->. It becomes OUTPUT_DIR/NAME.cpp, which includes the
# single header, and OUTPUT_DIR/NAME_cmake.cpp, which includes what the CMake targets offer.
cmake_minimum_required(VERSION 3.22)

set(most_lines 15)  # of code in the quick start: neither blank nor only a comment

if(NOT EXISTS "${README}")
  message(FATAL_ERROR "there is no README.md to take examples from")
endif()
file(READ "${README}" readme)

function(extract name result)
  set(marker "<!-- example: ${name} -->")
  string(FIND "${readme}" "${marker}" begin)
  if(begin EQUAL -1)
    message(FATAL_ERROR "README.md has no line ${marker}")
  endif()
  string(SUBSTRING "${readme}" ${begin} -1 rest)
  if(NOT rest MATCHES "^<!-- [a-z_: ]+ -->[ \n]*```cpp\n")
    message(FATAL_ERROR "README.md: no block ```cpp follows ${marker}")
  endif()
  string(LENGTH "${CMAKE_MATCH_0}" begin)
  string(SUBSTRING "${rest}" ${begin} -1 rest)
  string(FIND "${rest}" "\n```" end)
  if(end EQUAL -1)
    message(FATAL_ERROR "README.md: the example ${name} has no end")
  endif()
  math(EXPR end "${end} + 1")
  string(SUBSTRING "${rest}" 0 ${end} example)
  file(WRITE "${OUTPUT_DIR}/${name}.cpp" "${example}")
  string(REPLACE "\"shortshot.hpp\"" "<shortshot/shortshot.hpp>" for_cmake "${example}")
  file(WRITE "${OUTPUT_DIR}/${name}_cmake.cpp" "${for_cmake}")
  set(${result} "${example}" PARENT_SCOPE)
endfunction()

extract(firmware firmware)
extract(parents parents)
extract(quick_start quick_start)

string(REGEX REPLACE "[][;\\]" "x" lines "${quick_start}")  # what CMake's lists would interpret
string(REGEX MATCHALL "[^\n]+" lines "${lines}")
list(FILTER lines EXCLUDE REGEX "^ *(//.*)?$")
list(LENGTH lines count)
if(count GREATER most_lines)
  message(FATAL_ERROR "the README's quick start has ${count} lines of code; ${most_lines} are promised")
endif()
message(STATUS "quick start: ${count} lines of code")

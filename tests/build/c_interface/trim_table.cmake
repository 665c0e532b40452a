# A copy of the library whose table of descriptors has one line left, as a user may have it:
#   cmake -DSOURCE_DIR=... -DOUTPUT_DIR=... -P trim_table.cmake
cmake_minimum_required(VERSION 3.22)

foreach(part IN ITEMS CMakeLists.txt LICENSE package.xml include single_include)
  file(COPY "${SOURCE_DIR}/${part}" DESTINATION "${OUTPUT_DIR}")
endforeach()
set(file "${OUTPUT_DIR}/single_include/shortshot_c.hpp")
file(READ "${file}" text)
string(REGEX MATCHALL "\n    entry<ss::[^\n]*" lines "${text}")
list(FILTER lines EXCLUDE REGEX "ShapeColor95")
list(LENGTH lines count)
if(count LESS 10)
  message(FATAL_ERROR "the table of descriptors is not where it was: ${count} lines to take out")
endif()
foreach(line IN LISTS lines)
  string(REPLACE "${line}" "" text "${text}")
endforeach()
file(WRITE "${file}" "${text}")

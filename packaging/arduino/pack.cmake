# cmake [-DOUTPUT_DIR=...] -P pack.cmake: the library as Arduino's IDE imports it (Sketch, Include Library, Add .ZIP
# Library): build/packages/shortshot-arduino.zip, and the folder shortshot/ that is in it. Arduino wants the headers in
# src/, and knows no other folder: a clone itself is no Arduino library.
cmake_minimum_required(VERSION 3.22)

get_filename_component(root "${CMAKE_CURRENT_LIST_DIR}/../.." ABSOLUTE)
if(NOT OUTPUT_DIR)
  set(OUTPUT_DIR "${root}/build/packages")
endif()
set(library "${OUTPUT_DIR}/shortshot")

file(REMOVE_RECURSE "${library}")
foreach(part IN ITEMS library.properties src examples)
  file(COPY "${CMAKE_CURRENT_LIST_DIR}/${part}" DESTINATION "${library}")
endforeach()
file(COPY "${root}/single_include/shortshot.hpp" DESTINATION "${library}/src")
file(COPY "${root}/LICENSE" DESTINATION "${library}")
execute_process(COMMAND "${CMAKE_COMMAND}" -E tar cf shortshot-arduino.zip --format=zip shortshot
  WORKING_DIRECTORY "${OUTPUT_DIR}" COMMAND_ERROR_IS_FATAL ANY)
message(STATUS "${OUTPUT_DIR}/shortshot-arduino.zip")

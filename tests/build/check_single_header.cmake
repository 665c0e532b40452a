# cmake -DSOURCE_DIR=... -DOUTPUT_DIR=... -P check_single_header.cmake: is the committed single header what the generator
# makes of the headers?
cmake_minimum_required(VERSION 3.22)

set(fresh "${OUTPUT_DIR}/fresh_shortshot.hpp")
set(committed "${SOURCE_DIR}/single_include/shortshot.hpp")
execute_process(COMMAND_ERROR_IS_FATAL ANY
  COMMAND "${CMAKE_COMMAND}" "-DOUTPUT=${fresh}" -P "${SOURCE_DIR}/single_include/amalgamate.cmake")
execute_process(COMMAND "${CMAKE_COMMAND}" -E compare_files "${fresh}" "${committed}" RESULT_VARIABLE different)
if(different)
  message(FATAL_ERROR "single_include/shortshot.hpp is not what include/shortshot/ makes. Change the headers there, then:\n"
    "  cmake -P single_include/amalgamate.cmake")
endif()

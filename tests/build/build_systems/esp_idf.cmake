# As ESP-IDF does: each component's CMakeLists.txt is read by a script first, which wants to know what the component
# requires, and then belongs to the project.

if(CMAKE_SCRIPT_MODE_FILE)
  macro(idf_component_register)
    message(STATUS "a component")
    return()  # from the component's file
  endmacro()
  include("${COMPONENT}/CMakeLists.txt")
  return()
endif()

# A component without sources is an interface library, its folders are relative to it and must exist.
function(idf_component_register)
  cmake_parse_arguments(PARSE_ARGV 0 component "" "" "INCLUDE_DIRS")
  if(component_UNPARSED_ARGUMENTS OR NOT component_INCLUDE_DIRS)
    message(FATAL_ERROR "idf_component_register() supports INCLUDE_DIRS only")
  endif()
  get_filename_component(name "${CMAKE_CURRENT_LIST_DIR}" NAME)
  add_library(__idf_${name} INTERFACE)
  foreach(directory IN LISTS component_INCLUDE_DIRS)
    if(NOT IS_DIRECTORY "${CMAKE_CURRENT_LIST_DIR}/${directory}")
      message(FATAL_ERROR "Include directory '${directory}' is not a directory")
    endif()
    target_include_directories(__idf_${name} INTERFACE "${CMAKE_CURRENT_LIST_DIR}/${directory}")
  endforeach()
endfunction()

set(component "${PROJECT_BINARY_DIR}/clones/shortshot")
execute_process(COMMAND "${CMAKE_COMMAND}" -DESP_PLATFORM=1 "-DCOMPONENT=${component}" -P "${CMAKE_CURRENT_LIST_FILE}"
  OUTPUT_VARIABLE answer COMMAND_ERROR_IS_FATAL ANY)
if(NOT answer STREQUAL "-- a component\n")
  message(FATAL_ERROR "ESP-IDF's first reading of ${component} says: ${answer}")
endif()
set(ESP_PLATFORM 1)
add_subdirectory("${component}" "${PROJECT_BINARY_DIR}/component")
if(NOT LEFT_OUT)
  target_link_libraries(app PRIVATE __idf_shortshot)  # the application's REQUIRES
endif()

# The page's lines, EXAMPLE, in an application that has the clone beside its CMakeLists.txt.
file(READ "${EXAMPLE}" lines)
file(WRITE "${PROJECT_BINARY_DIR}/clones/CMakeLists.txt" "${lines}\nfind_package(Zephyr REQUIRED)\n")
set(Zephyr_DIR "${PROJECT_SOURCE_DIR}")
if(NOT LEFT_OUT)
  set(CONFIG_SHORTSHOT y)  # prj.conf
endif()
add_subdirectory("${PROJECT_BINARY_DIR}/clones" "${PROJECT_BINARY_DIR}/application")

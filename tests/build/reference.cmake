# Included by CMakeLists.txt: the API reference (./run docs). Every public name has a docstring.

find_package(Doxygen QUIET)
find_libraries(build/reference Doxygen::doxygen)
if(NOT found)
  return()
endif()
set(make_reference "${PROJECT_SOURCE_DIR}/packaging/reference/make.sh")
build_test(reference "${make_reference}" "${there}/reference")
build_test(reference.can_fail "${here}/check_reference.sh" "${PROJECT_SOURCE_DIR}" "${there}/reference"
  "${there}/reference_control")
depends(reference.can_fail reference)

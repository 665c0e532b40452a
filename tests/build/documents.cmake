# Included by CMakeLists.txt.

# ---- Generated and written files -------------------------------------------------------------------------------------

build_test(single_header_is_fresh "${CMAKE_COMMAND}" "-DSOURCE_DIR=${PROJECT_SOURCE_DIR}" "-DOUTPUT_DIR=${there}"
  -P "${here}/check_single_header.cmake")
build_test(changelog_has_version "${CMAKE_COMMAND}" "-DCHANGELOG=${PROJECT_SOURCE_DIR}/CHANGELOG.md"
  -DVERSION=${PROJECT_VERSION} -P "${here}/check_changelog.cmake")
set(include_order "${here}/check_include_order.sh")
build_test(include_order "${include_order}" "${PROJECT_SOURCE_DIR}/include")
build_test(include_order.can_fail "${include_order}" --control "${PROJECT_SOURCE_DIR}/include" "${there}/include_order")
build_test(readme "${CMAKE_COMMAND}" "-DDOCUMENT=${PROJECT_SOURCE_DIR}/README.md"
  -DEXAMPLES=quick_start,robotics,ros2,firmware "-DOUTPUT_DIR=${there}/readme" -P "${here}/extract_examples.cmake")
build_test(links "${here}/check_links.py" "${PROJECT_SOURCE_DIR}")
build_test(links.can_fail "${here}/check_links.py" --control "${there}/links")
build_test(run_script "${here}/test_run.sh" "${PROJECT_SOURCE_DIR}/run" "${there}/run_script")
build_test(fuzz_script "${here}/test_fuzz.sh" "${PROJECT_SOURCE_DIR}/tests/fuzz/fuzz.sh" "${there}/fuzz_script")

if(TARGET results_writer AND EXISTS "${PROJECT_SOURCE_DIR}/bench/results/peers.json")
  build_test(results_are_fresh results_writer "${PROJECT_SOURCE_DIR}" --check)
endif()

set(single_header_flag "-I${PROJECT_SOURCE_DIR}/single_include")
build_test(readme.quick_start "${CMAKE_CXX_COMPILER}" -std=c++17 -Wall -Wextra -Wconversion -Wshadow -Werror "${single_header_flag}"
  "${there}/readme/quick_start.cpp" -o "${there}/readme/quick_start")
build_test(readme.quick_start.runs "${there}/readme/quick_start")
build_test(readme.firmware "${CMAKE_CXX_COMPILER}" -std=c++17 ${SHORTSHOT_WARNINGS} "${single_header_flag}" -O2 -fno-pie
  ${no_runtime} -c "${there}/readme/firmware.cpp" -o "${there}/readme/firmware.o")
build_test(readme.firmware.symbols "${check_symbols}" "${there}/readme/firmware.o")
build_test(readme.firmware.links "${CMAKE_CXX_COMPILER}" -std=c++17 "${here}/firmware_main.cpp" "${there}/readme/firmware.o"
  -no-pie -o "${there}/readme/firmware")
build_test(readme.firmware.runs "${there}/readme/firmware")
# As for ROS, with a stand-in for its message; and a pose between two of them.
build_test(readme.robotics "${CMAKE_CXX_COMPILER}" -std=c++17 ${SHORTSHOT_WARNINGS} "${single_header_flag}" "-I${here}/ros" "-I${PROJECT_SOURCE_DIR}/tests/unit" -O2
  "${there}/readme/ros2.cpp" "${there}/readme/robotics.cpp" "${here}/robotics_main.cpp" -o "${there}/readme/robotics")
build_test(readme.robotics.runs "${there}/readme/robotics")
depends(readme.robotics readme)
depends(readme.robotics.runs readme.robotics)
depends(readme.quick_start readme)
depends(readme.quick_start.runs readme.quick_start)
depends(readme.firmware readme)
depends(readme.firmware.symbols readme.firmware)
depends(readme.firmware.links readme.firmware)
depends(readme.firmware.runs readme.firmware.links)

# ---- Pages beside the code ------------------------------------------------------------------------------------------

foreach(page IN ITEMS descriptor:parents recognition:recognition)
  string(REPLACE ":" ";" page "${page}")
  list(GET page 0 folder)
  list(GET page 1 example)
  build_test(page.${folder} "${CMAKE_COMMAND}" "-DDOCUMENT=${PROJECT_SOURCE_DIR}/include/shortshot/${folder}/README.md"
    "-DEXAMPLES=${example}" "-DOUTPUT_DIR=${there}/page_${folder}" -P "${here}/extract_examples.cmake")
  build_test(page.${folder}.${example} "${CMAKE_CXX_COMPILER}" -std=c++17 ${SHORTSHOT_WARNINGS} "${single_header_flag}" -O2
    -c "${there}/page_${folder}/${example}.cpp" -o "${there}/page_${folder}/${example}.o")
  depends(page.${folder}.${example} page.${folder})
endforeach()

# ---- The map: how to add a signal, a voting rule, ... ----------------------------------------------------------------

set(additions add_signal add_voting_rule add_search add_frame add_storage)
string(REPLACE ";" "," names "${additions}")
build_test(map "${CMAKE_COMMAND}" "-DDOCUMENT=${PROJECT_SOURCE_DIR}/include/shortshot/README.md" "-DEXAMPLES=${names}"
  "-DOUTPUT_DIR=${there}/map" -P "${here}/extract_examples.cmake")
foreach(addition IN LISTS additions)
  build_test(map.${addition} "${CMAKE_CXX_COMPILER}" -std=c++17 -Wall -Wextra -Wconversion -Wshadow -Werror
    "${single_header_flag}" "${there}/map/${addition}.cpp" -o "${there}/map/${addition}")
  build_test(map.${addition}.runs "${there}/map/${addition}")
  depends(map.${addition} map)
  depends(map.${addition}.runs map.${addition})
endforeach()

# ---- The page for firmware engineers ---------------------------------------------------------------------------------

set(page "${there}/firmware_page")
build_test(firmware_page "${CMAKE_COMMAND}" "-DDOCUMENT=${PROJECT_SOURCE_DIR}/bench/firmware/README.md"
  -DEXAMPLES=firmware,cycles,train_for_flash,recognize,learn,small_sensor,zephyr "-DOUTPUT_DIR=${page}" -P "${here}/extract_examples.cmake")
build_test(firmware_page.host "${CMAKE_CXX_COMPILER}" -std=c++17 ${SHORTSHOT_WARNINGS} "${single_header_flag}" -O2
  "${page}/firmware.cpp" "${here}/firmware_page_main.cpp" -o "${page}/firmware")
build_test(firmware_page.host.runs "${page}/firmware")
depends(firmware_page.host firmware_page)
depends(firmware_page.host.runs firmware_page.host)
build_test(firmware_page.recognition "${CMAKE_CXX_COMPILER}" -std=c++17 ${SHORTSHOT_WARNINGS} "${single_header_flag}"
  "${page}/train_for_flash.cpp" "${page}/recognize.cpp" "${page}/learn.cpp" "${here}/recognition_page_main.cpp"
  -o "${page}/recognition")
build_test(firmware_page.recognition.runs "${page}/recognition")
depends(firmware_page.recognition firmware_page)
depends(firmware_page.recognition.runs firmware_page.recognition)
build_test(firmware_page.small_sensor_host "${CMAKE_CXX_COMPILER}" -std=c++17 ${SHORTSHOT_WARNINGS} "${single_header_flag}"
  "${page}/small_sensor.cpp" "${here}/small_sensor_page_main.cpp" -o "${page}/small_sensor")
build_test(firmware_page.small_sensor_host.runs "${page}/small_sensor")
depends(firmware_page.small_sensor_host firmware_page)
depends(firmware_page.small_sensor_host.runs firmware_page.small_sensor_host)
if(arm-none-eabi_compiler)
  foreach(example IN ITEMS firmware cycles recognize learn small_sensor)
    build_test(firmware_page.${example} "${arm-none-eabi_compiler}" -std=c++17 ${SHORTSHOT_WARNINGS} "${single_header_flag}"
      -Os ${no_runtime} ${cortex_m7} -c "${page}/${example}.cpp" -o "${page}/${example}.o")
    build_test(firmware_page.${example}.symbols "${check_symbols}" "${page}/${example}.o")
    set_tests_properties(build.firmware_page.${example}.symbols PROPERTIES
      ENVIRONMENT "NM=arm-none-eabi-nm;OBJDUMP=arm-none-eabi-objdump")
    depends(firmware_page.${example} firmware_page)
    depends(firmware_page.${example}.symbols firmware_page.${example})
  endforeach()
endif()

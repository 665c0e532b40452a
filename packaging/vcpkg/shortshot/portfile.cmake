# An overlay port, of the clone that it lies in: vcpkg install shortshot --overlay-ports=packaging/vcpkg
# vcpkg's binary cache knows the port's files only: after a change of the clone add --binarysource=clear.
get_filename_component(SOURCE_PATH "${CURRENT_PORT_DIR}/../../.." ABSOLUTE)
set(VCPKG_BUILD_TYPE release)  # headers only

vcpkg_cmake_configure(SOURCE_PATH "${SOURCE_PATH}"
  OPTIONS
    -DSHORTSHOT_BUILD_TESTS=OFF
    -DSHORTSHOT_BUILD_BENCH=OFF
    -DSHORTSHOT_INSTALL_CMAKEDIR=share/${PORT}
    -DCMAKE_INSTALL_DOCDIR=share/${PORT})
vcpkg_cmake_install()
vcpkg_fixup_pkgconfig()
file(INSTALL "${CURRENT_PORT_DIR}/usage" DESTINATION "${CURRENT_PACKAGES_DIR}/share/${PORT}")

"""Conan 2, from the clone that this file lies in: conan create packaging/conan"""
import os
import re

from conan import ConanFile
from conan.tools.cmake import CMake, CMakeToolchain, cmake_layout
from conan.tools.files import copy, load


class Shortshot(ConanFile):
    name = "shortshot"
    description = "Short color-shape descriptors (SSH, SCSH, SHOT, CSHOT, B-SHOT) of RGB-D point clouds, header-only"
    license = "BSD-3-Clause"
    topics = ("point-cloud", "descriptor", "rgb-d", "shot", "robotics", "header-only")
    package_type = "header-library"
    settings = "os", "arch", "compiler", "build_type"
    no_copy_source = True

    def _clone(self, *path):
        return os.path.join(self.recipe_folder, "..", "..", *path)

    def set_version(self):
        header = load(self, self._clone("include", "shortshot", "version.hpp"))
        self.version = ".".join(re.findall(r"SHORTSHOT_VERSION_(?:MAJOR|MINOR|PATCH) (\d+)\n", header))

    def export_sources(self):
        for file in ("CMakeLists.txt", "LICENSE", "package.xml"):
            copy(self, file, self._clone(), self.export_sources_folder)
        copy(self, "*.hpp", self._clone("include"), os.path.join(self.export_sources_folder, "include"))

    def layout(self):
        cmake_layout(self)

    def generate(self):
        toolchain = CMakeToolchain(self)
        toolchain.cache_variables["SHORTSHOT_BUILD_TESTS"] = False
        toolchain.cache_variables["SHORTSHOT_BUILD_BENCH"] = False
        toolchain.cache_variables["SHORTSHOT_INSTALL_CMAKEDIR"] = "cmake"
        toolchain.generate()

    def build(self):
        CMake(self).configure()

    def package(self):
        CMake(self).install()
        copy(self, "LICENSE", self.source_folder, os.path.join(self.package_folder, "licenses"))

    def package_id(self):
        self.info.clear()  # the same for every compiler

    def package_info(self):
        self.cpp_info.bindirs = []
        self.cpp_info.libdirs = []
        self.cpp_info.builddirs = ["cmake"]  # shortshotConfig.cmake; Conan needs to write none
        self.cpp_info.set_property("cmake_find_mode", "none")

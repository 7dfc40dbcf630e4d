# SPDX-License-Identifier: Apache-2.0
"""Builds and runs the consumers of tests/consumer with the package that was just made."""
import os

from conan import ConanFile
from conan.tools.build import can_run
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout


class TrisectTest(ConanFile):
    settings = "os", "compiler", "build_type", "arch"

    def requirements(self):
        self.requires(self.tested_reference_str)

    def layout(self):
        cmake_layout(self)

    def generate(self):
        CMakeDeps(self).generate()
        CMakeToolchain(self).generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure(build_script_folder=os.path.join("..", "..", "tests", "consumer", "project"))
        cmake.build()

    def test(self):
        if can_run(self):
            for program in ("consumer", "from_manifold"):
                self.run(os.path.join(self.cpp.build.bindir, program), env="conanrun")

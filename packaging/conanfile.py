# SPDX-License-Identifier: Apache-2.0
"""Conan recipe of Trisect: ``conan create packaging``. Written for Conan 2; see docs/packages.md for what was tried."""
import pathlib

from conan import ConanFile
from conan.tools.build import check_min_cppstd
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import copy


class TrisectConan(ConanFile):
    name = "trisect"
    version = "0.1.0"
    license = "Apache-2.0"
    description = "Exact solid modelling: booleans, queries and interference of polygon meshes"
    topics = ("geometry", "boolean", "mesh", "csg")
    package_type = "static-library"
    settings = "os", "compiler", "build_type", "arch"
    options = {"with_tbb": [True, False], "fPIC": [True, False]}
    default_options = {"with_tbb": True, "fPIC": True}

    def layout(self):
        cmake_layout(self, src_folder=".")

    def export_sources(self):
        root = pathlib.Path(self.recipe_folder).parent
        for part in ("CMakeLists.txt", "LICENSE", "kernel/*", "brep/*", "bsp/*", "scripts/cmake/*"):
            copy(self, part, root, self.export_sources_folder)

    def requirements(self):
        self.requires("gmp/6.3.0")
        self.requires("boost/1.83.0", visible=False)
        if self.options.with_tbb:
            self.requires("onetbb/2021.12.0")

    def validate(self):
        check_min_cppstd(self, 20)

    def generate(self):
        dependencies = CMakeDeps(self)
        dependencies.generate()
        toolchain = CMakeToolchain(self)
        for name in ("APPS", "TESTS", "EXAMPLES", "C", "PYTHON", "MANIFOLD", "BENCH"):
            toolchain.cache_variables[f"TRISECT_BUILD_{name}"] = False
        toolchain.cache_variables["TRISECT_BATCHES"] = True
        toolchain.cache_variables["TRISECT_INSTALL"] = True
        toolchain.cache_variables["TRISECT_WITH_3MF"] = False
        toolchain.cache_variables["TRISECT_WITH_TEXT"] = False
        toolchain.cache_variables["TRISECT_WITH_TBB"] = bool(self.options.with_tbb)
        gmp = pathlib.Path(self.dependencies["gmp"].package_folder)
        toolchain.cache_variables["CMAKE_PREFIX_PATH"] = gmp.as_posix()
        toolchain.generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        copy(self, "LICENSE", self.source_folder, pathlib.Path(self.package_folder) / "licenses")
        CMake(self).install()

    def package_info(self):
        # Users get the project's own trisect-config.cmake.
        self.cpp_info.set_property("cmake_find_mode", "none")
        self.cpp_info.builddirs = ["lib/cmake/trisect"]
        self.cpp_info.libs = ["trisect_csg", "trisect_interference", "trisect_bsp", "trisect_brep", "trisect_kernel"]
        self.cpp_info.cxxflags = ["-ffp-contract=off"]

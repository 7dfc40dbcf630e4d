# SPDX-License-Identifier: Apache-2.0
"""Conan package of a library that Debian has installed, in place of the one of Conan's index.

    conan create packaging/conan/debian_stand_in.py --name gmp --version 6.3.0

scripts/test-conan uses it: the recipe of Trisect can so be run where that index is not to be had.
"""
import pathlib
import subprocess

from conan import ConanFile
from conan.tools.files import copy

# Debian's package, folders and files of headers below /usr/include, libraries.
CONTENT = {
    "gmp": (["gmp.h", "gmpxx.h"], ["libgmp.a", "libgmpxx.a"]),
    "boost": (["boost/*"], []),
    "onetbb": (["tbb/*", "oneapi/*"], ["libtbb.so*"]),
}


class DebianStandIn(ConanFile):
    settings = "os", "compiler", "build_type", "arch"

    def package(self):
        headers, libraries = CONTENT[self.name]
        triplet = subprocess.check_output(["gcc", "-print-multiarch"], text=True).strip()
        package = pathlib.Path(self.package_folder)
        for pattern in headers:
            for folder in ("/usr/include", f"/usr/include/{triplet}"):
                copy(self, pattern, folder, package / "include")
        for pattern in libraries:
            copy(self, pattern, f"/usr/lib/{triplet}", package / "lib")

    def package_info(self):
        self.cpp_info.libs = {"gmp": ["gmpxx", "gmp"], "onetbb": ["tbb"]}.get(self.name, [])
        if self.name == "onetbb":
            self.cpp_info.set_property("cmake_file_name", "TBB")
            self.cpp_info.set_property("cmake_target_name", "TBB::tbb")
        if self.name == "boost":
            self.cpp_info.set_property("cmake_file_name", "Boost")
            self.cpp_info.set_property("cmake_target_name", "Boost::headers")

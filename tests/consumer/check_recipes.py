#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""check_recipes.py ROOT CMAKE

The recipes in ROOT/packaging can be read, have the project's version, and name only options that the project has. They are
not run: that takes vcpkg (scripts/test-vcpkg), docker or buildah, and conan (scripts/test-conan).
"""
import json
import pathlib
import re
import subprocess
import sys
import tempfile

STUBS = ('vcpkg_check_linkage', 'vcpkg_check_features', 'vcpkg_cmake_configure', 'vcpkg_cmake_install',
         'vcpkg_cmake_config_fixup', 'vcpkg_fixup_pkgconfig', 'vcpkg_install_copyright')


def problems_of(root, cmake):
    packaging = root / 'packaging'
    lists = (root / 'CMakeLists.txt').read_text(encoding='utf-8')
    version = re.search(r'^    VERSION ([\d.]+)$', lists, re.MULTILINE)[1]
    port = json.loads((packaging / 'vcpkg' / 'trisect' / 'vcpkg.json').read_text(encoding='utf-8'))
    conan = (packaging / 'conanfile.py').read_text(encoding='utf-8')
    compile(conan, 'conanfile.py', 'exec')
    versions = {'vcpkg.json': port['version-semver'],
                'conanfile.py': re.search(r'version = "([^"]*)"', conan)[1],
                'changelog': re.match(r'trisect \(([\d.]+)-', (packaging / 'debian' / 'changelog').read_text())[1]}
    for name, found in versions.items():
        if found != version:
            yield f'{name} has version {found}, the project {version}'
    options = set(re.findall(r'\b(TRISECT_\w+)', lists))
    named = {f'TRISECT_BUILD_{name}' for name in re.findall(r'"([A-Z]+)"', re.search(r'for name in \((.*)\)', conan)[1])}
    for path in (packaging / 'conanfile.py', packaging / 'vcpkg' / 'trisect' / 'portfile.cmake',
                 packaging / 'debian' / 'rules'):
        named |= set(re.findall(r'\bTRISECT_(?!BUILD_\{)\w+', path.read_text(encoding='utf-8')))
    for name in sorted(named - options - {'TRISECT_PYTHON_DIR', 'TRISECT_ZSH_DIR'}):
        yield f'there is no option {name}'
    with tempfile.TemporaryDirectory() as folder:
        script = pathlib.Path(folder) / 'stubs.cmake'
        script.write_text('cmake_policy(VERSION 3.25)\n' + ''.join(f'function({s})\nendfunction()\n' for s in STUBS)
                          + f'set(CURRENT_PACKAGES_DIR "{folder}/packages")\n'
                          + f'include("{packaging}/vcpkg/trisect/portfile.cmake")\n', encoding='utf-8')
        done = subprocess.run([cmake, '-P', script], capture_output=True, text=True, check=False)
        if done.returncode:
            yield f'portfile.cmake: {done.stderr}'
    stages = re.findall(r'^FROM|^RUN|^COPY|^CMD|^WORKDIR', (packaging / 'Dockerfile').read_text(), re.MULTILINE)
    if stages.count('FROM') != 2:
        yield 'Dockerfile: two stages are expected'


def main():
    problems = list(problems_of(pathlib.Path(sys.argv[1]).resolve(), sys.argv[2]))
    for problem in problems:
        print(f'check_recipes.py: {problem}', file=sys.stderr)
    return 1 if problems else 0


if __name__ == '__main__':
    sys.exit(main())

#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""build.py [--mode release|debug] [--clean] [--prefix DIR]

Builds bin/trisect_runner with an installed trisect (cmake --install, libtrisect-dev, vcpkg or conan; where it is
not in a place that CMake searches, --prefix or CMAKE_PREFIX_PATH names it), and writes bin/build-info.json.
"""
import argparse
import json
import pathlib
import shutil
import subprocess

FOLDER = pathlib.Path(__file__).resolve().parent


def version_of(program):
    return subprocess.run([program, '--version'], capture_output=True, text=True, check=True).stdout.splitlines()[0]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[2])
    parser.add_argument('--mode', choices=['release', 'debug'], default='release')
    parser.add_argument('--clean', action='store_true', help='remove what was built, and stop')
    parser.add_argument('--prefix', help='where trisect is installed')
    parser.add_argument('--bin', default=FOLDER / 'bin', type=pathlib.Path, help='where the program goes')
    parser.add_argument('-y', '--accept-licenses', action='store_true', help='there is none to accept: Apache-2.0')
    arguments = parser.parse_args()
    build = arguments.bin / 'build'
    if arguments.clean:
        shutil.rmtree(arguments.bin, ignore_errors=True)
        return
    build.mkdir(parents=True, exist_ok=True)
    prefix = [f'-DCMAKE_PREFIX_PATH={pathlib.Path(arguments.prefix).resolve()}'] if arguments.prefix else []
    subprocess.run(['cmake', '-S', FOLDER, '-B', build, f'-DCMAKE_BUILD_TYPE={arguments.mode.capitalize()}',
                    f'-DCMAKE_RUNTIME_OUTPUT_DIRECTORY={arguments.bin.resolve()}', *prefix], check=True)
    subprocess.run(['cmake', '--build', build, '--parallel'], check=True)
    info = {'mode': arguments.mode, 'upstream': {'source': 'system', 'resolved_version': '0.1.0'},
            'toolchain': {'cmake': version_of('cmake'), 'cxx': version_of('c++')}}
    (arguments.bin / 'build-info.json').write_text(json.dumps(info, indent=2) + '\n', encoding='utf-8')


if __name__ == '__main__':
    main()

#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""check_test_folders.py ROOT [TABLE]

Reads the sources below ROOT/tests and the table of folders (test_folders.txt beside this script), and fails
where

  - a folder of tests is neither in the table nor that of a room with sources, or a folder of the table is not
    there;
  - NAME_test.cpp includes NAME.h and is in the folder of another room than NAME.h and NAME.cpp;
  - an include goes to a folder of tests that the table does not allow, or to a file that does not exist;
  - a CMakeLists.txt calls a case SLOW that its folder does not have.
"""
import pathlib
import re
import sys

LAYERS = ('kernel', 'brep', 'bsp')
SLOW = re.compile(r'trisect_add_test\([^()]*?\sSLOW\s([^()]*)\)')
INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*"([^"]+)"', re.MULTILINE)
# Folders that are not of tests, and whose headers are included by a path of their own.
OUTSIDE = ('bench/', 'gdml/', 'pieces/', 'scenes/', 'trisect/')


def read_table(text, problem):
    """Every folder that is no room's, with those that it may include."""
    table = {}
    for number, line in enumerate(text.split('\n'), 1):
        line = line.split('#')[0].strip()
        if not line:
            continue
        name, colon, below = line.partition(':')
        name = name.strip()
        if not colon or not name or name in table:
            problem(f'test_folders.txt:{number}: cannot read "{line}"')
            continue
        for folder in set(below.split()) - table.keys():
            problem(f'test_folders.txt:{number}: {folder} is not above in this list')
        table[name] = {name, *below.split()}
    return table


class Check:
    def __init__(self, root, table_path):
        self.root = root
        self.tests = root / 'tests'
        self.problems = []
        self.table = read_table(table_path.read_text(encoding='utf-8'), self.problems.append)
        self.files = self.sources(self.tests)
        library = [path for layer in LAYERS for path in self.sources(root / layer)]
        self.rooms = {self.folder(path) for path in library}
        self.homes = {}
        for path in library:
            self.homes.setdefault(path.stem, set()).add(self.folder(path))

    def sources(self, top):
        return sorted(path for path in top.rglob('*') if path.suffix in ('.h', '.cpp'))

    def folder(self, path):
        return path.relative_to(self.root).parent.as_posix()

    def run(self):
        if not self.files:
            self.problems.append(f'no tests below {self.root}')
        for name in self.table:
            if name != 'rooms' and not (self.tests / name).is_dir():
                self.problems.append(f'test_folders.txt: tests/{name} does not exist')
        for folder in sorted({self.folder(path) for path in self.files}):
            self.place(folder.removeprefix('tests/'))
        for path in self.files:
            self.name(path)
            self.includes(path)
        for listed in sorted(self.tests.rglob('CMakeLists.txt')):
            self.slow_cases(listed)
        return self.problems

    def place(self, folder):
        if folder not in self.rooms and folder.split('/')[0] not in self.table:
            self.problems.append(f'tests/{folder}: there is no room {folder}, and test_folders.txt has no such folder')

    def name(self, path):
        folder = self.folder(path).removeprefix('tests/')
        if not path.name.endswith('_test.cpp') or folder not in self.rooms:
            return
        stem = path.name.removesuffix('_test.cpp')
        if re.search(fr'#include <trisect/(\w+/)*{stem}\.h>', path.read_text(encoding='utf-8')):
            homes = self.homes.get(stem, {folder})
            if folder not in homes:
                self.problems.append(f'{path.relative_to(self.root)}: what it tests is in {", ".join(sorted(homes))}')

    def includes(self, path):
        text = path.read_text(encoding='utf-8')
        folder = self.folder(path).removeprefix('tests/')
        reach = self.table.get(folder.split('/')[0], {folder, *self.table.get('rooms', ())})
        for match in INCLUDE.finditer(text):
            says = self.refusal(path, reach, match[1])
            if says:
                line = text.count('\n', 0, match.start()) + 1
                self.problems.append(f'{path.relative_to(self.root)}:{line}: {match[0].strip()}   <- {says}')

    def slow_cases(self, listed):
        text = ''.join(path.read_text(encoding='utf-8') for path in listed.parent.glob('*.cpp'))
        for match in SLOW.finditer(re.sub(r'#.*', '', listed.read_text(encoding='utf-8'))):
            for case in match[1].split():
                suite, _, name = re.sub(r'^\w+/(?=\w+\.)|/\*$', '', case).partition('.')
                if not re.search(fr'\(\s*{suite},\s*{name}[,)]', text):
                    self.problems.append(f'{listed.relative_to(self.root)}: there is no case {case}')

    def refusal(self, path, reach, what):
        if (path.parent / what).is_file() and '/' not in what:
            return None
        if what.startswith(OUTSIDE):
            return None
        if not (self.tests / what).is_file():
            return 'there is no such file'
        below = what.rpartition('/')[0]
        if below in reach or below.split('/')[0] in reach:
            return None
        return f'may not include tests/{below}'


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit('usage: check_test_folders.py ROOT [TABLE]')
    table = sys.argv[2] if len(sys.argv) == 3 else pathlib.Path(__file__).resolve().parent / 'test_folders.txt'
    problems = Check(pathlib.Path(sys.argv[1]), pathlib.Path(table)).run()
    for problem in problems:
        print(f'check_test_folders.py: {problem}', file=sys.stderr)
    return 1 if problems else 0


if __name__ == '__main__':
    sys.exit(main())

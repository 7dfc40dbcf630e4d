#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""check_rooms.py ROOT [TABLE]

Reads the #include lines of ROOT/kernel, ROOT/brep and ROOT/bsp and the table of rooms (rooms.txt beside this
script), and fails where

  - an include goes to a room that the table does not allow, or out of the library (apps, tests, the umbrella);
  - a header and its source are in two rooms, unless the header is public and the source above it;
  - a source is in no room, or a room has no source;
  - an exception of the table is not needed any more;
  - an include is written relative to the file, which would work in the source tree but not once installed, or
    names a file that does not exist;
  - a file of the libraries, the command or the bindings includes GMP or oneTBB, but for the headers in DOORS;
  - a header brings CGAL or Boost, interop/cgal.h excepted: a user who does not ask for CGAL must not need it,
    and CGAL's licence is not ours; or a public header brings GMP or TBB, which stay private to the .cpp files,
    by these headers or directly;
  - a CMakeLists.txt enters a folder that nobody made;
  - a folder is flat, with more than FLAT sources.
"""
import collections
import pathlib
import re
import sys

LAYERS = ('kernel', 'brep', 'bsp')
FLAT = 44
ABOVE = ('apps', 'c', 'python')
# The only headers that include GMP and oneTBB, so that either can be left out or replaced in one place.
DOORS = {'kernel/number/gmp.h': r'gmp(xx)?\.h', 'kernel/support/thread_pool.h': r'(oneapi/)?tbb/.*',
         'kernel/support/concurrent_map.h': r'(oneapi/)?tbb/.*'}
BEHIND = re.compile(r'gmp(xx)?\.h|(oneapi/)?tbb/')
INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*([<"])([^>"]+)[>"]', re.MULTILINE)
ENTERED = re.compile(r'^[ \t]*(trisect_add_subfolders|add_subdirectory)\(([^)]*)\)', re.MULTILINE)

Room = collections.namedtuple('Room', 'name is_public reach')


class Table:
    """The rooms, which of them may include which, and the exceptions."""

    def __init__(self, text, problem):
        self.rooms = {}
        self.floor_of = {}
        self.splits = {}
        self.ups = set()
        for number, line in enumerate(text.split('\n'), 1):
            line = line.split('#')[0].strip()
            if line:
                self.read(line, lambda says, at=number: problem(f'rooms.txt:{at}: {says}'))

    def read(self, line, problem):
        words = line.split()
        if words[0] == 'floor':
            self.floor_of.update((path, words[1]) for path in words[3:])
        elif words[0] == 'split' and len(words) == 3:
            self.splits[words[1]] = words[2]
        elif words[0] == 'up' and len(words) == 3:
            self.ups.add((words[1], words[2]))
        elif ':' in words:
            is_public = words[0] == 'public'
            name = words[is_public]
            if name in self.rooms:
                problem(f'{name} is there twice')
            reach = {name}
            for below in words[words.index(':') + 1:]:
                alone = below.startswith('=')
                below = below.lstrip('=')
                if below in self.rooms:
                    reach |= {below} if alone else self.rooms[below].reach
                else:
                    problem(f'{name} may include {below}, which is not above in this list')
            self.rooms[name] = Room(name, is_public, reach)
        else:
            problem(f'cannot read "{line}"')

    def room_of(self, path):
        return self.rooms.get(self.floor_of.get(path, path.rpartition('/')[0]))


class Check:
    def __init__(self, root, table_path):
        self.root = root
        self.problems = []
        self.table = Table(table_path.read_text(encoding='utf-8'), self.problems.append)
        self.files = sorted(str(p.relative_to(root)) for layer in LAYERS for p in (root / layer).rglob('*')
                            if p.suffix in ('.h', '.cpp'))
        self.ups_met = set()

    def run(self):
        if not self.files:
            self.problems.append(f'no sources below {self.root}')
        self.places()
        self.pairs()
        for path in self.files:
            self.includes(path)
        for path in sorted(p for folder in ABOVE for p in (self.root / folder).rglob('*')
                           if p.suffix in ('.h', '.cpp', '.c')):
            self.doors(str(path.relative_to(self.root)), path.read_text(encoding='utf-8'))
        for path, header in sorted(self.table.ups - self.ups_met):
            self.problems.append(f'rooms.txt: {path} -> {header} is not needed any more')
        self.folders()
        return self.problems

    def places(self):
        used = set()
        for path in self.files:
            room = self.table.room_of(path)
            if room is None:
                self.problems.append(f'{path}: in no room of rooms.txt')
            else:
                used.add(room.name)
        for name in self.table.rooms.keys() - used:
            self.problems.append(f'rooms.txt: nothing is in {name}')
        for path in self.table.floor_of.keys() - set(self.files):
            self.problems.append(f'rooms.txt: {path} does not exist')
        flat = collections.Counter(path.rpartition('/')[0] for path in self.files)
        for folder, count in flat.items():
            if count > FLAT:
                self.problems.append(f'{folder} is flat: {count} files')

    def pairs(self):
        """What a header declares is defined in its room."""
        headers = collections.defaultdict(list)
        for path in self.files:
            if path.endswith('.h'):
                headers[path.rpartition('/')[2][:-2]].append(path)
        needed = set()
        for path in self.files:
            found = headers[path.rpartition('/')[2][:-4]] if path.endswith('.cpp') else []
            header = self.own_header(path, found)
            room, below = self.table.room_of(path), header and self.table.room_of(header)
            if not room or not below or room is below or below.is_public and below.name in room.reach:
                continue
            needed.add(header)
            if self.table.splits.get(header) != path:
                self.problems.append(f'{path}: its header is in another room, {header}')
        for header in self.table.splits.keys() - needed:
            self.problems.append(f'rooms.txt: the split of {header} is not needed any more')

    def own_header(self, path, found):
        """That of its name which it includes first, or one beside it."""
        match = INCLUDE.search((self.root / path).read_text(encoding='utf-8'))
        first = match and match[2].removeprefix('trisect/')
        beside = path[:-4] + '.h'
        return first if first in found else beside if beside in found else None

    def includes(self, path):
        text = (self.root / path).read_text(encoding='utf-8')
        room = self.table.room_of(path)
        is_header = path.endswith('.h') and path != 'brep/interop/cgal.h'
        for match in INCLUDE.finditer(text):
            mark, what = match.groups()
            says = self.refusal(path, room, mark, what)
            if not says and is_header and what.startswith(('CGAL/', 'boost/')):
                says = 'CGAL and Boost stay out of headers'
            is_private = BEHIND.match(what) or what.removeprefix('trisect/') in DOORS
            if not says and is_header and is_private and room and room.is_public:
                says = 'GMP and TBB stay inside .cpp files and rooms that are not public'
            if says:
                line = text.count('\n', 0, match.start()) + 1
                self.problems.append(f'{path}:{line}: {match[0].strip()}   <- {says}')
        self.doors(path, text)

    def doors(self, path, text):
        for match in INCLUDE.finditer(text):
            if BEHIND.match(match[2]) and not re.fullmatch(DOORS.get(path, ''), match[2]):
                line = text.count('\n', 0, match.start()) + 1
                self.problems.append(f'{path}:{line}: {match[0].strip()}   <- only by {" ".join(sorted(DOORS))}')

    def refusal(self, path, room, mark, what):
        if mark == '"':
            return 'write <trisect/room/name.h>'
        if not what.startswith('trisect/'):
            return None
        header = what.removeprefix('trisect/')
        if header in ('trisect.h', 'manifold.h'):
            return 'a room includes what it uses, not the umbrella'
        if not header.startswith(tuple(f'{layer}/' for layer in LAYERS)):
            return 'the library knows nothing above it'
        if not (self.root / header).is_file():
            return 'there is no such file'
        below = self.table.room_of(header)
        if not room or not below or below.name in room.reach:
            return None
        if (path, header) in self.table.ups:
            self.ups_met.add((path, header))
            return None
        return f'{room.name} may not include {below.name}'

    def folders(self):
        for listed in sorted(self.root.rglob('CMakeLists.txt')):
            shown = listed.relative_to(self.root)
            if shown.parts[0] == 'build':
                continue
            text = re.sub(r'#.*', '', listed.read_text(encoding='utf-8'))
            for match in ENTERED.finditer(text):
                # Of add_subdirectory only the first word is a folder of sources.
                for folder in match[2].split()[:1 if match[1] == 'add_subdirectory' else None]:
                    if '$' not in folder and not (listed.parent / folder / 'CMakeLists.txt').is_file():
                        self.problems.append(f'{shown} enters {folder}, which nobody made')


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit('usage: check_rooms.py ROOT [TABLE]')
    table = sys.argv[2] if len(sys.argv) == 3 else pathlib.Path(__file__).resolve().parent / 'rooms.txt'
    problems = Check(pathlib.Path(sys.argv[1]), pathlib.Path(table)).run()
    for problem in problems:
        print(f'check_rooms.py: {problem}', file=sys.stderr)
    return 1 if problems else 0


if __name__ == '__main__':
    sys.exit(main())

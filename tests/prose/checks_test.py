#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The checks of this folder find what they are for, in folders with one fault each."""
import pathlib
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).parent
REFERENCES = '| short | full |\n|---|---|\n| Fuchs, Kedem, Naylor 1980 | a title |\n'
RESULT = '# A\n\nMade with `x`, commit `0123abc`, 2026-11-22.\n\n## B\n\n| t |\n|---|\n'
HEADER = '// SPDX\n//\n// {}\n// Fuchs 1980.\n'
CLEAN = {'kernel/plane.h': HEADER.format('Plane: an oriented plane.'), 'docs/references.md': REFERENCES,
         'bench/results/a.md': RESULT}
FAULTS = [
    ('comments', 'kernel/plane.cpp', 'int a;  ///< once somebody needs it\n'),
    ('headers', 'kernel/plane.h', '// SPDX\n#pragma once\n'),
    ('headers', 'kernel/plane.h', HEADER.format('Plane: an oriented plane with')),
    ('headers', 'kernel/plane.h', HEADER.format('One two three four five six seven eight nine ten eleven twelve more.')),
    ('headers', 'kernel/plane.h', HEADER.format('Plane: the side that an algorithm asks for.')),
    ('headers', 'kernel/plane.h', HEADER.format('Plane: a wall of a cell.')),
    ('headers', 'kernel/plane.h', HEADER.format('Which side a point is on.')),
    ('references', 'kernel/side.cpp', '/// after Naylor (1987), section 2\n'),
    ('references', 'docs/a.md', 'The trees of Thibault\nand Naylor 1987.\n'),
    ('references', 'kernel/plane.h', '// no citation\n'),
    ('results', 'bench/results/a.md', '# A\n\n| t |\n|---|\n'),
    ('results', 'bench/results/a.md', '# A\n\nMade with `x`, 2026-11-22.\n\n| t |\n|---|\n'),
    ('results', 'bench/results/a.md', '# A\n\n## B\n\nMade with `x`, commit `0123abc`, 2026-11-22.\n\n## C\n\n| t |\n|---|\n'),
]


def passes(check, files):
    with tempfile.TemporaryDirectory() as root:
        for name, text in files.items():
            path = pathlib.Path(root, name)
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding='utf-8')
        command = [sys.executable, str(HERE / f'check_{check}.py'), root]
        return subprocess.run(command, stderr=subprocess.DEVNULL).returncode == 0


def main():
    failures = 0
    for check in ('comments', 'headers', 'references', 'results'):
        if not passes(check, CLEAN):
            print(f'refused without a fault: {check}', file=sys.stderr)
            failures += 1
    for check, name, text in FAULTS:
        if passes(check, dict(CLEAN, **{name: text})):
            print(f'not found by {check}: {text!r}', file=sys.stderr)
            failures += 1
    return 1 if failures else 0


if __name__ == '__main__':
    sys.exit(main())

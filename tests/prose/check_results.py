#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""check_results.py ROOT

Every table in ROOT/bench/results says how it was made: above it, in its section or in one around that, is

    Made with `COMMAND`, commit `ABCDEF0`, YYYY-MM-DD

where more commands and remarks may follow. Otherwise a reader cannot tell which code the figures are of.
"""
import pathlib
import re
import sys

STAMP = re.compile(r'^Made with `[^`]+`.*, commit `[0-9a-f]{7,40}`, 20\d\d-\d\d-\d\d\b')
HEADING = re.compile(r'^(#+) ')


def paragraphs_of(text):
    """Paragraphs of a document as one line each, with the numbers of their first lines."""
    lines, begin = [], 0
    for number, line in enumerate(text.splitlines() + [''], 1):
        if line.strip():
            begin = begin if lines else number
            lines.append(line)
        elif lines:
            yield begin, lines
            lines = []


def problems_of(root):
    for path in sorted((root / 'bench' / 'results').glob('*.md')):
        stamped = []  # by level of heading, that of the text before any heading first
        for begin, lines in paragraphs_of(path.read_text(encoding='utf-8')):
            heading = HEADING.match(lines[-1])
            if heading:
                stamped = (stamped + [False] * 6)[:len(heading.group(1))] + [False]
            elif STAMP.match(' '.join(lines)):
                stamped = (stamped or [False])[:-1] + [True]
            elif lines[0].startswith('|') and not any(stamped):
                yield f'{path.relative_to(root)}:{begin}: a table without command, commit and date'


def main():
    problems = list(problems_of(pathlib.Path(sys.argv[1])))
    for problem in problems:
        print(problem, file=sys.stderr)
    return 1 if problems else 0


if __name__ == '__main__':
    sys.exit(main())

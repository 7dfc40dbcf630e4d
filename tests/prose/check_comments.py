#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""check_comments.py ROOT

Comments of the library describe data by their properties: no verbs of speech, and nobody in particular does anything.
"""
import pathlib
import re
import sys

LAYERS = ('kernel', 'brep', 'bsp')
BANNED = re.compile(r'\b(asks|asking|tells?|telling|told|knows|knew|speaks?|speaking|nobody|somebody|anybody|everybody'
                    r'|who|whoever)\b')
COMMENT = re.compile(r'(?:^|\s)//+<?(.*)')


def problems_of(root):
    for layer in LAYERS:
        for path in sorted((root / layer).rglob('*')):
            if path.suffix not in ('.h', '.cpp'):
                continue
            for number, line in enumerate(path.read_text(encoding='utf-8').splitlines(), 1):
                comment = COMMENT.search(line)
                banned = comment and BANNED.search(comment.group(1))
                if banned:
                    yield f"{path.relative_to(root)}:{number}: '{banned.group(0)}' in a comment"


def main():
    problems = list(problems_of(pathlib.Path(sys.argv[1])))
    for problem in problems:
        print(problem, file=sys.stderr)
    return 1 if problems else 0


if __name__ == '__main__':
    sys.exit(main())

#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""check_references.py ROOT

Every work that a comment of ROOT's sources or a document cites by author and year is in docs/references.md, and every
line of that table is cited somewhere. A citation is a year after a name, a comma or a bracket, with the first author of
a listed work of that year before it in the same paragraph.
"""
import collections
import pathlib
import re
import sys

FOLDERS = ('kernel', 'brep', 'bsp', 'apps', 'bench', 'examples', 'tests', 'docs')
LIST = 'docs/references.md'
REACH = 400  # characters from the first author to the year; titles lie between

# After a bracket or a comma, with punctuation behind it; or after a name.
YEAR = re.compile(r'(?:[\[(]|, )((?:19[5-9]|20[012])\d)(?=[,.;:)\]])'
                  r'|\b(?:[^\W\d_a-z][\w\'-]*|al\.|others),? ((?:19[5-9]|20[012])\d)\b')
MONTH = re.compile(r'(January|February|March|April|May|June|July|August|September|October|November|December) \d{4}')
ENTRY = re.compile(r'^\| ([^|]+) (\d{4}) \|', re.MULTILINE)

Work = collections.namedtuple('Work', 'short author year')


def works_of(table):
    return [Work(f'{names} {year}', re.split(r',| and others', names)[0], year)
            for names, year in ENTRY.findall(table)]


def paragraphs_of(path):
    """Comments of a source, or the text of a document, with each paragraph as one line."""
    lines, text = [], path.read_text(encoding='utf-8')
    for line in text.splitlines():
        if path.suffix != '.md':
            comment = re.match(r'\s*//+<? ?(.*)', line) or re.match(r'.*?\s//+<? (.*)', line)
            line = comment.group(1) if comment else ''
        if line.strip() and not line.startswith('|'):
            lines.append(line.strip())
        elif lines or line.startswith('|'):
            yield ' '.join(lines)
            yield line
            lines = []
    yield ' '.join(lines)


def citations_in(paragraph):
    """Years that look like those of citations, each with the text before it."""
    text = MONTH.sub('', paragraph)
    for match in YEAR.finditer(text):
        yield match.group(1) or match.group(2), text[max(0, match.start() - REACH):match.end()]


def problems_of(root):
    works = works_of((root / LIST).read_text(encoding='utf-8'))
    cited = set()
    for folder in FOLDERS:
        for path in sorted((root / folder).rglob('*')):
            name = path.relative_to(root).as_posix()
            if path.suffix not in ('.h', '.cpp', '.md') or name == LIST or not path.is_file():
                continue
            for paragraph in paragraphs_of(path):
                for year, text in citations_in(paragraph):
                    found = [w for w in works if w.year == year and w.author in text]
                    cited.update(found)
                    if not found:
                        yield f'{name} cites what {LIST} does not list: ... {text[-70:]}'
    for work in works:
        if work not in cited:
            yield f'{LIST} lists {work.short}, which nothing cites'


def main():
    problems = list(problems_of(pathlib.Path(sys.argv[1])))
    for problem in problems:
        print(problem, file=sys.stderr)
    return 1 if problems else 0


if __name__ == '__main__':
    sys.exit(main())

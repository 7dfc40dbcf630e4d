#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""check_installed_headers.py PREFIX

Reads the headers below PREFIX/include/trisect, and fails where one includes a header of ours that is not there,
or has a type of the namespace `detail` in a signature: outside of that namespace, of private members and of
bodies of functions.
"""
import pathlib
import re
import sys

INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*<trisect/([^>]+)>', re.MULTILINE)
COMMENT = re.compile(r'//[^\n]*|/\*.*?\*/', re.DOTALL)
LITERAL = re.compile(r'"(?:[^"\\\n]|\\.)*"')
DIRECTIVE = re.compile(r'^[ \t]*#(?:[^\n]*\\\n)*[^\n]*', re.MULTILINE)
NAMESPACE = re.compile(r'\bnamespace\b(?P<name>[\w:\s]*)$')
CLASS = re.compile(r'\b(?P<key>class|struct|union)\b[^()=]*$')
ACCESS = re.compile(r'\b(public|private|protected)\s*:')
INITIALISERS = re.compile(r'\)\s*(?:noexcept)?\s*:(?!:).*$', re.DOTALL)


class Scope:
    """What a brace opened: whether its text is part of the interface, and whether it is a class."""

    def __init__(self, is_public, is_class=False):
        self.is_public = is_public
        self.is_class = is_class


def opened(before, outer):
    if not outer.is_public:
        return Scope(False)
    namespace = NAMESPACE.search(before)
    if namespace:
        return Scope('detail' not in re.split(r'\W+', namespace['name']))
    found = CLASS.search(before)
    if found and 'enum' not in before:
        return Scope(found['key'] != 'class', True)
    return Scope(False)


def signatures(text):
    """The statements of the interface, one at a time."""
    for pattern in (COMMENT, DIRECTIVE):
        text = pattern.sub(' ', text)
    text = LITERAL.sub('""', text)
    scopes = [Scope(True)]
    statement = ''
    for character in text:
        if character == '{':
            if scopes[-1].is_public:
                yield INITIALISERS.sub(')', statement)
            scopes.append(opened(statement, scopes[-1]))
            statement = ''
        elif character in '};':
            if scopes[-1].is_public:
                yield INITIALISERS.sub(')', statement)
            if character == '}':
                scopes.pop()
            statement = ''
        else:
            statement += character
            access = ACCESS.search(statement)
            if access and scopes[-1].is_class:
                scopes[-1].is_public = access[1] == 'public'
                statement = ''


def main(prefix):
    root = pathlib.Path(prefix) / 'include' / 'trisect'
    headers = sorted(root.rglob('*.h'))
    problems = [] if headers else [f'no headers in {root}']
    for header in headers:
        name = header.relative_to(root)
        text = header.read_text(encoding='utf-8')
        problems += [f'{name}: includes {other}, which is not installed'
                     for other in INCLUDE.findall(text) if not (root / other).exists()]
        problems += [f'{name}: a private type in a signature: {" ".join(s.split())}'
                     for s in signatures(text)
                     if 'detail::' in s and not re.search(r'\bfriend\b', s)]
    for problem in problems:
        print(problem, file=sys.stderr)
    return 1 if problems else 0


if __name__ == '__main__':
    sys.exit(main(sys.argv[1]))

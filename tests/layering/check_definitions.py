#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""check_definitions.py ROOT

Two types of one name in one namespace break the rule of one definition, and nothing says so: the
compiler sees one file at a time, and the linker takes one of the two destructors or vectors for
both. Optimised builds inline most of that and seem to work. This check reads the sources below ROOT,
as one program each

  - kernel, brep, bsp and apps;
  - every folder of tests with those and tests/reference;
  - bench and examples with the same;

and fails where two files define a type, an alias, an inline variable, or an inline function or
template with the same parameters, under one qualified name and outside of anonymous namespaces. It
also fails where a .cpp file defines a type there that no header names: nobody else can use it, and
the next file may well choose its name.

It reads tokens and not C++. Macros are not expanded, and what is inside of types and functions is
passed over. Specialisations and static functions do not count, nor does an alias that says the same
everywhere.
"""
import collections
import pathlib
import re
import sys

TOKEN = re.compile(r'''
      //[^\n]* | /\*.*?\*/                               # comments
    | ^[ \t]*\#(?:[^\n\\]|\\\n|\\.)*                     # directives
    | (?:u8|u|U|L)?R"(?P<raw>[^()\\\s]*)\(.*?\)(?P=raw)" # strings
    | "(?:[^"\\\n]|\\.)*" | '(?:[^'\\\n]|\\.)+'
    | (?P<token>[A-Za-z_]\w* | \d(?:[\w.']|[eEpP][+-])* | :: | \[\[ | \]\] | \S)
    ''', re.VERBOSE | re.DOTALL | re.MULTILINE)
NAME = re.compile(r'[A-Za-z_]\w*$')
KEYS = ('struct', 'class', 'union', 'enum')
BUILT_IN = ('bool', 'char', 'double', 'float', 'int', 'long', 'short', 'unsigned')

Definition = collections.namedtuple('Definition', 'kind name says path line')
Source = collections.namedtuple('Source', 'definitions named_types')


def tokens_of(text):
    """The tokens of a source and their lines, without comments, directives and literals."""
    found, line, at = [], 1, 0
    for match in TOKEN.finditer(text):
        line += text.count('\n', at, match.start())
        at = match.start()
        if match['token']:
            found.append((match['token'], line))
    return found


def end_of(words, at, opening, closing):
    """The index behind the bracket that closes the one at `at`."""
    depth = 0
    for i in range(at, len(words)):
        depth += (words[i] == opening) - (words[i] == closing)
        if depth == 0:
            return i + 1
    return len(words)


def plain(words):
    """A declaration without what stands before it: template <...>, [[...]], alignas(...)."""
    kept, at = [], 0
    while at < len(words):
        if words[at] == 'template' and not kept:
            at = end_of(words, at + 1, '<', '>')
        elif words[at] == '[[':
            at = end_of(words, at, '[[', ']]')
        elif words[at] == 'alignas':
            at = end_of(words, at + 1, '(', ')')
        else:
            kept.append(words[at])
            at += 1
    return kept


def type_in(words):
    """The name in the head of a type's definition, nothing for other heads and specialisations."""
    if not words or words[0] not in KEYS:
        return None
    at = 2 if words[0] == 'enum' and words[1] in ('class', 'struct') else 1
    name, after = (words[at:] + ['', ''])[:2]
    return name if NAME.match(name) and after in ('', ':', 'final') else None


def parameter_types(words):
    """Parameters without their names and defaults."""
    types, current, depth = [], [], 0
    for word in words + [',']:
        depth += (word in '(<{[') - (word in ')>}]')
        if word != ',' or depth != 0:
            current.append(word)
            continue
        if '=' in current:
            current = current[:current.index('=')]
        has_name = (len(current) > 1 and NAME.match(current[-1]) and current[-1] not in BUILT_IN
                    and current[-2] not in ('::', 'const'))
        types.append(' '.join(current[:-1] if has_name else current))
        current = []
    return ', '.join(types)


def function_in(words):
    """Name and parameters in the head of a function; nothing for members and static functions."""
    before = words[:words.index('(')] if '(' in words else []
    if not before or '=' in before or 'static' in before:
        return None
    first = before.index('operator') if 'operator' in before else len(before) - 1
    if first == 0 or before[first - 1] == '::' or not NAME.match(before[first]):
        return None
    end = end_of(words, len(before), '(', ')')
    return f"{''.join(before[first:])}({parameter_types(words[len(before) + 1:end - 1])})"


class Reader:
    """Goes through a source and collects what it defines outside of anonymous namespaces."""

    def __init__(self, path, shown):
        self.shown = shown
        self.is_header = path.suffix == '.h'
        tokens = tokens_of(path.read_text(encoding='utf-8'))
        self.words = [word for word, _ in tokens]
        self.lines = [line for _, line in tokens]
        self.namespaces = []  # None where it has no name
        self.definitions = []

    def read(self):
        start = at = 0
        while at < len(self.words):
            word = self.words[at]
            if word == '{':
                at, is_whole = self.brace(start, at)
                start = at if is_whole else start
                continue
            if word == ';':
                self.statement(start, at)
            elif word == '}' and self.namespaces:
                self.namespaces.pop()
            at += 1
            start = at if word in ';}' else start
        named = {b for a, b in zip(self.words, self.words[1:]) if a in KEYS}
        return Source(self.definitions, named)

    def add(self, kind, name, at, says=''):
        if None not in self.namespaces:
            qualified = '::'.join([n for n in self.namespaces if n] + [name])
            self.definitions.append(Definition(kind, qualified, says, self.shown, self.lines[at]))

    def brace(self, start, at):
        """What begins at `start` and has a brace at `at`: where to go on, and is it at an end?"""
        everything = self.words[start:at]
        words = plain(everything)
        if 'namespace' in words[:2]:
            named = words[words.index('namespace') + 1:]
            self.namespaces.append('::'.join(n for n in named if n != '::') if named else None)
            return at + 1, True
        if words == ['extern']:
            self.namespaces.append('')
            return at + 1, True
        after = end_of(self.words, at, '{', '}')
        if name := type_in(words):
            self.add('type', name, start)
            return after, False
        if '=' in words and 'operator' not in words:
            return after, False
        if '(' not in words:  # a variable, or a type that does not count
            if 'inline' in words and NAME.match(words[-1]):
                self.add('variable', words[-1], start)
            return after, False
        if self.words[after:after + 1] in ([','], ['{']):  # a list of initialisers
            return after, False
        is_shared = self.is_header or {'inline', 'constexpr', 'template'} & set(everything)
        if is_shared and (name := function_in(words)):
            self.add('function', name, start)
        return after, True

    def statement(self, start, end):
        words = plain(self.words[start:end])
        if '=' not in words:
            return
        at = words.index('=')
        if words[0] == 'using':
            self.add('alias', words[1], start, ' '.join(words[at + 1:]))
        elif 'inline' in words[:at] and '(' not in words[:at] and NAME.match(words[at - 1]):
            self.add('variable', words[at - 1], start)


def defined_twice(files, sources):
    """Names that several of the files define, with their definitions."""
    named = collections.defaultdict(list)
    for path in files:
        for definition in sources[path].definitions:
            named[definition.name].append(definition)
    for name, found in named.items():
        same = all(d.kind == 'alias' and d.says == found[0].says for d in found)
        if len({d.path for d in found}) > 1 and not same:
            yield name, found


def main():
    if len(sys.argv) != 2:
        sys.exit('usage: check_definitions.py ROOT')
    root = pathlib.Path(sys.argv[1])

    def below(*folders):
        return sorted(p for f in folders for e in ('*.h', '*.cpp') for p in (root / f).rglob(e))

    product = below('kernel', 'brep', 'bsp', 'apps')
    if not product:
        sys.exit(f'check_definitions.py: no sources below {root}')
    shared = product + below('tests/reference')
    tests = [p for p in sorted((root / 'tests').glob('*')) if p.name != 'reference']
    programs = [shared] + [shared + below(t.relative_to(root)) for t in tests]
    programs += [shared + below(folder) for folder in ('bench', 'examples')]
    sources = {path: Reader(path, str(path.relative_to(root))).read()
               for path in {p for files in programs for p in files}}

    problems = set()
    for files in programs:
        for name, found in defined_twice(files, sources):
            places = ', '.join(f'{d.path}:{d.line}' for d in found)
            problems.add(f'{name} is defined by several files: {places}')
    in_headers = {n for p, s in sources.items() if p.suffix == '.h' for n in s.named_types}
    for path, source in sources.items():
        for d in source.definitions:
            is_hidden = d.kind == 'type' and d.name.rsplit('::', 1)[-1] not in in_headers
            if path.suffix == '.cpp' and is_hidden:
                problems.add(f'{d.path}:{d.line}: no header names {d.name}: '
                             'put it into the anonymous namespace')
    for problem in sorted(problems):
        print(f'check_definitions.py: {problem}', file=sys.stderr)
    return 1 if problems else 0


if __name__ == '__main__':
    sys.exit(main())

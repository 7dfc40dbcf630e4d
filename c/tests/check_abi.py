#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""check_abi.py HEADER RECORD CC [--update]

Compares the binary interface that the C header HEADER declares with the one in RECORD: every function with its types,
every value of an enumeration, and size and offsets of every struct, as the compiler CC lays them out. Any difference
fails. --update writes the record anew. Once a version was released it refuses to, unless the version in the header has
another major or minor number: programs that were linked would go on and find another interface. A record begins, below
the licence, with

    version 0.1 not released

until somebody takes the last two words away. Sizes are those of 64-bit systems.
"""
import difflib
import pathlib
import re
import subprocess
import sys
import tempfile

PROBE = """#include <stddef.h>
#include <stdio.h>
#include "{header}"
int main(void) {{
{body}
    return 0;
}}
"""


def plain(text):
    """Without comments and directives, blanks as one."""
    text = re.sub(r'/\*.*?\*/', ' ', text, flags=re.DOTALL)
    text = re.sub(r'^[ \t]*#.*$', ' ', text, flags=re.MULTILINE)
    return re.sub(r'\s+', ' ', text)


def without_names(arguments):
    """Names of parameters are no part of the interface."""
    def bare(argument):
        argument = re.sub(r'\b\w+((?:\[\w*\])+)$', r'\1', argument.strip())
        if not argument.endswith(']') and re.search(r'[\w*] ?\w+$', argument) and argument != 'void':
            argument = re.sub(r'(?<=[\s*])\w+$', '', argument)
        return re.sub(r' ?([*\[\]]) ?', r'\1', argument).strip()
    return ', '.join(bare(argument) for argument in arguments.split(','))


def functions(text):
    for result, name, arguments in re.findall(r'TRISECT_C_API ([^();]*?)(\w+)\(([^()]*)\);', text):
        yield f'{result.replace(" *", "*").strip()} {name}({without_names(arguments)})'


def enumerators(text):
    for body, name in re.findall(r'typedef enum \w+ \{([^}]*)\} (\w+);', text):
        for entry in body.split(','):
            if entry.strip():
                yield name, entry.split('=')[0].strip()


def members(text):
    for body, name in re.findall(r'typedef struct \w+ \{([^}]*)\} (\w+);', text):
        for line in body.split(';'):
            match = re.fullmatch(r'(.*?)(\w+)((?:\[\w+\])*)', line.strip())
            if match:
                yield name, f'{match[1].strip()}{match[3]}'.replace(' *', '*'), match[2]


def layout(header, text, compiler):
    """Lines that the compiler's own program prints."""
    body = [f'    printf("value {kind} {name} %d\\n", (int){name});' for kind, name in enumerators(text)]
    seen = set()
    for name, kind, member in members(text):
        if name not in seen:
            body.append(f'    printf("struct {name} size %zu\\n", sizeof({name}));')
            seen.add(name)
        body.append(f'    printf("member {name} %zu {kind} {member}\\n", offsetof({name}, {member}));')
    with tempfile.TemporaryDirectory() as folder:
        source, program = pathlib.Path(folder) / 'probe.c', pathlib.Path(folder) / 'probe'
        source.write_text(PROBE.format(header=header, body='\n'.join(body)), encoding='utf-8')
        subprocess.run([compiler, '-std=c99', '-o', program, source], check=True)
        return subprocess.run([program], check=True, capture_output=True, text=True).stdout.splitlines()


def interface(header, compiler):
    whole = header.read_text(encoding='utf-8')
    text = plain(whole)
    version = '.'.join(re.search(rf'#define TRISECT_C_VERSION_{part} (\d+)', whole)[1] for part in ('MAJOR', 'MINOR'))
    return version, sorted(f'function {f}' for f in functions(text)) + layout(header, text, compiler)


def main(header, record, compiler, update):
    version, lines = interface(header.resolve(), compiler)
    declared = plain(header.read_text(encoding='utf-8')).count('TRISECT_C_API ')
    if len([line for line in lines if line.startswith('function ')]) != declared:
        return f'{header}: {declared} declarations, but not all can be read'
    head, *recorded = record.read_text(encoding='utf-8').splitlines()[1:] if record.exists() else ('version none',)
    _, known, *released = head.split(maxsplit=2)
    same = known == version and recorded == lines
    if update:
        is_released = known == version and not released
        if is_released and not same:
            return f'the interface of version {version} was released: raise the version in {header} first'
        head = f'version {version}' if is_released else f'version {version} not released'
        record.write_text('\n'.join(['# SPDX-License-Identifier: Apache-2.0', head, *lines]) + '\n', encoding='utf-8')
        return None
    if same:
        return None
    print(*difflib.unified_diff(recorded, lines, 'recorded', 'declared', lineterm='', n=0), sep='\n', file=sys.stderr)
    if known == version and not released:
        return f'the binary interface of version {version}, which was released, differs: raise the version'
    return f'the binary interface differs from {record}: where that is meant, write it anew with --update'


if __name__ == '__main__':
    arguments = [a for a in sys.argv[1:] if a != '--update']
    if len(arguments) != 3:
        sys.exit('usage: check_abi.py HEADER RECORD CC [--update]')
    problem = main(pathlib.Path(arguments[0]), pathlib.Path(arguments[1]), arguments[2], '--update' in sys.argv)
    if problem:
        sys.exit(f'check_abi.py: {problem}')

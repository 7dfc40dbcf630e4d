#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""split_module.py WHOLE PART OUT MORE

Divides the module WHOLE by binaryen's wasm-split: OUT has what PART has, which is a link of the same objects with fewer
exported functions, and MORE the rest, which shares memory, table and globals with OUT. Both inputs have the names of all
functions and are not optimised yet. MORE imports functions of OUT by names that are made short here.
"""
import pathlib
import subprocess
import sys
import tempfile

FEATURES = ['--enable-exception-handling', '--enable-simd', '--enable-mutable-globals', '--enable-bulk-memory',
            '--enable-sign-ext', '--enable-nontrapping-float-to-int']
CUSTOM, IMPORTS, EXPORTS = 0, 2, 7
PREFIX = b'%'


def number(data, at):
    value = shift = 0
    while True:
        byte = data[at]
        at += 1
        value |= (byte & 127) << shift
        shift += 7
        if byte < 128:
            return value, at


def packed(value):
    out = bytearray()
    while value >= 128:
        out.append(value & 127 | 128)
        value >>= 7
    out.append(value)
    return bytes(out)


def word(data, at):
    size, at = number(data, at)
    return data[at:at + size], at + size


def sections(data):
    at = 8
    while at < len(data):
        size, begin = number(data, at + 1)
        yield data[at], data[begin:begin + size]
        at = begin + size


def skip_import(data, at):
    """Past what is imported, behind its names."""
    kind = data[at]
    at += 1
    if kind in (0, 4):  # a function, a tag
        return number(data, at + (kind == 4))[1]
    if kind == 3:  # a global
        return at + 2
    flags, at = number(data, at + (kind == 1))
    at = number(data, at)[1]
    return number(data, at)[1] if flags & 1 else at


def function_names(data):
    """Of all that have a body: imported ones are numbered first."""
    imported = 0
    for kind, body in sections(data):
        if kind == IMPORTS:
            count, at = number(body, 0)
            for _ in range(count):
                at = word(body, word(body, at)[1])[1]
                imported += body[at] == 0
                at = skip_import(body, at)
        if kind != CUSTOM:
            continue
        name, at = word(body, 0)
        while name == b'name' and at < len(body):
            part, (size, at) = body[at], number(body, at + 1)
            if part == 1:
                count, here = number(body, at)
                out = []
                for _ in range(count):
                    index, here = number(body, here)
                    text, here = word(body, here)
                    if index >= imported:
                        out.append(text)
                return out
            at += size
    sys.exit('split_module: a module without names')


def renamed(data, section, short):
    """The module with other names of exports, or of imports, that begin with PREFIX."""
    out = bytearray(data[:8])
    for kind, body in sections(data):
        if kind == section:
            count, at = number(body, 0)
            made = bytearray(packed(count))
            for _ in range(count):
                if section == IMPORTS:
                    begin = at
                    at = word(body, at)[1]
                    made += body[begin:at]
                name, at = word(body, at)
                name = short.setdefault(name, PREFIX + b'%x' % len(short)) if name.startswith(PREFIX) else name
                made += packed(len(name)) + name
                begin = at
                at = skip_import(body, at) if section == IMPORTS else number(body, at + 1)[1]
                made += body[begin:at]
            body = bytes(made)
        out += bytes([kind]) + packed(len(body)) + body
    return bytes(out)


def main(whole, part, out, more):
    first = set(function_names(part.read_bytes()))
    later = [name for name in function_names(whole.read_bytes()) if name not in first]
    with tempfile.TemporaryDirectory() as folder:
        made = [pathlib.Path(folder) / name for name in ('first', 'more')]
        listed = pathlib.Path(folder) / 'later'
        listed.write_bytes(b'\n'.join(later) + b'\n')
        subprocess.run(['wasm-split', *FEATURES, '-g', whole, f'--split-funcs=@{listed}', '-o1', made[0], '-o2', made[1],
                        f'--export-prefix={PREFIX.decode()}'], check=True)
        short = {}
        for path, section in zip(made, (EXPORTS, IMPORTS)):
            path.write_bytes(renamed(path.read_bytes(), section, short))
        for path, target in zip(made, (out, more)):
            subprocess.run(['wasm-opt', *FEATURES, '-Oz', '--low-memory-unused', path, '-o', target], check=True)


if __name__ == '__main__':
    main(*[pathlib.Path(name) for name in sys.argv[1:]])

#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""compile_headers.py ROOT INCLUDE_DIR COMPILER JOBS

Every header must compile alone, whatever was included before it, and must do so for a user who has no CGAL
licence: CGAL_LICENSE_ERROR turns any use of a GPL part of CGAL into an error. interop/cgal.h and its like are
left out, since they need what they adapt.

Reading the standard library takes nearly all of the time, so one run of the compiler checks a chain of
headers: each includes the one before it, directly or not, so what it sees from before it would see anyway.
The chains are as few as possible: a matching of headers to headers that include them (Fulkerson 1956).
"""
import concurrent.futures
import pathlib
import re
import subprocess
import sys

INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*<trisect/([^>]+)>', re.MULTILINE)
FLAGS = ['-std=c++20', '-fsyntax-only', '-ffp-contract=off', '-Wall', '-Wextra', '-Wpedantic',
         '-DCGAL_LICENSE_ERROR=1']


def headers_below(root):
    found = (path for layer in ('kernel', 'brep', 'bsp') for path in (root / layer).rglob('*.h'))
    return sorted(str(path.relative_to(root)) for path in found
                  if 'interop' not in path.parts and path.name != 'trisect.h')


def closures(includes):
    """All that each header includes, directly or not."""
    known = {}

    def closure(header):
        if header not in known:
            known[header] = set()
            for below in includes[header]:
                known[header] |= {below} | closure(below)
        return known[header]

    return {header: closure(header) for header in includes}


def chains(users):
    """The headers in lists, each of which includes the one before it; users: those that include a header."""
    before = {}

    def extend(header, tried):
        for user in users[header]:
            if user not in tried:
                tried.add(user)
                if user not in before or extend(before[user], tried):
                    before[user] = header
                    return True
        return False

    for header in users:
        extend(header, set())
    after = {header: user for user, header in before.items()}
    result = []
    for header in users:
        if header not in before:
            result.append([header])
            while header in after:
                header = after[header]
                result[-1].append(header)
    return result


def main():
    if len(sys.argv) != 5:
        sys.exit('usage: compile_headers.py ROOT INCLUDE_DIR COMPILER JOBS')
    root, include_dir, compiler, jobs = pathlib.Path(sys.argv[1]), *sys.argv[2:4], int(sys.argv[4])
    headers = headers_below(root)
    includes = {header: [below for below in INCLUDE.findall((root / header).read_text(encoding='utf-8'))
                         if below in headers] for header in headers}
    below = closures(includes)
    users = {header: [user for user in headers if user != header and header in below[user]] for header in headers}

    def is_good(chain):
        text = ''.join(f'#include <trisect/{header}>\n' for header in chain)
        command = [compiler, *FLAGS, f'-I{include_dir}', '-x', 'c++', '-']
        if subprocess.run(command, input=text, text=True, check=False).returncode == 0:
            return True
        print(f'compile_headers.py: does not compile alone: one of {" ".join(chain)}', file=sys.stderr)
        return False

    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        good = list(pool.map(is_good, chains(users)))
    return 0 if headers and all(good) else 1


if __name__ == '__main__':
    sys.exit(main())

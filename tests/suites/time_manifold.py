#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""time_manifold.py BUILD THEIRS [--limit SECONDS]

Manifold's tests with our library and with theirs: each case that passes with both runs once with each, one after the other, as a
process of its own. BUILD: a build of this project with the programs suite_manifold_<name>. THEIRS: Manifold's program
manifold_test of the same commit, built by the caller. Prints seconds of processors, programs and their starts included, for each
program, and the cases that take longest with ours. Cases of ours that take more processor time than the limit count as `slow`.
"""
import argparse
import collections
import pathlib
import resource
import signal
import subprocess
import sys

from run import cases_of


def seconds_of(program, case, limit):
    """Seconds of processors of a case that passes; None of any other; a string where it takes too long."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    run = subprocess.run([program, f'--gtest_filter={case}'], capture_output=True, cwd=program.parent, check=False,
                         preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (limit, limit + 5)))
    if run.returncode == -signal.SIGXCPU:
        return 'slow'
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    is_run = b'[  PASSED  ] 1 test' in run.stdout
    return after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime if run.returncode == 0 and is_run else None


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument('build', type=pathlib.Path)
    parser.add_argument('theirs', type=pathlib.Path)
    parser.add_argument('--limit', type=int, default=60)
    parser.add_argument('--only', default='*')
    arguments = parser.parse_args()
    theirs, longest, total = arguments.theirs.resolve(), [], collections.Counter()
    print('| program | cases | s | s, Manifold | ratio | slow |\n|---|---:|---:|---:|---:|---:|')
    for program in sorted((arguments.build.resolve() / 'bin').glob(f'suite_manifold_{arguments.only}')):
        row = collections.Counter()
        for case in cases_of(program):
            ours = seconds_of(program, case, arguments.limit)
            if ours is None:
                continue
            if ours == 'slow':
                row['slow'] += 1
                continue
            peer = seconds_of(theirs, case, arguments.limit)
            if isinstance(peer, float):
                row.update(cases=1, ours=ours, theirs=peer)
                longest.append((ours, peer, case))
        total += row
        print_row(program.name.removeprefix('suite_manifold_'), row)
    print_row('all', total)
    print('\n| case | s | s, Manifold |\n|---|---:|---:|')
    for ours, peer, case in sorted(longest, reverse=True)[:12]:
        print(f'| {case} | {ours:.2f} | {peer:.2f} |')
    return 0


def print_row(name, row):
    ratio = row['ours'] / row['theirs'] if row['theirs'] else float('nan')
    print(f"| {name} | {row['cases']} | {row['ours']:.2f} | {row['theirs']:.2f} | {ratio:.1f} | {row['slow']} |", flush=True)


if __name__ == '__main__':
    sys.exit(main())

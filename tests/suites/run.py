#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""run.py BUILD [--limit SECONDS] [--only PROGRAM]

Runs the programs suite_<suite>_<name> of a build, case by case, each with a limit of processor time, which other work
on the machine does not use up, and prints a table in Markdown. Cases that do not pass are compared with deviations.txt beside this script:

    PROGRAM CASE KIND: REASON

KIND is "missing" for what the library does not have, "differs" where it answers otherwise, or "slow" for cases that
may not end in time. Fails where a case neither passes nor is listed, where a listed one passes that is not slow, and where
one ends otherwise than its kind says: a crash is never explained.
"""
import argparse
import collections
import pathlib
import re
import resource
import signal
import subprocess
import sys

# How a case of each kind may end.
ENDS = {'missing': ('missing', 'failed'), 'differs': ('failed',), 'slow': ('slow',)}
HERE = pathlib.Path(__file__).parent
MISSING = re.compile(r'not supported: ([^"]*)')


def read_deviations():
    known = {}
    for line in (HERE / 'deviations.txt').read_text(encoding='utf-8').splitlines():
        if line and not line.startswith('#'):
            program, case, rest = line.split(' ', 2)
            kind, reason = rest.split(': ', 1)
            known[program, case] = kind, reason
    return known


def cases_of(program):
    listed = subprocess.run([program, '--gtest_list_tests'], capture_output=True, text=True, check=True)
    suite = ''
    for line in listed.stdout.splitlines():
        if line.startswith(' '):
            yield suite + line.split('#')[0].strip()
        else:
            suite = line.split('#')[0].strip()


def outcome_of(program, case, limit, folder):
    """passed, missing, failed, crashed, slow or stuck, and what it said."""
    try:
        run = subprocess.run([program, f'--gtest_filter={case}', '--gtest_color=no'], capture_output=True, text=True,
                             errors='replace', cwd=folder, timeout=100 * limit, check=False,
                             preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (limit, limit + 5)))
    except subprocess.TimeoutExpired:
        return 'stuck', 'waits for something'
    if run.returncode == -signal.SIGXCPU:
        return 'slow', f'not finished after {limit} s'
    if run.returncode == 0:
        return 'passed', ''
    absent = MISSING.search(run.stdout)
    if absent:
        return 'missing', absent.group(1)
    if run.returncode < 0:
        return 'crashed', f'signal {-run.returncode}'
    said = [line for line in run.stdout.splitlines() if 'Which is' in line or 'actual' in line.lower()
            or 'description' in line]
    return 'failed', ' '.join(' '.join(said).split())[:160]


def processor_seconds():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def run_program(program, limit, known):
    name = program.name.removeprefix('suite_')
    counts = collections.Counter()
    problems = []
    begin = processor_seconds()
    for case in cases_of(program):
        kind, said = outcome_of(program, case, limit, program.parent)
        deviation = known.get((name, case))
        if kind == 'passed':
            counts['passed'] += 1
            if deviation and deviation[0] != 'slow':
                problems.append(f'{name} {case}: passes, but is listed as "{deviation[0]}"')
        elif deviation and kind in ENDS[deviation[0]]:
            counts[deviation[0]] += 1
        else:
            counts['unexplained'] += 1
            problems.append(f'{name} {case}: {kind}: {said}')
    return name, counts, processor_seconds() - begin, problems


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('build', type=pathlib.Path)
    parser.add_argument('--limit', type=int, default=60)
    parser.add_argument('--only', default='*')
    options = parser.parse_args()
    programs = sorted((options.build.resolve() / 'bin').glob(f'suite_{options.only}'))
    if not programs:
        print('run.py: there is no suite in', options.build, file=sys.stderr)
        return 2
    known = read_deviations()
    problems = []
    print('| program | cases | passed | missing | differs | slow | unexplained | seconds |\n'
          '|---|---:|---:|---:|---:|---:|---:|---:|')
    for program in programs:
        name, counts, seconds, found = run_program(program, options.limit, known)
        row = [counts[k] for k in ('passed', 'missing', 'differs', 'slow', 'unexplained')]
        print(f'| {name} | {sum(row)} |', ' | '.join(map(str, row)), f'| {seconds:.1f} |', flush=True)
        problems += found
    for problem in problems:
        print(problem, file=sys.stderr)
    return 1 if problems else 0


if __name__ == '__main__':
    sys.exit(main())

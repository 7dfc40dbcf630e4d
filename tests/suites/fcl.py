#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""fcl.py FOLDER [--peer PROGRAM]

FCL's own tests of shapes (test/test_fcl_geometric_shapes.cpp of github.com/flexible-collision-library/fcl, FOLDER), by the
Python package: whether two shapes meet, and how far apart they are. The file is read, not compiled: shapes, placements and what
is expected of them are taken from its statements (fcl_text.py). Its random turns are turns of ours with rational entries, the
same on both sides. Prints a table in Markdown.

Balls, capsules, cylinders, cones and ellipsoids are no solids of ours. Each is put between two: one within it, whose corners lie
on it, and one around it, cut off by its box (fcl_shapes.py). What the first says of meeting and the second of being apart is proved of
the shape. `undecided` is what neither proves: curved shapes that touch or nearly do. Of a distance the two give an interval, and
a case passes where it meets that of the test; `apart by` there is the tolerance of the test.

With --peer, fcl_answers of a build is asked the same, which is FCL of this machine; what it says against what is proved is listed.
"""
import argparse
import collections
import pathlib
import subprocess
import sys

from fcl_shapes import Undecided, distance_interval, meet
from fcl_text import cases_of
from run import read_deviations


def outcome_of(case):
    """passed, differs, undecided or missing; what is proved; and what is to be said."""
    if not case.is_shape():
        return 'missing', None, case.text
    try:
        met = meet(case.a, case.pose_a, case.b, case.pose_b)
    except Undecided:
        return 'undecided', None, ''
    if met != case.meets:
        return 'differs', met, f'{"meet" if met else "apart"}, which is proved'
    if case.distance is not None and not met:
        low, high = distance_interval(case.a, case.pose_a, case.b, case.pose_b)
        if high < case.distance - case.tolerance or low > case.distance + case.tolerance:
            return 'differs', met, f'distance in [{low}, {high}], not {case.distance}'
    return 'passed', met, ''


def peer_line(case):
    def words(shape, pose):
        return [shape.kind, *(repr(float(p)) for p in shape.parameters), *(repr(float(c)) for c in pose.matrix()[:3].flat)]

    return ' '.join([case.solver, str(len(case.a.parameters)), *words(case.a, case.pose_a), str(len(case.b.parameters)),
                     *words(case.b, case.pose_b)])


def ask_peer(program, cases):
    """Of each case, whether FCL says that the shapes meet."""
    lines = '\n'.join(peer_line(case) for case in cases) + '\n'
    run = subprocess.run([program], input=lines, capture_output=True, text=True, check=True)
    return [answer == '1' for answer in run.stdout.split()]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument('folder', type=pathlib.Path)
    parser.add_argument('--peer')
    arguments = parser.parse_args()
    text = (arguments.folder / 'test/test_fcl_geometric_shapes.cpp').read_text(encoding='utf-8')
    known, rows, problems, proved = read_deviations(), collections.defaultdict(collections.Counter), [], []
    reasons = collections.Counter()
    for case in cases_of(text):
        outcome, met, said = outcome_of(case)
        rows[case.program][outcome] += 1
        kind = known.get((f'fcl_{case.program}', case.name), ('',))[0]
        if outcome == 'missing':
            reasons[said] += 1
        if kind != (outcome if outcome == 'differs' else ''):
            problems.append(f'{case.program} {case.name}: {outcome}, listed as "{kind}": {said}')
        if met is not None:
            proved.append((case, met))
    print('| program | cases | passed | undecided | missing | differs |\n|---|---:|---:|---:|---:|---:|')
    for program, tally in rows.items():
        row = [tally[k] for k in ('passed', 'undecided', 'missing', 'differs')]
        print(f'| {program} | {sum(row)} |', ' | '.join(map(str, row)), '|')
    for reason, count in reasons.items():
        print(f'\n{count} are missing: {reason}.')
    if arguments.peer:
        answers = ask_peer(arguments.peer, [case for case, _ in proved])
        wrong = [(case, met) for (case, met), answer in zip(proved, answers) if met != answer]
        print(f'\nOf {len(proved)} cases that are proved FCL answers {len(wrong)} otherwise:')
        for case, met in wrong:
            print(f'- {case.program} {case.name} ({case.solver}): {"they meet" if met else "they are apart"}')
    for problem in problems:
        print('fcl.py:', problem, file=sys.stderr)
    return 1 if problems else 0


if __name__ == '__main__':
    sys.exit(main())

#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""jscad.py FOLDER

The booleans of solids that JSCAD's own tests do, by the Python package. FOLDER: packages/modeling of
github.com/jscad/OpenJSCAD.org, whose test programs node runs as they are (jscad_cases.js). A case passes when ours has the
volume of theirs, to 1e-12 of what was put in, and for scission as many parts. Polygons are not compared: theirs are as
their tree cuts them. Prints a table in Markdown.

Corners of balls that ought to be one, such as poles, differ by 1e-16 there; so coordinates are rounded to 1e-9.
"""
import collections
import json
import pathlib
import subprocess
import sys

import numpy
import trisect
from trisect import Solid

from run import read_deviations

DIGITS = 9


def triangles_of(polygons):
    points, faces = {}, []
    for polygon in polygons:
        loop = [points.setdefault(tuple(round(c, DIGITS) + 0.0 for c in p), len(points)) for p in polygon]
        faces += [(loop[0], b, c) for b, c in zip(loop[1:], loop[2:]) if len({loop[0], b, c}) == 3]
    return numpy.array(list(points), dtype=float).reshape(-1, 3), numpy.array(faces, dtype=numpy.int32).reshape(-1, 3)


def solid_of(polygons):
    points, faces = triangles_of(polygons)
    return Solid(points, faces) if len(faces) else Solid()


def volume_of(polygons):
    points, faces = triangles_of(polygons)
    a, b, c = (points[faces[:, i]] for i in range(3))
    return float(numpy.einsum('ij,ij->i', a, numpy.cross(b, c)).sum()) / 6


def ours(operation, operands):
    """The parts of the result."""
    if operation == 'scission':
        return [part for operand in operands for part in operand.components()]
    if operation == 'union':
        return [trisect.union(operands)]
    if operation == 'intersect':
        return [trisect.intersection(operands)]
    return [trisect.evaluate(operands[0] - trisect.union(operands[1:]))]


def outcome_of(case):
    operands = [solid_of(polygons) for polygons in case['operands']]
    parts = ours(case['operation'], operands)
    theirs = [volume_of(polygons) for polygons in case['results']]
    if len(parts) != len(theirs):
        return f'{len(parts)} parts where there are {len(theirs)}'
    size = sum(operand.volume for operand in operands)
    for part, volume in zip(sorted(part.volume for part in parts), sorted(theirs)):
        if abs(part - volume) > 1e-12 * size:
            return f'volume {part!r} where theirs is {volume!r}'
    return ''


def main():
    if len(sys.argv) != 2:
        sys.exit('usage: jscad.py FOLDER')
    here = pathlib.Path(__file__).parent
    run = subprocess.run(['node', here / 'jscad_cases.js', sys.argv[1]], capture_output=True, text=True, check=True)
    known, tally, problems, numbers = read_deviations(), collections.Counter(), [], collections.Counter()
    for line in run.stdout.splitlines():
        case = json.loads(line)
        numbers[case['test']] += 1
        name = f"{case['test'].replace(' ', '_')}.{numbers[case['test']]}"
        said = outcome_of(case)
        outcome = 'differs' if said else 'passed'
        tally[outcome] += 1
        kind = known.get(('jscad', name), ('passed',))[0]
        if kind != outcome:
            problems.append(f'{name}: {outcome}, listed as {kind}: {said}')
    print('| program | cases | passed | differs |\n|---|---:|---:|---:|')
    print(f'| JSCAD | {sum(tally.values())} | {tally["passed"]} | {tally["differs"]} |')
    for problem in problems:
        print('jscad.py:', problem, file=sys.stderr)
    return 1 if problems or not tally else 0


if __name__ == '__main__':
    sys.exit(main())

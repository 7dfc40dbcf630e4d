#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""pqp.py FOLDER [--answers FILE]

PQP's scene of falling tori (demos/falling of github.com/GammaUNC/PQP, FOLDER), by the Python package: two meshes and a place of
each at every step. Places are taken as they are written: six digits, so matrices are turns up to a millionth. Prints a table in
Markdown.

A step passes where the exact relation and the certified distance say the same: apart, or not. With --answers, a file with a line for
each step, 0 or 1 for apart or colliding and the distance, as PQP_Collide and PQP_Distance have them, is compared: `apart` and
`colliding` otherwise than PQP are listed, and how far the distances differ. Make one with a program of your own: PQP may not be
distributed with others.
"""
import argparse
import pathlib
import sys

import numpy
import trisect
from trisect import Pose, Relation, Solid


def solid_of(path):
    corners = numpy.array(path.read_text(encoding='utf-8').split()[1:], dtype=float).reshape(-1, 3)
    points, indices = numpy.unique(corners, axis=0, return_inverse=True)
    return Solid(points, indices.reshape(-1, 3))


def poses_of(path):
    """Nine numbers of a matrix by rows, and three of a move, a step."""
    steps = numpy.array(path.read_text(encoding='utf-8').split()[1:], dtype=float).reshape(-1, 12)
    return [Pose.from_matrix(numpy.column_stack([s[:9].reshape(3, 3), s[9:]])) for s in steps]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument('folder', type=pathlib.Path)
    parser.add_argument('--answers', type=pathlib.Path)
    arguments = parser.parse_args()
    scene = arguments.folder / 'demos/falling'
    a, b = (solid_of(scene / f'torus{k}.tris') for k in (1, 2))
    theirs = arguments.answers and [line.split() for line in arguments.answers.read_text(encoding='utf-8').splitlines()]
    passed, collide, otherwise, difference, problems = 0, 0, [], 0.0, []
    steps = list(zip(poses_of(scene / 'torus1.path'), poses_of(scene / 'torus2.path')))
    for k, (pose_a, pose_b) in enumerate(steps):
        apart = trisect.interfere(a, pose_a, b, pose_b).relation == Relation.DISJOINT
        distance = trisect.distance(a, pose_a, b, pose_b)
        if apart == (distance.lower > 0):
            passed += 1
        else:
            problems.append(f'step {k}: {"apart" if apart else "not apart"}, distance from {distance.lower}')
        collide += not apart
        if theirs:
            if (theirs[k][0] == '0') != apart:
                otherwise.append(f'step {k}: {"apart" if apart else "colliding"}, distance {distance.upper}')
            elif apart:
                difference = max(difference, abs(float(theirs[k][1]) - distance.upper))
    print('| scene | steps | passed | colliding |\n|---|---:|---:|---:|')
    print(f'| falling tori | {len(steps)} | {passed} | {collide} |')
    if theirs:
        print(f'\nPQP answers {len(otherwise)} otherwise; of the others distances differ by {difference:.1e} at most.')
        for line in otherwise:
            print('-', line)
    for problem in problems:
        print('pqp.py:', problem, file=sys.stderr)
    return 1 if problems or not steps else 0


if __name__ == '__main__':
    sys.exit(main())

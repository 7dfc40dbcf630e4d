#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""fcl_near.py PROGRAM [--rounds N]

FCL's shapes, turned at random (seed 1), just before and just behind where they begin to touch. PROGRAM, fcl_answers of a build, is FCL of
this machine. What is right is proved as in fcl.py, by a solid within and one around each shape, so of curved shapes only what
is farther from touching than their facets is asked. Prints how many answers of FCL are wrong for each pair of kinds, solver and
distance from touching, as a part of the way between the centres. Markdown.
"""
import argparse
import collections
import random
import sys
from dataclasses import dataclass
from typing import Any

from trisect import Pose

from fcl import ask_peer
from fcl_shapes import Shape, Undecided, meet

SHAPES = [Shape('Box', (20, 40, 50)), Shape('Sphere', (20,)), Shape('Capsule', (5, 20)), Shape('Cylinder', (5, 20)),
          Shape('Cone', (5, 20)), Shape('Ellipsoid', (5, 10, 20))]
PARTS = (1e-2, 1e-3, 1e-4, 1e-6, 1e-9, 1e-12, 1e-15)
WAY = 256.0


@dataclass
class Case:
    solver: str
    a: Any
    pose_a: Any
    b: Any
    pose_b: Any


def turned(dice):
    return Pose.from_quaternion([dice.randint(-9, 9) for _ in range(3)] + [dice.randint(1, 9)])


def proved(a, pose_a, b, pose_b):
    try:
        return meet(a, pose_a, b, pose_b)
    except Undecided:
        return None


def touching(a, turn_a, b, turn_b, toward):
    """How far along the way the centres are where meeting and being apart can no more be told apart."""
    low, high = 0.0, 1.0
    for _ in range(60):
        middle = (low + high) / 2
        found = proved(a, turn_a, b, Pose.from_translation([c * middle for c in toward]) @ turn_b)
        if found is None or middle in (low, high):
            return middle
        low, high = (middle, high) if found else (low, middle)
    return low


def cases_of(a, b, rounds, dice):
    """The part of the way, what is proved, and the question."""
    for _ in range(rounds):
        turn_a, turn_b = turned(dice), turned(dice)
        toward = [dice.uniform(-1, 1) * WAY for _ in range(3)]
        at = touching(a, turn_a, b, turn_b, toward)
        for part in PARTS:
            for sign in (-1, 1):
                pose_b = Pose.from_translation([c * at * (1 + sign * part) for c in toward]) @ turn_b
                found = proved(a, turn_a, b, pose_b)
                if found is not None:
                    for solver in ('LIBCCD', 'INDEP'):
                        yield part, found, Case(solver, a, turn_a, b, pose_b)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument('program')
    parser.add_argument('--rounds', type=int, default=10)
    arguments = parser.parse_args()
    dice = random.Random(1)
    print('| shapes | part of the way | solver | proved | apart, said to meet | meet, said to be apart |\n|---|---:|---|---:|---:|---:|')
    asked = wrong = 0
    for i, a in enumerate(SHAPES):
        for b in SHAPES[i:]:
            cases = list(cases_of(a, b, arguments.rounds, dice))
            tally = collections.defaultdict(collections.Counter)
            for (part, found, case), answer in zip(cases, ask_peer(arguments.program, [case for _, _, case in cases])):
                row = tally[part, case.solver]
                row['proved'] += 1
                row['meet' if found else 'apart'] += answer != found
            for (part, solver), row in sorted(tally.items(), reverse=True):
                asked, wrong = asked + row['proved'], wrong + row['meet'] + row['apart']
                if row['meet'] or row['apart']:
                    print(f"| {a.kind}, {b.kind} | {part:g} | {solver} | {row['proved']} | {row['apart']} | {row['meet']} |", flush=True)
    print(f'\n{wrong} of {asked} answers are wrong.')
    return 0


if __name__ == '__main__':
    sys.exit(main())

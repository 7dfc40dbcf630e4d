#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""exactness.py

The tables of exactness of axiolid's benchmarks (github.com/axiolid/benchmarks: drift, sliver, grid), by the Python package; walls with
openings and laws of sets are tests of ours (tests/algebra/wall_openings_test.cpp). What is right is computed from the doubles that are put
in, as fractions. Needs no folder. Prints tables in Markdown.

- drift: n openings turned by 30 degrees are cut out of a wall one after the other, each result the next operand. Its volume must
  be that of the wall less the parts of the openings in it, it must be in one piece with n handles, and the same set as the wall
  less all at once.
- sliver: two unit cubes whose overlap is thinner and thinner. Its volume must be that of the doubles.
- grid: three combs of n plates, which have n^3 boxes in common.
"""
import math
import sys
from fractions import Fraction

import trisect
from trisect import Solid

from libigl import genus_of


def turned_box(center, half, degrees):
    """Corners in doubles, as a program would compute them."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    corners = [(center[0] + x * half[0] * c - y * half[1] * s, center[1] + x * half[0] * s + y * half[1] * c)
               for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    return Solid.extrude(corners, center[2] - half[2], center[2] + half[2])


def row(*cells):
    print('|', ' | '.join(map(str, cells)), '|', flush=True)


def drift():
    print('| cuts in a row | error of the volume | parts | handles | as all at once |\n|---:|---:|---:|---:|---|')
    right = True
    for n in (1, 2, 4, 8, 16, 32, 64):
        wall = Solid.box([0, -0.15, 0], [n + 1, 0.15, 3])
        openings = [turned_box((i + 1, 0, 1.5), (0.3, 0.4, 0.7), 30) for i in range(n)]
        chain = wall
        for opening in openings:
            chain = trisect.evaluate(chain - opening)
        left = wall.exact_volume() - sum(trisect.intersection([wall, o]).exact_volume() for o in openings)
        at_once = trisect.difference(wall, openings)
        error, parts, handles = chain.exact_volume() - left, len(chain.components()), genus_of(chain)
        row(n, error, parts, handles, 'yes' if chain.equals(at_once) else 'no')
        right &= error == 0 and parts == 1 and handles == n and chain.equals(at_once)
    return right


def sliver():
    print('\n| overlap | error of the volume |\n|---:|---:|')
    right, cube = True, Solid.box([-0.5] * 3, [0.5] * 3)
    for exponent in (1, 3, 6, 9, 12, 15):
        begin = 1 - 10.0**-exponent - 0.5
        overlap = trisect.intersection([cube, Solid.box([begin, -0.5, -0.5], [begin + 1, 0.5, 0.5])]).exact_volume()
        error = overlap - (Fraction(1, 2) - Fraction(begin))
        row(f'1e-{exponent}', error)
        right &= error == 0
    return right


def grid():
    print('\n| plates of each comb | boxes | parts | error of the volume |\n|---:|---:|---:|---:|')
    right = True
    for n in (2, 3, 4, 5, 6):
        combs = []
        for axis in range(3):
            low, high = [-1.0] * 3, [n + 1.0] * 3
            plates = []
            for i in range(n):
                low[axis], high[axis] = float(i), i + 0.4
                plates.append(Solid.box(low, high))
            combs.append(trisect.union(plates))
        cells = trisect.intersection(combs)
        expected = sum(Fraction(i + 0.4) - i for i in range(n))**3
        error, parts = cells.exact_volume() - expected, len(cells.components())
        row(n, n**3, parts, error)
        right &= error == 0 and parts == n**3
    return right


def main():
    return 0 if all([drift(), sliver(), grid()]) else 1


if __name__ == '__main__':
    sys.exit(main())

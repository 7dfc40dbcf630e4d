# SPDX-License-Identifier: Apache-2.0
"""The text of CGAL's Nef polyhedra (`Selective Nef Complex`, standard kernel), read as boundaries of solids.

Sections follow one another in the order of the header: vertices, halfedges (the edge ends at a vertex), facets (one side of a
face), volumes, shalfedges (a corner of a facet), shalfloops, sfaces. Indices are lines of a section.
"""
import math
import re
from fractions import Fraction

SECTIONS = ('vertices', 'halfedges', 'facets', 'volumes', 'shalfedges', 'shalfloops', 'sfaces')


def sections_of(text):
    """Of each section its lines, as (lists of integers before the bar, integers behind it, mark)."""
    lines = text.splitlines()
    if lines[:2] != ['Selective Nef Complex', 'standard']:
        raise ValueError('an extended kernel: planes that have no end')
    counts = {}
    for line in lines[2:9]:
        name, count = line.split()
        counts[name] = int(count)
    at, found = 9, {}
    for name in SECTIONS:
        found[name] = [entry_of(line) for line in lines[at:at + counts[name]]]
        at += counts[name]
    return found


def entry_of(line):
    match = re.fullmatch(r'\s*\d+ \{ (.*?)\s*\}\s*(-?\d+)?\s*', line)
    if not match:
        raise ValueError(f'not an entry: {line}')
    fields, _, numbers = match.group(1).partition('|')
    lists = [[int(w) for w in field.split()] for field in fields.split(',')]
    return lists, [int(w) for w in numbers.split()], int(match.group(2) or 0)


def loop_of(first, corners, ends):
    """Vertices of the cycle of a facet, from the corner `first`."""
    loop, at = [], first
    while True:
        lists = corners[at][0]
        loop.append(ends[lists[3][0]][0][1][0])
        at = lists[6][0]
        if at == first:
            return loop
        if len(loop) > len(corners):
            raise ValueError('a cycle of a facet does not close')


def odd_part(number):
    return number // (number & -number)


def is_boundary(facet, found):
    """Whether this side of a face looks from a marked volume, which is behind it, into one that is not marked."""
    volumes = found['volumes']
    behind = found['facets'][facet[0][0][0]]
    return not volumes[facet[0][-1][0]][2] and volumes[behind[0][-1][0]][2]


def boundary_of(text):
    """Of the closure of all marked volumes: scale, points times scale as doubles, faces, and the volume by the divergence theorem.

    Marks of faces, edges and points make no difference. ValueError where no volume is marked, or the one that has no end,
    and for faces with holes, which these tests have no reader for.
    """
    found = sections_of(text)
    marks = [mark for _, _, mark in found['volumes']]
    if not any(marks):
        raise ValueError('no volume, but faces, edges or points alone')
    if marks[0]:
        raise ValueError('a volume without end')
    points = [[Fraction(n, numbers[3]) for n in numbers[:3]] for _, numbers, _ in found['vertices']]
    scale = math.lcm(1, *(odd_part(c.denominator) for p in points for c in p))
    points = [[c * scale for c in p] for p in points]
    doubles = [[float(c) for c in p] for p in points]
    if doubles != points:
        raise ValueError('coordinates have more digits than doubles')
    faces, six = [], 0
    for facet in found['facets']:
        lists = facet[0]
        if not is_boundary(facet, found):
            continue
        if len(lists[1]) != 1:
            raise ValueError('a face with holes')
        loop = loop_of(lists[1][0], found['shalfedges'], found['halfedges'])
        faces.append(loop)
        a = points[loop[0]]
        for b, c in zip(loop[1:], loop[2:]):
            b, c = points[b], points[c]
            six += (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2])
                    + a[2] * (b[0] * c[1] - b[1] * c[0]))
    return scale, doubles, faces, Fraction(six) / (6 * scale**3)

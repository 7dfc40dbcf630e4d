#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""libigl.py FOLDER

The cases of libigl's tests of booleans (tests/include/igl/copyleft/boolean and cgal) whose data are closed meshes, by the
Python package. FOLDER: github.com/libigl/libigl-tests-data, which is read; what must hold of each result is written here:
no open edges, manifold vertices and edges, a genus, numbers of vertices and faces, points inside and outside. Prints a table
in Markdown.

Not done: cases that ask for layers of outer hulls, surfaces cut by solids, or boxes of half-spaces, which are `missing`.
"""
import collections
import itertools
import pathlib
import sys

import trisect
from trisect import Location, Solid

from run import read_deviations

EPSILON = sys.float_info.epsilon
MISSING = ('trim_with_solid: triangle-vs-tet', 'trim_with_solid: two-vs-cube', 'half_space_box: simple',
           'peel_outer_hull_layers: TwoCubes', 'PeelOuterHullLayers: CubeWithFold', 'outer_hull_legacy: CubeWithFold')


def genus_of(solid):
    """Of a closed manifold surface; None of any other."""
    _, faces = solid.mesh()
    sides = collections.Counter((int(f[i]), int(f[(i + 1) % 3])) for f in faces for i in range(3))
    if any(n != 1 or (b, a) not in sides for (a, b), n in sides.items()):
        return None
    fans = collections.defaultdict(dict)
    for f in faces:
        for i in range(3):
            fans[int(f[i])][int(f[(i + 1) % 3])] = int(f[(i + 2) % 3])
    for fan in fans.values():  # one turn around the vertex comes by all of its neighbours
        begin = at = next(iter(fan))
        for steps in itertools.count(1):
            at = fan[at]
            if at == begin:
                break
        if steps != len(fan):
            return None
    return (2 - (len(fans) - len(sides) // 2 + len(faces))) // 2


def places(solid, points):
    return [place == Location.INSIDE for place in map(solid.locate, points)]


def corners(distance):
    return [[sign * distance for sign in signs] for signs in itertools.product((1, -1), repeat=3)]


def on_axes(distance):
    return [[distance if k == axis else 0.0 for k in range(3)] for axis in range(3)]


def cases(folder):
    """Name, what is found and what is expected."""
    def read(name, embedding='check'):
        return Solid.read(folder / name, embedding=embedding)

    cube = read('cube.obj')
    twice = trisect.union([read('two-boxes-bad-self-union.ply', 'resolve')])
    yield 'MeshBoolean: TwoCubes', genus_of(twice), 0
    minus = read('boolean_minus_test_cube.obj') - read('boolean_minus_test_green.obj')
    yield 'MeshBoolean: MinusTest', genus_of(trisect.evaluate(minus)), 1
    yield 'MeshBoolean: IntersectWithSelf', genus_of(trisect.intersection([cube, cube])), 0
    extrusion = read('extrusion.obj')
    both = trisect.intersection([extrusion, extrusion])
    yield ('CSGTree: extrusion', (both.vertex_count, both.triangle_count),
           (extrusion.vertex_count, extrusion.triangle_count))
    yield ('PointInsideComponent: simple', places(cube, [[0.0] * 3, *on_axes(1.0)]), [True] + 3 * [False])
    yield ('PointInsideComponent: near_boundary',
           places(cube, on_axes(0.5 + EPSILON) + on_axes(0.5 - EPSILON)), 3 * [False] + 3 * [True])
    yield ('PointInsideComponent: near_corner',
           places(cube, corners(0.5 + EPSILON) + corners(0.5 - EPSILON)), 8 * [False] + 8 * [True])
    fold = trisect.union([read('cube_with_fold.ply', 'resolve')])
    yield 'remesh_self_intersections: CubeWithFold', fold.volume > 0, True
    # Resolved, and nothing meets itself any more: so the file of the result is embedded, too.
    for path in sorted(folder.iterdir()):
        if path.suffix not in ('.obj', '.off', '.ply', '.stl') or path.stat().st_size > 1 << 20:
            continue
        try:
            solid = Solid.read(path, embedding='resolve')
        except trisect.Error:
            continue  # open surfaces bound no solid
        name = f'remesh_self_intersections: exact/{path.name}'
        resolved = trisect.union([solid])
        yield name, resolved.equals(Solid.from_exact_text(resolved.exact_text())), True


def main():
    if len(sys.argv) != 2:
        sys.exit('usage: libigl.py FOLDER')
    known, tally, problems = read_deviations(), collections.Counter(missing=len(MISSING)), []
    for name, found, expected in cases(pathlib.Path(sys.argv[1])):
        outcome = 'passed' if found == expected else 'differs'
        tally[outcome] += 1
        kind = known.get(('libigl', name.replace(' ', '_')), ('passed',))[0]
        if kind != outcome:
            problems.append(f'{name}: {outcome}, listed as {kind}: {found} where {expected} is expected')
    row = [tally[kind] for kind in ('passed', 'missing', 'differs')]
    print('| program | cases | passed | missing | differs |\n|---|---:|---:|---:|---:|')
    print(f'| libigl | {sum(row)} | {" | ".join(map(str, row))} |')
    for problem in problems:
        print('libigl.py:', problem, file=sys.stderr)
    return 1 if problems else 0


if __name__ == '__main__':
    sys.exit(main())

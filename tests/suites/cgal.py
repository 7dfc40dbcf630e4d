#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""cgal.py FOLDER

CGAL's pairs of corefinement (Polygon_mesh_processing/test/.../test_corefinement_bool_op_full.cmd) and its Nef polyhedra
(*.nef3 of the tests and examples), by the Python package. FOLDER: github.com/CGAL/cgal, of which only tests, examples and Data
are read. Prints a table in Markdown.

A line of the command file names two meshes and says of union, intersection and both differences whether theirs can give the
result, that is, whether its boundary has no edge with more than two faces. One case is one operation of one pair. It passes
when
- a flag of 1 meets a boundary of ours without such edges, and a flag of 0 one with them;
- the volumes of the four results agree as fractions: union and intersection together have the volume of both operands, and
  each difference has that of its operand less the intersection.
Open surfaces bound no solid: `open` counts their cases, and passes where ours is refused with the word "open_edge".

A Nef polyhedron is a case of its own: the faces around its marked volumes bound a solid whose volume is that of the faces
as fractions. `missing` are those without such volumes, of faces, edges and points alone, those without end, and faces with holes.

`absent` are cases whose files are not in FOLDER.
"""
import collections
import pathlib
import sys
from fractions import Fraction

import numpy
import trisect
from trisect import Solid

from nef_text import boundary_of
from run import read_deviations

PAIRS = 'Polygon_mesh_processing/test/Polygon_mesh_processing'
NEF = ('Nef_3/test/Nef_3/data', 'Nef_3/examples', 'Minkowski_sum_3/examples')
OPERATIONS = ('union', 'intersection', 'A-B', 'B-A')


def read(path, solids={}):
    """The solid of a file, or the sentence with which it is refused."""
    if path not in solids:
        try:
            solids[path] = Solid.read(path, embedding='resolve')
        except trisect.Error as error:
            solids[path] = str(error)
    return solids[path]


def is_manifold_along_edges(solid):
    """By places in the mesh that is certified: where two parts touch along an edge, ours has its ends twice, and a face that a
    groove meets in a line from within is one face in a mesh that is not."""
    points, faces = solid.certified_mesh().mesh()
    _, places = numpy.unique(points, axis=0, return_inverse=True)
    faces = places.reshape(-1)[faces]
    sides = collections.Counter((int(f[i]), int(f[(i + 1) % 3])) for f in faces for i in range(3))
    return all(n == 1 and sides[b, a] == 1 for (a, b), n in sides.items())


def results_of(a, b):
    both = trisect.intersection([a, b])
    return trisect.union([a, b]), both, trisect.evaluate(a - b), trisect.evaluate(b - a)


def volumes_agree(a, b, results):
    union, both, a_less, b_less = (r.exact_volume() for r in results)
    va, vb = a.exact_volume(), b.exact_volume()
    return (union + both == va + vb, union + both == va + vb, a_less == va - both, b_less == vb - both)


def pair_cases(folder):
    """Name, outcome and what is to be said of it."""
    names = collections.Counter()
    for line in (folder / PAIRS / 'test_corefinement_bool_op_full.cmd').read_text(encoding='utf-8').splitlines():
        words = line.split()
        if len(words) != 8:
            continue
        paths = [folder / PAIRS / w.replace('${CGAL_DATA_DIR}', str(folder / 'Data/data')) for w in words[:2]]
        name = '/'.join(p.stem for p in paths)
        cases = [f'{name}:{operation}' for operation in OPERATIONS]
        if not all(p.is_file() for p in paths):
            yield from ((case, 'absent', '') for case in cases)
            continue
        operands = [read(p) for p in paths]
        refused = [said for said in operands if isinstance(said, str)]
        if refused:
            outcome = 'open' if any('open_edge' in said for said in refused) else 'differs'
            yield from ((case, outcome, refused[0]) for case in cases)
            continue
        results = results_of(*operands)
        for case, flag, result, agrees in zip(cases, words[4:], results, volumes_agree(*operands, results)):
            manifold = is_manifold_along_edges(result)
            said = f'flag {flag}, {"no" if manifold else "an"} edge of many faces, volume {float(result.exact_volume())}'
            yield case, 'passed' if agrees and manifold == (flag == '1') else 'differs', said


def nef_cases(folder):
    for path in sorted(path for place in NEF for path in (folder / place).rglob('*.nef3*')):
        try:
            scale, points, faces, volume = boundary_of(path.read_text(encoding='utf-8'))
        except ValueError as error:
            yield f'nef:{path.name}', 'missing', str(error)
            continue
        solid = Solid(points, faces) if faces else Solid()
        agrees = solid.exact_volume() == volume * Fraction(scale) ** 3
        yield f'nef:{path.name}', 'passed' if agrees else 'differs', f'volume {solid.exact_volume()}, not {volume}'


def main():
    if len(sys.argv) != 2:
        sys.exit('usage: cgal.py FOLDER')
    folder = pathlib.Path(sys.argv[1])
    known, problems, reasons = read_deviations(), [], collections.Counter()
    print('| program | cases | passed | open, refused | missing | differs | absent |\n|---|---:|---:|---:|---:|---:|---:|')
    for program, cases in (('corefinement', pair_cases(folder)), ('Nef', nef_cases(folder))):
        tally = collections.Counter()
        for case, outcome, said in cases:
            tally[outcome] += 1
            kind = known.get((f'cgal_{program.lower()}', case), ('',))[0]
            if outcome == 'missing':
                reasons[said] += 1
            if kind != (outcome if outcome == 'differs' else ''):
                problems.append(f'{program} {case}: {outcome}, listed as "{kind}": {said}')
        row = [tally[k] for k in ('passed', 'open', 'missing', 'differs', 'absent')]
        print(f'| {program} | {sum(row)} |', ' | '.join(map(str, row)), '|', flush=True)
    for reason, count in reasons.items():
        print(f'\n{count} are missing: {reason}.')
    for problem in problems:
        print('cgal.py:', problem, file=sys.stderr)
    return 1 if problems else 0


if __name__ == '__main__':
    sys.exit(main())

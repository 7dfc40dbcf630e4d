#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""blender.py FILE

The cases of Blender's exact booleans (FILE: blenlib's BLI_mesh_boolean_test.cc), by the Python package. Their program is
read and not run: meshes with fractions as coordinates, operations, and how many vertices and faces there must be.
Coordinates are multiplied by the common denominator, so they are given exactly. Cases that do not pass must stand in
deviations.txt. Prints a table in Markdown.

Operations without a formula (BoolOpType::None: all parts of the arrangement) are no booleans and are left out.
"""
import collections
import fractions
import math
import pathlib
import re
import sys
import tempfile

import trisect

from run import read_deviations

TEST = re.compile(r'^TEST\(([^)]*)\)\n\{(.*?)^\}', re.MULTILINE | re.DOTALL)
STEP = re.compile(r'R"\((?P<spec>.*?)\)"'
                  r'|boolean_(?P<kind>trimesh|mesh)\(\s*\w+(?:\.imesh)?,\s*BoolOpType::(?P<op>\w+),\s*(?P<shapes>\d+),'
                  r'\s*(?:(?P<all>all_shape_zero)|\[\]\(int t\) \{ return (?P<shape>[^;]*); \}),'
                  r'|EXPECT_EQ\(\w+\.(?P<what>vert|face)_size\(\), (?P<count>\d+)\)', re.DOTALL)
SHAPE = re.compile(r't (<|>=) (\d+) \? ([01]) : ([01])')


def meshes_of(spec, shape_of):
    """The OFF texts of the shapes, with whole coordinates."""
    lines = spec.split('\n')
    vertices, faces = (int(word) for word in lines[0].split())
    points = [[fractions.Fraction(word) for word in line.split()] for line in lines[1:1 + vertices]]
    scale = math.lcm(*(c.denominator for p in points for c in p))
    loops = [line.split() for line in lines[1 + vertices:1 + vertices + faces]]
    shapes = collections.defaultdict(list)
    for t, loop in enumerate(loops):
        shapes[shape_of(t)].append(f'{len(loop)} {" ".join(loop)}')
    rows = [' '.join(str(c * scale) for c in p) for p in points]
    return ['\n'.join(['OFF', f'{vertices} {len(shapes[k])} 0', *rows, *shapes[k], '']) for k in sorted(shapes)]


def solid_of(text, folder):
    path = folder / 'shape.off'
    path.write_text(text, encoding='utf-8')
    return trisect.Solid.read(path)


def counts_of(solid, kind):
    """Vertices and faces: triangles, or what is left of the faces of the operands."""
    if kind == 'trimesh':
        return solid.vertex_count, solid.triangle_count
    words = solid.exact_text().split()
    return int(words[words.index('vertices') + 1]), int(words[words.index('faces') + 1])


def result_of(operation, spec, folder):
    sign, boundary, yes, no = SHAPE.match(operation['shape']).groups() if operation['shape'] else ('<', 0, 0, 0)
    low, high = (yes, no) if sign == '<' else (no, yes)
    solids = [solid_of(text, folder)
              for text in meshes_of(spec, lambda t: int(low if t < int(boundary) else high))]
    if operation['op'] == 'Difference':
        return counts_of(solids[0] - solids[1], operation['kind'])
    combine = {'Union': trisect.union, 'Intersect': trisect.intersection}
    return counts_of(combine[operation['op']](solids), operation['kind'])


def cases_in(text):
    """Name, mesh, operation and the counts that are expected."""
    for name, body in TEST.findall(text):
        spec, operation, counts, number = '', None, {}, 0
        for step in STEP.finditer(body):
            if step['spec']:
                spec = step['spec']
            elif step['kind']:
                operation, counts, number = step.groupdict(), {}, number + 1
            elif operation:
                counts[step['what']] = int(step['count'])
                if len(counts) == 2:
                    yield f'{name.replace(", ", ".")}.{number}', spec, operation, (counts['vert'], counts['face'])


def main():
    if len(sys.argv) != 2:
        sys.exit('usage: blender.py FILE')
    known, tally, problems = read_deviations(), collections.Counter(), []
    with tempfile.TemporaryDirectory() as name:
        for case, spec, operation, expected in cases_in(pathlib.Path(sys.argv[1]).read_text(encoding='utf-8')):
            if operation['op'] == 'None':
                tally['missing'] += 1
                continue
            try:
                found = result_of(operation, spec, pathlib.Path(name))
            except trisect.Error as error:
                found = error
            outcome = 'passed' if found == expected else 'differs'
            tally[outcome] += 1
            kind = known.get(('blender_mesh_boolean', case), ('passed',))[0]
            if kind != outcome:
                problems.append(f'{case}: {outcome}, listed as {kind}: {found} where {expected} is expected')
    row = [tally[kind] for kind in ('passed', 'missing', 'differs')]
    print('| program | cases | passed | missing | differs |\n|---|---:|---:|---:|---:|')
    print(f'| `BLI_mesh_boolean_test` | {sum(row)} | {" | ".join(map(str, row))} |')
    for problem in problems:
        print('blender.py:', problem, file=sys.stderr)
    return 1 if problems else 0


if __name__ == '__main__':
    sys.exit(main())

#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""val3dity.py VAL3DITY TRISECT

The cases of val3dity's own tests (VAL3DITY: a checkout) whose data are polyhedra in OBJ, OFF or POLY, judged by
`trisect check`. What is to be found stands in their test programs, which are read and not run: files and the codes of
ISO 19107 that they must give. A case passes when one of these codes goes with a finding of ours and the mesh bounds no
solid, or when it is to be valid and there is no error. `warned`: the code goes with a finding, but of warnings alone, so
the mesh bounds a solid here. Other cases must stand in deviations.txt. Prints a table in Markdown.

Shells in files of their own are appended to the first. Polygons with inner rings are left out: meshes have none.
"""
import argparse
import ast
import collections
import json
import pathlib
import subprocess
import sys
import tempfile

from run import read_deviations

# docs/invalid_solid.md has the same table.
CODES = {
    'repeated_corner': {102}, 'degenerate_face': {101, 104}, 'non_simple_face': {104}, 'non_planar_face': {203, 204},
    'hole_outside_face': {206}, 'empty_mesh': {301, 902}, 'open_edge': {301, 302}, 't_vertex': set(),
    'non_manifold_edge': {303}, 'non_manifold_vertex': {303}, 'duplicate_face': {303, 306, 402},
    'duplicate_opposite_faces': {303, 306, 401}, 'self_intersection': {306, 401, 402, 403, 404}, 'faces_touch': {306, 401},
    'flipped_face': {307}, 'inside_out_shell': {307, 403, 405}, 'shell_nesting': {403, 404, 405}, 'duplicate_point': set(),
    'unused_point': set()}
FOLDERS = {'dir_geometry_generic': 'data/test_geometry_generic', 'dir_valid': 'data/test_valid'}


class Case(collections.namedtuple('Case', 'name files codes')):
    """codes: alternatives, each a list."""


def constant_lists(node):
    return [ast.literal_eval(c) for c in ast.walk(node) if isinstance(c, ast.List)
            and all(isinstance(e, ast.Constant) for e in c.elts)]


def cases_in(program, root):
    """Fixtures have files as parameters; tests take a fixture and compare what they get with lists of codes."""
    fixtures, tests = {}, []
    for node in ast.parse(program.read_text(encoding='utf-8')).body:
        if not isinstance(node, ast.FunctionDef):
            continue
        arguments = [a.arg for a in node.args.args]
        folder = next((FOLDERS[a] for a in arguments if a in FOLDERS), None)
        for decorator in node.decorator_list:
            for keyword in getattr(decorator, 'keywords', []):
                if keyword.arg == 'params' and folder:
                    params = ast.literal_eval(keyword.value)
                    fixtures[node.name] = [[root / folder / f for f in ([p] if isinstance(p, str) else p)]
                                           for p in params]
                    if 'data_basecube' in arguments:
                        cube = root / 'data/test_valid/basecube.poly'
                        fixtures[node.name] = [[cube, *files] for files in fixtures[node.name]]
        if node.name.startswith('test_'):
            codes = [c for a in ast.walk(node) if isinstance(a, ast.Assert) for c in constant_lists(a)]
            tests.append((node.name, arguments, codes))
    for name, arguments, codes in tests:
        for files in (f for a in arguments for f in fixtures.get(a, [])):
            yield Case(f'{name}:{files[-1].name}', files, codes)


def read_poly(path):
    """Points and faces, each a list of rings."""
    words = iter(path.read_text(encoding='utf-8').split())
    points, faces = {}, []
    header = [int(next(words)) for _ in range(4)]
    for _ in range(header[0]):
        number = int(next(words))
        points[number] = [next(words) for _ in range(3)]
    count, _ = int(next(words)), next(words)
    for _ in range(count):
        rings, holes = int(next(words)), int(next(words))
        faces.append([[int(next(words)) for _ in range(int(next(words)))] for _ in range(rings)])
        for _ in range(4 * holes):
            next(words)
    return points, faces


def read_off(path):
    words = iter(w for line in path.read_text(encoding='utf-8').splitlines() for w in line.split('#')[0].split())
    next(words)
    counts = [int(next(words)) for _ in range(3)]
    points = {i: [next(words) for _ in range(3)] for i in range(counts[0])}
    return points, [[[int(next(words)) for _ in range(int(next(words)))]] for _ in range(counts[1])]


def read_obj(path):
    points, faces = {}, []
    for line in path.read_text(encoding='utf-8').splitlines():
        words = line.split()
        if words[:1] == ['v']:
            points[len(points)] = words[1:4]
        elif words[:1] == ['f']:
            faces.append([[int(w.split('/')[0]) - 1 for w in words[1:]]])
    return points, faces


READERS = {'.poly': read_poly, '.off': read_off, '.obj': read_obj}


def written(files, folder):
    """An OBJ file with all shells, or None where a face has inner rings."""
    lines, base = [], 0
    for file in files:
        points, faces = READERS[file.suffix](file)
        numbers = {key: base + i + 1 for i, key in enumerate(points)}
        base += len(points)
        lines += ['v ' + ' '.join(p) for p in points.values()]
        for face in faces:
            if len(face) != 1:
                return None
            lines.append('f ' + ' '.join(str(numbers[v]) for v in face[0]))
    path = folder / 'shells.obj'
    path.write_text('\n'.join(lines) + '\n', encoding='utf-8')
    return path


def outcome_of(case, trisect, folder):
    path = written(case.files, folder)
    if path is None:
        return 'missing', 'faces with inner rings'
    run = subprocess.run([trisect, '--json', 'check', path], capture_output=True, text=True, check=False)
    if 'it needs at least three' in run.stdout and [101] in case.codes:
        return 'passed', ''
    if run.returncode not in (0, 1):
        text = json.loads(run.stdout)['error']['message'] if run.stdout.startswith('{') else run.stderr.strip()
        return 'differs', f'exit code {run.returncode}: {text}'
    document = json.loads(run.stdout)
    counts = document['counts']
    found = set().union(*(CODES[kind] for kind in counts))
    good = any(found & set(codes) if codes else document['solid'] for codes in case.codes)
    if good and document['solid'] and [] not in case.codes:
        return 'warned', ''
    return ('passed' if good else 'differs'), f'{sorted(counts)} where {case.codes} are expected'


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument('val3dity', type=pathlib.Path)
    parser.add_argument('trisect', type=pathlib.Path)
    arguments = parser.parse_args()
    known, tally, problems = read_deviations(), collections.Counter(), []
    programs = ['test_geometry_generic', 'test_valid']
    with tempfile.TemporaryDirectory() as name:
        for program in programs:
            for case in cases_in(arguments.val3dity / 'tests' / f'{program}.py', arguments.val3dity):
                if any(file.suffix not in READERS for file in case.files):
                    tally[program, 'missing'] += 1
                    continue
                outcome, said = outcome_of(case, arguments.trisect, pathlib.Path(name))
                tally[program, outcome] += 1
                kind = known.get((f'val3dity_{program}', case.name), ('passed',))[0]
                if outcome != 'missing' and kind != ('passed' if outcome == 'warned' else outcome):
                    problems.append(f'{program} {case.name}: {outcome}, listed as {kind}: {said}')
    print('| program | cases | passed | warned | missing | differs |\n|---|---:|---:|---:|---:|---:|')
    for program in programs:
        row = [tally[program, kind] for kind in ('passed', 'warned', 'missing', 'differs')]
        print(f'| `{program}` | {sum(row)} | {" | ".join(map(str, row))} |')
    for problem in problems:
        print(problem, file=sys.stderr)
    return 1 if problems else 0


if __name__ == '__main__':
    sys.exit(main())

#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""boolean_runner.py RUNNER [--grid N] [--flag FLAG]...

Runs the runner of the open boolean benchmark (packaging/boolean-runner) on a request of its own and checks the
results: a grid of N^3 unit cubes whose corners are whole numbers, united one by one, first the ones of even
coordinate sums, then the odd ones, and taken away again in that order, so that nothing is left; and requests that
must be refused. After each step the volume and the area are counted. Prints what the steps took.
"""
import argparse
import json
import pathlib
import subprocess
import sys
import tempfile

FACES = [(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]
CORNERS = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]


def write_cube(path, at, open_below=False):
    faces = FACES[1:] if open_below else FACES
    lines = ['v ' + ' '.join(str(c + a) for c, a in zip(corner, at)) for corner in CORNERS]
    for a, b, c, d in faces:
        lines += [f'f {a + 1} {b + 1} {c + 1}', f'f {a + 1} {c + 1} {d + 1}']
    path.write_text('\n'.join(lines) + '\n', encoding='utf-8')


def six_volumes_and_area(path):
    """6 V, and the area of an OBJ file whose triangles are perpendicular to axes."""
    points, volume, area = [], 0.0, 0.0
    for line in path.read_text(encoding='utf-8').splitlines():
        words = line.split()
        if words[:1] == ['v']:
            points.append([float(word) for word in words[1:4]])
        elif words[:1] == ['f']:
            corners = [points[int(word.split('/')[0]) - 1] for word in words[1:]]
            for b, c in zip(corners[1:], corners[2:]):
                a = corners[0]
                u, v = ([q - p for p, q in zip(a, end)] for end in (b, c))
                normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
                volume += sum(p * n for p, n in zip(a, normal))
                area += sum(n * n for n in normal) ** 0.5 / 2
    return volume, area


class Grid:
    """The operations on N^3 cubes, and what there is after each."""

    def __init__(self, n, folder):
        places = [(x, y, z) for z in range(n) for y in range(n) for x in range(n)]
        ordered = [p for p in places if sum(p) % 2 == 0] + [p for p in places if sum(p) % 2 == 1]
        self.operations, self.expected = [], []
        for i, place in enumerate(ordered):
            path = folder / f'cube{i}.obj'
            write_cube(path, place)
            self.add({'op': 'load-mesh', 'path': str(path)}, {place})
        there, last = {ordered[0]}, 0
        for what, indices in (('boolean-union', range(1, len(ordered))),
                              ('boolean-difference', range(len(ordered)))):
            for i in indices:
                there = there | {ordered[i]} if what == 'boolean-union' else there - {ordered[i]}
                last = self.add({'op': what, 'args': [last, i]}, there)

    def add(self, operation, there):
        exposed = sum(1 for p in there for axis in range(3) for side in (-1, 1)
                      if tuple(c + side * (k == axis) for k, c in enumerate(p)) not in there)
        self.operations.append(operation)
        self.expected.append((6.0 * len(there), float(exposed)))
        return len(self.operations) - 1


def run(runner, flags, folder, runs):
    request, result = folder / 'request.json', folder / 'result.json'
    for one in runs:
        one['out_dir'] = str(folder / one['case_id'])
        pathlib.Path(one['out_dir']).mkdir()
    request.write_text(json.dumps({'kind': 'boolean-benchmark', 'version': 1, 'id': 'a-b', 'runs': runs}),
                       encoding='utf-8')
    code = subprocess.run([runner, '--request', request, '--result', result, *flags], check=False).returncode
    document = json.loads(result.read_text(encoding='utf-8'))
    assert document['id'] == 'a-b' and [r['case_id'] for r in document['runs']] == [r['case_id'] for r in runs]
    return code, document['runs']


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument('runner', type=pathlib.Path)
    parser.add_argument('--grid', type=int, default=3)
    parser.add_argument('--flag', action='append', default=[])
    arguments = parser.parse_args()
    problems = []
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        grid = Grid(arguments.grid, folder)
        cube, gaping = grid.operations[0], folder / 'open.obj'
        write_cube(gaping, (0, 0, 0), open_below=True)
        far = {'op': 'load-mesh', 'path': grid.operations[-1].get('path', grid.operations[1]['path'])}
        code, runs = run(arguments.runner, arguments.flag, folder, [
            {'case_id': 'grid', 'operations': grid.operations},
            {'case_id': 'variadic', 'operations': [cube, far, cube, {'op': 'boolean-union', 'args': [0, 1, 2]}]},
            {'case_id': 'alone', 'operations': [cube, {'op': 'boolean-union', 'args': [0]}]},
            {'case_id': 'open', 'operations': [{'op': 'load-mesh', 'path': str(gaping)}, cube]},
            {'case_id': 'absent', 'operations': [{'op': 'load-mesh', 'path': str(folder / 'none.obj')}]},
            {'case_id': 'unknown', 'operations': [cube, {'op': 'boolean-magic', 'args': [0]}]}])
        wanted = ['success', 'success', 'success', 'invalid_input', 'crash', 'unsupported']
        if [r['status'] for r in runs] != wanted or code != 1:
            problems.append(f'statuses {[r["status"] for r in runs]}, exit code {code}')
        for i, (step, expected) in enumerate(zip(runs[0]['ops'], grid.expected)):
            found = six_volumes_and_area(pathlib.Path(step['file']))
            if found != expected:
                problems.append(f'step {i}: six volumes and area {found}, expected {expected}')
        if len(runs[0]['ops']) != len(grid.expected):
            problems.append(f'{len(runs[0]["ops"])} of {len(grid.expected)} steps were done')
        if six_volumes_and_area(pathlib.Path(runs[1]['ops'][-1]['file']))[0] != 12.0:
            problems.append('the union of three, two of them equal, is not two cubes')
        sums = {key: sum(step.get(key, 0.0) for step in runs[0]['ops'])
                for key in ('io_ms', 'import_ms', 'operation_ms', 'export_ms')}
        print(f'{len(grid.expected)} steps:', ', '.join(f'{key} {value:.1f}' for key, value in sums.items()))
    for problem in problems[:10]:
        print('boolean_runner.py:', problem, file=sys.stderr)
    return 1 if problems else 0


if __name__ == '__main__':
    sys.exit(main())

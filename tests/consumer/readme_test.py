#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""readme_test.py ROOT [python=PROGRAM] [command=PROGRAM] [cxx=COMPILER] [cc=COMPILER]

Runs in the working directory what ROOT's README.md shows: the blocks of its first screen, and every line of the section
about the command, with files made here; the first program of docs/python.md and of docs/c.md; and the tutorial of
the site. What is named runs.
Programs in C++ and C are compiled with what pkg-config says, so PKG_CONFIG_PATH may be needed.
"""
import math
import pathlib
import re
import shlex
import subprocess
import sys

BLOCK = re.compile(r'^```(\w+)\n(.*?)^```$', re.MULTILINE | re.DOTALL)
ROW = {'.off': '{} {} {}\n', '.ply': '{} {} {}\n', '.obj': 'v {} {} {}\n'}


def prism(corners, radius, low, high, middle=(0, 0)):
    """Vertices and polygons; four corners and a radius of sqrt(2) make a cube's sides."""
    ring = [(middle[0] + radius * math.cos(2 * math.pi * (i + 0.5) / corners),
             middle[1] + radius * math.sin(2 * math.pi * (i + 0.5) / corners)) for i in range(corners)]
    points = [(x, y, z) for z in (low, high) for x, y in ring]
    sides = [(i, (i + 1) % corners, (i + 1) % corners + corners, i + corners) for i in range(corners)]
    return points, [tuple(reversed(range(corners))), tuple(range(corners, 2 * corners)), *sides]


def box(low, high):
    points, faces = prism(4, math.sqrt(2), -1, 1)
    return [tuple(a + (b - a) * round((c + 1) / 2) for a, b, c in zip(low, high, p)) for p in points], faces


def write(name, solid):
    points, faces = solid
    suffix = pathlib.Path(name).suffix
    if suffix == '.stl':
        triangles = [(f[0], f[i], f[i + 1]) for f in faces for i in range(1, len(f) - 1)]
        text = 'solid made\n' + ''.join(
            'facet normal 0 0 0\nouter loop\n' + ''.join('vertex {} {} {}\n'.format(*points[i]) for i in t)
            + 'endloop\nendfacet\n' for t in triangles) + 'endsolid made\n'
    else:
        rows = ''.join(ROW[suffix].format(*p) for p in points)
        if suffix == '.obj':
            text = rows + ''.join('f ' + ' '.join(str(i + 1) for i in f) + '\n' for f in faces)
        else:
            rows += ''.join(f'{len(f)} ' + ' '.join(map(str, f)) + '\n' for f in faces)
            text = f'OFF\n{len(points)} {len(faces)} 0\n{rows}' if suffix == '.off' else (
                f'ply\nformat ascii 1.0\nelement vertex {len(points)}\nproperty double x\nproperty double y\n'
                f'property double z\nelement face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n{rows}')
    pathlib.Path(name).write_text(text, encoding='ascii')


def prepare():
    for name in ('plate.obj', 'part.stl', 'scan.stl', 'expected.off', 'shaft.stl', 'nut.obj', 'box.obj'):
        write(name, box((0, 0, 0), (4, 3, 1)))
    write('hole.off', prism(24, 0.5, -0.5, 1.5, (2, 1.5)))
    write('tool.off', prism(24, 0.5, -0.5, 1.5, (2, 1.5)))
    write('ball.off', prism(24, 0.5, -0.5, 1.5, (2, 1.5)))
    write('drill.ply', prism(8, 0.25, -0.5, 1.5, (1, 1)))
    write('screw.obj', box((0, 0, 5), (1, 1, 6)))
    write('hub.stl', box((3, 2, 0), (6, 6, 2)))
    write('stock.stl', box((0, 0, -5), (20, 20, 0)))
    write('cutter.stl', prism(16, 1, 0, 5))
    write('holder.stl', prism(16, 2, 5, 9))
    for name, text in (('points.txt', '1 1 0.5\n'), ('pose.txt', '1 0 0 0.5  0 1 0 0  0 0 1 0\n'),
                       ('turns.txt', 'screw 1 0 0 1  1.5 1.5 0  0 0 -6\n'),
                       ('motion.txt', 'screw 1 0 0 0  0 0 0  0 0 3\n'),
                       ('plant.json', '{"parts": [{"file": "shaft.stl", "name": "shaft"}, {"file": "hub.stl", "name": "hub"}]}'),
                       ('program.nc', 'G0 X-5 Y10\nG0 Z-1\nG1 X25 F600\n')):
        pathlib.Path(name).write_text(text, encoding='ascii')


def run(words, accepted=(0,)):
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    if done.returncode not in accepted:
        sys.exit(f'readme_test.py: {shlex.join(map(str, words))}: exit code {done.returncode}\n{done.stdout}{done.stderr}')
    return done.stdout


def flags(package):
    return run(['pkg-config', '--cflags', '--libs', package]).split()


def compiled(compiler, name, source, package):
    pathlib.Path(name).write_text(source, encoding='utf-8')
    run([*shlex.split(compiler), name, '-o', './a.out', *flags(package)])
    run(['./a.out'])


def whole_program(lines):
    """Lines as they are shown, with a function around those that need one."""
    above = [line for line in lines if line.startswith(('#include', 'using '))]
    within = [line for line in lines if line not in above]
    return '\n'.join([*above, 'int main() {', *within, '}', ''])


def blocks_of(path):
    found = {}
    for language, text in BLOCK.findall(path.read_text(encoding='utf-8')):
        found.setdefault(language, text)
    return found


def tutorial_of(path):
    """Blocks that go on from one to the next."""
    return ''.join(text for language, text in BLOCK.findall(path.read_text(encoding='utf-8')) if language == 'python')


def main(root, programs):
    readme = (root / 'README.md').read_text(encoding='utf-8')
    shown = blocks_of(root / 'README.md')
    section = re.search(r'^## The command\n(.*?)^## ', readme, re.MULTILINE | re.DOTALL)[1]
    lines = [*shown['sh'].splitlines(), *re.findall(r'^    (trisect .*)$', section, re.MULTILINE)]
    prepare()
    count = 0
    if 'python' in programs:
        for text in (shown['python'], blocks_of(root / 'docs' / 'python.md')['python'],
                     tutorial_of(root / 'docs' / 'site' / 'tutorial.md')):
            run([programs['python'], '-c', text])
            count += len(text.splitlines())
    if 'command' in programs:
        for line in lines:
            words = shlex.split(line, comments=True)
            run([programs['command'], *words[1:]], accepted=(0, 1))
        count += len(lines)
    if 'cxx' in programs:
        compiled(programs['cxx'] + ' -std=c++20', 'shown.cpp', whole_program(shown['cpp'].splitlines()), 'trisect')
        count += len(shown['cpp'].splitlines())
    if 'cc' in programs:
        text = blocks_of(root / 'docs' / 'c.md')['c']
        compiled(programs['cc'], 'shown.c', text, 'trisect-c')
        count += len(text.splitlines())
    print(f'{count} lines of README.md and docs ran')


if __name__ == '__main__':
    main(pathlib.Path(sys.argv[1]), dict(word.split('=', 1) for word in sys.argv[2:]))

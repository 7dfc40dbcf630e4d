#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""rank_slab_test.py TRISECT [TRISECT_MPI MPIRUN]

Unites, intersects and subtracts two rings in slabs, with `trisect` and with `trisect-mpi` on 1, 2 and 4 ranks: all meshes
are the same bytes. Broken inputs and a folder that cannot be written leave an error and nothing else. Without the last two
arguments, or where MPI does not start, only the first part is done, and the test counts as skipped (77).
"""
import fcntl
import json
import math
import os
import pathlib
import signal
import struct
import subprocess
import sys
import tempfile
import time
import unittest

TRISECT = sys.argv[1]
TRISECT_MPI, MPIRUN = (sys.argv[2:4] + [None, None])[:2]
ENVIRONMENT = {**os.environ, 'OMPI_MCA_rmaps_base_oversubscribe': '1', 'OMPI_MCA_hwloc_base_binding_policy': 'none',
               'OMPI_ALLOW_RUN_AS_ROOT': '1', 'OMPI_ALLOW_RUN_AS_ROOT_CONFIRM': '1'}


def call(command):
    return subprocess.run(command, env=ENVIRONMENT, capture_output=True, text=True, timeout=300, check=False)


def has_mpi():
    if not TRISECT_MPI:
        print('MPI is absent: trisect-mpi was not built')
        return False
    started = call([MPIRUN, '-n', '2', 'true'])
    if started.returncode != 0:
        print('MPI does not start here: ' + started.stderr)
    return started.returncode == 0


READY = has_mpi()


def write_ring(path, around, across, turn, shift):
    """A torus as binary STL."""
    def point(i, j):
        a, b = 2 * math.pi * (i % around) / around, 2 * math.pi * (j % across) / across
        r = 10 + math.sin(5 * a) * math.cos(3 * b)
        x, y, z = (40 + r * math.cos(b)) * math.cos(a), (40 + r * math.cos(b)) * math.sin(a), r * math.sin(b)
        return (x * math.cos(turn) - z * math.sin(turn) + shift, y, x * math.sin(turn) + z * math.cos(turn))
    with open(path, 'wb') as file:
        file.write(bytes(80) + struct.pack('<I', 2 * around * across))
        for i in range(around):
            for j in range(across):
                p, q, r, s = point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)
                for t in ((p, q, r), (p, r, s)):
                    file.write(struct.pack('<12fH', 0, 0, 0, *t[0], *t[1], *t[2], 0))


class RankSlabs(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.a, self.b = str(self.folder / 'a.stl'), str(self.folder / 'b.stl')
        write_ring(self.a, 60, 30, 0, 0)
        write_ring(self.b, 50, 40, 0.7, 17.3)

    def boolean(self, program, operation, name, *more, code=0):
        out = self.folder / name
        done = call([*program, operation, self.a, self.b, '-o', str(out), '-q', *more])
        self.assertEqual(done.returncode, code, done.stderr)
        self.assertFalse((self.folder / (name + '.slabs')).exists())
        return out

    def ranks(self, count):
        return [MPIRUN, '-q', '-n', str(count), TRISECT_MPI]

    def test_command(self):
        for operation in ('union', 'intersection', 'difference'):
            slabs = self.boolean([TRISECT], operation, 'slabs.ply', '--slabs', '5')
            whole = self.boolean([TRISECT], operation, 'whole.ply')
            self.assertEqual(call([TRISECT, 'check', str(slabs)]).returncode, 0)
            diff = json.loads(call([TRISECT, 'diff', str(slabs), str(whole), '--json']).stdout)
            for side in ('only_first', 'only_second'):
                self.assertLess(abs(diff[side]['volume']), 1e-9)

    def test_other_formats(self):
        expected = self.boolean([TRISECT], 'difference', 'slabs.ply', '--slabs', '4')
        for ending in ('off', 'obj', 'trisect'):
            other = self.folder / f'other.{ending}'
            self.assertEqual(call([TRISECT, 'convert', self.b, '-o', str(other), '-q']).returncode, 0)
            first, self.b = self.b, str(other)
            for program in [[TRISECT]] + ([self.ranks(2)] if READY else []):
                found = self.boolean(program, 'difference', 'found.ply', '--slabs', '4')
                diff = json.loads(call([TRISECT, 'diff', str(found), str(expected), '--json']).stdout)
                self.assertLess(abs(diff['only_first']['volume']) + abs(diff['only_second']['volume']), 1e-9)
            self.b = first

    def write_as(self, name):
        """The second ring, as a text that no converter of ours writes."""
        whole = pathlib.Path(self.b).read_bytes()
        facets = [struct.unpack_from('<12f', whole, 84 + 50 * i)[3:] for i in range((len(whole) - 84) // 50)]
        facets = [(f[0:3], f[3:6], f[6:9]) for f in facets]
        points = sorted({p for f in facets for p in f})
        number = {p: i for i, p in enumerate(points)}
        path = self.folder / name
        with open(path, 'w', encoding='ascii') as file:
            if name.endswith('.stl'):
                file.write('solid ring\n')
                for f in facets:
                    corners = ''.join('vertex %r %r %r\n' % p for p in f)
                    file.write(f'facet normal 0 0 0\nouter loop\n{corners}endloop\nendfacet\n')
                file.write('endsolid\n')
            elif name.endswith('.ply'):
                file.write(f'ply\nformat ascii 1.0\nelement vertex {len(points)}\nproperty double x\nproperty double y\n'
                           f'property double z\nelement face {len(facets)}\n'
                           'property list uchar int vertex_indices\nend_header\n')
                file.write(''.join('%r %r %r\n' % p for p in points))
                file.write(''.join('3 %d %d %d\n' % tuple(number[p] for p in f) for f in facets))
            else:
                # Faces first, then points, and normals between.
                file.write(''.join('f %d//1 %d//1 %d//1\n' % tuple(number[p] + 1 for p in f) for f in facets))
                file.write(''.join('v %r %r %r\nvn 0 0 1\n' % p for p in points))
        return path

    def test_texts_in_pieces(self):
        expected = self.boolean([TRISECT], 'union', 'slabs.ply', '--slabs', '4').read_bytes()
        first = self.b
        for name in ('text.stl', 'text.ply', 'text.obj'):
            self.b = str(self.write_as(name))
            # One triangle after the other, as in the binary file: the same slabs, the same bytes.
            self.assertEqual(self.boolean([TRISECT], 'union', 'found.ply', '--slabs', '4').read_bytes(), expected, name)
            lines = pathlib.Path(self.b).read_text(encoding='ascii').splitlines(keepends=True)
            broken = self.folder / f'broken{pathlib.Path(name).suffix}'
            at = next(i for i, line in enumerate(lines) if i > 40 and line.count('.') == 3)
            broken.write_text(''.join([*lines[:at], lines[at].replace('.', '.x'), *lines[at + 1:]]), encoding='ascii')
            done = call([TRISECT, 'union', self.a, str(broken), '-o', str(self.folder / 'o.ply'), '--slabs', '4'])
            self.assertEqual(done.returncode, 3, done.stderr)
            self.assertIn(f'{broken.name}:{at + 1}:', done.stderr)
            self.assertFalse((self.folder / 'o.ply.slabs').exists())
            self.b = first
        # Cut among its points it would be an empty solid.
        (self.folder / 'cut.obj').write_text('v 0 0 0\nv 1 0 0\nv 0 1 0\n', encoding='ascii')
        done = call([TRISECT, 'union', self.a, str(self.folder / 'cut.obj'), '-o', str(self.folder / 'o.ply'), '--slabs', '4'])
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn('cut.obj:', done.stderr)

    def test_polygons_in_pieces(self):
        # Boxes of quadrilaterals, in both formats that have them, that share a part of a face's plane.
        for name, shift in (('box.off', 0), ('box.obj', 5)):
            at = [(x + shift, y + shift / 2, z) for x in (0, 10) for y in (0, 10) for z in (0, 10)]
            quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
            if name.endswith('off'):
                text = 'OFF\n8 6 0\n' + ''.join('%r %r %r\n' % p for p in at) + ''.join('4 %d %d %d %d\n' % q for q in quads)
            else:
                text = ''.join('v %r %r %r\n' % p for p in at)
                text += ''.join('f %d %d %d %d\n' % tuple(c - 8 for c in q) for q in quads)
            (self.folder / name).write_text(text, encoding='ascii')
        self.a, self.b = str(self.folder / 'box.off'), str(self.folder / 'box.obj')
        slabs = self.boolean([TRISECT], 'union', 'slabs.ply', '--slabs', '3')
        whole = self.boolean([TRISECT], 'union', 'whole.ply')
        diff = json.loads(call([TRISECT, 'diff', str(slabs), str(whole), '--json']).stdout)
        self.assertEqual([diff[side]['volume'] for side in ('only_first', 'only_second')], [0, 0])

    def test_memory_decides_for_texts(self):
        # 600 bytes for each of 600,000 triangles are too many.
        write_ring(self.b, 600, 500, 0.7, 17.3)
        self.b = str(self.write_as('text.obj'))
        out = self.folder / 'o.ply'
        done = call([TRISECT, 'union', self.a, self.b, '-o', str(out), '--json', '--assume-embedded', '--max-memory', '150M'])
        self.assertEqual(json.loads(done.stdout)['schema'], 'trisect.slabs/1', done.stderr)

    def test_memory_decides(self):
        out = self.folder / 'o.ply'
        done = call([TRISECT, 'union', self.a, self.b, '-o', str(out), '--json', '--max-memory', '2G'])
        self.assertEqual(json.loads(done.stdout)['schema'], 'trisect.boolean/1', done.stderr)

    def test_memory_that_a_check_for_self_intersection_would_exceed(self):
        for name, turn in (('a.stl', 0), ('b.stl', 0.7)):
            write_ring(self.folder / name, 300, 200, turn, 0)
        done = call([TRISECT, 'union', str(self.folder / 'a.stl'), str(self.folder / 'b.stl'), '-o', str(self.folder / 'o.ply'),
                     '--json', '--max-memory', '128M'])
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(json.loads(done.stdout)['schema'], 'trisect.slabs/1')

    def test_usage(self):
        for words in (['--faces'], ['--exact'], ['--lattice', '-10']):
            self.boolean([TRISECT], 'union', 'o.ply', '--slabs', '3', *words, code=2)
        self.boolean([TRISECT], 'union', 'o.off', '--slabs', '3', code=2)
        self.boolean([TRISECT], 'xor', 'o.ply', '--slabs', '3', code=2)

    def test_broken_inputs_leave_nothing(self):
        whole = pathlib.Path(self.b).read_bytes()
        programs = [[TRISECT]] + ([self.ranks(2)] if READY else [])
        for program in programs:
            pathlib.Path(self.b).write_bytes(whole[:-30])
            self.boolean(program, 'union', 'o.ply', '--slabs', '3', code=3)
            # One triangle twice, another one not at all.
            pathlib.Path(self.b).write_bytes(whole[:84] + whole[84:134] + whole[84:134] + whole[184:])
            self.boolean(program, 'union', 'o.ply', '--slabs', '3', code=4)
            self.assertEqual(sorted(p.name for p in self.folder.iterdir()), ['a.stl', 'b.stl'])

    def test_a_run_waits_for_what_is_left_of_the_last_one(self):
        expected = self.boolean([TRISECT], 'union', 'a.ply', '--slabs', '6').read_bytes()
        for program in [[TRISECT]] + ([self.ranks(2)] if READY else []):
            out = self.folder / 'b.ply'
            folder = self.folder / 'b.ply.slabs'
            folder.mkdir()
            with open(folder / 'job.lock', 'w') as lock:
                fcntl.flock(lock, fcntl.LOCK_SH)
                run = subprocess.Popen([*program, 'union', self.a, self.b, '-o', str(out), '-q', '--slabs', '6'],
                                       env=ENVIRONMENT)
                time.sleep(2)
                self.assertIsNone(run.poll())
                self.assertEqual([p.name for p in folder.iterdir()], ['job.lock'])
            self.assertEqual(run.wait(timeout=300), 0)
            self.assertEqual(out.read_bytes(), expected)
            self.assertFalse(folder.exists())

    @unittest.skipUnless(READY, 'needs MPI')
    def test_ranks(self):
        for operation in ('union', 'intersection', 'difference'):
            expected = self.boolean([TRISECT], operation, 'slabs.ply', '--slabs', '6').read_bytes()
            for count in (1, 2, 4):
                found = self.boolean(self.ranks(count), operation, 'ranks.ply', '--slabs', '6').read_bytes()
                self.assertEqual(found, expected)

    @unittest.skipUnless(READY, 'needs MPI')
    def test_killed_runs_go_on(self):
        write_ring(self.a, 250, 120, 0, 0)
        expected = self.boolean([TRISECT], 'union', 'slabs.ply', '--slabs', '12').read_bytes()
        out = self.folder / 'ranks.ply'
        for seconds in (0.3, 0.6, 0.9):
            run = subprocess.Popen([*self.ranks(2), 'union', self.a, self.b, '-o', str(out), '-q', '--slabs', '12',
                                    '--resume'], env=ENVIRONMENT, stderr=subprocess.DEVNULL)
            time.sleep(seconds)
            run.send_signal(signal.SIGKILL)
            run.wait()
            time.sleep(0.3)
        found = self.boolean(self.ranks(2), 'union', 'ranks.ply', '--slabs', '12', '--resume').read_bytes()
        self.assertEqual(found, expected)


if __name__ == '__main__':
    result = unittest.main(argv=sys.argv[:1], exit=False).result
    sys.exit(1 if not result.wasSuccessful() else 0 if READY else 77)

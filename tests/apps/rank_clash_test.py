#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""rank_clash_test.py MAKE_PLANT TRISECT [TRISECT_MPI MPIRUN]

Finds the clashes of a small plant with `trisect clash`, in one piece and in shards, and with `trisect-mpi clash` on 1, 2
and 4 ranks: all reports are the same bytes. So are those of runs that are gone on with. Without the last two arguments,
or where MPI does not start, only the first part is done, and the test counts as skipped (77).
"""
import itertools
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest
import zipfile

MAKE_PLANT, TRISECT = sys.argv[1:3]
TRISECT_MPI, MPIRUN = (sys.argv[3:5] + [None, None])[:2]
OUTPUTS = ('report.json', 'report.csv', 'report.bcf')
ENVIRONMENT = {**os.environ, 'OMPI_MCA_rmaps_base_oversubscribe': '1', 'OMPI_MCA_hwloc_base_binding_policy': 'none',
               'OMPI_ALLOW_RUN_AS_ROOT': '1', 'OMPI_ALLOW_RUN_AS_ROOT_CONFIRM': '1'}


def call(command):
    return subprocess.run(command, env=ENVIRONMENT, capture_output=True, text=True, timeout=300, check=False)


def ranks(count):
    return [MPIRUN, '-n', str(count), TRISECT_MPI]


def has_mpi():
    if not TRISECT_MPI:
        print('MPI is absent: trisect-mpi was not built')
        return False
    started = call([MPIRUN, '-n', '2', 'true'])
    if started.returncode != 0:
        print('MPI does not start here: ' + started.stderr)
    return started.returncode == 0


READY = has_mpi()


def overlapping_boxes(manifest):
    """Pairs of scaled blocks that a set has and whose interiors meet, by comparing all."""
    boxes = []
    for part in manifest['parts']:
        low, edges = part['pose'][3::4], [64 * part['pose'][5 * k] for k in range(3)]
        boxes.append((part['name'], part['group'], low, [a + b for a, b in zip(low, edges)]))
    groups = [({s['a']}, set(s['b']) if 'b' in s else {s['a']}) for s in manifest['sets']]
    return {frozenset((p[0], q[0])) for p, q in itertools.combinations(boxes, 2)
            if all(p[2][k] < q[3][k] and q[2][k] < p[3][k] for k in range(3)) and
            any((p[1] in a and q[1] in b) or (q[1] in a and p[1] in b) for a, b in groups)}


class RankClash(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        subprocess.run([sys.executable, MAKE_PLANT, self.folder, '--parts', '1500', '--clashes', '20'], check=True,
                       stdout=subprocess.DEVNULL)
        self.manifest = self.folder / 'manifest.json'

    def clash(self, program, name, *more, code=1):
        out = self.folder / name
        out.mkdir(exist_ok=True)
        outputs = [word for output in OUTPUTS for word in ('-o', str(out / output))]
        done = call([*program, 'clash', str(self.manifest), *outputs, '--volumes', '-q', *more])
        self.assertEqual(done.returncode, code, done.stderr)
        return out

    def assert_same(self, one, other):
        for output in OUTPUTS:
            self.assertEqual((one / output).read_bytes(), (other / output).read_bytes(), f'{other.name}/{output}')
        self.assertEqual(sorted(p.name for p in other.iterdir()), sorted(OUTPUTS))

    def test_shards_make_the_whole(self):
        whole = self.clash([TRISECT], 'whole')
        shards = [self.clash([TRISECT], f'shard{i}', '--shard', f'{i}/3', code=int(i == 1)) for i in (1, 2, 3)]
        merge = [word for shard in reversed(shards) for word in ('--merge', str(shard / 'report.json'))]
        self.assert_same(whole, self.clash([TRISECT], 'merged', *merge))
        self.clash([TRISECT], 'merged', *merge[:4], code=2)
        self.clash([TRISECT], 'merged', *merge, *merge[:2], code=2)
        self.clash([TRISECT], 'merged', '--merge', str(whole / 'report.json'), code=3)

    @unittest.skipUnless(READY, 'no MPI')
    def test_any_number_of_ranks(self):
        whole = self.clash([TRISECT], 'whole')
        for count in (1, 2, 4):
            self.assert_same(whole, self.clash(ranks(count), f'ranks{count}'))
        self.assert_same(whole, self.clash(ranks(2), 'small', '--cache', '1K'))
        self.assert_same(whole, self.clash(ranks(2), 'threads', '--threads', '2'))

    @unittest.skipUnless(READY, 'no MPI')
    def test_what_a_stopped_run_leaves_is_taken_over(self):
        whole = self.clash([TRISECT], 'whole')
        out = self.clash(ranks(3), 'stopped', '--max-work', '3000', code=5)
        partial = json.loads((out / 'report.json.partial.json').read_text(encoding='utf-8'))
        self.assertFalse(partial['is_complete'])
        self.assertTrue(partial['undone'])
        self.assertFalse((out / 'report.json').exists())
        self.assert_same(whole, self.clash(ranks(2), 'stopped', '--resume'))
        (out / 'report.json.journal.5').write_text('{"schema":"trisect.clash-journal/1","key":"x"}\n', encoding='ascii')
        self.clash(ranks(2), 'stopped', '--resume', code=2)

    @unittest.skipUnless(READY, 'no MPI')
    def test_many_parts_in_one_place(self):
        parts = [{'file': 'block.off', 'name': f'block {i}', 'pose': [i % 3, i % 5, 0]} for i in range(50)]
        self.manifest.write_text(json.dumps({'parts': parts}), encoding='ascii')
        whole = self.clash([TRISECT], 'whole')
        self.assertEqual(len(json.loads((whole / 'report.json').read_text(encoding='utf-8'))['clashes']), 50 * 49 // 2)
        self.assert_same(whole, self.clash(ranks(3), 'ranks'))
        out = self.clash(ranks(3), 'stopped', '--max-work', '100', code=5)
        self.assertTrue(list(out.glob('*.journal.*')))
        self.assert_same(whole, self.clash(ranks(2), 'stopped', '--resume'))

    def test_topics_by_the_ten_thousand(self):
        # Two files each: more than an archive has without ZIP64.
        parts = [{'file': 'block.off', 'id': f'{i}'} for i in range(260)]
        self.manifest.write_text(json.dumps({'parts': parts}), encoding='ascii')
        report = self.folder / 'many.bcf'
        done = call([TRISECT, 'clash', str(self.manifest), '-o', str(report), '-q'])
        self.assertEqual(done.returncode, 1, done.stderr)
        with zipfile.ZipFile(report) as archive:
            names = archive.namelist()
            self.assertEqual(len(names), len(set(names)))
            self.assertEqual(sum(name.endswith('markup.bcf') for name in names), 260 * 259 // 2)
            self.assertIn(b'Topic', archive.read(next(name for name in reversed(names) if name.endswith('markup.bcf'))))

    def test_plants_that_are_hard_to_divide(self):
        for scene, parts, gathered in (('beams', 600, 9), ('plane', 400, 0), ('clusters', 500, 90), ('heap', 900, 250),
                                       ('few', 1400, 900)):
            subprocess.run([sys.executable, MAKE_PLANT, self.folder, '--scene', scene, '--parts', str(parts), '--gathered',
                            str(gathered)], check=True, stdout=subprocess.DEVNULL)
            whole = self.clash([TRISECT], 'whole')
            clashes = json.loads((whole / 'report.json').read_text(encoding='utf-8'))['clashes']
            found = {frozenset((clash['a'], clash['b'])) for clash in clashes}
            self.assertEqual(found, overlapping_boxes(json.loads(self.manifest.read_text(encoding='ascii'))), scene)
            if READY:
                self.assert_same(whole, self.clash(ranks(3), 'ranks'))

    @unittest.skipUnless(READY, 'no MPI')
    def test_parts_are_divided(self):
        # Several regions, names with what a manifest is cut at, and parts that meet several of them.
        subprocess.run([sys.executable, MAKE_PLANT, self.folder, '--parts', '7000', '--clashes', '10'], check=True,
                       stdout=subprocess.DEVNULL)
        document = json.loads(self.manifest.read_text(encoding='ascii'))
        names = ['quote "', 'comma ",{[', 'escape \\', 'brackets ]}', 'umlaut \u00e4']
        for name, part in zip(names, document['parts']):
            part['id'] = name
        document['parts'].append({'file': 'block.off', 'id': 'long', 'name': 'beam over all', 'group': 'steel',
                                  'pose': [1000, 0, 0, 10, 0, 1, 0, 20, 0, 0, 1, 30]})
        self.manifest.write_text(json.dumps({'sets': document['sets'], 'parts': document['parts']}), encoding='ascii')
        whole = self.clash([TRISECT], 'whole')
        for count in (1, 2, 3, 5):
            self.assert_same(whole, self.clash(ranks(count), f'ranks{count}'))
        self.clash(ranks(3), 'stopped', '--max-work', '3000', code=5)
        self.assert_same(whole, self.clash(ranks(2), 'stopped', '--resume'))

    @unittest.skipUnless(READY, 'no MPI')
    def test_ranks_share_what_is_done_for_parts(self):
        subprocess.run([sys.executable, MAKE_PLANT, self.folder, '--parts', '20000', '--clashes', '20'], check=True,
                       stdout=subprocess.DEVNULL)
        for count in (1, 2, 4):
            done = call([*ranks(count), 'clash', str(self.manifest), '-o', str(self.folder / 'o.json'), '--json', '-q'])
            document = json.loads(done.stdout)
            boxes = [rank['boxes'] for rank in document['ranks']]
            # Once for each part, and once more for one that another rank was sent.
            moved = sum(boxes) - document['parts']
            self.assertGreaterEqual(moved, 0)
            self.assertLess(moved, 0.6 * document['parts'])
            self.assertLess(max(boxes), 1.2 * sum(boxes) / count)
            self.assertLess(document['message_bytes'], 100 * document['parts'] * min(count - 1, 2) + 1)
            for rank in document['ranks']:
                steps = [step['step'] for step in rank['steps']]
                self.assertEqual(steps, ['began', 'joined', 'read', 'compared', 'started', 'surveyed', 'routed', 'divided',
                                         'ended'])
                processor = [step['processor'] for step in rank['steps']]
                self.assertEqual(processor, sorted(processor))

    @unittest.skipUnless(READY, 'no MPI')
    def test_a_tile_is_sent_once_for_its_pieces(self):
        # 600 parts in one place, of which each of six is compared with all others: many pieces of one tile.
        parts = [{'file': 'block.off', 'id': f'{i}', 'group': 'few' if i % 100 == 0 else 'many'} for i in range(600)]
        sets = [{'name': 'all', 'a': 'few', 'b': 'many'}]
        self.manifest.write_text(json.dumps({'parts': parts, 'sets': sets}), encoding='ascii')
        done = call([*ranks(2), 'clash', str(self.manifest), '-o', str(self.folder / 'o.json'), '--json', '-q'])
        document = json.loads(done.stdout)
        self.assertEqual(document['clashes'], 6 * 594)
        # A tile has 600 times some 200 bytes, a clash some 1,000; all 112 pieces with a tile each would be 13 MB.
        self.assertLess(document['message_bytes'], 9_000_000)

    @unittest.skipUnless(READY, 'no MPI')
    def test_where_parts_are_cut_is_a_guess(self):
        # The list may be anywhere, and texts may look like parts: then one rank reads the whole.
        document = json.loads(self.manifest.read_text(encoding='ascii'))
        parts = document['parts'][:300]
        texts = '{"file": 1}, {"file": 2}' * 1200
        named_set = {**document['sets'][0], 'name': texts}
        for behind in ({}, {'sets': document['sets']}, {'sets': [named_set]}):
            for name in ('a name', '{"file": 1}, {"file": 2}'):
                named = [{'id': part['name'], **part, 'name': name} for part in parts]
                self.manifest.write_text(json.dumps({'parts': named, **behind}, indent=len(name) % 2 or None),
                                         encoding='ascii')
                self.assert_same(self.clash([TRISECT], 'whole'), self.clash(ranks(3), 'ranks'))

    @unittest.skipUnless(READY, 'no MPI')
    def test_what_only_one_rank_reads(self):
        parts = [{'file': 'block.off', 'name': f'block {i}', 'pose': [i, 0, 0]} for i in range(20)]
        rows = [f'block.off,block {i},{i} 0 0' for i in range(20)]
        csv = self.folder / 'manifest.csv'
        csv.write_text('\n'.join(['file,name,pose', *rows]), encoding='ascii')
        self.manifest = csv
        self.assert_same(self.clash([TRISECT], 'whole'), self.clash(ranks(3), 'ranks'))
        self.manifest = self.folder / 'manifest.json'
        # Refused with the same words: two of one identity, a pose that is none, no list of parts, what is not known.
        bad_pose = {'file': 'block.off', 'name': 'flat', 'pose': [1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0]}
        others = [{'key': [{'file': 'block.off'}, {'file': 'bar.off'}] * 4000}]
        for broken in ({'parts': [*parts, parts[3]]}, {'parts': [*parts, bad_pose]}, {'parts': 7}, {},
                       {'parts': parts, 'others': others}, {'parts': [*parts, {**parts[3], 'place': 1}]}):
            self.manifest.write_text(json.dumps(broken), encoding='ascii')
            reasons = []
            for program in ([TRISECT], ranks(3)):
                done = call([*program, 'clash', str(self.manifest), '-o', str(self.folder / 'o.json')])
                self.assertEqual(done.returncode, 3, done.stderr)
                reasons.append([line for line in done.stderr.splitlines() if 'manifest.json' in line][0])
            self.assertEqual(reasons[0], reasons[1])

    @unittest.skipUnless(READY, 'no MPI')
    def test_files_that_cannot_be_used(self):
        (self.folder / 'bar.off').unlink()
        block = self.folder / 'block.off'
        block.write_bytes(block.read_bytes()[:100])
        self.clash([TRISECT], 'whole', code=3)
        self.clash(ranks(3), 'ranks', code=3)
        whole = self.clash([TRISECT], 'whole', '--keep-going')
        self.assertEqual(len(json.loads((whole / 'report.json').read_text(encoding='utf-8'))['missing']), 2)
        out = self.clash(ranks(3), 'ranks', '--keep-going')
        self.assert_same(whole, out)


if __name__ == '__main__':
    result = unittest.main(argv=sys.argv[:1], exit=False, verbosity=2).result
    sys.exit(1 if not result.wasSuccessful() else 0 if READY else 77)

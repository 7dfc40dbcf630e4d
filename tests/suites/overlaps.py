#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""overlaps.py FOLDER TRISECT

Geometries of detectors whose overlaps are known: pyg4ometry's tests of its own search for overlaps (tests/geant4/T1*_overlap*
and T3*_overlap* of github.com/g4edge/pyg4ometry, FOLDER), by `trisect clash`. Their programs run as they are. What they import
of pyg4ometry is pyg4ometry_recorder.py, which writes what they build as GDML. Prints a table in Markdown.

What is expected follows from their numbers, which are of boxes and extrusions; where placements are turned by general angles only that
something overlaps, as the program says. Faces in one plane, which their search names as well, are no clash.
"""
import argparse
import contextlib
import importlib.util
import io
import json
import pathlib
import subprocess
import sys
import tempfile

import pyg4ometry_recorder
from run import read_deviations

# Pairs that clash, without the names of their mothers; None where some must.
EXPECTED = {
    'T102_overlap_none': set(),
    # Two pairs in part and one that is turned, all with faces in a plane; the last box is half outside.
    'T103_overlap_copl': {('b_pv8', 'b_pv9'), ('b_pv10', 'b_pv11'), ('b_pv12', 'b_pv13'), ('b_pv14', 'wl')},
    'T103_overlap_copl_simple': set(),
    'T104_overlap_volu': {('b_pv1', 'b_pv2'), ('b_pv2', 'b_pv3'), ('b_pv1', 'rl'), ('b_pv3', 'rl')},
    'T300_overlap_assembly_regular_lv': {('part_pv1/e_pv', 'abox_pv1'), ('part_pv1/camel_pv', 'abox_pv1')},
    'T301_overlap_assembly_none': set(),
    # Parts that would be 1e-12 mm deep: less than a step of 1e-9 mm.
    'T302_overlap_assembly_coplanar': set(),
    'T303_overlap_assembly_daughter_collision': {('part_pv1/e_pv', 'part_pv1/camel_pv'), ('part_pv2/e_pv', 'part_pv2/camel_pv')},
    'T304_overlap_assembly_volumetric': None,
    'T305_overlap_assembly_nested': None,
    'T306_overlap_replica_x': {('ml_pv1', 'ml2_pv1')},
    'T307_overlap_replica_x_internal': ({(f'bl/{i}', f'bl/{i + 1}') for i in range(7)} | {('bl/0', 'ml'), ('bl/7', 'ml')}),
}


def geometry_of(path):
    """What one of their programs builds, as GDML."""
    spec = importlib.util.spec_from_file_location(path.stem, path)
    module = importlib.util.module_from_spec(spec)
    with contextlib.redirect_stdout(io.StringIO()):
        spec.loader.exec_module(module)
        module.Test()
    return pyg4ometry_recorder.Registry.last.gdml()


def short_name(name):
    """Without the volume in which something is placed; the name of a mother is that of its volume."""
    return name.partition('/')[2] or name


def clashes_of(text, trisect, folder):
    (folder / 'geometry.gdml').write_text(text, encoding='utf-8')
    run = subprocess.run([trisect, '--quiet', 'clash', folder / 'geometry.gdml', '-o', folder / 'report.json'],
                         capture_output=True, text=True, check=False)
    if run.returncode not in (0, 1):
        return run.stderr.strip()
    report = json.loads((folder / 'report.json').read_text(encoding='utf-8'))
    return {tuple(short_name(clash[side]) for side in 'ab') for clash in report['clashes']}


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument('folder', type=pathlib.Path)
    parser.add_argument('trisect', type=pathlib.Path)
    arguments = parser.parse_args()
    tests = arguments.folder / 'tests/geant4'
    sys.path.insert(0, str(tests))
    sys.dont_write_bytecode = True
    pyg4ometry_recorder.install()
    known, passed, problems = read_deviations(), 0, []
    paths = sorted(tests.glob('T[13]*_overlap*.py'))
    with tempfile.TemporaryDirectory() as name:
        for path in paths:
            found = clashes_of(geometry_of(path), arguments.trisect.resolve(), pathlib.Path(name))
            expected = EXPECTED.get(path.stem, 'nothing is known')
            holds = bool(found) and not isinstance(found, str) if expected is None else found == expected
            passed += holds
            if holds == (('overlaps', path.stem) in known):
                problems.append(f'{path.stem}: {found}, not {expected}')
    print('| program | cases | passed | differs |\n|---|---:|---:|---:|')
    print(f'| overlaps of pyg4ometry | {len(paths)} | {passed} | {len(paths) - passed} |')
    for problem in problems:
        print('overlaps.py:', problem, file=sys.stderr)
    return 1 if problems or not paths else 0


if __name__ == '__main__':
    sys.exit(main())

#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Pages of `trisect view` in a headless browser, against the engine.

    tests/pages/view_test.py TRISECT [--models FOLDER] [--picks 200] [--screenshots FOLDER]

Of each page: faces hit at pixels (the first hit of the engine is in that face's exact plane), loops of sections across
axes (their number, corners and area), exact coordinates of vertices (rounded they are those of the mesh), and that a mark
leaves nothing in the picture. Exits with 77 where there is no Chromium. Needs the Python package.
"""

import argparse
import fractions
import json
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

import trisect
from browser import ask, find_browser, picture
from picks import check_pick

def check_picks(solid, picks):
    for pick in picks:
        eye = np.array(pick["eye"])
        way = np.array(pick["to"]) - eye
        plane = [float(fractions.Fraction(c)) for c in pick["plane"]]
        t_plane = (plane[3] - np.dot(plane[:3], eye)) / np.dot(plane[:3], way)
        hit = solid.first_hit(eye, way)
        check_pick(pick, hit and hit.t, t_plane)


def check_sections(command, files, operation, sections, found):
    for (axis, at), loops in zip(sections, found):
        done = subprocess.run(
            [command, "section", *files, "--op", operation, "--plane", f"{'xyz'[axis]}={at!r}", "--json"],
            capture_output=True, check=True,
        )
        expected = json.loads(done.stdout)
        if (loops["loops"], loops["corners"]) != (expected["loops"], expected["corners"]):
            raise SystemExit(f"{'xyz'[axis]} = {at}: {loops}, the engine: {expected['loops']} {expected['corners']}")
        if abs(loops["area"] - expected["area"]) > 1e-9 * expected["area"]:
            raise SystemExit(f"{'xyz'[axis]} = {at}: area {loops['area']}, the engine's {expected['area']}")


def check_vertices(vertices, made):
    """Rounded coordinates of a vertex that has no others say nothing. `made`: some are no doubles."""
    if any(v["precision"] == "rounded" for v in vertices):
        raise SystemExit("a vertex without three planes")
    if made and not any(v["precision"] == "planes" for v in vertices):
        raise SystemExit("no vertex was computed from planes")
    for v in vertices:
        rounded = [float(fractions.Fraction(c)) for c in v["exact"]]
        if rounded != v["rounded"]:
            raise SystemExit(f"vertex {v['number']}: {rounded}, not {v['rounded']}")


def solid_of(files, operation):
    solids = [trisect.Solid.read(f) for f in files]
    if len(solids) == 1:
        return solids[0]
    if operation == "difference":
        return trisect.difference(solids[0], solids[1:])
    return {"union": trisect.union, "intersection": trisect.intersection}[operation](solids)


def made_scenes(folder):
    """A flange with bores, whose computed vertices are no doubles."""
    plate = trisect.Solid.box((-1, -1, 0), (1, 1, 0.3))
    bores = [
        trisect.Solid.cylinder(0.2, 1, 24).transform(
            np.array([[1, 0, 0, x], [0, 1, 0.25, y], [0, 0, 1, -0.3]], dtype=float)
        )
        for x in (-0.5, 0.5)
        for y in (-0.6, 0.4)
    ]
    files = []
    for i, s in enumerate([plate, *bores]):
        files.append(str(folder / f"part{i}.off"))
        s.write(files[-1])
    return [(files, "difference")]


def model_scenes(models):
    if models is None:
        return []
    names = [
        (["mechanisms/nut-big.obj"], "union"),
        (["cad/plate_holes.STL"], "union"),
        (["pairs/hull-body.obj", "pairs/hull-mask.obj"], "difference"),
        (["large/cow100K.obj"], "union"),
    ]
    out = [([str(models / n) for n in files], operation) for files, operation in names]
    return [s for s in out if all(pathlib.Path(f).exists() for f in s[0])]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("command")
    parser.add_argument("--models", type=pathlib.Path)
    parser.add_argument("--picks", type=int, default=200)
    parser.add_argument("--screenshots", type=pathlib.Path)
    options = parser.parse_args()
    browser = find_browser()
    if browser is None:
        print("no Chromium: pages are not tested")
        return 77
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for number, (files, operation) in enumerate(made_scenes(folder) + model_scenes(options.models)):
            page = folder / f"page{number}.html"
            subprocess.run([options.command, "-q", "view", *files, "--op", operation, "-o", str(page)], check=True)
            solid = solid_of(files, operation)
            low, high = (np.array(b) for b in solid.bounds)
            sections = [(k, float(low[k] + p * (high[k] - low[k]))) for k in range(3) for p in (0.37, 0.613)]
            vertices = [7919 * i for i in range(300)]
            found = ask(browser, page, "report",
                        {"picks": options.picks, "seed": 5, "sections": sections, "vertices": vertices})
            check_picks(solid, found["picks"])
            if found["marks"]["there"] == 0 or found["marks"]["gone"] != 0:
                raise SystemExit(f"a mark changes the picture: {found['marks']}")
            check_sections(options.command, files, operation, sections, found["sections"])
            check_vertices(found["vertices"], made=len(files) > 1)
            print(f"{', '.join(pathlib.Path(f).name for f in files)}: {len(found['picks'])} picks, "
                  f"{len(sections)} sections, {len(vertices)} vertices, {page.stat().st_size} bytes")
            if options.screenshots:
                options.screenshots.mkdir(parents=True, exist_ok=True)
                picture(browser, page, options.screenshots / f"page{number}.png")
    return 0


if __name__ == "__main__":
    sys.exit(main())

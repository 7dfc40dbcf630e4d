#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Pages of relations, motions, findings, clashes, trees and hierarchies in a headless browser, against the command.

    tests/pages/stage_test.py TRISECT [--models FOLDER] [--picks 50] [--screenshots FOLDER]

Picks are compared with the first hit of the engine among all bodies under their poses; findings with the document of the
same command; the frame at which an animation stops, its time and poses with the first contact; leaves to which points come
with `locate`; volumes with the vertices that they have to contain. Exits with 77 where there is no Chromium.
"""

import argparse
import json
import pathlib
import random
import subprocess
import sys
import tempfile

import numpy as np

import trisect
from browser import ask, find_browser, picture
from picks import check_pick


class Tester:
    def __init__(self, options, browser, folder):
        self.options = options
        self.browser = browser
        self.folder = folder
        self.pages = 0

    def run(self, *words):
        """The page and the document of a command."""
        page = self.folder / f"{words[0]}{self.pages}.html"
        self.pages += 1
        done = subprocess.run(
            [self.options.command, "-q", *map(str, words), "--page", str(page), "--json"], capture_output=True, text=True
        )
        if done.returncode > 1:
            raise SystemExit(done.stderr)
        return page, json.loads(done.stdout)

    def report(self, page, **question):
        return ask(self.browser, page, "report", question)

    def shoot(self, page, name, function="", *arguments, dark=False):
        folder = self.options.screenshots
        if folder is None:
            return
        folder.mkdir(parents=True, exist_ok=True)
        picture(self.browser, page, folder / f"{name}.png", function, *arguments, dark=dark)

    def file(self, name, solid):
        path = self.folder / name
        solid.write(path)
        return path

    def matrix(self, name, matrix):
        path = self.folder / name
        path.write_text(" ".join(repr(float(x)) for x in np.array(matrix)[:3].flatten()) + "\n")
        return path


def expect(holds, words):
    if not holds:
        raise SystemExit(words)


def first_hit(solids, poses, eye, way):
    """Of a ray among solids under poses, by body."""
    best = None
    for body, (solid, pose) in enumerate(zip(solids, poses)):
        inverse = np.linalg.inv(np.vstack([np.reshape(pose, (3, 4)), [0, 0, 0, 1]]))
        hit = solid.first_hit(inverse[:3, :3] @ eye + inverse[:3, 3], inverse[:3, :3] @ way)
        if hit is not None and (best is None or hit.t < best[1]):
            best = (body, hit.t)
    return best


def check_picks(picks, solids, poses):
    for pick in picks:
        eye = np.array(pick["eye"])
        hit = first_hit(solids, poses, eye, np.array(pick["to"]) - eye)
        expect(hit is not None and hit[0] == pick["body"], f"picked {pick['name']}, the engine's first hit is {hit}")
        check_pick(pick, hit[1])


def entity_words(entity):
    kind = next(k for k in ("vertex", "edge", "face") if k in entity)
    return f"{kind} {entity[kind]} of"


IDENTITY = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0]


def slider(tester):
    """A block with a groove, and a block that fits into it."""
    groove = trisect.Solid.box((0, 0, 0), (6, 3, 2)) - trisect.Solid.box((-1, 1, 1), (7, 2, 3))
    key = trisect.Solid.box((1, 1, 1), (3, 2, 3)) | trisect.Solid.box((1.5, 0.25, 2), (2.5, 2.75, 3))
    return groove, key, tester.file("groove.off", groove), tester.file("key.off", key)


def test_interfere(tester):
    groove, key, *files = slider(tester)
    count = 0
    turn = [[0, -1, 0, 4], [1, 0, 0, 0.5], [0, 0, 1, 3]]
    cases = [("touching", np.hstack([np.eye(3), [[0.5], [0], [0]]])), ("overlapping", np.hstack([np.eye(3), [[4], [0.25], [-0.5]]])),
             ("disjoint", np.array(turn))]
    for name, pose in cases:
        page, document = tester.run("interfere", *files, "--pose-b", tester.matrix("pose.txt", pose), "--distance")
        expect(document["relation"] == name, f"{name}: {document['relation']}")
        found = tester.report(page, picks=tester.options.picks, seed=3)
        check_picks(found["picks"], [groove, key], [IDENTITY, np.array(pose).flatten()])
        count += len(found["picks"])
        regions = trisect.contact_regions(groove, np.eye(4), key, np.vstack([pose, [0, 0, 0, 1]]))
        expect(found["count"] == len(regions) + (1 if document["distance"] else 0),
               f"{name}: {found['count']} findings, the engine has {len(regions)} regions")
        texts = tester.report(page, findings=list(range(found["count"])))["findings"]
        pairs = {(entity_words(c["a"]), entity_words(c["b"])) for c in document["contacts"]}
        for finding in texts[1 if document["distance"] else 0:]:
            expect(any(a in finding["text"] and b in finding["text"] for a, b in pairs),
                   f"{finding['text']}: no contact of the engine")
        tester.shoot(page, f"interfere-{name}", "find", 1 if name == "touching" else 0)
        if name == "touching":
            tester.shoot(page, "interfere-dark", dark=True)
    print(f"interfere: {len(cases)} relations, {count} picks, all regions")


def pose_at(poses, s):
    i = min(int(s), len(poses) - 2)
    return (1 - (s - i)) * np.array(poses[i]) + (s - i) * np.array(poses[i + 1])


def test_sweep(tester):
    groove, key, *files = slider(tester)
    lines = [np.array(IDENTITY, dtype=float) for _ in range(3)]
    for line, (x, y, z) in zip(lines, ((-1, 0.1, 5), (2, 0.1, 3), (2.5, 0.1, -1))):
        line[3], line[7], line[11] = x, y, z
    motion = tester.folder / "motion.txt"
    motion.write_text("\n".join(" ".join(repr(float(x)) for x in line) for line in lines) + "\n")
    turning = tester.folder / "screw.txt"
    turning.write_text("1 0 0 0 0 1 0 0.1 0 0 1 4\nscrew 1 0 0 1  2 1.6 0  0 0 -4\n")
    for name, file in (("lines", motion), ("screw", turning)):
        page, document = tester.run("sweep", *files, "--motion", file)
        expect(document["contact"] is True, f"{name}: no contact")
        found = tester.report(page, play=0.3, findings=[0])
        stopped = found["stopped"]
        time = document["time"]["value"]
        expect(stopped["frame"] == stopped["contact"] and stopped["time"] == time,
               f"{name}: stopped at {stopped['time']}, first contact at {time}")
        expect("first contact" in stopped["text"], stopped["text"])
        if name == "lines":
            expect(np.allclose(stopped["poses"][1], pose_at(lines, time), rtol=0, atol=1e-13),
                   f"{name}: {stopped['poses'][1]}")
        else:  # where the pose puts the solid, the engine says that it meets: just before and just after
            relation = [trisect.interfere(groove, np.eye(4), key, np.reshape(found_pose, (3, 4))).relation
                        for found_pose in moved_by(stopped["poses"][1], (1e-9, -1e-9))]
            expect(relation[0] == trisect.Relation.DISJOINT and relation[1] != trisect.Relation.DISJOINT,
                   f"{name}: {relation}")
        expect(found["count"] == len(document["witnesses"]), f"{name}: {found['count']} findings")
        words = [entity_words(document["witnesses"][0][k]) for k in "ab"]
        expect(all(w in found["findings"][0]["text"] for w in words), f"{name}: {found['findings']}, not {words}")
        times = tester.report(page, frames=[0, 10, 10**9])["frames"]
        expect(times[0]["time"] == 0 and times[2]["time"] == (2 if name == "lines" else 1), f"{name}: {times}")
        tester.shoot(page, f"sweep-{name}", "find", 0)
        tester.shoot(page, f"sweep-{name}-contact", "play")
    print("sweep: 2 motions stop at the first contact")


def moved_by(pose, shifts):
    for shift in shifts:
        out = list(pose)
        out[11] += shift
        yield out


def test_check(tester):
    ball = trisect.Solid.sphere(1, 2)
    vertices, faces = ball.mesh()
    faces = np.array(faces)
    broken = np.delete(faces, [5, 40], axis=0)
    broken[100] = broken[100][::-1]
    bent = np.array(vertices)
    bent[int(faces[200][0])] *= -1.2
    path = tester.folder / "broken.off"
    trisect.write_mesh(path, bent, broken)
    page, document = tester.run("check", path)
    wanted = list(range(0, len(document["defects"]), 3))
    found = tester.report(page, findings=wanted)
    expect(found["count"] == len(document["defects"]), f"{found['count']} findings of {len(document['defects'])}")
    key = "sentence" if "sentence" in document["defects"][0] else "message"
    for i, finding in zip(wanted, found["findings"]):
        expect(finding["text"] == document["defects"][i][key], finding["text"])
    tester.shoot(page, "check", "find", 0)
    print(f"check: {found['count']} defects")


def test_verify(tester):
    a = trisect.Solid.box((0, 0, 0), (4, 3, 2))
    b = trisect.Solid.cylinder(0.8, 4, 32).translate((2, 1.5, -1))
    wrong = (a - b) | trisect.Solid.box((1.9, 1.4, 0.5), (2.1, 1.6, 0.7))
    files = [tester.file(name, s) for name, s in (("a.off", a), ("b.off", b), ("result.off", wrong))]
    page, document = tester.run("verify", "difference", *files)
    expect(document["verdict"] == "different", document["verdict"])
    found = tester.report(page, findings=[0])
    x, y, z = document["witness"]["rounded"]
    expect(found["count"] == 1 and f"({x:g}"[:4] in found["findings"][0]["text"], found["findings"])
    tester.shoot(page, "verify", "find", 0)
    print("verify: 1 witness")


def test_clash(tester):
    tester.file("pipe.off", trisect.Solid.cylinder(0.4, 10, 24))
    tester.file("beam.off", trisect.Solid.box((-5, -0.5, -0.5), (5, 0.5, 0.5)))
    parts = []
    for i in range(6):
        pose = [1, 0, 0, 1.7 * i - 4, 0, 1, 0, 0.3 * (i % 3), 0, 0, 1, -5]
        parts.append({"name": f"pipe {i}", "file": "pipe.off", "group": "pipes", "pose": pose})
    for i in range(4):
        pose = [1, 0, 0, 0, 0, 1, 0, 1.2 * i - 1.5, 0, 0, 1, 2 * i - 3]
        parts.append({"name": f"beam {i}", "file": "beam.off", "group": "beams", "pose": pose})
    manifest = tester.folder / "plant.json"
    manifest.write_text(json.dumps({"parts": parts, "sets": [{"name": "all", "a": ["pipes"], "b": ["beams"], "mode": "collision"}]}))
    page, document = tester.run("clash", manifest, "-o", tester.folder / "report.json", "--regions")
    clashes = json.loads((tester.folder / "report.json").read_text())["clashes"]
    found = tester.report(page, picks=tester.options.picks, seed=9, findings=[0])
    expect(found["count"] == len(clashes) == document["clashes"] and found["count"] > 0, f"{found['count']} of {len(clashes)}")
    expect(sorted(found["names"]) == sorted(p["name"] for p in parts), found["names"])
    by_id = {p["name"]: p for p in parts}
    solids = {f: trisect.Solid.read(tester.folder / f) for f in ("pipe.off", "beam.off")}
    check_picks(found["picks"], [solids[by_id[n]["file"]] for n in found["names"]], [by_id[n]["pose"] for n in found["names"]])
    tester.shoot(page, "clash")
    tester.shoot(page, "clash-one", "find", 1)
    print(f"clash: {found['count']} clashes of {len(parts)} parts, {len(found['picks'])} picks")


def special_points(solid, count):
    """Corners, middles of edges and of triangles, and points anywhere."""
    vertices, faces = solid.mesh()
    vertices = np.array(vertices)
    random.seed(4)
    points = [list(v) for v in vertices[:count]]
    for f in faces[:count]:
        points.append(list((vertices[f[0]] + vertices[f[1]]) / 2))
        points.append(list((vertices[f[0]] + vertices[f[1]]) / 4 + vertices[f[2]] / 2))
    low, high = (np.array(b) for b in solid.bounds)
    while len(points) < 1000:
        points.append([float(low[k] + random.random() * (high[k] - low[k])) for k in range(3)])
    return points


def test_tree(tester):
    block = trisect.Solid.box((0, 0, 0), (4, 3, 2))
    holes = [trisect.Solid.cylinder(0.5, 4, 16).translate((x, 1.5, -1)) for x in (1.0, 2.75)]
    lid = trisect.Solid.box((-0.5, 1, 1.25), (4.5, 2, 3))
    files = [tester.file(f"t{i}.off", s) for i, s in enumerate([block, *holes, lid])]
    solid = trisect.difference(block, [*holes, lid])
    for name, chosen, op in (("block", files, "difference"), ("one", files[:1], "union"), ("balls", None, "difference")):
        if chosen is None:
            chosen = [tester.file("ball.off", trisect.Solid.sphere(2, 5)), tester.file("bite.off", trisect.Solid.sphere(1.5, 5).translate((1.25, 0.5, 0.75)))]
            solid = trisect.Solid.read(chosen[0]) - trisect.Solid.read(chosen[1])
        elif name == "one":
            solid = block
        else:
            solid = trisect.difference(block, [*holes, lid])
        page, document = tester.run("tree", *chosen, "--op", op)
        points = special_points(solid, 60)
        listed = tester.folder / "points.txt"
        listed.write_text("\n".join(" ".join(map(repr, p)) for p in points) + "\n")
        done = subprocess.run([tester.options.command, "locate", *map(str, chosen), "--op", op, "--points", str(listed), "--json"],
                              capture_output=True, text=True, check=True)
        places = json.loads(done.stdout)["points"]
        found = tester.report(page, points=points, levels=[0, 2, 10**6])
        named = 0
        for point, place, here in zip(points, places, found["locations"]):
            cell = here["cells"]
            on_boundary = place["location"] not in ("inside", "outside")
            expect(cell["said"] == place["location"] or (on_boundary and cell["kind"] == "facets"),
                   f"{name}: {point}: the cells say {cell}, the engine {place}")
            if "planes" not in here:
                continue
            expect(here["planes"]["kind"] == place["location"], f"{name}: {point}: {here['planes']}, the engine: {place}")
            if on_boundary:
                named += 1
                expect(here["planes"]["entity"] == place[place["location"]], f"{name}: {point}: {here}, {place}")
        cells = document["cells"]
        deepest = [v for v in found["levels"] if v["tree"] == "cells"][-1]
        expect((deepest["inside"], deepest["outside"], deepest["open"]) ==
               (cells["inside_leaves"], cells["outside_leaves"], cells["listing_leaves"]) or cells["leaves"] > 2900,
               f"{name}: {deepest}, the engine: {cells}")
        tester.shoot(page, f"tree-{name}")
        if name != "balls":
            tester.shoot(page, f"tree-{name}-follow", "follow", [1.3, 0.8, 1.1], 4)
        else:
            tester.shoot(page, "tree-balls-level", "level", 9)
        print(f"tree of {name}: {len(points)} points, {named} on named entities, {cells['leaves']} leaves")


def test_hierarchies(tester):
    ring = trisect.Solid.torus(2, 0.6, 24, 12)
    other = ring.rotate("x", 90).translate((2, 0, 0))
    files = [tester.file("ring.off", ring), tester.file("other.off", other)]
    motion = tester.folder / "past.txt"
    motion.write_text("1 0 0 6 0 1 0 0 0 0 1 0\n1 0 0 -1 0 1 0 0 0 0 1 0\n")
    page, document = tester.run("compare-hierarchies", *files, "--motion", motion, "--frames", 20)
    shift = 6 - 7 * 13 / 19
    found = tester.report(page, level=0, at=13)
    expect([s["structure"] for s in found["structures"]] == [s["name"] for s in document["structures"]], "structures")
    vertices = np.array(other.mesh()[0]) + [shift, 0, 0]
    drawn = 0
    for s in found["structures"]:
        if not s["ends_b"]:
            continue
        drawn += 1
        ends = np.array(s["ends_b"])
        expect(np.all(ends.min(0) <= vertices.min(0) + 1e-5) and np.all(ends.max(0) >= vertices.max(0) - 1e-5),
               f"{s['structure']}: {ends.min(0)} to {ends.max(0)} does not contain {vertices.min(0)} to {vertices.max(0)}")
    expect(drawn >= 8, f"{drawn} structures have volumes")
    tester.shoot(page, "hierarchies-obb", "show", "obb", 3, 12)
    tester.shoot(page, "hierarchies-kdop18", "show", "kdop18", 2, 12)
    print(f"compare-hierarchies: {len(found['structures'])} structures, {drawn} with volumes")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("command")
    parser.add_argument("--models", type=pathlib.Path)
    parser.add_argument("--picks", type=int, default=50)
    parser.add_argument("--screenshots", type=pathlib.Path)
    parser.add_argument("--only", help="one test: interfere, sweep, ...")
    options = parser.parse_args()
    browser = find_browser()
    if browser is None:
        print("no Chromium: pages are not tested")
        return 77
    with tempfile.TemporaryDirectory() as name:
        tester = Tester(options, browser, pathlib.Path(name))
        tests = (test_interfere, test_sweep, test_check, test_verify, test_clash, test_tree, test_hierarchies)
        for test in tests:
            if options.only in (None, test.__name__.removeprefix("test_")):
                test(tester)
    return 0


if __name__ == "__main__":
    sys.exit(main())

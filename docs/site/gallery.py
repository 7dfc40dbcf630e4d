# SPDX-License-Identifier: Apache-2.0
"""Makes the pictures and the live pages of the site.

    gallery.py TRISECT FOLDER

Scenes come from the Python package, which has to be importable; pictures and pages come from the command.
"""

import math
import pathlib
import subprocess
import sys
import tempfile

import trisect


def flange():
    disc = trisect.Solid.cylinder(40, 8, segments=96)
    neck = trisect.Solid.cylinder(18, 30, segments=96)
    bore = trisect.Solid.cylinder(12, 40, segments=96).translate((0, 0, -5))
    bolts = [
        trisect.Solid.cylinder(4, 20, segments=48).translate(
            (30 * math.cos(k * math.pi / 3), 30 * math.sin(k * math.pi / 3), -5))
        for k in range(6)
    ]
    return disc | neck, trisect.union([bore, *bolts])


def corners():
    cube = trisect.Solid.box((-1, -1, -1), (1, 1, 1))
    bars = trisect.union([
        trisect.Solid.box((-2, -0.4, -0.4), (2, 0.4, 0.4)),
        trisect.Solid.box((-0.4, -2, -0.4), (0.4, 2, 0.4)),
        trisect.Solid.box((-0.4, -0.4, -2), (0.4, 0.4, 2)),
    ])
    return cube & trisect.Solid.sphere(1.3, 4), bars


def rings():
    ring = trisect.Solid.torus(2, 0.5, 96, 48)
    return ring, ring.rotate("x", 90).translate((2, 0, 0))


def rail_and_carriage():
    """They touch along the rail, with room on one side."""
    rail = trisect.Solid.box((0, 0, 0), (12, 4, 1)) | trisect.Solid.box((0, 1, 0), (12, 3, 2))
    rail -= trisect.union([trisect.Solid.cylinder(0.4, 3, 32).translate((x, 2, -0.5)) for x in (2, 6, 10)])
    carriage = trisect.Solid.box((4, -0.5, 1), (8, 4.5, 3)) - trisect.Solid.box((3, 1, 0), (9, 3.25, 2))
    return rail, carriage - trisect.Solid.cylinder(0.6, 4, 32).translate((6, 2, 0))


def bracket():
    corner = trisect.Solid.box((0, 0, 0), (5, 3, 1)) | trisect.Solid.box((0, 0, 0), (1, 3, 4))
    return corner - trisect.Solid.cylinder(0.7, 3, 8).translate((3.25, 1.5, -1))


def balls():
    ball = trisect.Solid.sphere(2, 5)
    return ball, trisect.Solid.sphere(1.5, 5).translate((1.25, -0.5, 0.75))


def broken(path):
    """A ball with a hole, a face turned over, and a corner pulled through it."""
    vertices, faces = trisect.Solid.sphere(1, 3).mesh()
    vertices, faces = vertices.copy(), faces.copy()
    faces[100] = faces[100][::-1]
    vertices[faces[900][0]] *= -0.4
    trisect.write_mesh(path, vertices, [f for i, f in enumerate(faces) if i not in (300, 301)])


def relations(run, work: pathlib.Path, folder: pathlib.Path) -> None:
    parts = [work / "rail.off", work / "carriage.off"]
    for path, solid in zip(parts, rail_and_carriage()):
        solid.write(path)
    run("interfere", *parts, "--page", folder / "interfere.html")
    motion = work / "motion.txt"
    motion.write_text("1 0 0 -9  0 1 0 0  0 0 1 5\n1 0 0 -6  0 1 0 0.1  0 0 1 3\n1 0 0 0  0 1 0 0.1  0 0 1 -1\n")
    run("sweep", *parts, "--motion", motion, "--page", folder / "sweep.html")
    broken(work / "broken.off")
    run("check", work / "broken.off", "--page", folder / "check.html")


def trees(run, work: pathlib.Path, folder: pathlib.Path) -> None:
    bracket().write(work / "bracket.off")
    run("tree", work / "bracket.off", "--page", folder / "planes.html")
    files = [work / "ball.off", work / "bite.off"]
    for path, solid in zip(files, balls()):
        solid.write(path)
    run("tree", *files, "--op", "difference", "--page", folder / "cells.html")
    ring = trisect.Solid.torus(2, 0.5, 32, 16)
    ring.write(work / "ring.off")
    ring.rotate("x", 90).translate((2, 0, 0)).write(work / "other.off")
    motion = work / "past.txt"
    motion.write_text("1 0 0 4 0 1 0 0 0 0 1 0\n1 0 0 -1 0 1 0 0 0 0 1 0\n")
    chosen = [w for name in ("aabb", "kdop18", "sphere", "obb", "octree", "bsp") for w in ("--structure", name)]
    run("compare-hierarchies", work / "ring.off", work / "other.off", "--motion", motion, "--frames", 31, *chosen,
        "--page", folder / "hierarchies.html")


def main(command: str, folder: pathlib.Path) -> None:
    folder.mkdir(parents=True, exist_ok=True)

    def run(*words) -> None:
        done = subprocess.run([command, *map(str, words), "-q"], stdout=subprocess.DEVNULL, check=False)
        if done.returncode > 1:  # 1: something was found
            raise SystemExit(done.returncode)

    with tempfile.TemporaryDirectory() as name:
        work = pathlib.Path(name)
        relations(run, work, folder)
        trees(run, work, folder)
        for scene, operation in ((flange, "difference"), (corners, "difference"), (rings, "union")):
            files = []
            for i, solid in enumerate(scene()):
                files.append(work / f"{scene.__name__}-{i}.off")
                solid.write(files[-1])
            run("render", *files, "--op", operation, "-o", folder / f"{scene.__name__}.png")
            if scene is flange:
                run("view", *files, "--op", operation, "-o", folder / "flange.html")
                run("tree", *files, "--op", operation, "-o", folder / "cells.svg")


if __name__ == "__main__":
    main(sys.argv[1], pathlib.Path(sys.argv[2]))

# SPDX-License-Identifier: Apache-2.0
"""Makes the pictures and the live page of the gallery.

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


def main(command: str, folder: pathlib.Path) -> None:
    folder.mkdir(parents=True, exist_ok=True)

    def run(*words) -> None:
        subprocess.run([command, *map(str, words), "-q"], check=True, stdout=subprocess.DEVNULL)

    with tempfile.TemporaryDirectory() as name:
        work = pathlib.Path(name)
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

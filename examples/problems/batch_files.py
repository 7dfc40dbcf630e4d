# SPDX-License-Identifier: Apache-2.0
"""Cuts the same tool out of many files, in several processes; a bad file stops nothing.

    python3 batch_files.py [folder with meshes]

Solids themselves go to other processes, too: pickle keeps them to the last bit.
"""
import concurrent.futures
import multiprocessing
import pathlib
import sys
import tempfile

import trisect
from trisect import Solid


def make_files(folder):
    """Six parts, and two files as they come: one with a hole and one that breaks off."""
    for i in range(6):
        part = Solid.box((4, 4, 2)) | Solid.cylinder(1, 3 + i, 24).translate((2, 2, 0))
        part.write(folder / f"part{i}.off")
    vertices, faces = Solid.box((1, 1, 1)).mesh()
    trisect.write_mesh(folder / "with_a_hole.obj", vertices, faces[1:])
    (folder / "torn.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nv 1 0", encoding="ascii")


def cut(path, tool, folder):
    """One file: what is cut off, what is left, and where it was written; or what is wrong."""
    try:
        with trisect.limits(threads=1, max_work=10**10):  # one processor each, and no hour-long files
            part = Solid.read(path)
            rest = part - tool
            target = folder / (path.stem + "-cut.stl")
            rest.write(target)
            return path.name, (part.exact_volume(), (part & tool).exact_volume(), rest.exact_volume())
    except trisect.Error as error:
        return path.name, error


def main():
    with tempfile.TemporaryDirectory() as scratch:
        out = pathlib.Path(scratch)
        folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else out
        if len(sys.argv) == 1:
            make_files(folder)
        paths = sorted(p for p in folder.iterdir() if p.suffix in (".off", ".obj", ".stl", ".STL", ".ply"))
        tool = Solid.cylinder(0.5, 100, 32).translate((2, 2, -50)) | Solid.box((3, 3, 1), (9, 9, 9))

        # Fresh processes: a fork of one that has threads may hang.
        context = multiprocessing.get_context("spawn")
        with concurrent.futures.ProcessPoolExecutor(2, mp_context=context) as pool:
            jobs = [pool.submit(cut, path, tool, out) for path in paths]
            results = [job.result() for job in concurrent.futures.as_completed(jobs)]

        for name, found in sorted(results, key=lambda r: r[0]):
            if isinstance(found, trisect.Error):
                print(f"{name}: {type(found).__name__}: {found}")
                continue
            whole, cut_off, rest = found
            assert cut_off + rest == whole  # exactly, of numbers from other processes
            print(f"{name}: {float(cut_off):.6f} of {float(whole):.6f} cut off")
        if len(sys.argv) == 1:
            bad = {name: found for name, found in results if isinstance(found, trisect.Error)}
            assert set(bad) == {"with_a_hole.obj", "torn.obj"}
            assert isinstance(bad["with_a_hole.obj"], trisect.InvalidSolid)
            assert isinstance(bad["torn.obj"], trisect.InputError) and "torn.obj:5" in str(bad["torn.obj"])
            assert len(list(out.glob("*-cut.stl"))) == 6


if __name__ == "__main__":
    main()

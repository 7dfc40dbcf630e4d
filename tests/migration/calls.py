# SPDX-License-Identifier: Apache-2.0
"""Extracts our calls from the tables of docs/migration.md.

    calls.py PAGE --cpp OUTPUT    writes a C++ program that makes all calls of tables in C++
    calls.py PAGE --run           runs those of tables in Python
"""
import pathlib
import re
import sys
import tempfile


def calls(page, language):
    """(line number, call) of each row with one, in tables whose second column is in a language."""
    ours = False
    for number, line in enumerate(page.read_text(encoding="utf-8").splitlines(), 1):
        if not line.startswith("|"):
            ours = False
            continue
        cells = [c.strip() for c in re.split(r"(?<!\\)\|", line.strip("|"))]
        if cells[1].startswith("Trisect, "):
            ours = cells[1] == "Trisect, " + language
            continue
        if set(cells[1]) <= set("-:") or not ours:
            continue
        if not re.fullmatch(r"`[^`]+`", cells[1]):
            sys.exit(f"{page}:{number}: the middle column must be one piece of code")
        yield number, cells[1].strip("`").replace("\\|", "|")


PROGRAM = """// Made of the calls in docs/migration.md.
#include <utility>
#include <vector>

#include <trisect/trisect.h>

using namespace trisect;

int main() {{
    const PolygonMesh mesh = make_box({{2, 2, 2}});
    const Solid a = Solid::from_mesh(mesh);
    const Solid b = Solid::from_mesh(make_box({{1, 1, 1}}, {{3, 3, 3}}));
    const std::vector<Solid> list{{a, b}};
    const Outline outline{{{{0, 0}}, {{4, 0}}, {{0, 4}}}};
    const std::vector<Outline> holes{{{{{{1, 1}}, {{2, 1}}, {{1, 2}}}}}};
    MeshMap map;
    const auto f = [](const Point3d& p) {{ return 1 - p[0] * p[0] - p[1] * p[1] - p[2] * p[2]; }};
{calls}
    return 0;
}}
"""


def write_program(page, output):
    lines = [f"    {{ [[maybe_unused]] const auto made = ({call}); }}  // line {number}"
             for number, call in calls(page, "C++")]
    if len(lines) < 40:
        sys.exit(f"{page}: only {len(lines)} calls in C++ were found")
    text = PROGRAM.format(calls="\n".join(lines))
    if not output.exists() or output.read_text(encoding="utf-8") != text:
        output.write_text(text, encoding="utf-8")


def run(page):
    import numpy as np

    import trisect
    from trisect import Location, Scene, Solid, difference, union

    box = Solid.box((1, 2, 3))
    names = {"np": np, "trisect": trisect, "Location": Location, "Solid": Solid, "union": union,
             "difference": difference, "a": Solid.box((2, 2, 2)), "b": Solid.box((1, 1, 1), (3, 3, 3)),
             "c": box, "p": [(0, 0), (4, 0), (0, 4)],
             "q": [(1, 0), (2, 0), (2, 1)], "m": np.eye(4), "m4": np.eye(4), "scene": Scene(),
             "points": np.array([(1, 1, 1), (5.0, 0, 0)]), "directions": np.array([(0, 0, 1), (-1.0, 0, 0)])}
    count = 0
    with tempfile.TemporaryDirectory() as folder:
        box.write(folder + "/part.stl")
        for number, call in calls(page, "Python"):
            vertices, faces = box.mesh()
            names["V"], names["F"] = vertices, faces
            if "[::-1]" in call:
                names["F"] = faces[:, ::-1]  # as OpenSCAD has them
            here = call.replace('"part.', f'"{folder}/part.')
            try:
                eval(here, names)
            except Exception as error:
                sys.exit(f"{page}:{number}: {call}: {type(error).__name__}: {error}")
            count += 1
    if count < 30:
        sys.exit(f"{page}: only {count} calls in Python were found")
    print(f"{count} calls ran")


def main():
    page = pathlib.Path(sys.argv[1])
    if sys.argv[2:3] == ["--cpp"]:
        write_program(page, pathlib.Path(sys.argv[3]))
    else:
        run(page)


main()

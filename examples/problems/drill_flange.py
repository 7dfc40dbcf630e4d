# SPDX-License-Identifier: Apache-2.0
"""Drills a flange: a bore, eight bolt holes, a counterbore for each; then puts bolts into it.

    python3 drill_flange.py [result.stl]
"""
import math
import sys

import trisect
from trisect import Relation, Solid

# Multiples of 1/1024, so that sums of coordinates are exact and copies congruent.
def on_grid(v):
    return round(v * 1024) / 1024


BOLTS = 8
places = [
    (on_grid(40 * math.cos(2 * math.pi * i / BOLTS)), on_grid(40 * math.sin(2 * math.pi * i / BOLTS)), 0)
    for i in range(BOLTS)
]

flange = Solid.cylinder(55, 12, 128) | Solid.cylinder(28, 30, 96)
bore = Solid.cylinder(18, 32, 96).translate((0, 0, -1))
hole = Solid.cylinder(5, 14, 32).translate((0, 0, -1))
counterbore = Solid.cylinder(8, 8, 32).translate((0, 0, 8))
tool = hole | counterbore
tools = [tool.translate(p) for p in places]

part = trisect.difference(flange, [bore, *tools])  # one pass for all nine

# What was cut away and what is left are the flange, to the last bit: tools meet no other one.
cut = sum((flange & t).exact_volume() for t in [bore, *tools])
assert part.exact_volume() + cut == flange.exact_volume()

# One hole for the bore and one for each bolt: genus 9, by Euler's formula.
vertices, faces = part.mesh()
genus = 1 - (len(vertices) - len(faces) // 2) // 2
assert genus == 1 + BOLTS

# A bolt of the drill's size touches the hole and overlaps nothing; a thicker one collides.
bolt = Solid.cylinder(5, 40, 32).translate((0, 0, -20))
thick = Solid.cylinder(5 + 2**-20, 40, 32).translate((0, 0, -20))
for x, y, z in places:
    pose = trisect.Pose.from_translation((x, y, z))
    assert trisect.interfere(part, None, bolt, pose).relation == Relation.TOUCHING
    assert trisect.interfere(part, None, thick, pose).relation == Relation.OVERLAPPING

# Every triangle knows the operand that it came from: how much area did the drills make?
_, _, sources = part.mesh(sources=True)
walls = sum(int((sources[:, 0] == s.source_id).sum()) for s in (bore, hole, counterbore))
part.write(sys.argv[1] if len(sys.argv) > 1 else "drill_flange.stl")
print(f"{part}: volume {part.volume:.3f}, genus {genus}, {walls} triangles made by tools")

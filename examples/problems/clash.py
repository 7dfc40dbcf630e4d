# SPDX-License-Identifier: Apache-2.0
"""Finds all clashes of two assemblies: pipes against a steel frame, in millimetres.

What is flush touches and is no clash; what penetrates by a millionth is one.
"""
import csv
from fractions import Fraction

import trisect
from trisect import Pose, Relation, Scene, Solid

FRAME, PIPES = 1, 2  # groups: only pairs of one frame part and one pipe are looked at

column = Solid.box((300, 300, 6000))
beam = Solid.box((5700, 300, 400))
pipe = Solid.cylinder(150, 14000, 48).rotate("y", 90)  # along x
duct = Solid.box((14000, 900, 750))

scene = Scene()
names = {}


def add(name, solid, place, group):
    body = scene.add(solid, Pose.from_translation(place), groups=group, looks_at=PIPES + FRAME - group)
    names[body] = name


for i in range(3):
    for k in range(4):
        add(f"column {i}{k}", column, (6000 * i, 4000 * k, 0), FRAME)
        if i < 2:
            add(f"beam {i}{k}", beam, (6000 * i + 300, 4000 * k, 5000), FRAME)
add("pipe through columns", pipe, (-500, 150, 3000), PIPES)
add("pipe between columns", pipe, (-500, 2000, 3000), PIPES)
# 300 wide and on a column's face at y = 4300: half of it is within 150, so it only touches.
add("flush pipe", pipe, (-500, 4450, 3000), PIPES)
# The top of this duct is exactly the underside of the beams; the next one is a millionth higher.
add("flush duct", duct, (-500, 8300, 4250), PIPES)
add("high duct", duct, (-500, 11900, 4250 + 2**-20), PIPES)

clashes = []
touching = {}
for pair in scene.interfering():
    a, b = names[pair.a], names[pair.b]
    if pair.relation == Relation.TOUCHING:
        touching.setdefault(b, []).append(a)
        continue
    common = trisect.overlap(scene.solid(pair.a), scene.pose(pair.a),
                             scene.solid(pair.b), scene.pose(pair.b))
    assert common.is_exact
    clashes.append((b, a, common.exact_volume()))

# The pipe crosses three columns, in each by its section times the column's width, exactly.
volumes = {name: [v for b, _, v in clashes if b == name] for name in names.values()}
assert volumes["pipe through columns"] == 3 * [pipe.exact_volume() / 14000 * 300]
assert not volumes["pipe between columns"] and "pipe between columns" not in touching
assert not volumes["flush pipe"] and len(touching["flush pipe"]) == 3
assert not volumes["flush duct"] and len(touching["flush duct"]) == 5
# Three columns, and two beams by a millionth of a millimetre.
assert sorted(volumes["high duct"])[:2] == 2 * [5700 * 300 * Fraction(1, 2**20)]
assert len(volumes["high duct"]) == 5

with open("clashes.csv", "w", newline="", encoding="utf-8") as file:
    csv.writer(file).writerows([("pipe", "frame", "volume")] + [(b, a, float(v)) for b, a, v in clashes])
for b, a, volume in clashes:
    print(f"{b} and {a}: {float(volume):.6g} mm^3")
print(f"{len(clashes)} clashes; {sum(map(len, touching.values()))} pairs touch and are none")

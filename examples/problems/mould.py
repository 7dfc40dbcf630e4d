# SPDX-License-Identifier: Apache-2.0
"""Makes a mould in two halves for a scanned part, and proves whether it opens.

    python3 mould.py [part.obj]
"""
import sys
from fractions import Fraction

import numpy as np

import trisect
from trisect import Motion, Solid


def pebble():
    """A closed mesh such as a scanner makes: a ball with bumps, widest in the plane z = 0."""
    vertices, faces = Solid.uv_sphere(1, 16, 10).mesh()
    x, y, z = vertices.T
    bumps = 1 + 0.06 * np.sin(5 * np.arctan2(y, x)) * (1 - z**2)
    return Solid(np.column_stack([40 * x * bumps, 30 * y * bumps, 15 * z]), faces)


def undercuts(solid, height):
    """Faces over which a half of the mould cannot be drawn off: above the parting plane they look
    down, below it they look up. The sign of a normal's z is decided exactly."""
    vertices, faces = solid.mesh()
    found = []
    for face, (a, b, c) in enumerate(vertices[faces]):
        (ux, uy), (vx, vy) = ([Fraction(p[k]) - Fraction(a[k]) for k in (0, 1)] for p in (b, c))
        z = ux * vy - uy * vx
        top, bottom = max(a[2], b[2], c[2]), min(a[2], b[2], c[2])
        if (z < 0 and top > height) or (z > 0 and bottom < height):
            found.append(face)
    return found


given = len(sys.argv) > 1
part = Solid.read(sys.argv[1]) if given else pebble()
# Plastic shrinks by some per cent when it cools, so the cavity is larger: by a 64th.
cavity = part.scale(1.015625)

low, high = cavity.bounds
wall = 0.25 * (high - low).max()
block = Solid.box(low - wall, high + wall)
middle = 0.5 * (low[2] + high[2])
lower, upper = (half - cavity for half in block.split((0, 0, 1, -middle)))

# Nothing is lost: both halves and the cavity are the block, exactly.
assert lower.exact_volume() + upper.exact_volume() + cavity.exact_volume() == block.exact_volume()
assert trisect.union([lower, upper, cavity]).equals(block)

found = undercuts(cavity, middle)
if not given:
    # The same by motion: the upper half is lifted, then the part. They may slide along each other,
    # but interiors must not meet. That is decided for all times at once; nothing is sampled.
    way = Motion.translation(None, (0, 0, 2 * (high[2] - low[2])))
    assert not trisect.first_contact(cavity, Motion(), upper, way, event="overlap")
    assert not trisect.first_contact(lower, Motion(), cavity, way, event="overlap")
    assert not found

    # A rod through the part and the wall, above the parting plane, locks the mould at once.
    rod = Solid.cylinder(3, 120, 8).translate((0, 0, -60)).rotate("y", 90).translate((0, 0, 6))
    locked, held = upper - rod, cavity | rod
    caught = trisect.first_contact(held, Motion(), locked, way, event="overlap")
    assert caught and caught.exact_time() == (0, 0)
    assert undercuts(held, middle)

lower.write("mould_lower.stl")
upper.write("mould_upper.stl")
print(f"cavity {cavity.volume:.1f} in a block of {block.volume:.1f}, {lower.triangle_count} and "
      f"{upper.triangle_count} triangles")
print("the mould opens" if not found else f"{len(found)} undercuts, the first in triangle {found[0]}")

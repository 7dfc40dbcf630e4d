# SPDX-License-Identifier: Apache-2.0
"""Counts integer points in a polyhedron, and gets its volume from the counts.

Every point of the grid that is on a face, an edge or a corner must be recognised as such, or the
sums are wrong: a test without mercy for "is this point inside?".

For a polyhedron with integer corners the number of integer points in its n-fold enlargement is a
polynomial in n (Ehrhart, 1962): its leading coefficient is the volume, its value at 0 the Euler
characteristic, and at -n it counts the points strictly inside, with the opposite sign.
"""
import numpy as np

import trisect
from trisect import Location, Solid

# An octahedron with a square tunnel through it and a cube that sticks out of it.
octahedron = Solid.hull([(9, 0, 0), (-9, 0, 0), (0, 9, 0), (0, -9, 0), (0, 0, 9), (0, 0, -9)])
tunnel = Solid.box((-2, -1, -9), (2, 1, 9))
cube = Solid.box((3, 3, -2), (8, 8, 2))
solid = (octahedron | cube) - tunnel
corners = trisect.union([solid]).mesh()[0]
assert (corners == np.round(corners)).all()


def count(n):
    """Integer points inside and on the boundary of the n-fold enlargement."""
    grid = np.arange(-9 * n - 1, 9 * n + 2, dtype=float)
    points = np.stack(np.meshgrid(grid, grid, grid, indexing="ij"), -1).reshape(-1, 3)
    found = solid.scale(n).locate(points)
    inside = int((found == Location.INSIDE).sum())
    outside = int((found == Location.OUTSIDE).sum())
    return inside, len(points) - outside - inside, len(points)


counts = [count(n) for n in (1, 2, 3)]
for n, (inside, on, asked) in enumerate(counts, 1):
    print(f"enlarged {n} times: {inside} inside, {on} on the boundary, of {asked} points")

# The polynomial through the Euler characteristic of a solid with one tunnel, 0, and three counts.
euler = 0
total = [euler] + [inside + on for inside, on, _ in counts]
volume_times_6 = total[3] - 3 * total[2] + 3 * total[1] - total[0]
assert volume_times_6 == 6 * solid.exact_volume()


def ehrhart(n):
    """Newton's interpolation at 0, 1, 2, 3, in integers."""
    d1, d2 = total[1] - total[0], total[2] - 2 * total[1] + total[0]
    return total[0] + n * d1 + n * (n - 1) // 2 * d2 + n * (n - 1) * (n - 2) // 6 * volume_times_6


# Reciprocity: the counts of interior points, which were not used so far.
for n, (inside, _, _) in enumerate(counts, 1):
    assert ehrhart(-n) == -inside

# A point that is off by the last bit of a double is not on the boundary.
assert solid.locate((3.0, 3.0, 3.0)).location == Location.ON_FACE
assert solid.locate((3.0, 3.0, np.nextafter(3.0, 4))).location == Location.OUTSIDE
assert solid.locate((3.0, 3.0, np.nextafter(3.0, 2))).location == Location.INSIDE
print(f"volume by counting: {volume_times_6}/6, exactly the volume of the solid: {solid.exact_volume()}")

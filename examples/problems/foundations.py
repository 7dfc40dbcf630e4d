# SPDX-License-Identifier: Apache-2.0
"""Cut and fill: a terrain from a grid of heights, a building pad with slopes, footings in the ground.

How much earth is dug off, how much is filled in, how much concrete is below the ground? All sums
come out exactly, which is how one finds out that a solid was forgotten.
"""
from fractions import Fraction

import numpy as np

import trisect
from trisect import Solid

N, CELL, BOTTOM = 40, 2.0, -20.0  # 40 x 40 cells of 2 m


def terrain():
    """Heights in millimetres, as from a survey, closed by walls and a floor."""
    x, y = np.meshgrid(np.arange(N + 1), np.arange(N + 1), indexing="ij")
    z = np.round(1000 * (3 * np.sin(x / 7) + 2 * np.cos(y / 5) + 0.1 * x)) / 1000
    top = np.column_stack([CELL * x.ravel(), CELL * y.ravel(), z.ravel()])
    floor = top * (1, 1, 0) + (0, 0, BOTTOM)
    index = np.arange((N + 1) ** 2).reshape(N + 1, N + 1)
    a, b, c, d = (index[i : N + i, j : N + j].ravel() for i, j in ((0, 0), (1, 0), (1, 1), (0, 1)))
    upper = np.concatenate([np.column_stack([a, b, c]), np.column_stack([a, c, d])])
    lower = upper[:, ::-1] + len(top)
    rim = np.concatenate([index[:-1, 0], index[-1, :-1], index[:0:-1, -1], index[0, :0:-1]])
    after = np.roll(rim, -1)
    sides = np.concatenate([np.column_stack([after, rim, rim + len(top)]),
                            np.column_stack([after, rim + len(top), after + len(top)])])
    return np.concatenate([top, floor]), np.concatenate([upper, lower, sides]), upper


vertices, faces, upper = terrain()
ground = Solid(vertices, faces)
# The same volume by hand: over each triangle a prism, the mean of three heights times two.
heights = [sum(Fraction(vertices[v][2]) for v in t) / 3 - Fraction(BOTTOM) for t in upper]
assert ground.exact_volume() == sum(heights) * Fraction(CELL) ** 2 / 2

# The pad lies at level 2. Above it everything is dug off, with slopes of one in one; below it the
# hollow is filled up, with slopes as well: frustums upside down and upright.
LEVEL, DEEP = 2.0, 16.0


def frustum(z, other, spread):
    square = [(28, 24), (56, 24), (56, 60), (28, 60)]
    middle = np.array([42, 42])
    wide = [p + np.sign(np.array(p) - middle) * spread for p in square]
    return Solid.hull([(*p, z) for p in square] + [(*p, other) for p in wide])


dug = frustum(LEVEL, LEVEL + DEEP, DEEP) & ground
filled = frustum(LEVEL, LEVEL - DEEP, DEEP) - ground
levelled = (ground - dug) | filled
assert levelled.exact_volume() == ground.exact_volume() - dug.exact_volume() + filled.exact_volume()
assert (levelled ^ ground).equals(dug | filled)

# Footings: piers on a grid, 1.25 m thick, that reach 3 m below the pad, with a ring beam.
piers = [Solid.box((x, y, LEVEL - 3), (x + 1.25, y + 1.25, LEVEL + 0.5)) for x in (30, 41.5, 52.75)
         for y in (26, 41.5, 56.75)]
ring = Solid.box((30, 26, LEVEL - 1), (54, 58, LEVEL)) - Solid.box((31, 27, LEVEL - 2), (53, 57, LEVEL + 1))
concrete = trisect.union([ring, *piers])
buried = concrete & levelled
finished = levelled | concrete
assert buried.exact_volume() + (concrete - levelled).exact_volume() == concrete.exact_volume()
assert finished.exact_volume() + buried.exact_volume() == levelled.exact_volume() + concrete.exact_volume()
assert (concrete - levelled).exact_volume() == 9 * Fraction(125, 100) ** 2 / 2  # nine stumps

finished.write("foundations.stl")
print(f"ground {ground.volume:.3f} m^3: {dug.volume:.3f} dug off, {filled.volume:.3f} filled in")
print(f"concrete {concrete.volume:.3f} m^3, {buried.volume:.3f} of it below the ground; {finished}")

# SPDX-License-Identifier: Apache-2.0
"""Carves a word into a plate and makes the letters that fit into it without a gap.

    python3 carve_letters.py [result.off]
"""
import sys

import trisect
from trisect import EntityKind, Relation, Solid

# Letters on a grid of 4 x 7: outlines, the first one outside, the others holes.
LETTERS = {
    "T": [[(0, 7), (0, 6), (1.5, 6), (1.5, 0), (2.5, 0), (2.5, 6), (4, 6), (4, 7)]],
    "R": [[(0, 0), (1, 0), (1, 3), (1.5, 3), (3, 0), (4, 0), (2.5, 3), (3, 3), (4, 4), (4, 6), (3, 7), (0, 7)],
          [(1, 4), (1, 6), (2.5, 6), (3, 5.5), (3, 4.5), (2.5, 4)]],
    "I": [[(1.5, 0), (2.5, 0), (2.5, 7), (1.5, 7)]],
    "S": [[(0, 0), (3, 0), (4, 1), (4, 3), (3, 4), (1, 4), (1, 6), (4, 6), (4, 7), (1, 7), (0, 6), (0, 4),
           (1, 3), (3, 3), (3, 1), (0, 1)]],
    "E": [[(0, 0), (4, 0), (4, 1), (1, 1), (1, 3), (3, 3), (3, 4), (1, 4), (1, 6), (4, 6), (4, 7), (0, 7)]],
    "C": [[(1, 0), (4, 0), (4, 1), (1.5, 1), (1, 1.5), (1, 5.5), (1.5, 6), (4, 6), (4, 7), (1, 7), (0, 6), (0, 1)]],
}
WORD, DEPTH, THICKNESS = "TRISECT", 0.75, 2.0


def area(loop):
    return abs(sum(x * v - u * y for (x, y), (u, v) in zip(loop, loop[1:] + loop[:1]))) / 2


letters = []
for place, letter in enumerate(WORD):
    outer, *holes = ([(x + 5 * place, y) for x, y in loop] for loop in LETTERS[letter])
    letters.append(Solid.extrude(outer, THICKNESS - DEPTH, THICKNESS, holes=holes))

plate = Solid.box((-1, -1, 0), (5 * len(WORD), 8, THICKNESS))
carved = trisect.difference(plate, letters)

# Areas on paper times the depth: all numbers are halves and quarters, so floats are exact here.
inked = sum(area(LETTERS[c][0]) - sum(map(area, LETTERS[c][1:])) for c in WORD)
assert carved.exact_volume() == plate.exact_volume() - inked * DEPTH

# Deeper than the plate, the letters fall out, and the middle of the R with its own.
pierced = trisect.difference(plate, [s.scale((1, 1, 8)).translate((0, 0, -12)) for s in letters])
assert len(carved.components()) == 1 and len(pierced.components()) == 2

# Each letter lies in its hollow: it touches the floor and the walls, and nowhere is a gap.
walls = 0
for place, letter in enumerate(letters):
    found = trisect.interfere(letter, None, carved, None)
    assert found.relation == Relation.TOUCHING
    areas = [r for r in trisect.contact_regions(letter, None, carved, None) if r.dimension == 2]
    assert all(r.opposite and r.a.kind == EntityKind.FACE for r in areas)
    corners = sum(map(len, LETTERS[WORD[place]]))
    assert len(areas) == corners + 1  # a wall for each side of the outline, and the floor
    walls += corners
# So together they are the plate again, as a set and to the last bit.
assert trisect.union([carved, *letters]).equals(plate)

carved.write(sys.argv[1] if len(sys.argv) > 1 else "carve_letters.off")
print(f"{WORD}: {inked} of area, {carved.exact_volume()} of {plate.exact_volume()} are left")
print(f"{len(letters)} letters fit into their hollows, along {walls} walls; {carved}")

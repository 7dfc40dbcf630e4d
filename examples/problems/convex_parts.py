# SPDX-License-Identifier: Apache-2.0
"""Divides a solid into convex parts, and proves that a decomposition is one.

Physics engines take convex parts. Whether parts that some program made are convex, do not overlap,
and fill the whole: each of these is a question with an exact answer.
"""
import numpy as np

import trisect
from trisect import Relation, Scene, Solid


def is_convex(solid):
    return Solid.hull(solid.mesh()[0]).equals(solid)


def reflex_plane(vertices, faces):
    """A plane of a face with an edge at which the solid is not convex, or None: the plane of
    triangle (a, b, c), if the third corner of a neighbour is above it."""
    opposite = {(t[i], t[(i + 1) % 3]): t[(i + 2) % 3] for t in faces for i in range(3)}
    for a, b, c in faces:
        normal = np.cross(vertices[b] - vertices[a], vertices[c] - vertices[a])
        for u, v in ((a, b), (b, c), (c, a)):
            if normal @ (vertices[opposite[v, u]] - vertices[a]) > 1e-9:
                return (*normal, -normal @ vertices[a])
    return None


def convex_parts(solid):
    """Cuts along planes of faces until all is convex. Doubles choose the planes; cuts are exact."""
    parts, open_ = [], [solid]
    while open_:
        piece = open_.pop()
        vertices, faces = piece.mesh()
        plane = reflex_plane(vertices, faces)
        if plane is None:
            parts.append(piece)
        else:
            open_ += [c for half in piece.split(plane) for c in half.components()]
    return parts


def wrong(solid, parts):
    """Why the parts are no convex decomposition of the solid, or None."""
    for number, part in enumerate(parts):
        if not is_convex(part):
            return f"part {number} is not convex"
    scene = Scene()
    for part in parts:
        scene.add(part)
    for pair in scene.interfering():
        if pair.relation not in (Relation.DISJOINT, Relation.TOUCHING):
            return f"parts {pair.a.index} and {pair.b.index} overlap"
    if not trisect.union(parts).equals(solid):
        missing = solid - trisect.union(parts)
        return f"{missing.volume:g} of the solid is in no part" if not missing.is_empty else "parts stick out"
    return None


# A U-profile with a window and a foot, on a grid, so that parts have corners that are doubles.
solid = Solid.box((8, 6, 6)) - Solid.box((2, -1, 2), (6, 7, 7)) - Solid.box((-1, 2, 3), (9, 4, 5))
solid = solid | Solid.extrude([(8, 0), (12, 0), (8, 4)], 0, 6)

parts = convex_parts(solid)
assert wrong(solid, parts) is None
assert sum(p.exact_volume() for p in parts) == solid.exact_volume()

# What is wrong is found: a part missing, one that is too large by a millionth, one that is not convex.
assert "is in no part" in wrong(solid, parts[1:])
grown = trisect.union([p.translate((2**-20, 0, 0)) for p in parts[:1]])
assert "overlap" in wrong(solid, [grown] + parts[1:]) or "no part" in wrong(solid, [grown] + parts[1:])
assert "not convex" in wrong(solid, [solid])

for number, part in enumerate(parts):
    part.write(f"convex_part_{number}.stl")
print(f"{solid} into {len(parts)} convex parts of {sum(p.triangle_count for p in parts)} triangles")

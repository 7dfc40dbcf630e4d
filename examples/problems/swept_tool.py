# SPDX-License-Identifier: Apache-2.0
"""Cuts a groove with a ball-nosed tool that moves along a path, not at samples of it.

What a convex tool sweeps over on a straight way is the hull of both ends, exactly. So is what the
tool meets before it stands in the stock: contact times are exact numbers.
"""
import numpy as np

import trisect
from trisect import Motion, Relation, Solid


# Multiples of 1/65536: corners of all copies of the tool are exact sums.
def on_grid(v):
    return np.round(np.asarray(v) * 65536) / 65536


# A shank of 12 sides with a round nose, its tip in the origin.
angles = np.arange(12) * np.pi / 6
rings = [(3 * np.sin(t), 3 - 3 * np.cos(t)) for t in (0.5, 1.0, np.pi / 2)] + [(3, 25)]
corners = on_grid([(0, 0, 0)] + [(r * np.cos(a), r * np.sin(a), z) for r, z in rings for a in angles])
tool = Solid.hull(corners)
corners, _ = tool.mesh()

stock = Solid.box((80, 50, 20))
t = np.linspace(0, 2 * np.pi, 49)
path = on_grid(np.column_stack([40 + 28 * np.cos(t), 25 + 16 * np.sin(2 * t) * 0.9, 14 + 2 * np.cos(3 * t)]))

sweeps = [Solid.hull(np.vstack([corners + a, corners + b])) for a, b in zip(path, path[1:])]

# All steps in one pass, and one after the other: the same set.
at_once = trisect.difference(stock, sweeps)
part, chips = stock, 0
for sweep in sweeps:
    chips += (part & sweep).volume
    part = part - sweep
assert part.equals(at_once)
assert abs(chips + part.volume - stock.volume) < 1e-9 * stock.volume

# The tool fits in its groove wherever it stood: it touches and cuts nothing more.
for place in path:
    pose = trisect.Pose.from_translation(place)
    assert trisect.interfere(part, None, tool, pose).relation == Relation.TOUCHING

# When does the tool, let down at the start, first touch the stock? In exact time.
down = Motion.translation(trisect.Pose.from_translation(path[0] + (0, 0, 20)), (0, 0, -20))
contact = trisect.first_contact(stock, Motion(), tool, down)
depth = 20 * (1 - contact.exact_time()[0])
assert 20 - path[0][2] == depth  # the tip, a corner, meets the top face
# In the part, the tool arrives at the bottom of the groove at the end of the way, not earlier.
assert not trisect.first_contact(part, Motion(), tool, down, event="overlap")

part.write("swept_tool.stl")
print(f"{len(sweeps)} steps removed {chips:.3f} of {stock.volume:.0f}; {part}")
print(f"the tool meets the stock at {contact.time} of its way down, {contact.witnesses[0].b}")

# SPDX-License-Identifier: Apache-2.0
"""Slices a part into layers for printing: outlines, areas, and a picture of all layers.

    python3 slice_for_printing.py [part.stl]
"""
import sys
from fractions import Fraction

import numpy as np

from trisect import Solid


def bracket():
    """A base, a rib and a boss with a bore, all of whose heights are multiples of 4."""
    base = Solid.box((60, 40, 4))
    rib = Solid.extrude([(0, 0), (30, 0), (0, 12)], 0, 5).rotate("x", 90).translate((3, 22.5, 4))
    boss = Solid.cylinder(11, 16, 64).translate((46, 20, 0))
    return (base | rib | boss) - Solid.cylinder(6, 18, 64).translate((46, 20, -1))


def area(loop):
    """Twice the area below a polygon in a plane z = constant, counter-clockwise positive, exactly."""
    xs, ys = ([Fraction(c) for c in loop[:, k]] for k in (0, 1))
    return sum(x * ys[(i + 1) % len(ys)] - xs[(i + 1) % len(xs)] * y
               for i, (x, y) in enumerate(zip(xs, ys)))


part = Solid.read(sys.argv[1]) if len(sys.argv) > 1 else bracket()
low, high = part.bounds
count = 100 if len(sys.argv) == 1 else 40
step = (high[2] - low[2]) / count
layers = []
for i in range(count):
    regions = part.section((0, 0, 1, -(low[2] + (i + 0.5) * step)))
    layers.append([loop for outline, holes in regions for loop in (outline, *holes)])

areas = [float(sum(area(loop) for loop in loops)) / 2 for loops in layers]
printed = step * sum(areas)
print(f"{count} layers of {step:.4f}, {sum(map(len, layers))} outlines, at most {max(areas):.2f} of area")
print(f"printed volume {printed:.4f}, the part's {part.volume:.4f}")

# The slabs between the layers' limits are the part, exactly; here they are cut as solids.
cuts = [low[2] + i * (high[2] - low[2]) / 8 for i in range(1, 8)]
rest, slabs = part, []
for z in cuts:
    slab, rest = rest.split((0, 0, 1, -z))
    slabs.append(slab)
slabs.append(rest)
assert sum(s.exact_volume() for s in slabs) == part.exact_volume()
if len(sys.argv) == 1:
    # Areas change at layers' limits only, and linearly between: each middle stands for its layer.
    assert abs(printed - part.volume) < 1e-9 * part.volume

# All layers beside each other, ten in a row.
size = 1.1 * (high - low)[:2]
with open("slices.svg", "w", encoding="utf-8") as file:
    file.write(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {10 * size[0]} '
               f'{-(-count // 10) * size[1]}">\n')
    for i, loops in enumerate(layers):
        shift = np.array([i % 10 * size[0], i // 10 * size[1]]) - low[:2]
        path = "".join("M" + "L".join("{:.6g},{:.6g}".format(*(p[:2] + shift)) for p in loop) + "Z"
                       for loop in loops)
        file.write(f'<path fill-rule="evenodd" fill="#468" d="{path}"/>\n')
    file.write("</svg>\n")

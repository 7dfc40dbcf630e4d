# SPDX-License-Identifier: Apache-2.0
"""Checks what another program computed: is this mesh the union of those two?

    python3 verify_result.py [union|intersection|difference|xor a.obj b.obj result.obj]

The answer is proved: equal, equal within a distance, or different with a point that anybody can check
with a page of integer arithmetic.
"""
import sys

import numpy as np

import trisect
from trisect import Solid, Verdict


def describe(report):
    if report.verdict == Verdict.EQUAL:
        return "equal, to the last bit"
    if report.verdict == Verdict.NOT_CLOSED:
        return f"bounds nothing: {report.result_defects.findings[0].sentence}"
    if report.verdict == Verdict.DIFFERENT:
        point = ", ".join(f"{float(c):.6g}" for c in report.witness.exact_point())
        has, lacks = ("mesh", "exact result") if report.witness.in_result else ("exact result", "mesh")
        return f"different: the {has} has the point ({point}), the {lacks} has not"
    return f"{report.verdict.name.lower()}: no point is wrong by more than {report.upper:.3g}"


if len(sys.argv) == 5:
    operation, *paths = sys.argv[1:]
    a, b, result = map(trisect.read_mesh, paths)
    print(describe(trisect.verify(operation, [a, b], result)))
    sys.exit()

# Two blocks, and what some kernels might make of their union.
a = Solid.box((4, 3, 2)).mesh()
b = Solid.box((3, 3, 3)).rotate((1, 2, 3), 40).translate((1, 0.5, 0.25)).mesh()
vertices, faces = trisect.union([Solid(*a), Solid(*b)]).mesh()

# 1. Ours, rounded to doubles: no point is wrong by more than the last bits.
ours = trisect.verify("union", [a, b], (vertices, faces), within=1e-14)
print("in doubles:      ", describe(ours))
assert ours.verdict == Verdict.WITHIN

# 2. In floats, as in a binary STL. Is that good enough? For a printer, not for a proof.
floats = (vertices.astype(np.float32), faces)
coarse = trisect.verify("union", [a, b], floats, within=1e-6)
print("in floats:       ", describe(coarse))
assert coarse.verdict == Verdict.WITHIN
assert trisect.verify("union", [a, b], floats, within=1e-9).verdict == Verdict.DIFFERENT

# 3. A kernel that lost a small piece: a tip was flattened.
tip = vertices[:, 2].argmax()
flat = vertices.copy()
flat[tip, 2] -= 0.01
lost = trisect.verify("union", [a, b], (flat, faces), within=1e-3)
print("with a flat tip: ", describe(lost))
assert lost.verdict == Verdict.DIFFERENT and lost.witness.in_exact and not lost.witness.in_result
# The witness by itself: it is in one of the operands, and not in the result.
winding = lost.witness.winding
assert any(winding[:2]) and not winding[2]

# 4. The wrong operation, and a mesh with a hole.
common = trisect.intersection([Solid(*a), Solid(*b)]).mesh()
print("the intersection:", describe(trisect.verify("union", [a, b], common, within=0.1)))
holed = trisect.verify("union", [a, b], (vertices, faces[1:]))
print("with a hole:     ", describe(holed))
assert holed.verdict == Verdict.NOT_CLOSED

# SPDX-License-Identifier: Apache-2.0
"""Certificates, checked by the library and, from what they hand out, by fractions alone."""
import numpy as np
import pytest

import trisect
from trisect import EnclosedMotion, Motion, Pose, Relation, Solid


def shift(x, y=0.0, z=0.0):
    return Pose.from_translation((x, y, z))


def dot(u, v):
    return sum(a * b for a, b in zip(u, v))


def placed(triangles, pose):
    """Corners of triangles under a pose."""
    rows = pose.exact_matrix()
    return [[tuple(dot(row[:3], p) + row[3] for row in rows) for p in t] for t in triangles]


def leaves(nodes, a, b):
    """The leaves of a tree with their triangles of A and of B; every node once."""
    open_ = [(0, a, b)]
    seen = set()
    while open_:
        at, left, right = open_.pop()
        assert at not in seen
        seen.add(at)
        kind, value = nodes[at]
        if kind == "split_a":
            half = len(left) // 2
            open_ += [(at + 1, left[:half], right), (value, left[half:], right)]
        elif kind == "split_b":
            half = len(right) // 2
            open_ += [(at + 1, left, right[:half]), (value, left, right[half:])]
        else:
            yield value, [p for t in left for p in t], [p for t in right for p in t]
    assert len(seen) == len(nodes)


@pytest.fixture
def ball():
    return Solid.sphere(1, 1)


def test_disjoint_by_planes_that_anybody_can_check(ball):
    turn = Pose.from_quaternion((3, 1, 2, 1), (2.125, 0.25, 0))
    proof = trisect.certify_relation(ball, None, ball, turn)
    assert proof.relation == Relation.DISJOINT and proof.is_complete and proof.check() is None
    a = placed(proof.triangles_a(), Pose())
    b = placed(proof.triangles_b(), turn)
    # Small faces may be of several triangles, but all of the boundary must be there.
    assert len(a) >= 80 and len(b) >= 80
    for plane, below, above in leaves(proof.apart(), a, b):
        assert all(dot(plane[:3], p) + plane[3] < 0 for p in below)
        assert all(dot(plane[:3], p) + plane[3] > 0 for p in above)


def test_overlapping_by_three_points(cube):
    proof = trisect.certify_relation(cube, None, cube, shift(0.5))
    assert proof.relation == Relation.OVERLAPPING and proof.check() is None
    half = proof.in_both
    assert all(0 < c < 1 for c in half) and half[0] > 0.5
    assert proof.only_in_a[0] < 0.5 and proof.only_in_b[0] > 1
    assert proof.plane is None and proof.on_both is None and proof.cells() == []


def test_touching_by_a_plane(cube):
    proof = trisect.certify_relation(cube, None, cube, shift(1, 0.5))
    assert proof.relation == Relation.TOUCHING and proof.check() is None
    a, b, c, d = proof.plane
    for p in trisect.Solid.box((1, 1, 1)).mesh()[0]:
        assert dot((a, b, c), map(int, p)) + d <= 0
    assert proof.on_both[0] == 1


def test_touching_from_within_by_cells():
    slot = Solid.box((3, 3, 3)) - Solid.box((1, 1, 1), (2, 2, 4))
    key = Solid.box((1, 1, 1), (2, 2, 3))
    proof = trisect.certify_relation(slot, None, key, None)
    assert proof.relation == Relation.TOUCHING and proof.check() is None
    kinds = [cell[0] for cell in proof.cells()]
    assert kinds.count("split") + 1 == len(kinds) - kinds.count("split")  # a binary tree
    assert {"without_a", "without_b"} >= set(kinds) - {"split"}


def test_inside_and_equal(cube):
    big = Solid.box((-1, -1, -1), (2, 2, 2))
    proof = trisect.certify_relation(cube, None, big, None)
    assert proof.relation == Relation.INSIDE and proof.check() is None and proof.only_in_b
    assert trisect.certify_relation(big, None, cube, None).relation == Relation.CONTAINS
    same = trisect.certify_relation(cube, shift(1), cube, shift(1))
    assert same.relation == Relation.EQUAL and same.check() is None
    assert repr(same) == "<RelationCertificate>"


def test_distances_by_slabs(ball):
    pose = shift(3, 1)
    proof = trisect.certify_distance(ball, None, ball, pose)
    assert proof.is_complete and proof.check() is None
    gap = [p - q for p, q in zip(proof.on_a, proof.on_b)]
    assert dot(gap, gap) == proof.squared
    assert proof.squared == trisect.exact_squared_distance(ball, None, ball, pose)
    a, b = placed(proof.triangles_a(), Pose()), placed(proof.triangles_b(), pose)
    for (normal, below, above), left, right in leaves(proof.slabs(), a, b):
        assert (above - below) ** 2 >= proof.squared * dot(normal, normal)
        assert all(dot(normal, p) <= below for p in left)
        assert all(dot(normal, p) >= above for p in right)
    nothing = trisect.certify_distance(ball, None, Solid(), None)
    assert not nothing.is_complete and repr(nothing) == "<DistanceCertificate: incomplete>"


def test_first_contacts(cube):
    fall = Motion.translation(shift(0.25, 0.25, 3), (0, 0, -4))
    proof = trisect.certify_first_contact(cube, Motion(), cube, fall)
    assert proof.is_complete and proof.is_contact and proof.check() is None
    low, high = proof.time
    assert low <= 0.5 <= high
    assert sum(c * (0.5**i) for i, c in enumerate(map(float, proof.polynomial))) == 0
    past = Motion.translation(shift(5), (0, 0, 9))
    none = trisect.certify_first_contact(cube, Motion(), cube, past)
    assert none.is_complete and not none.is_contact and none.time is None
    assert none.check() is None and none.node_count > 0


def test_first_overlaps(cube):
    slide = Motion.translation(shift(-3, 0, 1), (6, 0, 0))
    none = trisect.certify_first_overlap(cube, Motion(), cube, slide)
    assert not none.is_overlap and none.is_complete and none.check() is None and none.missing == ""
    fall = Motion.translation(shift(0.25, 0.25, 3), (0, 0, -4))
    proof = trisect.certify_first_overlap(cube, Motion(), cube, fall)
    assert proof.is_overlap and proof.is_complete and proof.check() is None
    assert proof.time[0] <= 0.5 <= proof.time[1]


def test_enclosed_contacts(cube):
    turn = EnclosedMotion.turning(shift(1.25, 0, 0.25), (0, 0, 1), 90)
    wall = Solid.box((-5, 1.5, -5), (5, 2, 5))
    proof = trisect.certify_enclosed_contact(wall, EnclosedMotion(), cube, turn, width=1e-4)
    assert proof.check() is None and proof.free
    assert proof.free_until <= proof.contact_by <= proof.free_until + 1e-4
    if proof.is_complete:
        assert 1.5 < proof.in_both[1] < 2


def test_certified_meshes(cube):
    part = cube - cube.rotate((1, 2, 3), 20).translate((0.5, 0.25, 0.125))
    made = part.certified_mesh()
    assert made.certificate and made.certificate.closed and made.certificate.oriented
    assert made.certificate.self_intersecting_pairs == 0 and made.certificate.max_move >= 0
    vertices, faces = made.mesh()
    assert trisect.certify(vertices, faces) and trisect.certify((vertices, faces))
    assert abs(Solid(vertices, faces).volume - part.volume) < 1e-12
    floats = part.certified_mesh(precision="float")
    assert (floats.mesh()[0] == floats.mesh()[0].astype(np.float32)).all()
    assert floats.outcome in (trisect.RoundingOutcome.PLAIN, trisect.RoundingOutcome.GRIDDED,
                              trisect.RoundingOutcome.REPAIRED)
    assert floats.radius < 1e-6
    with pytest.raises(trisect.UsageError, match="precision"):
        part.certified_mesh(precision="half")


def test_meshes_that_bound_nothing(cube):
    vertices, faces = cube.mesh()
    holed = trisect.certify(vertices, faces[1:])
    assert not holed and not holed.closed and "not proved" in repr(holed)
    assert not trisect.certify(vertices, faces[:, ::-1]).oriented
    twice = trisect.certify(np.concatenate([vertices, vertices + 0.5]),
                            np.concatenate([faces, faces + len(vertices)]))
    assert twice.closed and twice.self_intersecting_pairs > 0 and not twice

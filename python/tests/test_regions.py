# SPDX-License-Identifier: Apache-2.0
"""Contact regions and overlaps of placed solids."""
from fractions import Fraction

import numpy as np
import pytest

import trisect
from trisect import Pose, Relation, Solid


def area(loop):
    """The area that a plane loop encloses, as a vector."""
    return 0.5 * sum(np.cross(p, q) for p, q in zip(loop, np.roll(loop, -1, axis=0)))


def shift(x, y=0.0, z=0.0):
    return Pose.from_translation((x, y, z))


def test_the_area_of_two_faces(cube):
    (region,) = trisect.contact_regions(cube, None, cube, shift(1, 0.25, 0.5))
    assert region.dimension == 2 and region.opposite and repr(region) == "<ContactRegion: area, 1 loop>"
    assert region.a.kind == region.b.kind == trisect.EntityKind.FACE
    (loop,) = region.loops
    assert loop.shape == (4, 3) and (loop[:, 0] == 1).all()
    assert area(loop).tolist() == [0.375, 0, 0]  # to the left, seen from where A's normal points
    assert {tuple(p) for p in region.exact_loops()[0]} == {
        (1, Fraction(y), Fraction(z)) for y in ("1/4", "1") for z in ("1/2", "1")
    }


def test_an_area_with_a_hole():
    plate = Solid.box((4, 4, 1)) - Solid.box((1, 1, -1), (3, 3, 2))
    lid = Solid.box((0, 0, 1), (4, 4, 2))
    (region,) = trisect.contact_regions(plate, None, lid, None)
    assert len(region.loops) == 2
    assert sum(area(loop)[2] for loop in region.loops) == 12


def test_edges_and_corners(cube):
    (edge,) = trisect.contact_regions(cube, None, cube, shift(1, 1, 0.5))
    assert edge.dimension == 1 and edge.loops[0].shape == (2, 3)
    (corner,) = trisect.contact_regions(cube, None, cube, shift(1, 1, 1))
    assert corner.dimension == 0 and corner.loops[0].tolist() == [[1, 1, 1]]
    assert trisect.contact_regions(cube, None, cube, shift(2)) == []


def test_regions_under_rotations_are_rational(cube):
    turn = Pose.from_quaternion((2, 0, 0, 1))  # cosine 3/5
    (region,) = trisect.contact_regions(cube, turn, cube, turn @ shift(0, 0, 1))
    assert {tuple(p) for p in region.exact_loops()[0]} == {
        (0, 0, 1), (Fraction(3, 5), Fraction(4, 5), 1), (Fraction(-1, 5), Fraction(7, 5), 1),
        (Fraction(-4, 5), Fraction(3, 5), 1)}


def test_overlaps(cube):
    found = trisect.overlap(cube, None, cube, shift(0.5, 0.5, 0.25))
    assert found.is_exact and found.scale == 1 and found.max_move == 0
    assert found.exact_volume() == Fraction(3, 16) and found.volume == 0.1875
    assert found.solid.equals(Solid.box((0.5, 0.5, 0.25), (1, 1, 1)))
    assert "exact" in repr(found)
    nothing = trisect.overlap(cube, None, cube, shift(1))
    assert nothing.solid.is_empty and nothing.volume == 0


def test_an_overlap_is_in_the_frame_of_a(cube):
    quarter = Pose.from_quaternion((1, 0, 0, 1))
    found = trisect.overlap(cube, quarter, cube, shift(-0.5))
    placed = found.solid.transform(quarter)
    assert placed.equals(Solid.box((-0.5, 0, 0), (0, 1, 1)))


def test_overlaps_under_rotations_have_a_scale(cube):
    turn = Pose.from_quaternion((2, 0, 0, 1))
    found = trisect.overlap(cube, None, cube, turn)
    # A square and one that is turned by the angle a about its corner: tan((90° - a) / 2).
    assert found.is_exact and found.scale == 5
    assert found.solid.exact_volume() == found.exact_volume() * 125
    assert found.exact_volume() == Fraction(1, 3)


def test_overlaps_of_results(cube):
    cut = cube - Solid.box((0.25, 0.25, -1), (0.75, 0.75, 2))
    found = trisect.overlap(cut, None, cube, shift(0.5))
    assert found.exact_volume() == Fraction(1, 2) - Fraction(1, 8)
    assert trisect.interfere(cut, None, found.solid, None).relation == Relation.CONTAINS


@pytest.mark.parametrize("call", [trisect.contact_regions, trisect.overlap])
def test_what_is_refused(cube, call):
    with pytest.raises(TypeError, match="pose_b"):
        call(cube, None, cube, "there")
    with pytest.raises(trisect.UnsupportedError):
        call(cube, None, Solid.half_space((0, 0, 1, 0)), None)

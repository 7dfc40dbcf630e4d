# SPDX-License-Identifier: Apache-2.0
"""Points, rays, distances and planes against a solid."""
from fractions import Fraction

import numpy as np
import pytest

import trisect
from trisect import Location, Solid


@pytest.fixture
def part(two_boxes):
    return two_boxes[0] - two_boxes[1]


def test_one_point_is_located_with_its_faces(part, two_boxes):
    a, b = two_boxes
    assert part.locate((0.5, 0.5, 0.5)).location == Location.INSIDE
    assert part.locate((1.5, 1.5, 1.5)).location == Location.OUTSIDE
    edge = part.locate((2, 1, 0.5))
    assert edge.location == Location.ON_FACE and edge.faces[0][0] == a.source_id
    notch = part.locate([1, 1, 1])
    assert notch.location == Location.ON_VERTEX
    assert {operand for operand, _ in notch.faces} == {b.source_id}
    assert len(notch.faces) == 3 and notch.corner is not None


def test_a_place_compares_with_locations(part):
    inside, outside = part.locate((0.5, 0.5, 0.5)), part.locate((1.5, 1.5, 1.5))
    assert inside == Location.INSIDE and Location.INSIDE == inside and inside != Location.OUTSIDE
    assert outside == Location.OUTSIDE and Location.OUTSIDE == outside and outside != inside
    assert Location(inside) is Location.INSIDE and inside in {Location.INSIDE}
    edge = part.locate((2, 0, 0.5))
    assert edge == part.locate((2, 0, 0.25)) and edge == Location.ON_EDGE
    other = part.locate((0, 0, 0.5))
    assert other == Location.ON_EDGE and edge != other
    # As arrays have them, alone and whole.
    located = part.locate([(0.5, 0.5, 0.5), (1.5, 1.5, 1.5)])
    assert inside == located[0] and located[0] == inside and inside != located[1]
    assert (located == inside).tolist() == [True, False]
    assert (inside == located).tolist() == [True, False]
    assert inside != "INSIDE" and inside != None and inside != 4.5  # noqa: E711


def test_many_points(part):
    points = np.array([(0.5, 0.5, 0.5), (1.5, 1.5, 1.5), (2, 0.5, 0.5), (2, 0, 0.5), (0, 0, 0)])
    located = part.locate(points)
    assert located.dtype == np.uint8 and located.shape == (5,)
    assert [Location(int(x)) for x in located] == [
        Location.INSIDE, Location.OUTSIDE, Location.ON_FACE, Location.ON_EDGE, Location.ON_VERTEX]
    assert (located == Location.INSIDE).tolist() == [True, False, False, False, False]
    assert [p.location for p in part.places(points)] == [Location(int(x)) for x in located]
    assert part.locate(np.zeros((0, 3))).shape == (0,)
    assert part.locate(points.astype(np.float32)).shape == (5,)


def test_refused_points(part):
    with pytest.raises(trisect.UsageError, match=r"points: must have the shape \(n, 3\), not \(4,\)"):
        part.locate((1, 2, 3, 4))
    with pytest.raises(trisect.UsageError, match="finite"):
        part.locate((1, np.nan, 3))
    with pytest.raises(TypeError, match="points"):
        part.locate("here")


def test_rays(part):
    hit = part.first_hit((-1, 0.5, 0.5), (1, 0, 0))
    assert hit.t == 1 and hit.exact_t() == Fraction(1) and not hit.is_interval
    assert hit.place.location == Location.ON_FACE
    assert part.first_hit((-1, 0.5, 0.5), (-1, 0, 0)) is None
    assert [h.t for h in part.all_hits((-1, 0.5, 0.5), (1, 0, 0))] == [1, 3]
    # Along an edge of the solid: vertex, edge, vertex.
    along = part.all_hits((-1, 0, 0), (1, 0, 0))
    assert [h.place.location for h in along] == [
        Location.ON_VERTEX, Location.ON_EDGE, Location.ON_VERTEX]
    assert along[1].is_interval and (along[1].t, along[1].t_leave) == (1, 3)
    t, faces = part.first_hits([(-1, 0.5, 0.5), (-1, 9, 9)], [(1, 0, 0), (1, 0, 0)])
    assert t[0] == 1 and np.isinf(t[1]) and faces.shape == (2, 2)
    with pytest.raises(trisect.UsageError, match="2 origins and 1 directions"):
        part.first_hits(np.zeros((2, 3)), np.ones((1, 3)))
    with pytest.raises(trisect.UsageError):
        part.first_hit((0, 0, 0), (0, 0, 0))


def test_distances(part):
    nearest = part.nearest((3, 0.5, 0.5))
    assert nearest.distance == 1 and nearest.exact_squared_distance() == 1
    assert (nearest.point == (2, 0.5, 0.5)).all()
    assert nearest.exact_point() == (2, Fraction(1, 2), Fraction(1, 2))
    distances = part.signed_distances([(3, 0.5, 0.5), (0.5, 0.5, 0.5), (2, 0.5, 0.5)])
    assert np.allclose(distances, [1, -0.5, 0]) and distances[2] == 0
    assert Solid().nearest((0, 0, 0)) is None


def test_sections(part):
    plate = Solid.box((0, 0, 0), (4, 4, 1)) - Solid.box((1, 1, -1), (2, 2, 2))
    ((outline, holes),) = plate.section((0, 0, 1, -0.5))
    assert outline.shape == (4, 3) and len(holes) == 1 and holes[0].shape == (4, 3)
    assert (outline[:, 2] == 0.5).all()

    def area(loop):
        x, y = loop[:, 0], loop[:, 1]
        return 0.5 * (x @ np.roll(y, -1) - y @ np.roll(x, -1))

    assert area(outline) == 16 and area(holes[0]) == -1
    assert plate.section((0, 0, 1, -7)) == []
    assert plate.relation_to_plane((0, 0, 1, -0.5)) == trisect.PlaneRelation.STRADDLING
    assert plate.relation_to_plane((0, 0, 1, -1)) == trisect.PlaneRelation.TOUCHING_BELOW
    with pytest.raises(trisect.UsageError, match="plane: must be 4 numbers"):
        plate.section((0, 0, 1))
    with pytest.raises(trisect.UsageError):
        plate.section((0, 0, 0, 1))


def test_faces_in_a_box(part, two_boxes):
    faces = part.faces_in_box((0.9, 0.9, 0.9), (1.1, 1.1, 1.1))
    assert faces.shape == (3, 2) and (faces[:, 0] == two_boxes[1].source_id).all()


def test_slices():
    plate = Solid.box((0, 0, 0), (4, 4, 2)) - Solid.box((1, 1, -1), (2, 2, 1)) | Solid.box((8, 0, 0), (9, 1, 1))
    heights = [0.5, 1.5, 7, 1, 0.5]
    layers = plate.slices(heights)
    assert [len(layer) for layer in layers] == [2, 1, 0, 2, 2]
    assert [[len(holes) for _, holes in layer] for layer in layers] == [[1, 0], [0], [], [0, 0], [1, 0]]

    def loops(layer):
        return sorted(sorted(map(tuple, loop.tolist())) for outer, holes in layer for loop in (outer, *holes))

    for height, layer in zip(heights, layers):
        assert loops(layer) == loops(plate.section((0, 0, 1, -height)))
        assert all((outer[:, 2] == height).all() for outer, _ in layer)
    for axis, normal in (("x", (1, 0, 0)), ("y", (0, 1, 0)), ((1, 2, 3), (1, 2, 3))):
        (layer,) = plate.slices(np.array([1.5]), axis=axis)
        section = plate.section((*normal, -1.5))
        assert len(layer) == len(section) and np.allclose(loops(layer), loops(section))
    assert [len(layer) for layer in plate.slices([0, 2], faces="above")] == [2, 0]
    assert [len(layer) for layer in plate.slices([0, 2], faces="below")] == [0, 1]
    assert plate.slices([]) == [] and Solid().slices([1]) == [[]]
    with pytest.raises(trisect.UsageError, match="axis: must be"):
        plate.slices([1], axis="w")
    with pytest.raises(trisect.UsageError, match="heights: must have the shape"):
        plate.slices(1)
    with pytest.raises(trisect.UsageError, match="finite"):
        plate.slices([np.inf])
    with pytest.raises(trisect.UsageError, match="faces: must be"):
        plate.slices([1], faces="all")
    with pytest.raises(trisect.UnsupportedError):
        (~plate).slices([1])

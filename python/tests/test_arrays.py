# SPDX-License-Identifier: Apache-2.0
"""Arrays in and out: types, layouts, copies, and what is refused."""
import gc

import numpy as np
import pytest

import trisect
from conftest import CUBE_QUADS, CUBE_TRIANGLES, CUBE_VERTICES

INTEGERS = ["int8", "int16", "int32", "int64", "uint8", "uint16", "uint32", "uint64", ">i4", ">i8"]
REALS = ["float16", "float32", "float64", ">f8", "longdouble", "int32", "bool"]


@pytest.mark.parametrize("dtype", INTEGERS)
def test_faces_of_every_integer_type(dtype):
    assert trisect.Solid(CUBE_VERTICES, CUBE_TRIANGLES.astype(dtype)).volume == 1


@pytest.mark.parametrize("dtype", REALS)
def test_vertices_of_every_real_type(dtype):
    assert trisect.Solid(CUBE_VERTICES.astype(dtype), CUBE_TRIANGLES).volume == 1


def test_arrays_with_strides_and_in_columns():
    wide = np.zeros((16, 3))
    wide[::2] = CUBE_VERTICES
    faces = np.asfortranarray(CUBE_TRIANGLES.astype(np.int32))
    assert trisect.Solid(wide[::2], faces).volume == 1
    reversed_corners = np.ascontiguousarray(CUBE_TRIANGLES[:, ::-1])[:, ::-1]
    assert trisect.Solid(CUBE_VERTICES, reversed_corners).volume == 1


def test_read_only_arrays():
    vertices = CUBE_VERTICES.copy()
    vertices.flags.writeable = False
    assert trisect.Solid(vertices, CUBE_TRIANGLES).volume == 1


def test_lists_tuples_and_polygons():
    assert trisect.Solid(CUBE_VERTICES.tolist(), CUBE_QUADS.tolist()).volume == 1
    assert trisect.Solid(CUBE_VERTICES, CUBE_QUADS).volume == 1
    # The bottom as one polygon, all else as triangles: 0 and 6 are those of the bottom.
    mixed = [tuple(CUBE_QUADS[0])] + [list(CUBE_TRIANGLES[i]) for i in range(12) if i % 6 != 0]
    solid = trisect.Solid(CUBE_VERTICES, mixed)
    assert solid.volume == 1
    assert trisect.Solid(CUBE_VERTICES, [np.array(f) for f in mixed]).volume == 1


class ArrayLike:
    """Has no more of an array than numpy's protocol."""

    def __init__(self, values):
        self.values = values

    def __array__(self, dtype=None):
        return np.asarray(self.values, dtype=dtype)


def test_whatever_numpy_makes_an_array_of():
    assert trisect.Solid(ArrayLike(CUBE_VERTICES), ArrayLike(CUBE_TRIANGLES)).volume == 1
    buffer = memoryview(CUBE_VERTICES)
    assert trisect.Solid(buffer, CUBE_TRIANGLES).volume == 1


def test_results_own_their_memory(cube):
    vertices, faces = cube.mesh()
    assert vertices.dtype == np.float64 and faces.dtype == np.int32
    assert vertices.shape == (8, 3) and faces.shape == (12, 3)
    # Nothing was copied: a capsule holds what the library made.
    assert not vertices.flags.owndata and not faces.flags.owndata
    assert vertices.flags.c_contiguous and vertices.flags.writeable
    kept = vertices[3]
    before = kept.copy()
    del vertices, faces
    gc.collect()
    assert (kept == before).all()


def test_sources_name_operand_and_face(two_boxes):
    a, b = two_boxes
    vertices, faces, sources = (a - b).mesh(sources=True)
    assert sources.shape == (len(faces), 2) and sources.dtype == np.uint32
    assert set(sources[:, 0]) == {a.source_id, b.source_id}
    assert sources[:, 1].max() < 6
    # The faces of b that bound the notch are three.
    assert len(set(sources[sources[:, 0] == b.source_id, 1])) == 3


def test_empty_arrays_are_the_empty_set():
    assert trisect.Solid([], []).is_empty
    assert trisect.Solid(np.zeros((0, 3)), np.zeros((0, 3), dtype=int)).is_empty
    vertices, faces = trisect.Solid().mesh()
    assert vertices.shape == (0, 3) and faces.shape == (0, 3)


# What is refused, and what the message names.
REFUSED = [
    (lambda v, f: (v[:, :2], f), ValueError, r"vertices: must have the shape \(n, 3\), not \(8, 2\)"),
    (lambda v, f: (v.ravel(), f), ValueError, r"vertices: .*\(24,\)"),
    (lambda v, f: (v[None], f), ValueError, r"vertices: .*\(1, 8, 3\)"),
    (lambda v, f: (v, f[:, :2]), ValueError, r"faces: must have the shape .*not \(12, 2\)"),
    (lambda v, f: (v, f.ravel()), ValueError, r"faces: .*\(36,\)"),
    (lambda v, f: (v, f.astype(float)), TypeError, "faces: .*integers, not of float64"),
    (lambda v, f: (v.astype(complex), f), TypeError, "vertices: .*complex128"),
    (lambda v, f: (v.astype(str), f), TypeError, "vertices: "),
    (lambda v, f: ("vertices", f), TypeError, "vertices: must be an array, not str"),
    (lambda v, f: (v, None), TypeError, "faces: must be an array, not NoneType"),
    (lambda v, f: ([[1, 2], [3]], f), TypeError, "vertices: "),
    (lambda v, f: (v, [[0, 1, 2], [0, "x", 1, 2]]), TypeError, "faces: face 1 .*no integer"),
    (lambda v, f: (v, [[0, 1, 2], 7]), TypeError, "faces: face 1 must be a sequence"),
    (lambda v, f: (v, [[0, 1, 2], [0, 1]]), ValueError, "faces: face 1 has 2 corners"),
    (lambda v, f: (v, [[0, 1, 2], [0, 1, 2, 10**30]]), ValueError, "face 1 names vertex 10000000"),
]


@pytest.mark.parametrize("change, error, message", REFUSED)
def test_refused_shapes_and_types(change, error, message):
    with pytest.raises(error, match=message):
        trisect.Solid(*change(CUBE_VERTICES, CUBE_TRIANGLES))


@pytest.mark.parametrize("dtype", ["int32", "int64", "int8"])
def test_negative_indices_are_refused(dtype):
    faces = CUBE_TRIANGLES.astype(dtype)
    faces[7, 1] = -1
    with pytest.raises(trisect.UsageError, match="face 7 names vertex -1, and there are 8: 0 to 7"):
        trisect.Solid(CUBE_VERTICES, faces)


@pytest.mark.parametrize("dtype", ["int32", "int64", "uint32", "uint64", "uint8"])
def test_indices_out_of_range_are_refused(dtype):
    faces = CUBE_TRIANGLES.astype(dtype)
    faces[3, 2] = 8
    with pytest.raises(trisect.UsageError, match="face 3 names vertex 8, and there are 8: 0 to 7"):
        trisect.Solid(CUBE_VERTICES, faces)


def test_an_index_that_wraps_around_is_refused():
    faces = CUBE_TRIANGLES.astype(np.int64)
    faces[2, 0] += 2**32
    with pytest.raises(trisect.UsageError, match="face 2 names vertex 42949672"):
        trisect.Solid(CUBE_VERTICES, faces)


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
def test_coordinates_that_are_not_finite_are_refused(value):
    vertices = CUBE_VERTICES.copy()
    vertices[5, 1] = value
    with pytest.raises(trisect.UsageError, match="vertex 5 is .*: coordinates must be finite"):
        trisect.Solid(vertices, CUBE_TRIANGLES)


def test_huge_numbers():
    # The scale does not matter where coordinates do not span too many bits.
    huge = trisect.Solid(CUBE_VERTICES * 1e300, CUBE_TRIANGLES)
    assert huge.exact_volume() == int(1e300) ** 3


def test_more_than_2_to_32_corners_are_refused_before_they_are_read():
    # Views of one row: no memory is behind them.
    faces = np.broadcast_to(np.array([[0, 1, 2]]), (2**32, 3))
    with pytest.raises(trisect.LimitError, match="4294967296 faces"):
        trisect.Solid(CUBE_VERTICES, faces)
    vertices = np.broadcast_to(np.zeros((1, 3)), (2**32, 3))
    with pytest.raises(trisect.LimitError, match="4294967296 are more than"):
        trisect.Solid(vertices, CUBE_TRIANGLES)

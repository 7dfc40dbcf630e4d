# SPDX-License-Identifier: Apache-2.0
"""Mending where it is asked for, with a report."""
import numpy as np
import pytest

import trisect
from trisect import Solid


def test_nothing_is_done_that_is_not_asked_for(cube):
    v, f = cube.mesh()
    f[0] = f[0][::-1]
    out = trisect.mend(v, f)
    assert not out.report and not out.report.is_closed
    assert np.array_equal(out.vertices, v) and np.array_equal(out.faces, f)
    assert out.report.misoriented_edges == 3


def test_faces_are_turned_over(cube):
    v, f = cube.mesh()
    f[[1, 4]] = f[[1, 4]][:, ::-1]
    out = trisect.mend(v, f, orient=True)
    assert out.report.turned_faces == [1, 4] and out.report.is_closed
    assert Solid(out.vertices, out.faces).volume == cube.volume
    assert out.source_faces == list(range(len(f)))


def test_shells_are_turned_over():
    v, f = Solid.box((0, 0, 0), (4, 4, 4)).mesh()
    w, g = Solid.box((1, 1, 1), (2, 2, 2)).mesh()
    both = np.concatenate([v, w]), np.concatenate([f[:, ::-1], g + len(v)])
    out = trisect.mend(both, shells=True)
    assert out.report.turned_shells == 2
    assert Solid(out.vertices, out.faces).volume == 63
    out = trisect.mend(both, shells=True, inner="material")
    assert out.report.turned_shells == 1
    assert trisect.check(out.vertices, out.faces).count(trisect.DefectKind.SHELL_NESTING) == 1


def test_seams_are_closed(cube):
    v, f = cube.mesh()
    rng = np.random.default_rng(1)
    soup = v[f].reshape(-1, 3) + rng.uniform(-1e-6, 1e-6, (3 * len(f), 3))
    faces = np.arange(3 * len(f)).reshape(-1, 3)
    out = trisect.mend(soup, faces, seams=1e-5)
    assert out.report.is_closed and len(out.vertices) == 8
    assert 0 < out.report.max_move <= 1e-5
    assert Solid(out.vertices, out.faces).volume == pytest.approx(cube.volume, rel=1e-4)
    vertex, into, move = out.report.joined[0]
    assert np.linalg.norm(soup[vertex] - soup[into]) == pytest.approx(move)
    assert np.array_equal(soup[out.source_vertices], out.vertices)
    assert not trisect.mend(soup, faces, seams=1e-9).report.is_closed


def test_holes_have_places_and_may_be_filled(cube):
    v, f = cube.mesh()
    hole = np.delete(f, 5, axis=0)
    report = trisect.mend(v, hole, orient=True).report
    (boundary,) = report.open
    assert boundary.edges == 3 and boundary.is_loop and boundary.length > 0
    assert np.array_equal(v[boundary.vertex], boundary.place)
    out = trisect.mend(v, hole, fill=True)
    assert out.report.filled_holes == 1 and out.source_faces[-1] is None
    assert Solid(out.vertices, out.faces).volume == cube.volume


def test_duplicates_are_dropped(cube):
    v, f = cube.mesh()
    out = trisect.mend(v, np.concatenate([f, f[2:3]]), drop=True)
    assert out.report.duplicate_faces == [len(f)] and len(out.faces) == len(f)


def test_polygons_stay_polygons():
    v = np.array([[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)], dtype=float)
    quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [7, 5, 1, 3]]
    out = trisect.mend(v, quads, orient=True)
    assert out.faces.shape == (6, 4) and out.report.turned_faces == []
    mixed = trisect.mend(v, quads[:5] + [[1, 3, 7], [1, 5, 7]], orient=True)
    assert mixed.faces[5] == [1, 3, 7] and mixed.report.turned_faces == [6]


def test_bad_arguments(cube):
    v, f = cube.mesh()
    with pytest.raises(trisect.UsageError):
        trisect.mend(v, f, seams=-1)
    with pytest.raises(trisect.UsageError):
        trisect.mend(v, f, shells=True, inner="nothing")
    v[0, 0] = np.inf
    with pytest.raises((trisect.UsageError, trisect.LimitError)):
        trisect.mend(v, f, orient=True)

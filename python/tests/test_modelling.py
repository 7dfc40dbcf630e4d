# SPDX-License-Identifier: Apache-2.0
"""Solids of functions, heights and outlines, and offsets."""
import math

import numpy as np
import pytest

import trisect
from trisect import Solid

SQUARE = [(1, 0), (2, 0), (2, 1), (1, 1)]


def ball(points):
    return 1 - np.linalg.norm(points, axis=1)


def test_level_set():
    solid = Solid.level_set(ball, (-1.25,) * 3, (1.25,) * 3, 0.125)
    assert abs(solid.volume - 4 * math.pi / 3) < 0.03
    assert trisect.check(*solid.mesh()).is_solid
    smaller = Solid.level_set(ball, (-1.25,) * 3, (1.25,) * 3, 0.125, level=0.5, root_steps=3)
    assert abs(smaller.volume - math.pi / 6) < 0.01
    half = Solid.level_set(lambda p: [1] * len(p), (0, 0, 0), (1, 2, 3), 1)
    assert half.volume == 6


def test_level_set_errors():
    def raises(points):
        raise KeyError("mine")

    box = ((0, 0, 0), (1, 1, 1))
    with pytest.raises(KeyError, match="mine"):
        Solid.level_set(raises, *box, 0.5)
    with pytest.raises(TypeError, match="function"):
        Solid.level_set(3, *box, 0.5)
    with pytest.raises(trisect.UsageError, match="shape"):
        Solid.level_set(lambda p: p, *box, 0.5)
    with pytest.raises(trisect.UsageError, match="numbers"):
        Solid.level_set(lambda p: "x", *box, 0.5)
    with pytest.raises(trisect.UsageError, match=r"not finite at \(0, 0, 0\)"):
        Solid.level_set(lambda p: p[:, 0] * np.nan, *box, 0.5)
    with pytest.raises(trisect.LimitError, match="cells"):
        Solid.level_set(ball, *box, 0.01, max_cells=1000)


def test_height_field():
    field = Solid.height_field([[1, 2, 3], [4, 5, 6]], -1, spacing=(2, 4), origin=(10, 20))
    assert field.volume == 72
    assert field.bounds.tolist() == [[10, 20, -1], [14, 24, 6]]
    with pytest.raises(trisect.UsageError, match="row 1, column 0"):
        Solid.height_field([[1, 2], [0, 1]])
    with pytest.raises(trisect.UsageError, match="shape"):
        Solid.height_field([1, 2, 3])


def test_sweeps():
    assert Solid.extrude(SQUARE, 0, 3, scale=0).volume == 1
    assert Solid.extrude(SQUARE, 0, 3, scale=(1, 0)).volume == 1.5
    twisted = Solid.extrude(SQUARE, 0, 3, twist=90, divisions=20)
    assert abs(twisted.volume - 3) < 0.1
    hole = [(1.25, 0.25), (1.75, 0.25), (1.75, 0.75), (1.25, 0.75)]
    assert Solid.extrude(SQUARE, 0, 4, holes=[hole], scale=0).volume == 1
    assert Solid.extrude(SQUARE, 0, 4, holes=[hole]).volume == 3
    quarter = Solid.revolve(SQUARE, 90, 4)
    assert quarter.volume == 1.5
    ring = Solid.revolve(SQUARE, segments=4, holes=[hole])
    assert ring.volume == 6 * 0.75
    with pytest.raises(trisect.UsageError, match="both sides"):
        Solid.revolve([(-1, 0), (1, 0), (1, 1)])


def test_grow(cube):
    assert cube.grow(0.5, shape="cube").volume == 8
    assert cube.grow(-0.25, shape="cube").volume == 0.125
    assert cube.grow(1, shape=cube).volume == 8
    exact = 1 + 6 * 0.5 + 3 * math.pi * 0.25 + 4 / 3 * math.pi * 0.125
    within, around = cube.grow(0.5), cube.grow(0.5, around=True)
    assert 0.95 * exact < within.volume < exact < around.volume < 1.1 * exact
    with pytest.raises(trisect.UsageError, match="shape"):
        cube.grow(1, shape="cone")


def test_mirror_resize_trim(cube):
    part = cube.translate((1, 0, 0))
    assert part.mirror((1, -1, 0)).equals(cube.translate((0, 1, 0)))
    assert abs(part.mirror((1, 2, 3)).volume - 1) < 1e-12
    assert cube.resize((2, 0, 0)).volume == 2
    assert cube.resize((2, 0, 0), follow=True).volume == 8
    assert cube.resize((2, 0, 0), follow=(False, True, False)).volume == 4
    assert cube.trim((0, 0, 1, -0.25)).bounds.tolist() == [[0, 0, 0.25], [1, 1, 1]]

# SPDX-License-Identifier: Apache-2.0
"""Solids that several tests need."""
import numpy as np
import pytest

import trisect

CUBE_VERTICES = np.array([(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)], dtype=float)
CUBE_QUADS = np.array(
    [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
)
CUBE_TRIANGLES = np.concatenate([CUBE_QUADS[:, (0, 1, 2)], CUBE_QUADS[:, (0, 2, 3)]])


@pytest.fixture
def cube():
    return trisect.Solid(CUBE_VERTICES, CUBE_TRIANGLES)


@pytest.fixture
def two_boxes():
    return trisect.Solid.box((0, 0, 0), (2, 2, 2)), trisect.Solid.box((1, 1, 1), (3, 3, 3))

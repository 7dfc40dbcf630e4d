# SPDX-License-Identifier: Apache-2.0
"""Solids from and to meshio.Mesh, and so all formats that meshio reads and writes."""
from __future__ import annotations

from typing import Any, Dict, List

import numpy as np

import trisect

from ._types import Embedding

#: Cells that bound a solid; all others but the following are refused.
SURFACE = ("triangle", "quad", "polygon")
#: Cells that files carry along and that bound nothing.
IGNORED = ("vertex", "line")


def to_solid(mesh: Any, *, embedding: Embedding = "check") -> trisect.Solid:
    """The solid that the triangles, quadrilaterals and polygons of a meshio.Mesh bound.

    Raises
    ------
    UnsupportedError
        For volume cells and curved ones: extract their surface first.
    """
    faces: List[Any] = []
    for block in mesh.cells:
        if block.type in SURFACE or block.type.startswith("polygon"):
            faces.append(np.asarray(block.data))
        elif block.type not in IGNORED:
            raise trisect.UnsupportedError(f"meshio: cells of type {block.type!r} bound no solid")
    if len(faces) == 1:
        return trisect.Solid(mesh.points, faces[0], embedding=embedding)
    if all(block.ndim == 2 and block.shape[1] == 3 for block in faces) and faces:
        return trisect.Solid(mesh.points, np.concatenate(faces), embedding=embedding)
    loops = [loop for block in faces for loop in block]
    return trisect.Solid(mesh.points, loops, embedding=embedding)


def from_solid(solid: trisect.Solid, *, sources: bool = False) -> Any:
    """A meshio.Mesh with the triangles of a solid.

    Parameters
    ----------
    sources : bool
        Add where each triangle comes from, as the cell data ``operand`` and ``face``.
    """
    import meshio

    if not sources:
        vertices, faces = solid.mesh()
        return meshio.Mesh(vertices, [("triangle", faces)])
    vertices, faces, source = solid.mesh(sources=True)
    data: Dict[str, Any] = {"operand": [source[:, 0]], "face": [source[:, 1]]}
    return meshio.Mesh(vertices, [("triangle", faces)], cell_data=data)

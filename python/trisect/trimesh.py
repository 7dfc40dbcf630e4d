# SPDX-License-Identifier: Apache-2.0
"""Trisect as an engine of trimesh.

>>> import trimesh, trisect.trimesh
>>> trisect.trimesh.register()
>>> trimesh.boolean.union([a, b], engine="trisect")

Coordinates stay doubles all the way, and what is no solid is an exception that names the place
instead of an empty result.
"""
from __future__ import annotations

from typing import Any, Iterable, List, Protocol

import trisect

from ._types import Embedding

OPERATIONS = ("union", "intersection", "difference")


class MeshLike(Protocol):
    """What this module needs of a trimesh.Trimesh."""

    @property
    def vertices(self) -> Any: ...

    @property
    def faces(self) -> Any: ...


def to_solid(mesh: MeshLike, *, embedding: Embedding = "check") -> trisect.Solid:
    """The solid of a trimesh.Trimesh, or of anything with ``vertices`` and ``faces``."""
    return trisect.Solid(mesh.vertices, mesh.faces, embedding=embedding)


def from_solid(solid: trisect.Solid, **kwargs: Any) -> Any:
    """A trimesh.Trimesh with the triangles of a solid; keywords go to its constructor.

    Vertices are not merged again (``process=False``): the mesh is closed as it is.
    """
    import trimesh

    vertices, faces = solid.mesh()
    kwargs.setdefault("process", False)
    return trimesh.Trimesh(vertices=vertices, faces=faces, **kwargs)


def boolean(
    meshes: Iterable[MeshLike], operation: str = "union", check_volume: bool = True, **kwargs: Any
) -> Any:
    """The signature of trimesh's engines.

    Parameters
    ----------
    meshes : iterable of trimesh.Trimesh
    operation : {'union', 'intersection', 'difference'}
        A difference takes all others from the first.
    check_volume : bool
        Whether to find out if the meshes meet themselves; False takes them as free of that. That
        they are closed and oriented is always checked.

    Returns
    -------
    trimesh.Trimesh
    """
    if operation not in OPERATIONS:
        raise trisect.UsageError(f"operation: must be one of {', '.join(OPERATIONS)}, not {operation!r}")
    kwargs.pop("debug", None)
    embedding: Embedding = "check" if check_volume else "assume"
    solids: List[trisect.Solid] = []
    for number, mesh in enumerate(meshes):
        try:
            solids.append(to_solid(mesh, embedding=embedding))
        except trisect.Error as error:
            error.args = (f"mesh {number}: {error}",)
            raise
    if not solids:
        raise trisect.UsageError("meshes: there is none")
    if operation == "union":
        result = trisect.union(solids)
    elif operation == "intersection":
        result = trisect.intersection(solids)
    else:
        result = trisect.difference(solids[0], solids[1:])
    return from_solid(result, **kwargs)


def register(name: str = "trisect", *, default: bool = False) -> None:
    """Puts `boolean` into trimesh's table of engines.

    Parameters
    ----------
    name : str
        What ``engine=`` calls it.
    default : bool
        Whether ``engine=None`` takes it, too.
    """
    import trimesh

    # The table is private, and the only one there is; versions differ in its name.
    module = trimesh.boolean
    for attribute in ("_engines", "_backends"):
        table = getattr(module, attribute, None)
        if isinstance(table, dict):
            break
    else:
        raise trisect.UnsupportedError("this version of trimesh has no table of boolean engines")
    table[name] = boolean
    if default:
        table[None] = boolean
    available = getattr(module, "engines_available", None)
    if isinstance(available, set):
        available.add(name)

# SPDX-License-Identifier: Apache-2.0
"""Exact solid modelling.

Booleans of meshes, points, rays, sections, interference and first contact of moving solids. Every
decision is exact; there is no tolerance.

>>> import trisect
>>> plate = trisect.Solid.box((0, 0, 0), (4, 3, 1))
>>> hole = trisect.Solid.cylinder(0.5, 2).translate((2, 1.5, -0.5))
>>> part = plate - hole
>>> vertices, faces = part.mesh()
"""
from ._errors import (
    CancelledError,
    Error,
    InputError,
    InternalError,
    InvalidSolid,
    LimitError,
    UnsupportedError,
    UsageError,
)
from ._trisect import (
    BodyId,
    Contact,
    DefectKind,
    Distance,
    EntityKind,
    EntityName,
    Finding,
    FirstContact,
    Formula,
    Interference,
    Joint,
    Location,
    Motion,
    Nearest,
    Place,
    PlaneRelation,
    Pose,
    RayHit,
    Relation,
    Report,
    Rounding,
    Scene,
    ScenePair,
    Severity,
    Solid,
    Verdict,
    VerifyReport,
    VerifyWitness,
    Witness,
    __version__,
    are_nearer_than,
    check,
    difference,
    distance,
    evaluate,
    exact_squared_distance,
    first_contact,
    interfere,
    intersection,
    limits,
    read_mesh,
    union,
    verify,
    write_mesh,
)

__all__ = [
    "BodyId",
    "CancelledError",
    "Contact",
    "DefectKind",
    "Distance",
    "EntityKind",
    "EntityName",
    "Error",
    "Finding",
    "FirstContact",
    "Formula",
    "InputError",
    "Interference",
    "InternalError",
    "InvalidSolid",
    "Joint",
    "LimitError",
    "Location",
    "Motion",
    "Nearest",
    "Place",
    "PlaneRelation",
    "Pose",
    "RayHit",
    "Relation",
    "Report",
    "Rounding",
    "Scene",
    "ScenePair",
    "Severity",
    "Solid",
    "UnsupportedError",
    "UsageError",
    "Verdict",
    "VerifyReport",
    "VerifyWitness",
    "Witness",
    "__version__",
    "are_nearer_than",
    "check",
    "difference",
    "distance",
    "evaluate",
    "exact_squared_distance",
    "first_contact",
    "interfere",
    "intersection",
    "limits",
    "read_mesh",
    "union",
    "verify",
    "write_mesh",
]

# Classes are found by copy, pickle and help() where they are imported from.
for _name in __all__:
    _object = globals()[_name]
    if isinstance(_object, type):
        _object.__module__ = "trisect"
del _name, _object

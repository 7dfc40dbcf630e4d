# SPDX-License-Identifier: Apache-2.0
"""Adapters, against modules that have what is used of trimesh and meshio and nothing else."""
import sys
import types

import numpy as np
import pytest

import trisect
import trisect.meshio
import trisect.trimesh
from conftest import CUBE_QUADS, CUBE_TRIANGLES, CUBE_VERTICES


class Trimesh:
    def __init__(self, vertices=None, faces=None, process=True, **kwargs):
        self.vertices = np.asarray(vertices)
        self.faces = np.asarray(faces)
        self.process = process
        self.kwargs = kwargs


@pytest.fixture
def trimesh(monkeypatch):
    module = types.ModuleType("trimesh")
    module.Trimesh = Trimesh
    module.boolean = types.SimpleNamespace(_engines={None: "theirs"}, engines_available={"theirs"})
    monkeypatch.setitem(sys.modules, "trimesh", module)
    return module


def two_meshes():
    return Trimesh(CUBE_VERTICES, CUBE_TRIANGLES), Trimesh(CUBE_VERTICES + 0.5, CUBE_TRIANGLES)


@pytest.mark.parametrize(
    "operation, volume", [("union", 1.875), ("intersection", 0.125), ("difference", 0.875)]
)
def test_engine_of_trimesh(trimesh, operation, volume):
    trisect.trimesh.register()
    engine = trimesh.boolean._engines["trisect"]
    result = engine(list(two_meshes()), operation=operation, check_volume=True)
    assert isinstance(result, Trimesh) and not result.process
    assert trisect.Solid(result.vertices, result.faces).volume == volume
    assert trimesh.boolean._engines[None] == "theirs"
    assert "trisect" in trimesh.boolean.engines_available


def test_engine_of_trimesh_by_default(trimesh):
    trisect.trimesh.register(default=True)
    assert trimesh.boolean._engines[None] is trisect.trimesh.boolean


def test_engine_of_trimesh_keeps_doubles(trimesh):
    a, b = two_meshes()
    a.vertices = a.vertices + 1e-9
    result = trisect.trimesh.boolean([a, b], "union")
    assert {tuple(p) for p in result.vertices} >= {tuple(a.vertices[0])}


def test_engine_of_trimesh_names_the_mesh_that_is_wrong(trimesh):
    a, b = two_meshes()
    b.faces = b.faces[:, ::-1]
    with pytest.raises(trisect.InvalidSolid, match="mesh 1: .*inside out"):
        trisect.trimesh.boolean([a, b], "difference")
    with pytest.raises(trisect.UsageError, match="operation"):
        trisect.trimesh.boolean([a, b], "sum")
    with pytest.raises(trisect.UsageError, match="there is none"):
        trisect.trimesh.boolean([], "union")


def test_a_trimesh_without_a_table_of_engines(trimesh):
    trimesh.boolean = types.SimpleNamespace()
    with pytest.raises(trisect.UnsupportedError):
        trisect.trimesh.register()


def block(kind, data):
    return types.SimpleNamespace(type=kind, data=np.asarray(data))


class Mesh:
    def __init__(self, points, cells, cell_data=None):
        self.points = points
        self.cells = [block(kind, data) for kind, data in cells]
        self.cell_data = cell_data


def test_solids_of_meshio():
    all_triangles = Mesh(CUBE_VERTICES, [("triangle", CUBE_TRIANGLES)])
    assert trisect.meshio.to_solid(all_triangles).volume == 1
    halves = Mesh(
        CUBE_VERTICES,
        [("vertex", [[0]]), ("triangle", CUBE_TRIANGLES[:6]), ("triangle", CUBE_TRIANGLES[6:])],
    )
    assert trisect.meshio.to_solid(halves).volume == 1
    mixed = Mesh(
        CUBE_VERTICES,
        [("quad", CUBE_QUADS[:2]), ("triangle", CUBE_TRIANGLES[[2, 3, 4, 5, 8, 9, 10, 11]])],
    )
    assert trisect.meshio.to_solid(mixed).volume == 1
    with pytest.raises(trisect.UnsupportedError, match="tetra"):
        trisect.meshio.to_solid(Mesh(CUBE_VERTICES, [("tetra", [[0, 1, 2, 4]])]))


def test_meshes_for_meshio(monkeypatch, cube):
    monkeypatch.setitem(sys.modules, "meshio", types.SimpleNamespace(Mesh=Mesh))
    mesh = trisect.meshio.from_solid(cube)
    assert mesh.cells[0].type == "triangle" and mesh.cells[0].data.shape == (12, 3)
    named = trisect.meshio.from_solid(cube, sources=True)
    assert set(named.cell_data["operand"][0]) == {cube.source_id}


def test_files_of_meshio_itself(tmp_path, cube):
    """Where meshio is installed: written by it, read by us, and the other way round."""
    meshio = pytest.importorskip("meshio")
    trisect.meshio.from_solid(cube).write(tmp_path / "cube.vtk")
    again = trisect.meshio.to_solid(meshio.read(tmp_path / "cube.vtk"))
    assert again.equals(cube)
    cube.write(tmp_path / "cube.off")
    assert trisect.meshio.to_solid(meshio.read(tmp_path / "cube.off")).equals(cube)


def test_arrays_of_scipy():
    """Hulls as points, rotations as matrices, where scipy is installed."""
    spatial = pytest.importorskip("scipy.spatial")
    points = np.random.default_rng(1).normal(size=(40, 3))
    hull = spatial.ConvexHull(points)
    solid = trisect.Solid.hull(hull.points[hull.vertices])
    assert abs(solid.volume - hull.volume) < 1e-12 and solid.vertex_count == len(hull.vertices)
    # Its triangles have no common orientation; the planes say which side is out.
    faces = hull.simplices.copy()
    corners = points[faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    inward = (normals * hull.equations[:, :3]).sum(axis=1) < 0
    faces[inward] = faces[inward][:, ::-1]
    assert trisect.Solid(hull.points, faces).equals(solid)
    turn = np.eye(4)
    turn[:3, :3] = spatial.transform.Rotation.from_euler("z", 90, degrees=True).as_matrix().round()
    assert solid.transform(turn).equals(solid.rotate("z", 90))


@pytest.mark.parametrize("kind", [np.int32, np.int64, np.uint32])
def test_arrays_of_columns(kind):
    """As of Eigen, whose matrices are stored column by column."""
    vertices = np.asfortranarray(CUBE_VERTICES)
    faces = np.asfortranarray(CUBE_TRIANGLES.astype(kind))
    assert trisect.Solid(vertices, faces).volume == 1
    assert trisect.Solid(vertices.astype(np.float32), faces).volume == 1


def test_objects_with_vertices_and_faces():
    mesh = two_meshes()[0]
    assert trisect.check(mesh).is_solid
    assert trisect.verify("union", [mesh], mesh).verdict == trisect.Verdict.EQUAL

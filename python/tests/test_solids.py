# SPDX-License-Identifier: Apache-2.0
"""Booleans, measures, transforms, parts and copies of solids."""
import copy
import json
import pickle
from fractions import Fraction

import numpy as np
import pytest

import trisect
from trisect import Formula, Solid


def test_operators(two_boxes):
    a, b = two_boxes
    assert (a | b).volume == 15
    assert (a & b).volume == 1
    assert (a - b).volume == 7
    assert (a ^ b).volume == 14
    assert (~a & b).volume == 7
    assert (~~a).equals(a)


def test_operators_with_something_else(cube):
    with pytest.raises(TypeError, match="unsupported operand"):
        cube | 3
    with pytest.raises(TypeError, match="unsupported operand"):
        "x" - cube


def test_many_operands_in_one_pass():
    boxes = [Solid.box((i, 0, 0), (i + 2, 1, 1)) for i in range(10)]
    assert trisect.union(boxes).volume == 11
    assert trisect.union(iter(boxes)).volume == 11
    assert trisect.intersection(boxes[:2]).volume == 1
    assert trisect.difference(boxes[0], boxes[1:]).volume == 1
    assert trisect.union([]).is_empty
    assert trisect.intersection([]).is_whole_space
    assert trisect.difference(boxes[0], []).equals(boxes[0])
    with pytest.raises(TypeError, match="union: operand 1: must be a Solid or a Formula, not int"):
        trisect.union([boxes[0], 7])


def test_formulas_are_evaluated_at_once(two_boxes):
    a, b = two_boxes
    c = Solid.box((0, 0, 0), (1, 1, 1))
    formula = Formula(a) - b | c
    assert trisect.evaluate(formula).volume == 7
    assert trisect.evaluate(a - Formula(b)).volume == 7
    assert trisect.evaluate(~Formula(a) & b).volume == 7
    assert trisect.evaluate(a ^ Formula(b)).equals(a ^ b)
    with pytest.raises(trisect.UsageError, match="winding"):
        trisect.evaluate(a, winding="odd")


def test_measures():
    a = Solid.box((0, 0, 0), (1, 2, 3))
    assert a.volume == 6 and a.exact_volume() == Fraction(6)
    assert isinstance(a.exact_volume(), Fraction)
    assert a.area == 22 and a.exact_area() == 22
    assert (a.centroid == (0.5, 1, 1.5)).all()
    assert a.exact_centroid() == (Fraction(1, 2), 1, Fraction(3, 2))
    assert (a.bounds == [(0, 0, 0), (1, 2, 3)]).all()
    assert (a.vertex_count, a.triangle_count) == (8, 12)
    assert Solid.sphere(1).exact_area() is None


def test_measures_of_nothing_and_everything():
    empty = Solid()
    assert empty.is_empty and empty.volume == 0 and empty.centroid is None and empty.bounds is None
    with pytest.raises(trisect.UnsupportedError):
        Solid.half_space((0, 0, 1, 0)).volume
    assert Solid.whole_space().is_whole_space
    with pytest.raises(trisect.UnsupportedError):
        Solid.whole_space().mesh()


def test_fractions_of_any_length():
    a = Solid.sphere(1.1, 3)
    b = a.rotate((1, 2, 3), 37.0).translate((0.3, 0.2, 0.1))
    volume = (a | b).exact_volume()
    # Python itself refuses to print so long a number; nothing of ours may do so on the way.
    assert volume.denominator > 10**5000
    assert float(volume) == (a | b).volume
    assert (a | b).exact_volume() + (a & b).exact_volume() == a.exact_volume() + b.exact_volume()


def test_exact_transforms(cube):
    moved = cube.translate((0.5, 0, -3))
    assert (moved.bounds == [(0.5, 0, -3), (1.5, 1, -2)]).all()
    turned, rounding = cube.transform(trisect.Pose.rotation_near((0, 0, 1), 90), report=True)
    assert rounding.lossless and rounding.moved == 0 and rounding.max_move == 0
    assert turned.equals(cube.translate((-1, 0, 0)))
    assert cube.rotate("z", 90).equals(turned)
    assert cube.rotate((0, 0, 1), -270).equals(turned)
    assert cube.mirror("x").equals(cube.translate((-1, 0, 0)))
    assert cube.scale(3).volume == 27
    assert cube.scale(np.float32(2)).volume == cube.scale(np.int64(2)).volume == 8
    assert cube.scale((1, 2, 3)).volume == 6


def test_rounded_transforms_are_reported():
    ball = Solid.sphere(1, 2)
    turned, rounding = ball.transform(trisect.Pose.rotation_near((1, 2, 3), 10), report=True)
    assert not rounding.lossless and 0 < rounding.max_move < 1e-15
    assert abs(turned.volume - ball.volume) < 1e-12


@pytest.mark.parametrize(
    "matrix, message",
    [
        (np.eye(2), r"map: must have the shape"),
        (np.zeros((3, 3)), "singular"),
        (np.diag([1, 1, 1, 2]), "last row"),
        (np.full((3, 4), np.nan), "finite"),
    ],
)
def test_refused_transforms(cube, matrix, message):
    with pytest.raises(trisect.UsageError, match=message):
        cube.transform(matrix)


def test_refused_arguments(cube):
    with pytest.raises(trisect.UsageError, match="by: must be 3 numbers"):
        cube.translate((1, 2))
    with pytest.raises(trisect.UsageError, match="axis"):
        cube.mirror("w")
    with pytest.raises(trisect.UsageError, match="embedding"):
        Solid([], [], embedding="maybe")
    with pytest.raises(trisect.UsageError):
        Solid.cylinder(-1, 1)
    with pytest.raises(TypeError):
        Solid.cylinder("wide", 1)


def test_primitives():
    assert Solid.box((1, 2, 3)).volume == 6
    assert abs(Solid.cylinder(1, 1, 1000).volume - np.pi) < 1e-4
    assert abs(Solid.cone(1, 0, 1, 1000).volume - np.pi / 3) < 1e-4
    assert abs(Solid.sphere(1, 5).volume - 4 / 3 * np.pi) < 1e-2
    assert abs(Solid.uv_sphere(1, 200, 100).volume - 4 / 3 * np.pi) < 1e-2
    assert abs(Solid.torus(2, 1, 200, 100).volume - 4 * np.pi**2) < 0.1
    square = [(0, 0), (3, 0), (3, 3), (0, 3)]
    hole = [(1, 1), (2, 1), (2, 2), (1, 2)]
    assert Solid.extrude(square, 0, 2, holes=[hole]).volume == 16


def test_components_and_split():
    bar = Solid.box((0, 0, 0), (4, 1, 1))
    cutter = Solid.box((1, -1, -1), (2, 2, 2))
    inside, outside = bar.split(cutter)
    assert (inside.volume, outside.volume) == (1, 3)
    parts = outside.components()
    assert sorted(p.volume for p in parts) == [1, 2]
    below, above = bar.split((1, 0, 0, -3))
    assert (below.volume, above.volume) == (3, 1)
    assert (below | above).equals(bar)
    assert (below & above).is_empty
    slabs = bar.split_by_planes([(1, 0, 0, -0.5), (1, 0, 0, -3)])
    assert [s.volume for s in slabs] == [0.5, 2.5, 1]
    assert [s.volume for s in bar.split_by_planes([])] == [4]
    with pytest.raises(trisect.UsageError):
        bar.split_by_planes([(0, 0, 0, 1)])
    with pytest.raises(trisect.UsageError):
        bar.split_by_planes([(0, 0, 1)])


def test_solids_made_of_solids():
    cube = Solid.box((0, 0, 0), (1, 1, 1))
    far = cube.translate((3, 0, 0))
    assert cube.convex_hull(far).volume == 4
    assert cube.minkowski_sum(cube).volume == 8
    assert (cube | far).minkowski_sum(cube).volume == 16
    assert cube.scale(3).minkowski_difference(cube).volume == 8
    frame = Solid.box((0, 0, 0), (4, 4, 1)) - Solid.box((1, 1, -1), (3, 3, 2))
    assert frame.project().volume == 12
    assert frame.project(cut=0.5).volume == 12
    assert frame.offset(0.5, corners="miter").volume == 25 - 1
    with pytest.raises(trisect.UsageError, match="corners"):
        frame.offset(1, corners="none")


def test_programs_of_openscad(tmp_path):
    assert Solid.from_csg("cube(size = 2); cube(size = [3, 1, 1]);").volume == 9
    Solid.box((0, 0, 0), (1, 1, 1)).write(tmp_path / "a.off")
    program = 'import(file = "a.off");'
    assert Solid.from_csg(program, folder=str(tmp_path)).volume == 1
    with pytest.raises(trisect.UnsupportedError):
        Solid.from_csg(program)
    nodes = [{"node": "cube", "arguments": {"size": [1, 2, 3]}}]
    assert Solid.from_csg(json.dumps({"nodes": nodes}), format="json").volume == 6
    with pytest.raises(trisect.InputError):
        Solid.from_csg("cube();", format="json")
    with pytest.raises(ValueError):
        Solid.from_csg("cube();", format="scad")


def test_embedding_of_a_mesh_that_meets_itself():
    # Two cubes that overlap, as one mesh.
    v, f = Solid.box((0, 0, 0), (2, 2, 2)).mesh()
    both = np.concatenate([v, v + 1]), np.concatenate([f, f + len(v)])
    for embedding in ("check", "resolve"):
        solid = Solid(*both, embedding=embedding)
        assert solid.volume == 15


def test_inside_out_meshes():
    v, f = Solid.box((0, 0, 0), (1, 1, 1)).mesh()
    with pytest.raises(trisect.InvalidSolid, match="inside out"):
        Solid(v, f[:, ::-1])
    solid = Solid(v, f[:, ::-1], inside_out=True, embedding="resolve")
    assert trisect.evaluate(solid, winding="nonzero").volume == 1


def test_open_meshes_are_refused_with_places():
    v, f = Solid.box((0, 0, 0), (1, 1, 1)).mesh()
    with pytest.raises(trisect.InvalidSolid, match="open_edge.*edge from vertex") as caught:
        Solid(v, f[1:])
    report = caught.value.report
    assert report.count(trisect.DefectKind.OPEN_EDGE) == 3
    assert not report.is_solid
    finding = report.findings[0]
    assert finding.kind == trisect.DefectKind.OPEN_EDGE
    assert finding.severity == trisect.Severity.ERROR
    assert len(finding.vertices) == 2
    assert (finding.place == v[finding.vertices[0]]).all()


def test_copies(two_boxes):
    a, b = two_boxes
    part = a - b
    assert copy.copy(part).equals(part)
    assert copy.deepcopy([part])[0].equals(part)


@pytest.mark.parametrize(
    "make",
    [
        Solid,
        Solid.whole_space,
        lambda: Solid.box((0.1, 0.2, 0.3), (1.1, 1.2, 1.3)),
        lambda: Solid.sphere(1, 2) - Solid.sphere(1, 2).rotate((1, 2, 3), 20).translate((0.5, 0, 0)),
        lambda: ~Solid.box((0, 0, 0), (1, 1, 1)),
        lambda: Solid.half_space((0, 0, 1, 0)),
        lambda: Solid.half_space((0, 0, 1, 0)) - Solid.sphere(1, 2),
    ],
)
def test_pickles_hold_the_same_set_exactly(make):
    solid = make()
    again = pickle.loads(pickle.dumps(solid))
    assert again.equals(solid)
    assert again.is_empty == solid.is_empty and again.is_whole_space == solid.is_whole_space


def test_pickles_keep_tree_and_names(two_boxes):
    a, b = two_boxes
    again = pickle.loads(pickle.dumps(a - b))
    assert again.to_bytes() != (a - b).to_bytes()  # operands have numbers of their own
    before, after = (solid.mesh(sources=True) for solid in (a - b, again))
    assert all((x == y).all() for x, y in zip(before[:2], after[:2]))
    assert (before[2][:, 1] == after[2][:, 1]).all()
    operands = np.unique(after[2][:, 0])
    assert len(operands) == 2 and not set(operands) & {a.source_id, b.source_id}
    assert pickle.loads(pickle.dumps(a)).source_id not in (0, a.source_id)


def test_bytes_of_solids(tmp_path, two_boxes):
    part = two_boxes[0] - two_boxes[1]
    data = part.to_bytes()
    assert Solid.from_bytes(data).equals(part)
    part.write(tmp_path / "part.trisect")
    assert (tmp_path / "part.trisect").read_bytes() == data
    assert Solid.read(tmp_path / "part.trisect").equals(part)
    part.write(tmp_path / "part.bin", format="trisect")
    assert Solid.read(tmp_path / "part.bin", format="trisect").equals(part)
    with pytest.raises(trisect.InputError, match="bytes of a solid"):
        Solid.from_bytes(data[:-1])
    with pytest.raises(trisect.InputError, match="bytes of a solid"):
        Solid.from_bytes(b"nonsense")
    with pytest.raises(trisect.InputError, match="part.off"):
        part.write(tmp_path / "part.off")
        Solid.read(tmp_path / "part.off", format="trisect")
    with pytest.raises(trisect.UnsupportedError):
        Solid.half_space((0, 0, 1, 0)).exact_text()


def test_exact_text(two_boxes):
    part = two_boxes[0] - two_boxes[1]
    assert Solid.from_exact_text(part.exact_text()).equals(part)
    with pytest.raises(trisect.InputError, match="exact text:1"):
        Solid.from_exact_text("nonsense")


def test_repr(cube):
    assert repr(cube) == "<trisect.Solid: 8 vertices, 12 triangles>"
    assert repr(Solid()) == "<trisect.Solid: empty>"
    assert repr(Solid.whole_space()) == "<trisect.Solid: all of space>"
    assert repr(Solid.half_space((0, 0, 1, 0))) == "<trisect.Solid: unbounded>"
    assert Solid.__module__ == "trisect"


def test_files(tmp_path, two_boxes):
    part = two_boxes[0] - two_boxes[1]
    for name in ("part.obj", "part.stl", "part.off", "part.ply", "part.step"):
        part.write(tmp_path / name)
        assert Solid.read(tmp_path / name).equals(part)
    vertices, faces = trisect.read_mesh(str(tmp_path / "part.off"))
    assert Solid(vertices, faces).equals(part)
    trisect.write_mesh(tmp_path / "again.obj", vertices, faces)
    assert Solid.read(tmp_path / "again.obj").equals(part)
    (tmp_path / "bad.off").write_text("OFF\n3 1 0\n0 0 0\n1 0 zero\n0 1 0\n3 0 1 2\n")
    with pytest.raises(trisect.InputError, match="bad.off:4:5"):
        Solid.read(tmp_path / "bad.off")
    with pytest.raises(trisect.InputError, match="missing.stl"):
        Solid.read(tmp_path / "missing.stl")
    with pytest.raises(trisect.UsageError, match="format"):
        part.write(tmp_path / "part.igs", format="igs")


def test_hulls():
    box = Solid.box((1, 2, 3))
    inside = [(0.5, 0.5, 0.5), (0.5, 0, 0), (1, 2, 3)]
    assert Solid.hull(np.concatenate([box.mesh()[0], inside])).equals(box)
    ball = Solid.sphere(1, 2)
    assert Solid.hull(ball.mesh()[0]).equals(ball)
    torus = Solid.torus(2, 1, 16, 8)
    hull = Solid.hull(torus.mesh()[0])
    assert (torus - hull).is_empty and hull.volume > torus.volume
    # What a box sweeps over.
    corners = box.mesh()[0]
    swept = Solid.hull(np.concatenate([corners, corners + (4, 0, 0)]))
    assert swept.equals(Solid.box((5, 2, 3)))
    with pytest.raises(trisect.UsageError, match="not in one plane"):
        Solid.hull([(0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 0)])
    with pytest.raises(trisect.UsageError, match="vertex 1 .*finite"):
        Solid.hull([(0, 0, 0), (np.nan, 0, 0), (0, 1, 0), (1, 1, 1)])
    with pytest.raises(trisect.UsageError, match="points: must have the shape"):
        Solid.hull([(0, 0), (1, 1)])


def test_edited_formula_evaluates_near_what_changed():
    plate = Solid.box((0, 0, 0), (40, 40, 2))
    holes = [
        Solid.cylinder(1, 4, segments=12).translate((5 + 6 * i, 5, -1)) for i in range(5)
    ]
    edited = trisect.EditedFormula()
    first = edited.evaluate(plate - Formula(holes[0]) - holes[1] - holes[2])
    assert edited.evaluated_all and edited.box is None
    second = edited.evaluate(plate - Formula(holes[0]) - holes[3] - holes[2])
    assert second.equals(plate - holes[0] - holes[3] - holes[2])
    assert first.equals(plate - holes[0] - holes[1] - holes[2])
    assert not edited.evaluated_all
    assert edited.changed_operands == 2
    low, high = edited.box
    assert low[0] <= 10 and high[0] >= 24 and high[0] < 30
    with pytest.raises(TypeError, match="evaluate: must be a Solid or a Formula, not int"):
        edited.evaluate(3)

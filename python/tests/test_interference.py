# SPDX-License-Identifier: Apache-2.0
"""Relations, distances, first contact and scenes of placed solids."""
import copy
import pickle
from fractions import Fraction

import numpy as np
import pytest

import trisect
from trisect import Joint, Motion, Pose, Relation, Scene, Solid


def shift(x, y=0, z=0):
    return np.array([(1, 0, 0, x), (0, 1, 0, y), (0, 0, 1, z)], dtype=float)


def test_relations(cube):
    assert trisect.interfere(cube, None, cube, None).relation == Relation.EQUAL
    assert trisect.interfere(cube, None, cube, shift(1)).relation == Relation.TOUCHING
    assert str(Relation.TOUCHING) == "Relation.TOUCHING"
    assert trisect.interfere(cube, None, cube, shift(0.5)).relation == Relation.OVERLAPPING
    assert trisect.interfere(cube, None, cube, shift(2)).relation == Relation.DISJOINT
    half = np.diag([0.5, 0.5, 0.5, 1])
    assert trisect.interfere(cube, half, cube, None).relation == Relation.INSIDE
    assert trisect.interfere(cube, None, cube, half).relation == Relation.CONTAINS


def test_contacts_name_faces_of_operands():
    cube = Solid.box((0, 0, 0), (1, 1, 1))
    found = trisect.interfere(cube, None, cube, shift(1), contacts=True)
    areas = [c for c in found.contacts if c.dimension == 2]
    assert len(areas) == 1 and areas[0].opposite
    assert areas[0].a.kind == trisect.EntityKind.FACE
    assert areas[0].a.faces[0][0] == cube.source_id
    assert trisect.interfere(cube, None, cube, shift(1)).contacts == []


def test_poses():
    quarter = Pose.from_quaternion((1, 0, 0, 1))
    assert quarter @ quarter @ quarter @ quarter == Pose()
    assert quarter * quarter.inverse() == Pose()
    assert hash(quarter @ quarter.inverse()) == hash(Pose())
    assert np.allclose(quarter.matrix() @ (1, 0, 0, 1), (0, 1, 0, 1))
    assert Pose.rotation_near((0, 0, 1), 90) == quarter
    assert Pose.from_matrix(np.diag([1, 1, -1])).is_mirror
    assert Pose.from_translation((1, 2, 3)) == Pose.from_matrix(shift(1, 2, 3))
    with pytest.raises(trisect.UsageError, match="matrix: must have the shape"):
        Pose.from_matrix(np.eye(5))
    with pytest.raises(trisect.UsageError):
        Pose.from_quaternion((0, 0, 0, 0))
    with pytest.raises(trisect.UsageError, match="pose_a: .*singular"):
        trisect.interfere(Solid(), np.zeros((3, 4)), Solid(), None)
    with pytest.raises(trisect.UsageError, match="map: must have the shape"):
        Solid.box((1, 1, 1)).transform(np.eye(5))
    with pytest.raises(TypeError, match="pose_b"):
        trisect.interfere(Solid(), None, Solid(), "somewhere")


def test_poses_as_fractions_and_pickles():
    turn = Pose.from_quaternion((2, 0, 0, 1), (0.25, 0, -1e-9))
    (a, b, c, x), (d, *_), (*_, z) = turn.exact_matrix()
    assert (a, b, c, d) == (Fraction(3, 5), Fraction(-4, 5), 0, Fraction(4, 5))
    assert x == 0.25 and z == Fraction(-1e-9)
    for pose in (Pose(), turn, turn @ turn @ turn, Pose.from_matrix(np.diag([1e-30, -1, 3e20]))):
        assert pickle.loads(pickle.dumps(pose)) == pose and copy.deepcopy(pose) == pose


def test_distances(cube):
    d = trisect.distance(cube, None, cube, shift(3))
    assert d.lower <= 2 <= d.upper and d.upper - d.lower < 1e-12
    assert trisect.exact_squared_distance(cube, None, cube, shift(3, 3)) == 8
    assert trisect.are_nearer_than(cube, None, cube, shift(3), 2.0001)
    assert not trisect.are_nearer_than(cube, None, cube, shift(3), 2)
    assert trisect.distance(cube, None, Solid(), None) is None
    with pytest.raises(trisect.UsageError):
        trisect.are_nearer_than(cube, None, cube, None, -1)
    with pytest.raises(trisect.UnsupportedError):
        trisect.interfere(cube, None, Solid.half_space((0, 0, 1, 0)), None)


def test_first_contact(cube):
    fall = Motion.translation(shift(0, 0, 3), (0, 0, -4))
    contact = trisect.first_contact(cube, Motion(), cube, fall)
    assert contact and contact.time == 0.5 and contact.at_start == Relation.DISJOINT
    assert contact.exact_time() == (Fraction(1, 2), Fraction(1, 2))
    assert len(contact.witnesses) > 0
    past = Motion.translation(shift(5), (0, 0, 9))
    none = trisect.first_contact(cube, Motion(), cube, past)
    assert not none and none.time is None and none.exact_time() is None
    slide = Motion.translation(shift(-3, 0, 1), (6, 0, 0))
    assert trisect.first_contact(cube, Motion(), cube, slide).time == pytest.approx(1 / 3)
    assert not trisect.first_contact(cube, Motion(), cube, slide, event="overlap")
    with pytest.raises(trisect.UsageError, match="event"):
        trisect.first_contact(cube, Motion(), cube, slide, event="crash")


def test_a_turn_meets_at_an_irrational_time(cube):
    turn = Motion.screw(shift(1.25), (1, 0, 0, 1))
    wall = Solid.box((-5, 1.5, -5), (5, 2, 5))
    contact = trisect.first_contact(wall, Motion(), cube, turn)
    low, high = contact.exact_time(Fraction(1, 10**30))
    assert low < high and high - low <= Fraction(1, 10**30)
    assert abs(float(low) - contact.time) < 1e-15


def test_motions():
    motion = Motion.translation(None, (1, 0, 0)).then(Motion.blend(shift(1), shift(1, 5)))
    assert motion.piece_count == 2
    assert motion.pose_at(Fraction(1, 2)) == Pose.from_translation((0.5, 0, 0))
    assert motion.pose_at(2) == Pose.from_translation((1, 5, 0))
    assert Motion.through([None, shift(1), shift(2)]).piece_count == 2
    with pytest.raises(trisect.UsageError):
        motion.pose_at(3)
    with pytest.raises(TypeError, match="parameter"):
        motion.pose_at("late")


def test_scenes(cube):
    scene = Scene()
    bodies = [scene.add(cube, shift(2 * i)) for i in range(4)]
    assert len(scene) == 4 and bodies[2] in scene and scene.bodies() == bodies
    assert scene.interfering() == []
    scene.set_pose(bodies[1], shift(1))
    (pair,) = [p for p in scene.interfering(contacts=True) if p.a == bodies[0]]
    assert pair.b == bodies[1] and pair.relation == Relation.TOUCHING and pair.contacts
    assert scene.pose(bodies[1]) == Pose.from_translation((1, 0, 0))
    scene.replace(bodies[0], Solid())
    assert all(bodies[0] not in (p.a, p.b) for p in scene.interfering())
    assert scene.solid(bodies[0]).is_empty
    scene.ignore(bodies[1], bodies[2])
    assert scene.interfering() == []
    scene.remove(bodies[3])
    assert bodies[3] not in scene
    with pytest.raises(trisect.UsageError):
        scene.set_pose(bodies[3], None)


def test_links(cube):
    scene = Scene()
    base = scene.add(cube)
    arm = scene.add_link(base, cube, Joint.revolute((0, 0, 0), (0, 0, 1)), mount=shift(2))
    assert scene.pose(arm) == Pose.from_translation((2, 0, 0))
    scene.set_joint(arm, 1)
    assert scene.pose(arm) == Pose.from_translation((2, 0, 0)) @ Pose.from_quaternion((1, 0, 0, 1))
    scene.set_joint(arm, Fraction(1, 3))
    scene.set_joint(arm, Joint.revolute((0, 0, 0), (0, 0, 1)).value_near(45))
    with pytest.raises(trisect.UsageError):
        scene.set_pose(arm, None)

# SPDX-License-Identifier: Apache-2.0
"""Shapes of FCL between two solids: one within the shape, one around it.

FCL's shapes stand about the origin: a box with its sides, a ball, an ellipsoid with its half axes, a capsule, a cylinder and a
cone along z with radius and height, and half-spaces and planes with a normal and an offset. Corners within lie on the shape or, by
a rounding, inside; a solid around is that one scaled until all of its faces are outside, and cut off by the shape's box. Both have
the shape's points on the axes, so what touches along an axis is decided.
"""
import functools
import itertools
import math

import numpy
import trisect
from trisect import Pose, Relation, Solid

HALF_SPACE_SIZE = 4096.0
ROUND_STEPS = 16
INWARDS = 1 - 8 * 2.0**-53
OUTWARDS = 1 + 1e-12


class Undecided(Exception):
    """Neither solid proves an answer."""


class Shape:
    """KIND of FCL with its parameters: lengths, or a normal and an offset."""

    def __init__(self, kind, parameters):
        self.kind, self.parameters = kind, tuple(parameters)

    def key(self):
        return self.kind, self.parameters


def ball_points():
    """Corners on the unit ball, within it by a rounding, and on its axes exactly; and how far its faces come to the centre."""
    n, points = ROUND_STEPS, set()
    for signs in itertools.product((1, -1), repeat=3):
        for i in range(n + 1):
            for j in range(n + 1 - i):
                p = numpy.array([i, j, n - i - j]) * signs
                points.add(tuple(float(c) for c in p / math.sqrt(float(p @ p)) * (1.0 if n in abs(p) else INWARDS)))
    points = numpy.array(sorted(points)) + 0.0
    vertices, faces = Solid.hull(points).mesh()
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    normals = numpy.cross(b - a, c - a)
    depths = numpy.einsum('ij,ij->i', normals, a) / numpy.linalg.norm(normals, axis=1)
    return points, float(depths.min())


@functools.lru_cache(maxsize=None)
def ball():
    return ball_points()


def circle_points(steps=64):
    angles = [2 * math.pi * i / steps for i in range(steps)]
    points = [[math.cos(t) * INWARDS, math.sin(t) * INWARDS] for t in angles]
    for i, p in enumerate(((1, 0), (0, 1), (-1, 0), (0, -1))):
        points[i * steps // 4] = [float(c) for c in p]
    return numpy.array(points), math.cos(math.pi / steps) * INWARDS


def axis_box(half):
    return Solid.box([-float(h) for h in half], [float(h) for h in half])


def round_pair(half_axes, shift=0.0):
    """An ellipsoid, or its hull with itself moved along z by shift up and down."""
    points, depth = ball()
    half = numpy.array(half_axes, dtype=float)
    ends = [numpy.array([0, 0, s]) for s in ((shift, -shift) if shift else (0.0,))]
    inner = Solid.hull(numpy.concatenate([points * half + e for e in ends]))
    wide = Solid.hull(numpy.concatenate([points * half * (OUTWARDS / depth) + e for e in ends]))
    return inner, trisect.intersection([wide, axis_box(half + [0, 0, shift])])


def prism_pair(radius, height, is_cone):
    ring, depth = circle_points()

    def hull(scale):
        low = [[x * radius * scale, y * radius * scale, -height / 2] for x, y in ring]
        high = [[0, 0, height / 2]] if is_cone else [[x, y, height / 2] for x, y, _ in low]
        return Solid.hull(numpy.array(low + high))

    return hull(1.0), trisect.intersection([hull(OUTWARDS / depth), axis_box([radius, radius, height / 2])])


def half_space_pair(normal, offset):
    """{x: normal . x <= offset} within a large box, for normals along an axis; all of it without a normal."""
    low, high = [-HALF_SPACE_SIZE] * 3, [HALF_SPACE_SIZE] * 3
    for axis in range(3):
        if normal[axis]:
            (high if normal[axis] > 0 else low)[axis] = offset / normal[axis]
    solid = Solid.box(low, high)
    return solid, solid


@functools.lru_cache(maxsize=None)
def solids_of(key):
    """The solid within and the one around; of a plane those of both sides."""
    kind, p = key
    if kind == 'Box':
        solid = axis_box([c / 2 for c in p])
        return [(solid, solid)]
    if kind == 'Sphere':
        return [round_pair([p[0]] * 3)]
    if kind == 'Ellipsoid':
        return [round_pair(p)]
    if kind == 'Capsule':
        return [round_pair([p[0]] * 3, p[1] / 2)]
    if kind in ('Cylinder', 'Cone'):
        return [prism_pair(p[0], p[1], kind == 'Cone')]
    if kind == 'Halfspace':
        return [half_space_pair(p[:3], p[3])]
    return [half_space_pair(p[:3], p[3]), half_space_pair([-c for c in p[:3]], -p[3])]


def meet_solids(a, pose_a, b, pose_b):
    if trisect.interfere(a[0], pose_a, b[0], pose_b).relation != Relation.DISJOINT:
        return True
    if trisect.interfere(a[1], pose_a, b[1], pose_b).relation == Relation.DISJOINT:
        return False
    raise Undecided


def meet(a, pose_a, b, pose_b):
    """Whether closed shapes have a point in common. A shape meets a plane where it meets both of its sides."""
    answers, undecided = [], False
    for x in solids_of(a.key()):
        for y in solids_of(b.key()):
            try:
                answers.append(meet_solids(x, pose_a, y, pose_b))
            except Undecided:
                undecided = True
    if not all(answers):
        return False
    if undecided:
        raise Undecided
    return True


def distance_interval(a, pose_a, b, pose_b):
    (x,), (y,) = solids_of(a.key()), solids_of(b.key())
    low = trisect.distance(x[1], pose_a, y[1], pose_b).lower
    high = trisect.distance(x[0], pose_a, y[0], pose_b).upper
    return low, high


def turned_pose(by=(3.25, 7.5, 1.125)):
    """A turn with rational entries about no axis of the frame, and a move: FCL's random transform."""
    return Pose.from_quaternion([7, 2, -3, 5], by)

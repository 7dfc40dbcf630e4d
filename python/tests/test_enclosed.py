# SPDX-License-Identifier: Apache-2.0
"""Motions that no rational formula describes, and what is left of Motion."""
import math
from fractions import Fraction

import numpy as np
import pytest

import trisect
from trisect import ContactOutcome, EnclosedMotion, Motion, Pose, Solid


@pytest.fixture
def wall():
    return Solid.box((-5, 1.5, -5), (5, 2, 5))


def turned(t):
    """A turn by t radians about z of what stands at x = 1.25, z = 0.25."""
    c, s = math.cos(t), math.sin(t)
    return np.array([(c, -s, 0, 1.25 * c), (s, c, 0, 1.25 * s), (0, 0, 1, 0.25)])


def first_time():
    """When the corner (2.25, 1) of the turning cube reaches y = 1.5."""
    return math.asin(1.5 / math.hypot(2.25, 1)) - math.atan2(1, 2.25)


def test_a_turn_of_constant_speed(cube, wall):
    turn = EnclosedMotion.turning(Pose.from_translation((1.25, 0, 0.25)), (0, 0, 2), 90, duration=3)
    assert turn.duration == 3 and repr(turn) == "<trisect.EnclosedMotion: duration 3.0>"
    found = trisect.enclosed_first_contact(wall, EnclosedMotion(), cube, turn, width=1e-7)
    time = 3 * first_time() / (math.pi / 2)
    assert found.outcome == ContactOutcome.CONTACT and found.is_narrow
    assert all(found.free_until <= a <= b <= found.contact_by for a, b in found.undecided)
    assert found.free_until <= time <= found.contact_by <= found.free_until + 1e-7
    assert found.witnesses and repr(found).startswith("<EnclosedContact between ")


def test_key_frames(cube, wall):
    half = math.pi / 4
    turn = EnclosedMotion.through(
        [0, 1], [(1, 0, 0, 0), (math.cos(half), 0, 0, math.sin(half))], [(0, 0, 0), (0, 0, 0)]
    )
    moved = cube.translate((1.25, 0, 0.25))
    found = trisect.enclosed_first_contact(wall, EnclosedMotion(), moved, turn, width=1e-6)
    time = first_time() / (math.pi / 2)
    assert found.free_until - 1e-9 <= time <= found.contact_by + 1e-9
    with pytest.raises(trisect.UsageError, match="rotations: must have the shape"):
        EnclosedMotion.through([0, 1], [(1, 0, 0, 0)], [(0, 0, 0), (0, 0, 0)])
    with pytest.raises(trisect.UsageError):
        EnclosedMotion.through([0, 0], 2 * [(1, 0, 0, 0)], 2 * [(0, 0, 0)])
    with pytest.raises(TypeError):
        EnclosedMotion.through([0, "late"], 2 * [(1, 0, 0, 0)], 2 * [(0, 0, 0)])


def test_a_function(cube, wall):
    # The second derivatives of its numbers are at most 1.25.
    motion = EnclosedMotion.smooth(turned, lambda a, b: 1.25, breaks=(0, 1.5), error=1e-15)
    found = trisect.enclosed_first_contact(wall, EnclosedMotion(), cube, motion, width=1e-6)
    assert found.free_until <= first_time() <= found.contact_by
    away = Solid.box((-5, 3, -5), (5, 4, 5))
    none = trisect.enclosed_first_contact(away, EnclosedMotion(), cube, motion)
    assert none.outcome == ContactOutcome.NONE and none.contact_by is None
    assert none.free_until == 1.5


def test_a_function_that_fails(cube, wall):
    def fails(t):
        raise ZeroDivisionError("from pose")

    with pytest.raises(ZeroDivisionError, match="from pose"):
        trisect.enclosed_first_contact(
            wall, EnclosedMotion(), cube, EnclosedMotion.smooth(fails, lambda a, b: 1))
    flat = EnclosedMotion.smooth(lambda t: np.eye(2), lambda a, b: 1)
    with pytest.raises(trisect.UsageError, match="pose: must return a matrix"):
        trisect.enclosed_first_contact(wall, EnclosedMotion(), cube, flat)
    with pytest.raises(TypeError, match="bend: must be callable"):
        EnclosedMotion.smooth(turned, 3)


def test_rational_motions_are_exact(cube):
    fall = EnclosedMotion(Motion.translation((np.eye(4) + [[0] * 4, [0] * 4, [0, 0, 0, 3], [0] * 4]), (0, 0, -4)))
    found = trisect.enclosed_first_contact(cube, EnclosedMotion(), cube, fall, width=1e-6)
    assert found.free_until <= 0.5 and (found.contact_by is None or found.contact_by < 0.51)
    # Undecided at the touch alone, if at all.
    assert all(0.49 < a <= b < 0.51 for a, b in found.undecided[:1])


def test_what_is_refused(cube, wall):
    turn = EnclosedMotion.turning(None, (0, 0, 1), 90)
    with pytest.raises(trisect.UsageError):
        trisect.enclosed_first_contact(wall, EnclosedMotion(), cube, turn, width=0)
    with pytest.raises(trisect.UsageError):
        EnclosedMotion.turning(None, (0, 0, 0), 90)
    with pytest.raises(trisect.UsageError):
        EnclosedMotion.turning(None, (0, 0, 1), math.nan)
    longer = EnclosedMotion.turning(None, (0, 0, 1), 90, duration=2)
    with pytest.raises(trisect.UsageError):
        trisect.enclosed_first_contact(wall, longer, cube, turn)


def test_any_rational_motion(cube):
    # Along a parabola: x = 3 - 4 t + t^2, over 1.
    one, zero = [1], [0]
    entries = [one, zero, zero, [3, -4, 1], zero, one, zero, zero, zero, zero, one, zero]
    motion = Motion.rational(entries, [1])
    contact = trisect.first_contact(cube, Motion(), cube, motion)
    low, high = contact.exact_time(Fraction(1, 10**20))  # t = 2 - sqrt(2)
    assert (2 - low) ** 2 >= 2 >= (2 - high) ** 2
    with pytest.raises(trisect.UsageError, match="entries: must be 12"):
        Motion.rational(entries[1:], [1])
    with pytest.raises(TypeError, match="denominator"):
        Motion.rational(entries, ["x"])


def test_joined_motions():
    up = Motion.translation(None, (0, 0, 1))
    on = Motion.translation(Pose.from_translation((0, 0, 1)), (1, 0, 0))
    both = Motion.joined([up, on])
    assert both.piece_count == 2 and both.pose_at(2) == Pose.from_translation((1, 0, 1))
    with pytest.raises(trisect.UsageError):
        Motion.joined([on, up])


def test_least_distance(cube, wall):
    down = Motion.translation(None, (0, 1, 0))
    found = trisect.least_distance(wall, Motion(), cube, down, relative=1e-4)
    assert found.is_narrow and repr(found).startswith("<LeastDistance between ")
    last = trisect.distance(wall, None, cube, Pose.from_translation((0, 1, 0)))
    assert found.lower <= last.upper and found.upper - found.lower <= 1e-4 * found.upper
    beside = Pose.from_translation((1.25, 0, 0.25))
    turn = EnclosedMotion.turning(beside, (0, 0, 1), 10)
    nearest = trisect.least_distance(wall, EnclosedMotion(), cube, turn)
    angle = math.radians(10)
    clearance = 1.5 - 2.25 * math.sin(angle) - math.cos(angle)  # of the corner (2.25, 1)
    assert nearest.lower <= clearance * (1 + 1e-9) and nearest.upper >= clearance * (1 - 1e-9)
    assert nearest.lower > 0 and nearest.time == pytest.approx(1)
    through = trisect.least_distance(wall, EnclosedMotion(), cube, EnclosedMotion.turning(beside, (0, 0, 1), 20))
    assert through.lower == 0 and through.upper < 1e-9
    assert trisect.least_distance(wall, Motion(), Solid(), Motion()) is None
    with pytest.raises(trisect.UsageError):
        trisect.least_distance(wall, Motion(), cube, down, relative=0)
    with pytest.raises(TypeError):
        trisect.least_distance(wall, None, cube, down)

# SPDX-License-Identifier: Apache-2.0
"""Cases of FCL's test of shapes, read from its C++ text.

Statements that are understood: declarations and assignments of shapes and of the placements tf1 and tf2, testShapeIntersection,
shapeDistance with the expectations that follow it, and the reversible tests. Tests with triangles are cases without shapes.
"""
import math
import re
from dataclasses import dataclass
from typing import Any, Optional

from trisect import Pose

from fcl_shapes import Shape, turned_pose

NUMBER = r'-?\d+(?:\.\d*)?(?:e-?\d+)?'


@dataclass
class Case:
    program: str
    name: str
    solver: str
    text: str = ''
    a: Any = None
    b: Any = None
    pose_a: Any = None
    pose_b: Any = None
    meets: Optional[bool] = None
    distance: Optional[float] = None
    tolerance: float = 0.0

    def is_shape(self):
        return self.a is not None


def shape_of(kind, text):
    numbers = [float(n) for n in re.findall(NUMBER, text.replace('Vector3<S>', ''))]
    if 'Zero' in text:
        numbers = [0, 0, 0, *numbers]
    return Shape(kind, numbers)


def length_of(text):
    """A number, or one less another, as C++ has it."""
    first, _, less = text.partition(' - ')
    return float(first) - float(less or 0)


def pose_of(text, transform):
    """`transform * X` or X, which is the identity, a translation, a turn q about z, or the turn of `transform`."""
    text = text.strip()
    first = Pose()
    if 'transform.linear()' in text:
        return turned_pose(by=(0.0, 0.0, 0.0))
    if text.startswith('transform'):
        first, text = transform, text[len('transform'):].lstrip(' *')
    if not text or 'Identity' in text:
        return first
    if '(q)' in text:
        return first @ Pose.rotation_near([0, 0, 1], math.degrees(3.140 / 6))
    match = re.fullmatch(r'Transform3<S>\(Translation3<S>\(Vector3<S>\((.*), (.*), (.*)\)\)\)', text)
    if not match:
        raise ValueError(f'not a placement: {text}')
    return first @ Pose.from_translation([length_of(c) for c in match.groups()])


def functions_of(text):
    for match in re.finditer(r'^void (test_(?:shape|reversible)\w+)\(\)\n\{\n(.*?)^\}', text, re.M | re.S):
        body = re.sub(r'//[^\n]*|^#[^\n]*', '', match.group(2), flags=re.M)
        yield match.group(1).removeprefix('test_'), [' '.join(s.split()) for s in body.split(';')]


class Reader:
    """The state of one function while its statements are read."""

    def __init__(self, function, transform):
        self.function, self.transform = function, transform
        self.shapes, self.poses, self.words = {}, {}, {}
        self.count = 0
        self.pending = None

    def case(self, solver, **what):
        self.count += 1
        program = re.sub(r'(GJK)?_.*', '', self.function)
        return Case(program, f'{self.function}.{self.count}', solver, **what)

    def read(self, statement):
        """Cases that the statement completes."""
        if match := re.fullmatch(r'(?:(Sphere|Box|Capsule|Cylinder|Cone|Ellipsoid|Halfspace|Plane)<S> )(\w+)\((.*)\)', statement):
            self.shapes[match.group(2)] = shape_of(match.group(1), match.group(3))
        elif match := re.fullmatch(r'hs = (Halfspace|Plane)<S>\((.*)\)', statement):
            self.shapes['hs'] = shape_of(match.group(1), match.group(2))
        elif match := re.fullmatch(r'(tf[12]) = (.*)', statement):
            self.poses[match.group(1)] = pose_of(match.group(2), self.transform)
        elif match := re.fullmatch(r'const bool (\w+) = (true|false)', statement):
            self.words[match.group(1)] = match.group(2)
        elif statement.startswith('testShapeIntersection('):
            yield self.intersection([w.strip() for w in statement.split('(', 1)[1].split(',')])
        elif 'TriangleIntersect(' in statement:
            yield self.case('', text='a triangle is no solid')
        elif match := re.fullmatch(r'res = solver([12])<S>\(\)\.shapeDistance\((.*), &dist.*\)', statement):
            self.pending = self.distance(*match.groups())
        elif statement.startswith('EXPECT_') and self.pending:
            self.expect(statement)
            if '(res)' in statement:
                yield self.pending
                self.pending = None
        elif match := re.fullmatch(r'S distance = ([\d.]+)', statement):
            self.words['distance'] = float(match.group(1))
        elif match := re.fullmatch(r'testReversibleShape(\w+)\((\w+), (\w+), distance\)', statement):
            yield from self.reversible(*match.groups())

    def intersection(self, words):
        a, tf_a, b, tf_b, solver, meets = words[:6]
        meets = meets.rstrip(')')
        is_not = meets.startswith('!')
        meets = self.words.get(meets.lstrip('!'), meets)
        return self.case('LIBCCD' if 'LIBCCD' in solver else 'INDEP', a=self.shapes[a], b=self.shapes[b],
                         pose_a=self.poses[tf_a], pose_b=self.poses[tf_b], meets=(meets == 'true') != is_not)

    def distance(self, solver, text):
        match = re.fullmatch(r'(\w+), (.*), (s[12]?), (.*)', text)
        a, tf_a, b, tf_b = match.groups()
        return self.case('LIBCCD' if solver == '1' else 'INDEP', a=self.shapes[a], b=self.shapes[b],
                         pose_a=pose_of(tf_a, self.transform), pose_b=pose_of(tf_b, self.transform))

    def expect(self, statement):
        if match := re.fullmatch(rf'EXPECT_TRUE\((?:std::)?f?abs\(dist - ({NUMBER})(?: \* ({NUMBER}))?\) < ({NUMBER})\)', statement):
            self.pending.distance = float(match.group(1)) * float(match.group(2) or 1)
            self.pending.tolerance = float(match.group(3))
        elif '(res)' in statement:
            self.pending.meets = 'FALSE' in statement

    def reversible(self, what, a, b):
        a, b, half = self.shapes[a], self.shapes[b], self.words['distance'] / 2
        for one, sign, two in ((a, -1, b), (b, 1, a)):
            for solver in ('LIBCCD', 'INDEP'):
                yield self.case(solver, a=one, b=two, pose_a=Pose.from_translation([sign * half, 0, 0]),
                                pose_b=Pose.from_translation([-sign * half, 0, 0]), meets=what == 'Intersection')


def cases_of(text):
    transform = turned_pose()
    for function, statements in functions_of(text):
        reader = Reader(function, transform)
        for statement in statements:
            yield from reader.read(statement)

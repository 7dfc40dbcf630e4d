#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""issues.py

Booleans that ended in wrong answers elsewhere, each from the issue where it was reported, by the Python package: the shapes have the
sizes and places of the report, and round ones as many facets as it says. Needs no folder. Prints a table in Markdown.

What must hold of every case: union and intersection together have the volume of both operands and each difference that of its
operand less the intersection, as fractions; and every result written in doubles is closed, oriented, and meets itself nowhere. Of
most a volume, a number of parts or a genus is known besides, computed from the doubles that were put in.
"""
import collections
import math
import sys
from fractions import Fraction

import trisect
from trisect import Pose, Solid

from libigl import genus_of
from run import read_deviations


def box(low, high):
    return Solid.box(low, high)


def cube(x, y, z, center=(0, 0, 0)):
    half = (x / 2, y / 2, z / 2)
    return box([c - h for c, h in zip(center, half)], [c + h for c, h in zip(center, half)])


def ball(radius, center, slices=64, stacks=32):
    return Solid.uv_sphere(radius, slices, stacks).translate(center)


def along(solid, direction, center):
    """A solid about the z axis, turned by a rational turn next to one that takes z to the direction, and moved."""
    x, y, z = direction
    angle = math.degrees(math.acos(z / math.sqrt(x * x + y * y + z * z)))
    turn = Pose.rotation_near([-y, x, 0], angle) if x or y else Pose()
    return solid.transform(turn).translate(center)


def all_four(a, b):
    return (trisect.union([a, b]), trisect.intersection([a, b]), trisect.evaluate(a - b), trisect.evaluate(b - a))


def sound(result):
    mesh = result.certified_mesh()
    return result.is_empty or bool(mesh.certificate)


def pair(a, b):
    """What must hold of any two, and their four results."""
    union, both, a_less, b_less = results = all_four(a, b)
    va, vb, v = a.exact_volume(), b.exact_volume(), both.exact_volume()
    holds = (union.exact_volume() + v == va + vb and a_less.exact_volume() == va - v and b_less.exact_volume() == vb - v
             and all(map(sound, results)))
    return holds, results


def parts(solid):
    return len(solid.components())


def pyvista_cases():
    holds, (_, _, _, less) = pair(cube(1.1, 10, 10), cube(1, 18, 27))
    yield 'pyvista#4843: a bar through a slab', holds and less.exact_volume() == 18 * 27 - 100 and genus_of(less) == 1
    wall, window = box([0, 0, -0.1], [6, 3, 0.1]), box([1, 1, -0.2], [2, 2, 0.2])
    holds, (_, _, less, _) = pair(wall, window)
    yield 'pyvista#7548: a window in a wall', holds and less.exact_volume() == 17 * 2 * Fraction(0.1) and genus_of(less) == 1
    center = (0.5, 0.5, 0.5)
    holds, (_, _, less, _) = pair(ball(0.6, center, 120, 120), cube(1, 1, 1, center))
    yield 'pyvista#4904: six caps of a ball', holds and parts(less) == 6
    holds, (_, both, less, _) = pair(cube(2, 2, 2), cube(1, 1, 1))
    yield 'pyvista#3840: a cube in a cube', holds and both.exact_volume() == 1 and less.exact_volume() == 7
    holds, (_, both, less, _) = pair(cube(40, 40, 40), ball(3, (0, 0, 10)))
    yield 'pyvista-support#447: a cavity', holds and parts(both) == 1 and less.vertex_count == 8 + both.vertex_count
    holds, (union, both, _, _) = pair(ball(1, (0, 0, 0)), ball(1, (5, 0, 0)))
    yield 'pyvista-support#305: parts that do not meet', holds and both.is_empty and parts(union) == 2
    holds, (union, _, _, _) = pair(
        ball(22.443613622177708, (60.69442458, 148.23356447, -607.05434454), 50, 50),
        ball(19.99923563231063, (60.83777191, 147.54242583, -610.92167808), 50, 50))
    yield 'pyvista#6688: two balls', holds and genus_of(union) == 0
    holds, (union, _, _, _) = pair(ball(0.5, (0, 0, 0), 30, 30), ball(0.5, (0.5, 0, 0), 30, 30))
    yield 'pyvista#1485: balls whose poles are in a plane', holds and genus_of(union) == 0
    middle = (2.4623486548662186, 15.274176120758057, 2.042705088853836)
    cylinder = along(Solid.cylinder(0.5, middle[1], 100).translate([0, 0, -middle[1] / 2]), (0, 1, 0),
                     (middle[0], middle[1] / 2, middle[2]))
    cone = along(Solid.cone(1, 0, 3, 8).translate([0, 0, -1.5]), (-0.4634096920490265, 0.6903295516967773, -0.5556047558784485),
                 (1.7672341, 16.30967, 1.2092979))
    holds, (union, _, _, _) = pair(trisect.union([ball(1, middle, 30, 30), cylinder]), cone)
    clipped, rest = union.split([0, 1, 0, -middle[1]])
    yield ('pyvista#2788: a ball, a cylinder and a cone, clipped',
           holds and sound(clipped) and clipped.exact_volume() + rest.exact_volume() == union.exact_volume())
    grid = [[x, y, (math.sin(x * x) + math.cos(y * y)) / 2 - 0.8] for x in steps(1.6, 32) for y in steps(1.6, 32)]
    holds, _ = pair(under_surface(grid, 32, -3.0), cube(3, 3, 4.2))
    yield 'pyvista#4059: a wavy surface and a cube', holds
    dx, dy, dz, dk = -0.804, 1.6, 2.2, 2
    slanted = Solid.hull([[-dx, -dy, -dz], [-dx, dy, -dz], [dx, -dy, dz], [dx, dy, dz], [dk, -dy, -dz], [dk, dy, -dz],
                          [dk, -dy, dz], [dk, dy, dz]])
    holds, _ = pair(slanted, cube(3, 3, 4.2))
    yield 'pyvista#4059: a slanted block and a cube', holds


def steps(reach, count):
    return [-reach + 2 * reach * i / (count - 1) for i in range(count)]


def under_surface(points, side, bottom):
    """The solid between a grid of points and a level below it."""
    lower = [[x, y, bottom] for x, y, _ in points]
    n, faces = side * side, []
    for i in range(side - 1):
        for j in range(side - 1):
            a, b, c, d = i * side + j, (i + 1) * side + j, (i + 1) * side + j + 1, i * side + j + 1
            faces += [[a, b, c], [a, c, d], [n + a, n + c, n + b], [n + a, n + d, n + c]]
    rim = ([i * side for i in range(side)] + [(side - 1) * side + j for j in range(1, side)]
           + [i * side + side - 1 for i in range(side - 2, -1, -1)] + [j for j in range(side - 2, 0, -1)])
    for a, b in zip(rim, rim[1:] + rim[:1]):
        faces += [[b, a, n + a], [b, n + a, n + b]]
    return Solid(points + lower, faces)


def vedo_cases():
    holds, (_, both, _, _) = pair(cube(1, 2, 3, (-0.4, 0, 0)), cube(1, 2, 3, (0.4, 0, 0)))
    yield 'vedo#739: boxes beside each other', holds and parts(both) == 1
    holds, (_, both, _, _) = pair(ball(2, (0, 0, 0)), Solid.cylinder(0.25, 0.7, 24).translate([0.2, 0.2, -0.15]))
    yield 'vedo#623: a cylinder in a ball', holds and both.triangle_count == 4 * 24 - 4
    zero, wall, front, gap, part = 0.000001, 0.75, 1.15, 0.2, 5
    far_x, far_y = wall + 2 * gap + front + part, 2 * wall + 2 * gap + part
    outside = box([zero, zero, zero], [far_x, far_y, 1])
    holds, (_, _, less, _) = pair(outside, box([wall, wall, -0.1], [far_x - front, far_y - wall, 1.1]))
    yield 'vedo#1127: a frame', holds and genus_of(less) == 1


def trimesh_cases():
    for shift in (1e4, 1e5, 1e9):
        far = cube(1, 1, 1).translate([shift] * 3)
        yield f'trimesh#2310: a box and itself at {shift:g}', trisect.intersection([far, far]).exact_volume() == 1
    holds, (_, _, less, _) = pair(cube(1, 1, 1), cube(1, 1, 1, (0, 0, 0.5)))
    yield 'trimesh#2156: a shifted cube', holds and less.exact_volume() == Fraction(1, 2)
    holds, (_, _, less, _) = pair(cube(4, 2, 2), cube(4, 1, 1))
    yield 'trimesh#519: flush ends', holds and less.exact_volume() == 12 and genus_of(less) == 1
    meshes = [cube(1, 1, 1), cube(1, 1, 1, (1, 1, 0)), cube(1, 1, 1, (2, 0, 0))]
    union = trisect.union(meshes)
    yield 'trimesh#2236: cubes along an edge', union.exact_volume() == 3 and sound(union)


def three_cases():
    small = (0.45 + 0.45 + 0.45) / 30
    a = cube(0.45 - small, 0.45 - small, 0.45 + 1e-4)
    b = cube(0.45 + 1e-4, 0.45 - small, 0.45 - small)
    holds, (union, _, _, _) = pair(a, b)
    yield 'three-bvh-csg#185: nearly flush boxes', holds and genus_of(union) == 0
    first = trisect.evaluate(cube(1, 1, 1) - cube(1, 1, 1, (0.5, 0.5, 0)))
    second = trisect.evaluate(first - cube(1, 1, 1, (0, 0.5, 0)))
    yield 'three-bvh-csg#210: flush cubes, twice', second.exact_volume() == Fraction(1, 2) and second.vertex_count == 8
    holds, (union, _, _, _) = pair(cube(1, 1, 1), cube(1, 1, 1, (1, 0, 0)))
    yield 'three-bvh-csg#103: cubes side by side', holds and union.exact_volume() == 2 and genus_of(union) == 0
    holds, (union, _, less, _) = pair(cube(1, 1, 1), cube(1, 1, 1))
    yield 'three-bvh-csg#103: a cube and itself', holds and union.vertex_count == 8 and less.is_empty
    upright = Solid.cylinder(1, 2, 20).translate([0, 0, -1])
    holds, (union, _, _, _) = pair(upright, upright.rotate('x', 90))
    yield 'three-bvh-csg#53: crossed cylinders', holds and parts(union) == 1
    holds, (_, both, less, _) = pair(ball(1, (0, 0, 0), 32, 16), ball(1, (0, 0, 0), 32, 16).scale(0.5))
    yield 'three-bvh-csg: a ball in a ball', holds and parts(both) == 1
    for x, y in ((-0.2122622792047668, 0.75), (-0.42051608752915404, 0.75)):
        holds, (union, _, _, _) = pair(ball(1, (0, 0, 0), 50, 50), ball(1, (x, y, 0), 50, 50))
        yield f'three-bvh-csg#168: balls at {x}', holds and genus_of(union) == 0
    holds, (union, _, _, _) = pair(cube(1, 1, 1), ball(1, (-0.27300968690619787, 0.5329319712626078, 0), 50, 50))
    yield 'three-bvh-csg#8: a cube and a ball', holds and parts(union) == 1
    torus = Solid.torus(0.6, 0.2, 30, 30)
    for x, y in ((-0.9710495828020456, -0.17902368686930203), (-0.1334678235982406, 0.23870515499070477)):
        holds, _ = pair(torus, ball(0.5, (x, y, 0), 50, 50))
        yield f'three-bvh-csg#36: a torus and a ball at {x}', holds
    middle = cube(4, 4, 4, (1, 1, 1))
    holds, (_, both, _, _) = pair(cube(4, 4, 4), ball(1.5, (1, 1, 1), 64, 32))
    yield 'Oblikovati#2147: a ball through three sides', holds and middle.volume == 64 and 10.8 < both.volume < 11.01
    holds, (_, _, less, _) = pair(cube(256, 256, 128), cube(256, 256, 128, (128, 0, 0)))
    yield 'sbox-public#10911: half a block', holds and less.exact_volume() == 128 * 256 * 128 and less.vertex_count == 8


def main():
    known, problems = read_deviations(), []
    print('| whose | cases | passed | differs |\n|---|---:|---:|---:|')
    for whose, cases in (('PyVista', pyvista_cases()), ('vedo', vedo_cases()), ('trimesh', trimesh_cases()),
                         ('three-bvh-csg and two others', three_cases())):
        tally = collections.Counter()
        for name, holds in cases:
            outcome = 'passed' if holds else 'differs'
            tally[outcome] += 1
            if known.get(('issues', name.replace(' ', '_')), ('passed',))[0] != outcome:
                problems.append(f'{name}: {outcome}')
        print(f'| {whose} | {sum(tally.values())} | {tally["passed"]} | {tally["differs"]} |', flush=True)
    for problem in problems:
        print('issues.py:', problem, file=sys.stderr)
    return 1 if problems else 0


if __name__ == '__main__':
    sys.exit(main())

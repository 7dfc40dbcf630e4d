// SPDX-License-Identifier: Apache-2.0
//
// The oracle's own tests: solids whose volume, area, corners and creases are known by hand, unit
// cubes counted one by one for expressions over boxes, and identities of set algebra.
#include "naive_boolean.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "canonical_boundary.h"
#include "random_solids.h"

namespace {

using namespace reference;
using Kind = Expression::Kind;

Result combine(const Operand& a, Kind kind, const Operand& b) {
    return evaluate({a, b}, pair_expression(kind));
}

CanonicalBoundary boundary_of(const Result& result) { return canonical_boundary(result.cells); }

Rational volume_of(const Result& result) { return volume(boundary_of(result)); }

// Of solids whose planes are parallel to the axes, where |normal| is 1 for integer positions.
Rational area_of(const Result& result) {
    Rational sum = 0;
    for (const auto& [plane, ratio] : area_ratios(boundary_of(result))) {
        EXPECT_EQ(abs(plane.normal[0]) + abs(plane.normal[1]) + abs(plane.normal[2]), 1);
        sum += ratio;
    }
    return sum;
}

std::size_t corner_count(const Result& result) { return real_vertices(boundary_of(result)).size(); }

std::size_t edge_count(const Result& result) { return edges(boundary_of(result)).size(); }

Point3 at(long x, long y, long z, long divisor = 1) {
    return {fraction(x, divisor), fraction(y, divisor), fraction(z, divisor)};
}

const Operand cube = box({0, 0, 0}, {4, 4, 4});

TEST(Operand, balance_and_volume) {
    EXPECT_TRUE(is_balanced(cube));
    EXPECT_EQ(signed_volume(cube), 64);
    EXPECT_EQ(signed_volume(reversed(cube)), -64);
    Operand open = cube;
    open.pop_back();
    EXPECT_FALSE(is_balanced(open));
    EXPECT_THROW(evaluate({open}, Expression::leaf(0)), std::invalid_argument);
}

TEST(Boxes, one_alone) {
    const Result result = evaluate({cube}, Expression::leaf(0));
    EXPECT_EQ(volume_of(result), 64);
    EXPECT_EQ(area_of(result), 96);
    EXPECT_EQ(corner_count(result), 8u);
    EXPECT_EQ(edge_count(result), 12u);
    EXPECT_TRUE(is_closed(boundary_of(result)));
    EXPECT_FALSE(result.unbounded);
    EXPECT_EQ(boundary_of(result), canonical_boundary(polygons_of(cube)));
}

struct Configuration {
    const char* name;
    LatticePoint low;
    LatticePoint high;
    long union_volume;
    long union_area;
    long common_volume;
    long common_area;
    std::size_t union_corners;
    std::size_t union_edges;
};

// Against the cube from 0 to 4. Corners and creases of the union by hand.
const Configuration configurations[] = {
    {"disjoint", {6, 0, 0}, {7, 1, 1}, 65, 102, 0, 0, 16, 24},
    {"equal faces", {4, 0, 0}, {6, 4, 4}, 96, 128, 0, 0, 8, 12},
    {"face inside face", {4, 1, 1}, {5, 2, 2}, 65, 100, 0, 0, 16, 24},
    // The common corner vanishes in a straight crease.
    {"faces in one corner", {4, 0, 0}, {5, 1, 1}, 65, 100, 0, 0, 14, 21},
    {"faces along an edge", {4, 1, 0}, {5, 2, 1}, 65, 100, 0, 0, 16, 24},
    // Two edges of the cube and two of the box cross and cut each other.
    {"face crossing face", {4, 2, 2}, {5, 6, 6}, 80, 136, 0, 0, 18, 28},
    {"edge on edge", {4, 4, 0}, {6, 6, 4}, 80, 136, 0, 0, 14, 23},
    {"part of an edge", {4, 4, 1}, {6, 6, 2}, 68, 112, 0, 0, 16, 25},
    {"corner on corner", {4, 4, 4}, {5, 5, 5}, 65, 102, 0, 0, 15, 24},
    {"inside", {1, 1, 1}, {2, 2, 2}, 64, 96, 1, 6, 8, 12},
    {"inside on a face", {0, 1, 1}, {1, 2, 2}, 64, 96, 1, 6, 8, 12},
    {"inside in a corner", {0, 0, 0}, {1, 1, 1}, 64, 96, 1, 6, 8, 12},
    {"equal", {0, 0, 0}, {4, 4, 4}, 64, 96, 64, 96, 8, 12},
    {"overlap at a corner", {2, 2, 2}, {6, 6, 6}, 120, 168, 8, 24, 20, 30},
    {"overlap with one face flush", {2, 2, 0}, {6, 6, 4}, 112, 152, 16, 40, 16, 24},
    {"through", {1, 1, -1}, {2, 2, 5}, 66, 104, 4, 18, 24, 36},
    {"plate over", {-1, -1, 4}, {5, 5, 5}, 100, 160, 0, 0, 16, 24},
};

TEST(Boxes, all_touching_configurations) {
    for (const Configuration& c : configurations) {
        SCOPED_TRACE(c.name);
        const Operand other = box(c.low, c.high);
        const Result joined = combine(cube, Kind::Union, other);
        const Result common = combine(cube, Kind::Intersection, other);
        const Result rest = combine(cube, Kind::Difference, other);
        const Result either = combine(cube, Kind::Xor, other);
        EXPECT_EQ(volume_of(joined), c.union_volume);
        EXPECT_EQ(area_of(joined), c.union_area);
        EXPECT_EQ(volume_of(common), c.common_volume);
        EXPECT_EQ(area_of(common), c.common_area);
        EXPECT_EQ(volume_of(rest), 64 - c.common_volume);
        EXPECT_EQ(volume_of(either), c.union_volume - c.common_volume);
        EXPECT_EQ(corner_count(joined), c.union_corners);
        EXPECT_EQ(edge_count(joined), c.union_edges);
        for (const Result* result : {&joined, &common, &rest, &either}) {
            EXPECT_TRUE(is_closed(boundary_of(*result)));
        }
    }
}

TEST(Boxes, slanted_volume) {
    // A corner of the cube cut off by x + y + z = 3.
    const Operand corner = tetrahedron({0, 0, 0}, {3, 0, 0}, {0, 3, 0}, {0, 0, 3});
    const Result rest = combine(cube, Kind::Difference, corner);
    EXPECT_EQ(volume_of(rest), 64 - fraction(27, 6));
    // Triangle with legs of length 3 sqrt 2: area 9 sqrt 3 / 2, and |normal| = sqrt 3.
    EXPECT_EQ(area_ratios(boundary_of(rest)).at(OrientedPlane(-1, -1, -1, 3)), fraction(9, 2));
    EXPECT_EQ(corner_count(rest), 10u);
    EXPECT_EQ(edge_count(rest), 15u);
    EXPECT_EQ(total_area_vector(boundary_of(rest)), (std::array<Rational, 3>{}));
}

TEST(Windings, nested_and_overlapping_shells) {
    const Operand inner = box({1, 1, 1}, {3, 3, 3});
    const Expression leaf = Expression::leaf(0);
    const Operand doubled = concatenated(cube, inner);
    const Operand hollow = concatenated(cube, reversed(inner));
    EXPECT_EQ(volume_of(evaluate({doubled}, leaf)), 64);
    EXPECT_EQ(volume_of(evaluate({hollow}, leaf)), 56);
    const Result twice =
        evaluate({doubled}, [](const std::vector<int>& windings) { return windings[0] == 2; });
    EXPECT_EQ(volume_of(twice), 8);
    for (const ConvexCell& cell : twice.cells) {
        EXPECT_EQ(cell.windings_inside, std::vector<int>{2});
        EXPECT_EQ(cell.windings_outside, std::vector<int>{1});
    }
    EXPECT_EQ(locate(evaluate({hollow}, leaf), at(2, 2, 2)), Location::Outside);
    EXPECT_EQ(locate(evaluate({doubled}, leaf), at(2, 2, 2)), Location::Inside);
}

TEST(Windings, inside_out_and_coincident_shells) {
    const Expression leaf = Expression::leaf(0);
    EXPECT_TRUE(evaluate({reversed(cube)}, leaf).cells.empty());
    EXPECT_EQ(volume_of(evaluate({reversed(cube)}, leaf, InsideRule::NonZero)), 64);
    EXPECT_TRUE(evaluate({concatenated(cube, reversed(cube))}, leaf).cells.empty());
    EXPECT_TRUE(same_set(evaluate({concatenated(cube, cube)}, leaf), evaluate({cube}, leaf)));
    // Two overlapping boxes in one operand are their union.
    const Operand other = box({2, 2, 2}, {6, 6, 6});
    EXPECT_TRUE(
        same_set(evaluate({concatenated(cube, other)}, leaf), combine(cube, Kind::Union, other)));
    EXPECT_TRUE(same_set(evaluate({concatenated(cube, reversed(other))}, leaf),
                         combine(cube, Kind::Difference, other)));
    EXPECT_TRUE(same_set(evaluate({concatenated(cube, reversed(other))}, leaf, InsideRule::NonZero),
                         combine(cube, Kind::Xor, other)));
}

TEST(Location, on_every_kind_of_point) {
    const Result wall = combine(cube, Kind::Union, box({4, 0, 0}, {8, 4, 4}));
    EXPECT_EQ(locate(wall, at(4, 2, 2)), Location::Inside);      // on the vanished wall
    EXPECT_EQ(locate(wall, at(4, 4, 2)), Location::OnBoundary);  // on its edge
    EXPECT_EQ(locate(wall, at(4, 4, 4)), Location::OnBoundary);
    EXPECT_EQ(locate(wall, at(0, 0, 0)), Location::OnBoundary);
    EXPECT_EQ(locate(wall, at(1, 3, 5, 7)), Location::Inside);
    EXPECT_EQ(locate(wall, at(57, 1, 1, 7)), Location::Outside);
    const Result touching = combine(cube, Kind::Intersection, box({4, 0, 0}, {8, 4, 4}));
    EXPECT_EQ(locate(touching, at(4, 2, 2)), Location::Outside);  // regularised away
    EXPECT_EQ(locate(touching, at(4, 4, 4)), Location::Outside);
    const Result outside =
        evaluate({cube}, Expression::node(Kind::Complement, {Expression::leaf(0)}));
    EXPECT_EQ(locate(outside, at(9, 9, 9)), Location::Inside);
    EXPECT_EQ(locate(outside, at(1, 1, 1)), Location::Outside);
    EXPECT_EQ(locate(outside, at(0, 1, 1)), Location::OnBoundary);
}

TEST(Canonical, independent_of_fragmentation) {
    // A square ring: as one face with a hole, and as four overlapping-free pieces with T-junctions.
    const OrientedPlane up(0, 0, 5, -10);
    const auto p = [](long x, long y) { return at(x, y, 2); };
    const Polygon ring{
        up, {{p(0, 0), p(6, 0), p(6, 3), p(6, 6), p(0, 6)}, {p(2, 2), p(2, 4), p(4, 4), p(4, 2)}}};
    const std::vector<Polygon> pieces{{up, {{p(0, 0), p(6, 0), p(6, 2), p(0, 2)}}},
                                      {up, {{p(0, 4), p(5, 4), p(6, 4), p(6, 6), p(0, 6)}}},
                                      {up, {{p(0, 2), p(2, 2), p(2, 4), p(0, 4)}}},
                                      {up, {{p(4, 2), p(6, 2), p(6, 4), p(4, 4)}}}};
    const CanonicalBoundary whole = canonical_boundary(std::vector<Polygon>{ring});
    EXPECT_EQ(whole, canonical_boundary(pieces))
        << explain_difference(whole, canonical_boundary(pieces));
    EXPECT_EQ(real_vertices(whole).size(), 8u);
    EXPECT_EQ(area_ratios(whole).at(OrientedPlane(0, 0, 1, -2)), 32);
    EXPECT_FALSE(is_closed(whole));
    std::vector<Polygon> twice = pieces;
    twice.push_back(pieces.front());
    EXPECT_NE(whole, canonical_boundary(twice));
    EXPECT_FALSE(explain_difference(whole, canonical_boundary(twice)).empty());
    Polygon back = ring;
    back.plane = up.flipped();
    EXPECT_NE(whole, canonical_boundary(std::vector<Polygon>{back}));
    Polygon off = ring;
    off.loops[0][0][2] += 1;
    EXPECT_THROW(canonical_boundary(std::vector<Polygon>{off}), std::invalid_argument);
}

TEST(Canonical, corners_that_touch_creases) {
    // In one plane a wedge stands with its tip on the straight side of a rectangle.
    const OrientedPlane up(0, 0, 1, 0);
    const auto p = [](long x, long y) { return at(x, y, 0); };
    const CanonicalBoundary touching = canonical_boundary(
        std::vector<Polygon>{{up, {{p(0, 0), p(4, 0), p(4, 1), p(2, 1), p(0, 1)}}},
                             {up, {{p(2, 1), p(3, 3), p(1, 3)}}}});
    EXPECT_EQ(touching.regions.begin()->second.size(), 7u);
    EXPECT_EQ(real_vertices(touching).size(), 7u);
    EXPECT_EQ(edges(touching).size(), 8u);
}

// --- Random families -----------------------------------------------------------------------------

// Counts unit cubes, for operands made of boxes on the lattice.
TEST(Random, expressions_over_boxes_by_counting) {
    Random random(11);
    for (int round = 0; round < 60; ++round) {
        SCOPED_TRACE(round);
        struct Shell {
            LatticePoint low;
            LatticePoint high;
            int winding;
        };
        const std::size_t count = 2 + random.below(3);
        std::vector<std::vector<Shell>> shells(count);
        std::vector<Operand> operands(count);
        for (std::size_t i = 0; i < count; ++i) {
            for (std::size_t j = random.below(2); j < 2; ++j) {
                Shell shell{{}, {}, random.chance(1, 4) ? -1 : 1};
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    shell.low[axis] = random.between(0, 5);
                    shell.high[axis] = random.between(shell.low[axis] + 1, 6);
                }
                const Operand solid = box(shell.low, shell.high);
                operands[i] =
                    concatenated(operands[i], shell.winding > 0 ? solid : reversed(solid));
                shells[i].push_back(shell);
            }
        }
        const InsideRule rule = random.chance(1, 2) ? InsideRule::Positive : InsideRule::NonZero;
        const Expression expression = random_expression(random, count, count + 2);
        const Indicator indicator = make_indicator(expression, rule);
        const Result result = evaluate(operands, indicator);
        const bool far = indicator(std::vector<int>(count));
        EXPECT_EQ(result.unbounded, far);
        long cubes = 0;
        for (long cell = 0; cell < 216; ++cell) {
            const LatticePoint c{cell % 6, cell / 6 % 6, cell / 36};
            std::vector<int> windings(count);
            for (std::size_t i = 0; i < count; ++i) {
                for (const Shell& shell : shells[i]) {
                    bool inside = true;
                    for (std::size_t axis = 0; axis < 3; ++axis) {
                        inside = inside && shell.low[axis] <= c[axis] && c[axis] < shell.high[axis];
                    }
                    windings[i] += inside ? shell.winding : 0;
                }
            }
            const bool inside = indicator(windings);
            cubes += (inside ? 1 : 0) - (far ? 1 : 0);
            if (random.chance(1, 30)) {
                const Point3 middle = at(2 * c[0] + 1, 2 * c[1] + 1, 2 * c[2] + 1, 2);
                EXPECT_EQ(locate(result, middle), inside ? Location::Inside : Location::Outside);
            }
        }
        EXPECT_EQ(volume_of(result), cubes) << to_string(expression);
    }
}

TEST(Random, generator_makes_closed_operands) {
    Random random(1);
    for (int round = 0; round < 500; ++round) {
        EXPECT_TRUE(is_balanced(random_operand(random)));
        const Operand solid = random_embedded_solid(random);
        EXPECT_TRUE(is_balanced(solid));
        EXPECT_GT(signed_volume(solid), 0);
    }
    Random first(5);
    Random second(5);
    EXPECT_EQ(random_family(first, 4), random_family(second, 4));
    // A platform that draws other numbers would not run the same tests.
    EXPECT_EQ(Random(0).next(), 0xe220a8397b1dcdafu);
}

TEST(Random, embedded_solids_are_their_own_boundary) {
    Random random(2);
    for (int round = 0; round < 100; ++round) {
        const Operand solid = random_embedded_solid(random);
        const Result result = evaluate({solid}, Expression::leaf(0));
        EXPECT_EQ(boundary_of(result), canonical_boundary(polygons_of(solid)));
        EXPECT_EQ(volume_of(result), signed_volume(solid));
    }
}

TEST(Random, identities_of_pairs) {
    Random random(3);
    for (int round = 0; round < 80; ++round) {
        SCOPED_TRACE(round);
        const std::vector<Operand> pair = random_family(random, 2);
        const Operand& a = pair[0];
        const Operand& b = pair[1];
        const Result joined = combine(a, Kind::Union, b);
        const Result common = combine(a, Kind::Intersection, b);
        const Result rest = combine(a, Kind::Difference, b);
        const Result either = combine(a, Kind::Xor, b);
        const Result only_a = evaluate({a}, Expression::leaf(0));
        const Result only_b = evaluate({b}, Expression::leaf(0));
        EXPECT_EQ(volume_of(joined) + volume_of(common), volume_of(only_a) + volume_of(only_b));
        EXPECT_EQ(volume_of(rest) + volume_of(common), volume_of(only_a));
        EXPECT_EQ(volume_of(either), volume_of(joined) - volume_of(common));
        EXPECT_TRUE(combine(a, Kind::Difference, a).cells.empty());
        EXPECT_TRUE(same_set(combine(a, Kind::Union, a), only_a));
        EXPECT_TRUE(same_set(combine(b, Kind::Union, a), joined));
        for (const Result* result : {&joined, &common, &rest, &either}) {
            const CanonicalBoundary boundary = boundary_of(*result);
            EXPECT_TRUE(is_closed(boundary));
            EXPECT_EQ(total_area_vector(boundary), (std::array<Rational, 3>{}));
            for (const auto& [plane, segments] : boundary.regions) {
                for (const BoundarySegment& segment : segments) {
                    EXPECT_EQ(segment.multiplicity, 1);
                }
            }
        }
    }
}

TEST(Random, laws_of_three_operands) {
    Random random(4);
    const auto leaf = [](std::size_t i) { return Expression::leaf(i); };
    const auto node = [](Kind kind, std::vector<Expression> children) {
        return Expression::node(kind, std::move(children));
    };
    for (int round = 0; round < 30; ++round) {
        SCOPED_TRACE(round);
        const std::vector<Operand> family = random_family(random, 3);
        const auto same = [&](const Expression& x, const Expression& y) {
            EXPECT_TRUE(same_set(evaluate(family, x), evaluate(family, y)))
                << to_string(x) << " and " << to_string(y);
        };
        const Expression sum = node(Kind::Union, {leaf(0), leaf(1)});
        // The oracle evaluates expressions point by point, so a law holds by itself; what may go
        // wrong, and is tried by moving the operands, depends on their place and order.
        same(node(Kind::Intersection, {sum, leaf(2)}),
             node(Kind::Union, {node(Kind::Intersection, {leaf(0), leaf(2)}),
                                node(Kind::Intersection, {leaf(1), leaf(2)})}));
        std::vector<Operand> moved;
        for (const Operand& operand : family) {
            moved.push_back(translated(operand, {1000003, -77, 5}));
        }
        const Expression expression = random_expression(random, 3, 6);
        EXPECT_EQ(volume_of(evaluate(family, expression)), volume_of(evaluate(moved, expression)));
        for (Operand& operand : moved) {
            std::reverse(operand.begin(), operand.end());
            operand = axes_rotated(operand, 1);
        }
        EXPECT_EQ(volume_of(evaluate(family, expression)), volume_of(evaluate(moved, expression)));
    }
}

// Membership of lattice points and half-lattice points follows from the operands' memberships
// wherever these are off their boundaries, and a boundary point of the result is on some operand's
// surface.
TEST(Random, membership) {
    Random random(6);
    for (int round = 0; round < 25; ++round) {
        SCOPED_TRACE(round);
        const std::size_t count = 2 + random.below(3);
        const std::vector<Operand> family = random_family(random, count);
        const Expression expression = random_expression(random, count, count + 3);
        const Result result = evaluate(family, expression);
        std::vector<Result> alone;
        for (const Operand& operand : family) {
            alone.push_back(evaluate({operand}, Expression::leaf(0)));
        }
        for (int sample = 0; sample < 10; ++sample) {
            const long divisor = random.between(1, 2);
            const Point3 p = at(random.between(0, 32), random.between(0, 32), random.between(0, 32),
                                divisor * 2);
            std::vector<bool> memberships;
            bool clear = true;
            for (const Result& operand : alone) {
                const Location location = locate(operand, p);
                clear = clear && location != Location::OnBoundary;
                memberships.push_back(location == Location::Inside);
            }
            const Location location = locate(result, p);
            if (clear) {
                EXPECT_EQ(location,
                          holds(expression, memberships) ? Location::Inside : Location::Outside);
            }
        }
        for (const Point3& corner : real_vertices(boundary_of(result))) {
            EXPECT_EQ(locate(result, corner), Location::OnBoundary);
        }
    }
}

}  // namespace

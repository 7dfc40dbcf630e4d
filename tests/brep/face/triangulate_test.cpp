// SPDX-License-Identifier: Apache-2.0

#include <trisect/brep/triangulate.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <set>
#include <span>
#include <utility>

#include <trisect/brep/exact_rational.h>

namespace triangulate_test {
namespace {

using namespace trisect;

using Loop = std::vector<std::array<std::int64_t, 2>>;
using Loops = std::vector<Loop>;

// A figure of the x-y plane laid into space: the identity, turned over, onto another axis, and
// sheared into a general position.
enum class Placement { Flat, TurnedOver, Upright, Sheared };

LatticePoint place(std::int64_t x, std::int64_t y, Placement how) {
    switch (how) {
        case Placement::Flat:
            return {x, y, 5};
        case Placement::TurnedOver:
            return {y, x, -5};
        case Placement::Upright:
            return {3, x, y};
        case Placement::Sheared:
            return {x + y, x - 3 * y, 7 * x + 2 * y + 11};
    }
    return {};
}

Plane plane_of(Placement how) {
    return Plane::through(place(0, 0, how), place(1, 0, how), place(0, 1, how));
}

Int128 doubled_area(const std::array<std::int64_t, 2>& a, const std::array<std::int64_t, 2>& b,
                    const std::array<std::int64_t, 2>& c) {
    return Int128{b[0] - a[0]} * (c[1] - a[1]) - Int128{b[1] - a[1]} * (c[0] - a[0]);
}

struct Figure {
    std::vector<std::array<std::int64_t, 2>> flat;
    std::vector<Point> points;
    std::vector<std::vector<std::uint32_t>> loops;
};

// Every corner gets an index of its own when `split`, equal corners share one otherwise.
Figure figure(const Loops& loops, Placement how, bool split) {
    Figure out;
    std::map<std::array<std::int64_t, 2>, std::uint32_t> known;
    for (const Loop& loop : loops) {
        out.loops.emplace_back();
        for (const auto& p : loop) {
            const auto next = static_cast<std::uint32_t>(out.points.size());
            const auto index = split ? next : known.try_emplace(p, next).first->second;
            if (index == next) {
                out.flat.push_back(p);
                out.points.emplace_back(place(p[0], p[1], how));
            }
            out.loops.back().push_back(index);
        }
    }
    return out;
}

// Areas add up exactly, all are positive, and the directed edges of the triangles cancel down to
// those of the loops: together that is a triangulation which uses every corner.
void expect_triangulation(const Figure& f, const std::vector<IndexTriangle>& triangles) {
    Int128 area = 0;
    std::map<std::pair<std::array<std::int64_t, 2>, std::array<std::int64_t, 2>>, int> edges;
    const auto count = [&](std::uint32_t a, std::uint32_t b, int by) {
        const auto& p = f.flat[a];
        const auto& q = f.flat[b];
        edges[p < q ? std::pair(p, q) : std::pair(q, p)] += p < q ? by : -by;
    };
    for (const auto& loop : f.loops) {
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const auto a = loop[i];
            const auto b = loop[(i + 1) % loop.size()];
            area -= doubled_area({0, 0}, f.flat[a], f.flat[b]);
            count(a, b, -1);
        }
    }
    for (const auto& t : triangles) {
        const Int128 twice = doubled_area(f.flat[t[0]], f.flat[t[1]], f.flat[t[2]]);
        EXPECT_TRUE(twice > 0);
        area += twice;
        for (std::size_t i = 0; i < 3; ++i) count(t[i], t[(i + 1) % 3], 1);
    }
    EXPECT_TRUE(area == 0);
    for (const auto& [edge, n] : edges) EXPECT_EQ(n, 0);
}

// The points of a figure by doubles that leave all open that they can.
class BluntPoints final : public RoundedPoints {
public:
    explicit BluntPoints(std::span<const Point> points) : points_(points) {
        for (const Point& p : points) nearest_.push_back({p.approximation().c, 0x1p+20});
    }
    [[nodiscard]] std::span<const Approximation> nearest() const override { return nearest_; }
    [[nodiscard]] HomogeneousPoint homogeneous(std::uint32_t i) const override {
        return points_[i].homogeneous();
    }
    [[nodiscard]] int compare_along(std::uint32_t a, std::uint32_t b, int axis) const override {
        const auto order = compare_coordinate(points_[a], points_[b], axis);
        return order < 0 ? -1 : (order > 0 ? 1 : 0);
    }

private:
    std::span<const Point> points_;
    std::vector<Approximation> nearest_;
};

void expect_triangulable(const Loops& loops) {
    for (const Placement how :
         {Placement::Flat, Placement::TurnedOver, Placement::Upright, Placement::Sheared}) {
        for (const bool split : {false, true}) {
            const Figure f = figure(loops, how, split);
            const auto triangles = triangulate(plane_of(how), f.points, f.loops);
            expect_triangulation(f, triangles);
            const BluntPoints blunt(f.points);
            EXPECT_EQ(triangulate(PlaneProjection(plane_of(how), blunt), f.loops), triangles);
        }
    }
}

Loop square(std::int64_t x, std::int64_t y, std::int64_t size) {
    return {{x, y}, {x + size, y}, {x + size, y + size}, {x, y + size}};
}
Loop hole(Loop loop) {
    std::reverse(loop.begin(), loop.end());
    return loop;
}
Loop rotated(Loop loop, std::size_t by) {
    std::rotate(loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(by), loop.end());
    return loop;
}

TEST(Triangulate, Convex) {
    expect_triangulable({{{0, 0}, {4, 0}, {0, 3}}});
    expect_triangulable({square(0, 0, 5)});
    expect_triangulable({{{2, 0}, {4, 0}, {6, 2}, {6, 4}, {4, 6}, {2, 6}, {0, 4}, {0, 2}}});
}

// Corner i is (i, i²), and the last side closes the parabola.
Loop parabola(std::int64_t corners) {
    Loop loop;
    for (std::int64_t i = 0; i < corners; ++i) loop.push_back({i, i * i});
    return loop;
}

TEST(Triangulate, ConvexOutlineOfManyCornersHasFewTrianglesAtEach) {
    for (const std::int64_t n : {16, 17, 18, 19, 50, 1000}) {
        expect_triangulable({parabola(n)});
        const Figure f = figure({parabola(n)}, Placement::Flat, false);
        std::vector<int> uses(f.points.size(), 0);
        for (const auto& t : triangulate(plane_of(Placement::Flat), f.points, f.loops))
            for (const auto c : t) ++uses[c];
        if (n <= 16) continue;
        EXPECT_LE(*std::max_element(uses.begin(), uses.end()),
                  2 * std::ceil(std::log2(static_cast<double>(n))));
    }
}

TEST(Triangulate, StraightRunsUseEveryCorner) {
    const Loop triangle{{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}, {2, 2}, {0, 4}, {0, 3}, {0, 1}};
    for (std::size_t i = 0; i < triangle.size(); ++i) expect_triangulable({rotated(triangle, i)});
    expect_triangulable({{{0, 0}, {1, 0}, {2, 0}, {0, 2}}});
    Loop grid;
    for (std::int64_t i = 0; i < 9; ++i) grid.push_back({i, 0});
    for (std::int64_t i = 0; i < 9; ++i) grid.push_back({9, i});
    for (std::int64_t i = 9; i > 0; --i) grid.push_back({i, 9});
    for (std::int64_t i = 9; i > 0; --i) grid.push_back({0, i});
    expect_triangulable({grid});
}

TEST(Triangulate, ReflexOutlines) {
    const Loop ell{{0, 0}, {4, 0}, {4, 2}, {2, 2}, {2, 4}, {0, 4}};
    for (std::size_t i = 0; i < ell.size(); ++i) expect_triangulable({rotated(ell, i)});
    expect_triangulable({{{0, 0}, {9, 0}, {9, 9}, {8, 1}, {7, 9}, {6, 1}, {5, 9}, {4, 1}, {3, 9}}});
    expect_triangulable({{{0, 0}, {2, 1}, {4, 0}, {2, 5}}});
}

TEST(Triangulate, Spiral) {
    Loop outside;
    Loop inside;
    std::int64_t reach = 1;
    for (int i = 0; i < 60; ++i) {
        constexpr std::array<std::array<std::int64_t, 2>, 4> corner{
            {{1, -1}, {1, 1}, {-1, 1}, {-1, -1}}};
        const auto [x, y] = corner[static_cast<std::size_t>(i % 4)];
        outside.push_back({x * (reach + 1), y * (reach + 1)});
        inside.push_back({x * reach, y * reach});
        if (i % 4 == 3) reach += 2;
        if (i % 4 == 3) outside.back()[1] -= 2, inside.back()[1] -= 2;
    }
    outside.insert(outside.end(), inside.rbegin(), inside.rend());
    expect_triangulable({outside});
}

TEST(Triangulate, Holes) {
    expect_triangulable({square(0, 0, 9), hole(square(3, 3, 3))});
    expect_triangulable({square(0, 0, 9), hole(square(1, 1, 3)), hole(square(5, 5, 3)),
                         hole(square(1, 5, 3)), hole(square(5, 1, 3))});
    // A ring of walls around a hole in a hole's shadow.
    expect_triangulable(
        {square(0, 0, 20),
         hole({{4, 4}, {16, 4}, {16, 16}, {4, 16}, {4, 14}, {14, 14}, {14, 6}, {4, 6}}),
         hole(square(8, 8, 3))});
}

TEST(Triangulate, ManyHoles) {
    Loops loops{square(0, 0, 400)};
    for (std::int64_t i = 0; i < 20; ++i)
        for (std::int64_t j = 0; j < 20; ++j)
            loops.push_back(hole(square(20 * i + 5, 20 * j + 5, 9)));
    const Figure f = figure(loops, Placement::Sheared, false);
    expect_triangulation(f, triangulate(plane_of(Placement::Sheared), f.points, f.loops));
}

TEST(Triangulate, HoleTouchesTheOutlineInOneVertex) {
    expect_triangulable({square(0, 0, 8), hole({{0, 0}, {4, 2}, {2, 4}})});
    expect_triangulable({{{0, 0}, {4, 0}, {8, 0}, {8, 8}, {0, 8}}, hole({{4, 0}, {5, 3}, {3, 3}})});
}

TEST(Triangulate, HoleTouchesTheOutlineInTwoVerticesAndCutsIt) {
    expect_triangulable({square(0, 0, 8), hole({{0, 0}, {5, 3}, {8, 8}, {3, 5}})});
    expect_triangulable(
        {square(0, 0, 8), hole({{0, 0}, {8, 8}, {3, 5}}), hole({{1, 5}, {2, 6}, {1, 6}})});
}

TEST(Triangulate, HolesTouchEachOther) {
    expect_triangulable({square(0, 0, 12), hole(square(2, 2, 3)), hole(square(5, 5, 3))});
    // A closed chain of four holes leaves an island.
    expect_triangulable({square(0, 0, 12), hole({{2, 6}, {5, 8}, {6, 10}}),
                         hole({{6, 10}, {7, 8}, {10, 6}}), hole({{10, 6}, {7, 4}, {6, 2}}),
                         hole({{6, 2}, {5, 4}, {2, 6}})});
}

TEST(Triangulate, OutlineTouchesItself) {
    // Two squares that meet in a corner, as one loop in either way of passing it.
    expect_triangulable({{{0, 0}, {4, 0}, {4, 4}, {8, 4}, {8, 8}, {4, 8}, {4, 4}, {0, 4}}});
    // A hole tied to the outline in a vertex, as one loop.
    expect_triangulable({{{0, 0}, {8, 0}, {8, 8}, {0, 8}, {0, 0}, {2, 4}, {4, 2}}});
    // A slit: the outline walks to a hole and back.
    expect_triangulable(
        {{{0, 0}, {9, 0}, {9, 9}, {0, 9}, {0, 0}, {3, 3}, {3, 6}, {6, 6}, {6, 3}, {3, 3}}});
}

TEST(Triangulate, Polygon1000) {
    Loop loop;
    std::mt19937_64 random(3);
    for (int i = 0; i < 1000; ++i) {
        const double angle = 2 * std::numbers::pi * i / 1000;
        const double r = 1e6 + static_cast<double>(random() % 900000);
        loop.push_back({std::llround(r * std::cos(angle)), std::llround(r * std::sin(angle))});
    }
    expect_triangulable({loop});
}

TEST(Triangulate, FullWidthCoordinates) {
    constexpr std::int64_t L = (std::int64_t{1} << 52) - 1;
    // Nearly straight: the middle corners are off the line by less than a double can tell.
    const Loops loops{{{-L, -L}, {0, 0}, {L, L - 1}, {L, L}, {1, 2}, {0, 1}}};
    for (const bool split : {false, true}) {
        const Figure f = figure(loops, Placement::Flat, split);
        expect_triangulation(f, triangulate(plane_of(Placement::Flat), f.points, f.loops));
    }
}

// The plane x + y + z = 1 cut by planes through the origin's neighbourhood: no corner is a lattice
// point, three of them lie on one line, and no area may be lost.
TEST(Triangulate, PlanePoints) {
    const Plane support(3, 5, 7, Plane::Coefficient(-11));
    const auto at = [&](std::int64_t x, std::int64_t y) {  // the point over (x/13, y/17)
        return Point(support, Plane(13, 0, 0, Plane::Coefficient(-x)),
                     Plane(0, 17, 0, Plane::Coefficient(-y)));
    };
    const std::vector<std::array<std::int64_t, 2>> flat{{0, 0},   {10, 0},  {20, 0}, {30, 0},
                                                        {30, 30}, {15, 15}, {0, 30}};
    std::vector<Point> points;
    std::vector<std::vector<std::uint32_t>> loops(1);
    for (const auto& p : flat) {
        loops[0].push_back(static_cast<std::uint32_t>(points.size()));
        points.push_back(at(p[0], p[1]));
    }
    const Figure f{flat, points, loops};
    expect_triangulation(f, triangulate(support, points, loops));
}

TEST(Triangulate, RandomFiguresOfUnitSquares) {
    // Unions of unit squares on a small board, traced along their boundary: plenty of holes, shared
    // vertices and straight runs.
    std::mt19937 random(11);
    for (int round = 0; round < 400; ++round) {
        constexpr int n = 9;
        const int squares = round % 2 == 0 ? 22 : 60;
        std::array<std::array<bool, n + 2>, n + 2> board{};
        std::vector<std::array<int, 2>> stack{{3, 3}};
        board[3][3] = true;
        for (int k = 0; k < squares; ++k) {  // grow one connected patch
            const auto at = stack[random() % stack.size()];
            const int dir = static_cast<int>(random() % 4);
            const int x = std::clamp(at[0] + (dir == 0) - (dir == 1), 1, n);
            const int y = std::clamp(at[1] + (dir == 2) - (dir == 3), 1, n);
            if (!board[static_cast<std::size_t>(x)][static_cast<std::size_t>(y)])
                stack.push_back({x, y});
            board[static_cast<std::size_t>(x)][static_cast<std::size_t>(y)] = true;
        }
        std::multimap<std::array<std::int64_t, 2>, std::array<std::int64_t, 2>> edges;
        const auto filled = [&](int x, int y) {
            return board[static_cast<std::size_t>(x)][static_cast<std::size_t>(y)];
        };
        for (int x = 1; x <= n; ++x) {
            for (int y = 1; y <= n; ++y) {
                if (!filled(x, y)) continue;
                if (!filled(x, y - 1)) edges.insert({{x, y}, {x + 1, y}});
                if (!filled(x + 1, y)) edges.insert({{x + 1, y}, {x + 1, y + 1}});
                if (!filled(x, y + 1)) edges.insert({{x + 1, y + 1}, {x, y + 1}});
                if (!filled(x - 1, y)) edges.insert({{x, y + 1}, {x, y}});
            }
        }
        Loops loops;
        while (!edges.empty()) {
            loops.emplace_back();
            auto e = edges.begin();
            const auto start = e->first;
            std::array<std::int64_t, 2> at = start;
            do {
                auto out = edges.find(at);
                if (edges.count(at) > 1 && random() % 2 == 0) ++out;
                loops.back().push_back(at);
                at = out->second;
                edges.erase(out);
            } while (at != start);
        }
        expect_triangulable(loops);
    }
}

// Large figures of the kinds that are quadratic for ears, bridges or sweeps along one axis.
void expect_large(const Loops& loops) {
    for (const Placement how : {Placement::Flat, Placement::Upright, Placement::Sheared}) {
        const Figure f = figure(loops, how, false);
        expect_triangulation(f, triangulate(plane_of(how), f.points, f.loops));
    }
}

Loop turned_left(Loop loop) {
    for (auto& p : loop) p = {-p[1], p[0]};
    return loop;
}

TEST(Triangulate, CombOfManyTeeth) {
    Loop comb;
    constexpr std::int64_t n = 5000;
    comb.push_back({2 * n, -7});
    for (std::int64_t i = n; i > 0; --i) {
        comb.push_back({2 * i, 100 + i % 3});
        comb.push_back({2 * i - 1, i % 2});
    }
    comb.push_back({0, -7});
    expect_large({comb});
    expect_large({turned_left(comb)});
    expect_large({turned_left(turned_left(comb))});
}

TEST(Triangulate, SpiralOfManyTurns) {
    Loop outside;
    Loop inside;
    constexpr std::array<std::array<std::int64_t, 2>, 4> corner{
        {{1, -1}, {1, 1}, {-1, 1}, {-1, -1}}};
    std::int64_t reach = 1;
    for (std::size_t i = 0; i < 8000; ++i) {
        const auto [x, y] = corner[i % 4];
        outside.push_back({x * (reach + 1), y * (reach + 1)});
        inside.push_back({x * reach, y * reach});
        if (i % 4 == 3) reach += 2;
        if (i % 4 == 3) outside.back()[1] -= 2, inside.back()[1] -= 2;
    }
    outside.insert(outside.end(), inside.rbegin(), inside.rend());
    expect_large({outside});
}

TEST(Triangulate, StarOfManyPoints) {
    Loop star;
    constexpr int n = 10000;
    for (int i = 0; i < n; ++i) {
        const double angle = 2 * std::numbers::pi * i / n;
        const double r = i % 2 == 0 ? 1e9 : 1e6;
        star.push_back({std::llround(r * std::cos(angle)), std::llround(r * std::sin(angle))});
    }
    expect_large({star});
}

// Corners on lattice points next to the circle: nearly straight everywhere, reflex here and there.
TEST(Triangulate, CircleOfAHundredThousandCornersWithAThousandHoles) {
    Loop circle;
    constexpr int n = 100000;
    constexpr double r = 1e8;
    for (int i = 0; i < n; ++i) {
        const double angle = 2 * std::numbers::pi * i / n;
        circle.push_back({std::llround(r * std::cos(angle)), std::llround(r * std::sin(angle))});
    }
    Loops loops{circle};
    for (std::int64_t i = 0; i < 32; ++i)
        for (std::int64_t j = 0; j < 32; ++j)
            loops.push_back(hole(square(4000000 * (i - 16) + 5, 4000000 * (j - 16) + 7 * i, 9999)));
    const Figure f = figure(loops, Placement::Sheared, false);
    const auto triangles = triangulate(plane_of(Placement::Sheared), f.points, f.loops);
    EXPECT_EQ(triangles.size(), f.points.size() - 2 + 2 * 1024);
    expect_triangulation(f, triangles);
}

TEST(Triangulate, TenThousandHolesInRowsAndColumns) {
    Loops loops{square(0, 0, 2000)};
    for (std::int64_t i = 0; i < 100; ++i)
        for (std::int64_t j = 0; j < 100; ++j)
            loops.push_back(hole(square(20 * i + 5, 20 * j + 5, 9)));
    expect_large(loops);
}

TEST(Triangulate, RowsOfHolesThatTouch) {
    // Every hole touches its neighbours in corners, the first and the last one touch the outline.
    Loop outline{{0, 0}};
    Loops holes;
    for (std::int64_t row = 1; row <= 40; ++row) {
        outline.push_back({800, 20 * row});
        for (std::int64_t i = 0; i < 40; ++i)
            holes.push_back(hole({{20 * i, 20 * row},
                                  {20 * i + 10, 20 * row - 5},
                                  {20 * i + 20, 20 * row},
                                  {20 * i + 10, 20 * row + 5}}));
    }
    outline.push_back({800, 900});
    outline.push_back({0, 900});
    for (std::int64_t row = 40; row >= 1; --row) outline.push_back({0, 20 * row});
    outline.insert(outline.begin() + 1, {800, 0});
    Loops loops{outline};
    loops.insert(loops.end(), holes.begin(), holes.end());
    expect_large(loops);
}

TEST(Triangulate, ManyOutlinesInHolesOfEachOther) {
    Loops loops;
    for (std::int64_t i = 0; i < 200; ++i) {
        loops.push_back(square(4 * i, 4 * i, 4000 - 8 * i));
        loops.push_back(hole(square(4 * i + 2, 4 * i + 2, 4000 - 8 * i - 4)));
    }
    expect_large(loops);
}

// What the precondition forbids ends in an error or in triangles of no use, and in nothing worse.
TEST(Triangulate, LoopsThatOverlapAreRefusedOrSurvived) {
    const Figure overlapping =
        figure({{{0, 0}, {10, 0}, {10, 1}, {0, 1}}, {{3, 0}, {7, 0}, {7, 2}, {3, 2}}},
               Placement::Flat, true);
    EXPECT_THROW(
        (void)triangulate(plane_of(Placement::Flat), overlapping.points, overlapping.loops), Error);
    std::mt19937 random(27);
    std::uniform_int_distribution<std::int64_t> at(0, 5);
    std::uniform_int_distribution<int> corners(3, 8);
    int refused = 0;
    for (int i = 0; i < 3000; ++i) {
        Loops loops(static_cast<std::size_t>(1 + i % 3));
        for (Loop& loop : loops)
            for (int k = corners(random); k > 0; --k) loop.push_back({at(random), at(random)});
        const Figure any = figure(loops, Placement::Flat, i % 2 == 0);
        try {
            (void)triangulate(plane_of(Placement::Flat), any.points, any.loops);
        } catch (const Error&) {
            ++refused;
        }
    }
    EXPECT_GT(refused, 1000);
}

}  // namespace
}  // namespace triangulate_test

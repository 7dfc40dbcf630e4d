// SPDX-License-Identifier: Apache-2.0
//
// Two meshes of which only the facets that come near the other one are divided
// (two_meshes_without_tree.h), against a tree of cells: the same mesh, corner by corner.

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include <trisect/brep/primitives/sphere.h>
#include <trisect/bsp/cells/lazy_tree.h>

#include "engines.h"

namespace undivided_test {
namespace {

using engines::evaluate_by_cells;
using reference::Operand;

struct Count {
    int tried = 0;
    int undivided = 0;
};

void expect_same_as_divided(const trisect::Expression& expression, std::uint32_t leaf_polygons,
                            Count& count) {
    trisect::EvaluateOptions options;
    options.leaf_polygons = leaf_polygons;
    options.threads = 1;
    const auto difference = engines::undivided_difference(expression, options);
    ++count.tried;
    count.undivided += difference ? 1 : 0;
    EXPECT_EQ(difference.value_or(""), "");
}

void expect_all_same(const trisect::Solid& a, const trisect::Solid& b, std::uint32_t leaf,
                     Count& count) {
    const trisect::Expression p = a;
    const trisect::Expression q = b;
    for (const trisect::Expression& e :
         {p | q, p & q, p - q, q - p, ~p | q, ~(p | q), ~p & ~q, ~(p - q)})
        expect_same_as_divided(e, leaf, count);
}

trisect::Solid solid(const Operand& operand) {
    return engines::solid(operand, trisect::Embedding::Assume);
}

// Moved along an axis, and out of all symmetry with the one that was not.
trisect::PolygonMesh moved_sphere(std::uint32_t subdivisions, std::size_t axis) {
    trisect::PolygonMesh out = trisect::make_icosphere(1, subdivisions);
    for (auto& p : out.points) {
        p[axis] += 0.73;
        p[(axis + 1) % 3] *= 0.81;
        p[(axis + 2) % 3] += 0.11 * p[axis] + 0.03;
    }
    return out;
}

TEST(Undivided, PairsInGeneralPosition) {
    Count count;
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        reference::Random random(seed + 510000);
        expect_all_same(solid(engines::mapped(reference::random_embedded_solid(random), random)),
                        solid(engines::mapped(reference::random_embedded_solid(random), random)),
                        seed % 2 == 0 ? 4 : 30, count);
    }
    EXPECT_GT(count.undivided, 200);
}

// Rings of long thin facets, and fans of such at both ends or in an apex.
Operand round_body(std::size_t kind, int corners, std::int64_t radius) {
    reference::LatticePolygon polygon;
    for (int i = 0; i < corners; ++i) {
        const double r = static_cast<double>(radius) * (kind == 2 && i % 2 == 1 ? 0.8 : 1.0);
        const double angle = 2 * 3.14159265358979 * i / corners;
        polygon.push_back({std::llround(r * std::cos(angle)), std::llround(r * std::sin(angle))});
    }
    if (kind == 1) return reference::pyramid(polygon, -2 * radius, {radius / 9, 7, 2 * radius});
    return reference::prism(polygon, -2 * radius, 2 * radius);
}

// Turned any way, their boxes say little about where they are.
TEST(Undivided, LongFacets) {
    Count count;
    for (std::uint64_t seed = 1; seed <= 30; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        reference::Random random(seed + 540000);
        const auto body = [&](std::size_t kind) {
            return solid(engines::mapped(round_body(kind, 40, 2000), random));
        };
        const trisect::Expression a = body(seed % 3);
        const trisect::Expression b = body(seed / 3 % 3);
        for (const trisect::Expression& e : {a | b, a & b, b - a})
            expect_same_as_divided(e, seed % 2 == 0 ? 8 : 40, count);
    }
    EXPECT_GT(count.undivided, 80);
}

// Fans in one plane, cut differently.
TEST(Undivided, LongFacetsInSpecialPosition) {
    Count count;
    const std::array<reference::LatticePoint, 6> moves{
        {{0, 0, 4000}, {1000, 0, 0}, {0, 0, 0}, {700, 300, 0}, {0, 500, 1000}, {2000, 0, 4000}}};
    for (std::size_t kind = 0; kind < 3; ++kind)
        for (const reference::LatticePoint& by : moves)
            for (std::size_t turns = 0; turns < 2; ++turns) {
                const Operand body = round_body(kind, 24, 1000);
                Operand other = body;
                for (auto& triangle : other)
                    for (auto& p : triangle)
                        if (turns == 1) p = {-p[0], -p[1], p[2]};
                const trisect::Expression a = solid(body);
                const trisect::Expression b = solid(reference::translated(other, by));
                for (const trisect::Expression& e : {a | b, a & b, b - a})
                    expect_same_as_divided(e, 10, count);
            }
    EXPECT_GT(count.undivided, 60);
}

// A body of several parts, some of which lie within the other body, or where it does not come.
TEST(Undivided, PartsThatNothingCrosses) {
    Count count;
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        reference::Random random(seed + 530000);
        Operand parts = reference::random_embedded_solid(random);
        for (const std::int64_t x : {-3000, 3000})
            for (auto triangle : reference::random_embedded_solid(random)) {
                for (auto& p : triangle) p[0] += x;
                parts.push_back(triangle);
            }
        Operand other = reference::box({-100, -100, -100}, {101, 103, 2});
        for (auto& triangle : other)
            for (auto& p : triangle) p[0] += p[1] / 7;
        expect_all_same(solid(parts), solid(engines::mapped(other, random)), 10, count);
    }
    EXPECT_GT(count.tried, 0);
    EXPECT_EQ(count.undivided, count.tried);
    RecordProperty("undivided", count.undivided);
}

TEST(Undivided, LargeMeshesByAnyNumberOfThreads) {
    for (std::size_t k = 0; k < 3; ++k) {
        const trisect::PolygonMesh moved = moved_sphere(5, k);
        trisect::SolidOptions import;
        import.import.lattice = trisect::Lattice{-40};
        const trisect::Solid a = trisect::Solid::from_mesh(trisect::make_icosphere(1, 5), import);
        const trisect::Solid b = trisect::Solid::from_mesh(moved, import);
        trisect::EvaluateOptions options;
        const trisect::Solid divided = evaluate_by_cells(a - b, options);
        ASSERT_EQ(trisect::detail::state_of(divided)->lazy_tree(), nullptr);
        const trisect::PolygonMesh expected = engines::boundary_mesh(divided);
        for (const std::uint32_t threads : {1U, 2U, 8U}) {
            options.threads = threads;
            const trisect::Solid result = trisect::evaluate(a - b, options);
            ASSERT_NE(trisect::detail::state_of(result)->lazy_tree(), nullptr);
            const trisect::PolygonMesh mesh = engines::boundary_mesh(result);
            EXPECT_EQ(engines::open_edge(mesh), "");
            EXPECT_FALSE(trisect::detail::state_of(result)->lazy_tree()->is_cut());
            EXPECT_EQ(mesh.corners, expected.corners);
            EXPECT_TRUE(mesh.points == expected.points);
        }
        const trisect::Solid result = trisect::evaluate(a - b, options);
        EXPECT_EQ(engines::boundary_mesh(trisect::evaluate(result | b)).corners,
                  engines::boundary_mesh(trisect::evaluate(divided | b)).corners);
        EXPECT_EQ(result.to_brep().counts().faces, divided.to_brep().counts().faces);
    }
}

// Files seldom have coordinates of the same fineness.
TEST(Undivided, MeshesOfDifferentLattices) {
    const trisect::PolygonMesh moved = moved_sphere(4, 0);
    const auto on_lattice = [](const trisect::PolygonMesh& mesh, int exponent) {
        trisect::SolidOptions import;
        import.import.lattice = trisect::Lattice{exponent};
        return trisect::Solid::from_mesh(mesh, import);
    };
    trisect::PolygonMesh rounded = trisect::make_icosphere(1, 4);
    for (auto& p : rounded.points)
        for (double& c : p) c = std::ldexp(std::nearbyint(std::ldexp(c, 32)), -32);
    // Meshes of a result come in the order in which they were imported.
    const trisect::Solid coarse = on_lattice(rounded, -32);
    const trisect::Solid fine = on_lattice(rounded, -40);
    const trisect::Solid b = on_lattice(moved, -40);
    const trisect::Solid mixed = trisect::evaluate(coarse - b);
    EXPECT_NE(trisect::detail::state_of(mixed)->lazy_tree(), nullptr);
    const trisect::PolygonMesh mesh = engines::boundary_mesh(mixed);
    const trisect::PolygonMesh expected = engines::boundary_mesh(evaluate_by_cells(fine - b));
    EXPECT_EQ(mesh.corners, expected.corners);
    EXPECT_TRUE(mesh.points == expected.points);
    EXPECT_NE(trisect::detail::state_of(trisect::evaluate(b - coarse))->lazy_tree(), nullptr);
    EXPECT_NE(trisect::detail::state_of(trisect::evaluate(~coarse | ~b))->lazy_tree(), nullptr);
}

// Who has an index asks it, and who is so much larger gets one: the price of a small cut does not
// depend on the part.
bool is_undivided(const trisect::Expression& e) {
    return trisect::detail::state_of(trisect::evaluate(e))->lazy_tree() != nullptr;
}

TEST(Undivided, NotWhereOneMeshIsIndexed) {
    trisect::SolidOptions import;
    import.import.lattice = trisect::Lattice{-40};
    const trisect::Solid b = trisect::Solid::from_mesh(moved_sphere(4, 0), import);
    const trisect::Solid larger = trisect::Solid::from_mesh(trisect::make_icosphere(1, 5), import);
    EXPECT_TRUE(is_undivided(larger - b));
    EXPECT_TRUE(is_undivided(larger - b));
    const trisect::Solid same = trisect::Solid::from_mesh(trisect::make_icosphere(1, 4), import);
    EXPECT_TRUE(is_undivided(same - b));
    same.refine();
    EXPECT_FALSE(is_undivided(same - b));
}

// Sixteen times as many facets are looked at once; the second time they get an index. Where they
// are many, the first time.
TEST(Undivided, OnceWhereOneMeshIsMuchLarger) {
    trisect::SolidOptions import;
    import.import.lattice = trisect::Lattice{-40};
    const trisect::Solid b = trisect::Solid::from_mesh(moved_sphere(3, 0), import);
    const trisect::Solid larger = trisect::Solid::from_mesh(trisect::make_icosphere(1, 5), import);
    EXPECT_TRUE(is_undivided(larger - b));
    EXPECT_FALSE(is_undivided(larger - b));
    const trisect::Solid large = trisect::Solid::from_mesh(trisect::make_icosphere(1, 6), import);
    EXPECT_FALSE(is_undivided(large - b));
}

// A tool that is flush with a part on both of its sides, or on all: no shift uncovers all that they
// share, growth does. The same with coordinates behind the point.
TEST(Undivided, ToolsThatAreFlushOnOppositeSides) {
    Count count;
    const Operand part = reference::box({0, 0, 0}, {900, 700, 100});
    const std::array<std::array<reference::LatticePoint, 2>, 4> tools{
        {{{{100, 100, 0}, {300, 350, 100}}},
         {{{0, 100, 0}, {900, 350, 100}}},
         {{{0, 0, 0}, {900, 700, 100}}},
         {{{0, 300, 0}, {450, 700, 100}}}}};
    for (std::uint64_t seed = 0; seed < 8; ++seed)
        for (const auto& [low, high] : tools) {
            const auto moved = [&](Operand o) {
                if (seed == 0) return o;
                reference::Random random(seed);
                return engines::mapped(o, random);
            };
            const trisect::Expression a = solid(moved(part));
            const trisect::Expression b = solid(moved(reference::box(low, high)));
            for (const trisect::Expression& e : {a | b, a & b, a - b, b - a})
                expect_same_as_divided(e, 4, count);
        }
    EXPECT_EQ(count.undivided, count.tried);
}

TEST(Undivided, SpecialPositionOfCoordinatesWithFractions) {
    int wide = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        trisect::PolygonMesh sphere = trisect::make_icosphere(0.1, 3);
        for (auto& p : sphere.points) p[(k + 1) % 3] += 1000.1;
        trisect::PolygonMesh moved = sphere;
        for (auto& p : moved.points) p[k] += std::ldexp(1.0, -5);
        const trisect::Solid a = trisect::Solid::from_mesh(sphere);
        const trisect::Solid b = trisect::Solid::from_mesh(moved);
        wide += trisect::detail::state_of(a)->whole ? 0 : 1;
        for (const trisect::Expression& e :
             {trisect::Expression(a) | b, trisect::Expression(a) & b, trisect::Expression(a) - b}) {
            const trisect::Solid result = trisect::evaluate(e);
            ASSERT_NE(trisect::detail::state_of(result)->lazy_tree(), nullptr);
            const trisect::PolygonMesh mesh = engines::boundary_mesh(result);
            EXPECT_EQ(engines::open_edge(mesh), "");
            EXPECT_FALSE(trisect::detail::state_of(result)->lazy_tree()->is_cut());
            const trisect::PolygonMesh expected = engines::boundary_mesh(evaluate_by_cells(e));
            EXPECT_EQ(mesh.points.size(), expected.points.size());
            EXPECT_TRUE(trisect::evaluate(trisect::Expression(result) ^
                                          trisect::evaluate(e, {.leaf_polygons = 3}))
                            .is_empty());
        }
    }
    EXPECT_EQ(wide, 3);
}

// Faces, edges and corners coincide.
TEST(Undivided, PairsOnASmallGrid) {
    Count count;
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        reference::Random random(seed + 520000);
        expect_all_same(solid(reference::random_embedded_solid(random)),
                        solid(reference::random_embedded_solid(random)), 10, count);
    }
    EXPECT_GT(count.tried, 0);
    EXPECT_EQ(count.undivided, count.tried);
    RecordProperty("undivided", count.undivided);
}

}  // namespace
}  // namespace undivided_test

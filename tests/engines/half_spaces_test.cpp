// SPDX-License-Identifier: Apache-2.0
//
// Solids on a small grid cut by half-spaces through their vertices, edges and faces, and through
// anything else, against the naive engine: there a half-space is a pyramid whose base lies in its
// plane, and which is far larger than what it cuts.

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid.h>
#include <trisect/kernel/stop_scope.h>

#include "engines.h"
#include "evaluate_stats.h"

namespace half_spaces_test {
namespace {

using reference::LatticePoint;
using reference::Operand;
using Kind = reference::Expression::Kind;

LatticePoint cross(const LatticePoint& a, const LatticePoint& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// What lies below the plane with this normal through a point, for both engines.
struct HalfSpace {
    LatticePoint normal;
    LatticePoint through;

    [[nodiscard]] trisect::Solid solid() const {
        std::int64_t offset = 0;
        for (std::size_t k = 0; k < 3; ++k) offset -= normal[k] * through[k];
        return trisect::Solid::half_space(
            trisect::Plane(normal[0], normal[1], normal[2], trisect::Plane::Coefficient(offset)),
            {});
    }
    [[nodiscard]] Operand pyramid() const {
        constexpr std::int64_t far = 100'000;
        const LatticePoint u = normal[0] == 0 && normal[1] == 0
                                   ? LatticePoint{1, 0, 0}
                                   : LatticePoint{normal[1], -normal[0], 0};
        const LatticePoint v = cross(normal, u);
        const auto at = [&](std::int64_t along_u, std::int64_t along_v, std::int64_t up) {
            LatticePoint p = through;
            for (std::size_t k = 0; k < 3; ++k)
                p[k] += far * (along_u * u[k] + along_v * v[k] + up * normal[k]);
            return p;
        };
        const std::array base{at(-1, -1, 0), at(1, -1, 0), at(1, 1, 0), at(-1, 1, 0)};
        const LatticePoint apex = at(0, 0, -1);
        Operand out{{base[0], base[1], base[2]}, {base[0], base[2], base[3]}};
        for (std::size_t i = 0; i < 4; ++i) out.push_back({base[(i + 1) % 4], base[i], apex});
        return out;
    }
};

LatticePoint corner_of(const Operand& solid, reference::Random& random) {
    return solid[random.below(solid.size())][random.below(3)];
}

// Through three corners of the solid, two or one, or near one.
HalfSpace half_space_for(const Operand& solid, reference::Random& random) {
    const auto small = [&] {
        LatticePoint n{random.between(-3, 3), random.between(-3, 3), random.between(-3, 3)};
        if (n == LatticePoint{0, 0, 0}) n[random.below(3)] = 1;
        return n;
    };
    const auto way = [](const LatticePoint& a, const LatticePoint& b) {
        return LatticePoint{b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    };
    const LatticePoint a = corner_of(solid, random);
    LatticePoint n = small();
    LatticePoint through = a;
    switch (random.below(8)) {
        case 0:
            n = cross(way(a, corner_of(solid, random)), way(a, corner_of(solid, random)));
            break;
        case 1:
            n = cross(way(a, corner_of(solid, random)), n);
            break;
        case 2:
            break;
        default:
            for (std::int64_t& c : through) c += random.between(-4, 4);
            break;
    }
    if (n == LatticePoint{0, 0, 0}) n = small();
    if (random.chance(1, 2))
        for (std::int64_t& c : n) c = -c;
    return {n, through};
}

struct Counts {
    std::uint64_t cuts = 0;  // without a tree
    std::uint64_t leaves = 0;
    std::uint64_t plain = 0;
};

// Evaluates a formula as it comes, and by cells of several sizes.
void expect_agreement(const std::vector<Operand>& operands,
                      const std::vector<trisect::Solid>& solids,
                      const reference::Expression& formula, Counts& counts) {
    const auto expected =
        reference::canonical_boundary(reference::evaluate(operands, formula).cells);
    std::vector<trisect::PolygonMesh> meshes;
    constexpr std::uint32_t whole = 0;
    const std::uint32_t usual = trisect::EvaluateOptions().leaf_polygons;
    for (const std::uint32_t leaf : {whole, usual, 4U, 30U}) {
        trisect::EvaluateOptions options;
        options.threads = 1;
        if (leaf != whole) options.leaf_polygons = leaf;
        trisect::test::EvaluateStats stats;
        const auto evaluated = [&] {
            if (leaf == whole) return evaluate(engines::formula(formula, solids), options, &stats);
            const trisect::StopScope scope({.max_work = std::uint64_t{1} << 60});
            return evaluate(engines::formula(formula, solids), options, &stats);
        };
        const trisect::Solid result = evaluated();
        counts.cuts += stats.half_space_cuts;
        counts.leaves += stats.mixed_leaves;
        counts.plain += stats.filtered_leaves;
        EXPECT_EQ(engines::difference(result.to_brep(), expected), "");
        meshes.push_back(engines::boundary_mesh(result));
        EXPECT_EQ(engines::open_edge(meshes.back()), "");
    }
    EXPECT_EQ(meshes[0].corners, meshes[1].corners);
    EXPECT_TRUE(meshes[0].points == meshes[1].points);
}

reference::Expression leaf(std::size_t i) { return reference::Expression::leaf(i); }
reference::Expression node(Kind kind, std::vector<reference::Expression> children) {
    return reference::Expression::node(kind, std::move(children));
}

void expect_all(std::uint64_t seed, bool mapped, Counts& counts) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    reference::Random random(seed);
    const auto solid = [&] {
        const Operand grid = reference::random_embedded_solid(random);
        return mapped ? engines::mapped(grid, random) : grid;
    };
    std::vector<Operand> operands{solid(), solid()};
    std::vector<trisect::Solid> solids;
    for (const Operand& o : operands)
        solids.push_back(engines::solid(o, trisect::Embedding::Assume));
    for (std::size_t i = 0; i < 2; ++i) {
        HalfSpace h = half_space_for(operands[0], random);
        // Now and then the second one is parallel to the first.
        operands.push_back(h.pyramid());
        solids.push_back(h.solid());
        if (i == 0 && random.chance(1, 3)) {
            h.through = corner_of(operands[0], random);
            h.through[random.below(3)] += random.between(-3, 3);
            operands.push_back(h.pyramid());
            solids.push_back(h.solid());
            break;
        }
    }
    const std::vector<reference::Expression> formulas{
        node(Kind::Intersection, {leaf(0), leaf(2)}),
        node(Kind::Difference, {leaf(0), leaf(2)}),
        node(Kind::Intersection, {leaf(0), leaf(2), leaf(3)}),
        node(Kind::Difference, {node(Kind::Intersection, {leaf(0), leaf(2)}), leaf(3)}),
        node(Kind::Intersection, {node(Kind::Union, {leaf(0), leaf(1)}), leaf(2)}),
        node(Kind::Difference, {node(Kind::Xor, {leaf(0), leaf(1)}), leaf(3)}),
        node(Kind::Intersection,
             {leaf(0), node(Kind::Union, {leaf(2), node(Kind::Complement, {leaf(3)})})}),
    };
    for (std::size_t i = 0; i < formulas.size(); ++i) {
        SCOPED_TRACE("formula " + std::to_string(i));
        expect_agreement(operands, solids, formulas[i], counts);
    }
    // Step by step: what a half-space leaves is cut by the next one, and by a mesh.
    const trisect::Solid part = evaluate(engines::formula(formulas[0], solids));
    std::vector<trisect::Solid> steps{part, solids[1], part, solids[3]};
    SCOPED_TRACE("steps");
    expect_agreement(operands, steps, formulas[2], counts);
    expect_agreement(
        operands, {part, solids[1], solids[2], solids[3]},
        node(Kind::Difference, {node(Kind::Intersection, {leaf(0), leaf(2)}), leaf(1)}), counts);
}

TEST(HalfSpaces, ThroughVerticesEdgesAndFacesOfTheGrid) {
    Counts counts;
    for (std::uint64_t seed = 1; seed <= 60; ++seed) expect_all(830000 + seed, false, counts);
    EXPECT_GT(counts.cuts, 30U);
    EXPECT_GT(counts.plain, 300U);
    EXPECT_GT(counts.leaves - counts.plain, 300U);
}

TEST(HalfSpaces, OutOfTheGrid) {
    Counts counts;
    for (std::uint64_t seed = 1; seed <= 40; ++seed) expect_all(840000 + seed, true, counts);
    EXPECT_GT(counts.cuts, 30U);
    EXPECT_GT(counts.plain, 300U);
}

}  // namespace
}  // namespace half_spaces_test

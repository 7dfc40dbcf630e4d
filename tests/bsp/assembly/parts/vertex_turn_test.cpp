// SPDX-License-Identifier: Apache-2.0
//
// Turns of outlines by planes, against orientations of the exact vertices: of solids on a small
// grid, where faces coincide and many turns are none, and of turned boxes, whose sides are rounded
// to two nearly coplanar halves, so that many turns are too small for doubles.

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <vector>

#include <trisect/brep/planar_loops.h>
#include <trisect/brep/primitives/box.h>
#include <trisect/brep/transform.h>
#include <trisect/bsp/assembly/assembly_parts.h>
#include <trisect/bsp/assembly/joining/join_facets.h>
#include <trisect/bsp/assembly/parts/vertex_turn.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid.h>

#include "engines/engines.h"

namespace {

using trisect::AffineMap;
using trisect::PlaneProjection;
using trisect::Solid;
using trisect::detail::BoundaryEdge;
using trisect::detail::BoundaryEdges;
using trisect::detail::BoundaryFacet;
using trisect::detail::BoundaryParts;
using trisect::detail::Workbench;

struct Count {
    std::size_t turns = 0;
    std::size_t straight = 0;
    std::size_t named = 0;
    std::size_t uncertain = 0;  // which doubles cannot tell
};

void compare(const Workbench& bench, const BoundaryFacet& f, const BoundaryEdge& in,
             const BoundaryEdge& out, Count& count) {
    const auto axes = PlaneProjection::axes_of(bench.plane_at(f.support), f.flipped);
    const std::array vertices{in.from, in.to, out.to};
    const auto at = [&](std::size_t i) { return bench.homogeneous(vertices[i]); };
    const int expected = PlaneProjection::exact_orientation(at(0), at(1), at(2), axes);
    EXPECT_EQ(trisect::detail::turn_at_vertex(bench, f.support, f.flipped, in.line, out.line),
              expected);
    const bool named = trisect::detail::name_tells_turn(bench, in.to, f.support, in.line, out.line);
    if (named) {
        EXPECT_NE(expected, 0);
    }
    const auto near = [&](std::size_t i) { return bench.approximation(vertices[i]); };
    const bool sure = PlaneProjection::filtered_orientation(near(0), near(1), near(2), axes) != 0;
    count.turns += expected != 0;
    count.straight += expected == 0;
    count.named += named;
    count.uncertain += expected != 0 && !sure;
}

// All edges that follow each other, where one leaves a vertex of a facet.
void compare_all(const Solid& solid, Count& count) {
    BoundaryParts parts;
    trisect::detail::gather_parts(*trisect::detail::state_of(solid), parts, false);
    BoundaryEdges edges = parts.edges;
    trisect::detail::join_facets(parts, edges);
    for (std::size_t i = 0; i < edges.size();) {
        std::size_t end = i;
        while (end < edges.size() && edges[end].facet == edges[i].facet) ++end;
        for (std::size_t in = i; in < end; ++in) {
            std::size_t leaving = 0;
            std::size_t out = i;
            for (std::size_t k = i; k < end; ++k) {
                if (edges[k].from != edges[in].to) continue;
                out = k;
                ++leaving;
            }
            const auto& f = parts.facets[static_cast<std::size_t>(edges[in].facet)];
            if (leaving == 1) compare(parts.bench, f, edges[in], edges[out], count);
        }
        i = end;
    }
}

TEST(VertexTurn, SolidsOnTheSmallGrid) {
    Count count;
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        reference::Random random(seed + 770000);
        const auto operands = reference::random_family(random, 3, true);
        std::vector<Solid> solids;
        for (const auto& o : operands)
            solids.push_back(engines::solid(o, trisect::Embedding::Assume));
        compare_all(trisect::evaluate(trisect::Expression(solids[0]) | solids[1] | solids[2]),
                    count);
        compare_all(trisect::evaluate(trisect::Expression(solids[0]) - solids[1] - solids[2]),
                    count);
    }
    EXPECT_GT(count.turns, 2000U);
    EXPECT_GT(count.straight, 200U);
}

TEST(VertexTurn, SidesOfTurnedBoxes) {
    reference::Random random(780000);
    const auto number = [&](double low, double high) {
        return low + (high - low) * static_cast<double>(random.between(0, 1 << 20)) * 0x1p-20;
    };
    std::vector<Solid> boxes;
    for (std::size_t i = 0; i < 40; ++i) {
        const AffineMap turn =
            AffineMap::rotation({number(-1, 1), number(-1, 1), number(0.1, 1)}, number(10, 80));
        const AffineMap move = AffineMap::translation({number(0, 1), number(0, 1), number(0, 1)});
        boxes.push_back(Solid::from_mesh(trisect::transformed(
            trisect::make_box({-0.2, -0.2, -0.2}, {0.2, 0.2, 0.2}), compose(move, turn))));
    }
    trisect::Expression all(boxes[0]);
    for (std::size_t i = 1; i < boxes.size(); ++i) all = all | boxes[i];
    Count count;
    compare_all(trisect::evaluate(all), count);
    EXPECT_GT(count.turns, 1000U);
    EXPECT_GT(count.uncertain, 50U);
    EXPECT_GT(3 * count.named, count.turns);
}

}  // namespace

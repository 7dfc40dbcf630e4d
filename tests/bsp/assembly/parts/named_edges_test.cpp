// SPDX-License-Identifier: Apache-2.0
//
// Planes that pass through a point because edges cross there: what their names say is true, and is
// said of all four triples of planes that name such a point.

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <trisect/bsp/assembly/parts/named_edges.h>

#include "engines/engines.h"

namespace {

using trisect::detail::passes_by_edges;
using trisect::detail::PlaneId;
using trisect::detail::PlaneName;
using trisect::detail::PointId;
using trisect::detail::Source;
using trisect::detail::Workbench;

using SourcePtr = std::shared_ptr<const Source>;

SourcePtr source_of(const reference::Operand& operand) {
    return Source::make(engines::lattice_mesh(operand));
}

/// The planes of all facets and of all their edges.
std::vector<PlaneId> planes_of(const Source& source, Workbench& bench) {
    std::vector<PlaneId> planes;
    for (std::uint32_t f = 0; f < source.facet_count(); ++f) {
        planes.push_back(bench.plane(PlaneName::support(&source, f)));
        for (int i = 0; i < 3; ++i) planes.push_back(bench.plane(PlaneName::edge(&source, f, i)));
    }
    return planes;
}

TEST(NamedEdges, TwoEdgesThatCrossNameThePointInFourWays) {
    // The edge from (0, 0, 6) to (12, 0, 6) of one and that from (6, -6, 0) to (6, 6, 12) of the
    // other.
    const SourcePtr a =
        source_of(reference::tetrahedron({0, 0, 6}, {12, 0, 6}, {6, 7, 0}, {5, -7, 1}));
    const SourcePtr b =
        source_of(reference::tetrahedron({6, -6, 0}, {6, 6, 12}, {1, 1, 15}, {11, 2, 15}));
    const auto at_edge = [](const Source& s, std::array<int, 2> heights) {
        // Facets that have both corners with these third coordinates.
        std::vector<std::uint32_t> facets;
        for (std::uint32_t f = 0; f < s.facet_count(); ++f) {
            std::array<std::size_t, 2> found{};
            for (int i = 0; i < 3; ++i)
                for (std::size_t k = 0; k < 2; ++k)
                    if (s.corner(f, i).z == heights[k]) ++found[k];
            const bool has_edge =
                heights[0] == heights[1] ? found[0] == 2 : found[0] == 1 && found[1] == 1;
            if (has_edge) facets.push_back(f);
        }
        return facets;
    };
    const auto of_a = at_edge(*a, {6, 6});
    const auto of_b = at_edge(*b, {0, 12});
    ASSERT_EQ(of_a.size(), 2U);
    ASSERT_EQ(of_b.size(), 2U);
    Workbench bench;
    std::array<PlaneId, 4> planes{};
    for (std::size_t i = 0; i < 2; ++i) {
        planes[i] = bench.plane(PlaneName::support(a.get(), of_a[i]));
        planes[2 + i] = bench.plane(PlaneName::support(b.get(), of_b[i]));
    }
    for (std::size_t left_out = 0; left_out < 4; ++left_out) {
        const PointId p = bench.meet(planes[(left_out + 1) % 4], planes[(left_out + 2) % 4],
                                     planes[(left_out + 3) % 4]);
        EXPECT_TRUE(passes_by_edges(bench, p, planes[left_out]));
        EXPECT_EQ(bench.side(p, planes[left_out]), 0);
    }
}

TEST(NamedEdges, SolidsOfASmallGridAreNeverSaidToMeetWhereTheyDoNot) {
    reference::Random random(20261122);
    std::size_t said = 0;
    std::size_t on = 0;
    for (int round = 0; round < 40; ++round) {
        const SourcePtr a = source_of(reference::random_embedded_solid(random));
        const SourcePtr b = source_of(reference::random_embedded_solid(random));
        Workbench bench;
        const std::vector<PlaneId> first = planes_of(*a, bench);
        const std::vector<PlaneId> second = planes_of(*b, bench);
        const auto pick = [&](const std::vector<PlaneId>& planes) {
            return planes[random.below(planes.size())];
        };
        for (int i = 0; i < 4000; ++i) {
            // Two planes of one facet of a, or of two; one of b and another one of either.
            const PlaneId p = pick(first);
            const PlaneId q = pick(first);
            const PlaneId r = pick(second);
            if (!trisect::meet_in_a_point(bench.plane_at(p), bench.plane_at(q), bench.plane_at(r)))
                continue;
            const PlaneId asked = i % 2 == 0 ? pick(first) : pick(second);
            const PointId point = bench.meet(p, q, r);
            if (bench.is_corner(point)) continue;
            const bool passes = bench.side(point, asked) == 0;
            on += passes ? 1U : 0U;
            if (!passes_by_edges(bench, point, asked)) continue;
            ++said;
            EXPECT_TRUE(passes) << "round " << round << ", " << i;
        }
    }
    EXPECT_GT(said, 100U);
    EXPECT_GE(on, said);
}

}  // namespace

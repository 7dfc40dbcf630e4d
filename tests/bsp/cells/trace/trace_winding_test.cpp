// SPDX-License-Identifier: Apache-2.0
//
// Traces: the change of the winding number along a segment, or the admission that the segment runs
// through an edge, a vertex or along a face.

#include <gtest/gtest.h>

#include <trisect/bsp/cells/cell_tree.h>
#include <trisect/bsp/cells/trace/trace_winding.h>

#include "engines/engines.h"

namespace {

using reference::Operand;
using trisect::detail::CellNode;
using trisect::detail::FinePoint;
using trisect::detail::Source;
using trisect::detail::splitting_scale;

// All polygons of an operand in one leaf.
std::shared_ptr<const CellNode> leaf(const Operand& operand) {
    const auto source = Source::make(engines::lattice_mesh(operand));
    return CellNode::fresh(*source, FinePoint{}, 0, false);
}

// Positions in units of the lattice; multiples of 1/128.
FinePoint at(double x, double y, double z) {
    const auto fine = [](double v) {
        return static_cast<std::int64_t>(v * static_cast<double>(splitting_scale));
    };
    return {{fine(x), fine(y), fine(z)}};
}

std::optional<int> trace(const Operand& operand, const FinePoint& from, const FinePoint& to,
                         bool flipped = false) {
    const auto node = leaf(operand);
    const std::vector<trisect::detail::PolygonRef> refs(node->polygons().begin(),
                                                        node->polygons().end());
    return trisect::detail::trace_winding(refs, flipped, from, to);
}

const Operand cube = reference::box({0, 0, 0}, {4, 4, 4});
const FinePoint outside = at(-2, 1.25, 1.75);
const FinePoint inside = at(2, 1.25, 1.75);
const FinePoint beyond = at(6, 1.25, 1.75);

TEST(TraceWinding, EntersLeavesAndPassesThrough) {
    EXPECT_EQ(trace(cube, outside, inside), 1);
    EXPECT_EQ(trace(cube, inside, beyond), -1);
    EXPECT_EQ(trace(cube, outside, beyond), 0);
    EXPECT_EQ(trace(cube, outside, at(-2, 9, 9)), 0);
    EXPECT_EQ(trace(cube, inside, at(3, 2.5, 0.5)), 0);
}

TEST(TraceWinding, CountsInsideOutAndDoubledShells) {
    EXPECT_EQ(trace(reference::reversed(cube), outside, inside), -1);
    EXPECT_EQ(trace(cube, outside, inside, true), -1);
    EXPECT_EQ(trace(reference::concatenated(cube, cube), outside, inside), 2);
    EXPECT_EQ(trace(reference::concatenated(cube, reference::reversed(cube)), outside, inside), 0);
}

TEST(TraceWinding, NoPolygonsNoChange) { EXPECT_EQ(trace({}, outside, inside), 0); }

TEST(TraceWinding, AdmitsDegenerateSegments) {
    // Through the middle of the cube's edge x = 0, y = 0.
    EXPECT_EQ(trace(cube, at(-1, -1, 1.25), at(1, 1, 1.25)), std::nullopt);
    // Through the vertex at the origin.
    EXPECT_EQ(trace(cube, at(-1, -1, -1), at(1, 1, 1)), std::nullopt);
    // Along the face x = 0.
    EXPECT_EQ(trace(cube, at(0, -1, 1.25), at(0, 5, 2.25)), std::nullopt);
    // Through the diagonal of a face, where its two triangles meet.
    const auto diagonal = trace(cube, at(-1, 2, 2), at(1, 2, 2));
    EXPECT_TRUE(!diagonal || *diagonal == 1);
}

TEST(TraceWinding, IsNotMisledByPlanesCrossedBesideTheFace) {
    // Crosses the planes of three faces of the cube, none of them inside the face.
    EXPECT_EQ(trace(cube, at(-1, 5, 5.5), at(5, 9, -7)), 0);
}

TEST(TraceWinding, LongSegmentsFarFromTheOrigin) {
    const std::int64_t far = (std::int64_t{1} << 52) - 8;
    const Operand distant = reference::box({far, far, far}, {far + 4, far + 4, far + 4});
    const FinePoint target{{(far + 2) * splitting_scale, (far + 1) * splitting_scale + 34,
                            (far + 1) * splitting_scale + 98}};
    EXPECT_EQ(trace(distant, at(-2, 1.25, 1.75), target), 1);
}

// Against counting: boxes with corners on the lattice, points off it.
TEST(TraceWinding, RandomBoxesAreCounted) {
    reference::Random random(11);
    int degenerate = 0;
    for (int round = 0; round < 400; ++round) {
        Operand operand;
        std::vector<std::array<reference::LatticePoint, 2>> boxes;
        for (int i = 0; i < 4; ++i) {
            reference::LatticePoint low;
            reference::LatticePoint high;
            for (std::size_t k = 0; k < 3; ++k) {
                low[k] = random.between(0, 6);
                high[k] = low[k] + random.between(1, 5);
            }
            boxes.push_back({low, high});
            operand = reference::concatenated(std::move(operand), reference::box(low, high));
        }
        const auto random_point = [&] {
            FinePoint p;
            for (auto& c : p.c)
                c = random.between(-1, 12) * splitting_scale + 2 * random.between(1, 127);
            return p;
        };
        const auto winding = [&](const FinePoint& p) {
            int w = 0;
            for (const auto& [low, high] : boxes) {
                bool in = true;
                for (std::size_t k = 0; k < 3; ++k)
                    in = in && low[k] * splitting_scale < p.c[k] &&
                         p.c[k] < high[k] * splitting_scale;
                w += in ? 1 : 0;
            }
            return w;
        };
        const FinePoint from = random_point();
        const FinePoint to = random_point();
        const auto change = trace(operand, from, to);
        if (!change) {
            ++degenerate;
            continue;
        }
        EXPECT_EQ(*change, winding(to) - winding(from)) << "round " << round;
    }
    EXPECT_LT(degenerate, 40);
}

}  // namespace

// SPDX-License-Identifier: Apache-2.0
//
// What a large leaf's refinement promises: its leaves list the facets whose boxes meet their cells,
// and know a point with its winding number. And nobody sees whether a part was refined before.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/bsp/cells/cell_tree.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/cells/trace/trace_winding.h>
#include <trisect/bsp/divide/reference_points.h>
#include <trisect/bsp/divide/refine_leaf.h>
#include <trisect/bsp/expression.h>

#include "engines/evaluate_stats.h"

namespace {

using trisect::evaluate;
using trisect::EvaluateOptions;
using trisect::PolygonMesh;
using trisect::Solid;
using trisect::detail::Box;
using trisect::detail::Cell;
using trisect::detail::CellNode;
using trisect::detail::PolygonList;
using trisect::detail::PolygonRef;
using trisect::test::EvaluateStats;

// Of unequal density: the smaller ball has as many facets, so the frame of the whole is coarse for
// it.
PolygonMesh balls() {
    PolygonMesh all = trisect::make_icosphere(100'000, 4);
    const PolygonMesh small = trisect::make_icosphere(2, 4);
    const auto first = static_cast<std::uint32_t>(all.points.size());
    for (const auto& p : small.points) all.points.push_back({p[0] + 150'000, p[1], p[2]});
    for (std::size_t f = 0; f < small.face_count(); ++f) {
        const auto face = small.face(f);
        all.add_triangle(first + face[0], first + face[1], first + face[2]);
    }
    return all;
}

// A plate of n by n rectangles, cut along their diagonals, about the origin: the edges of one side
// are seen along z in the same lines as those of the other.
PolygonMesh plate(std::uint32_t n, double width, double depth) {
    PolygonMesh m;
    for (const double z : {0.0, -100.0})
        for (std::uint32_t i = 0; i <= n; ++i)
            for (std::uint32_t j = 0; j <= n; ++j)
                m.points.push_back({width * (i - 0.5 * n), depth * (j - 0.5 * n),
                                    z + static_cast<double>((7 * i + 5 * j) % 3)});
    const std::uint32_t below = (n + 1) * (n + 1);
    const auto at = [n](std::uint32_t i, std::uint32_t j) { return i * (n + 1) + j; };
    const auto square = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
        m.add_triangle(a, b, c);
        m.add_triangle(a, c, d);
    };
    for (std::uint32_t i = 0; i < n; ++i) {
        for (std::uint32_t j = 0; j < n; ++j) {
            square(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
            square(below + at(i, j), below + at(i, j + 1), below + at(i + 1, j + 1),
                   below + at(i + 1, j));
        }
        for (const auto& [a, b] : {std::pair{at(i, 0), at(i + 1, 0)},
                                   {at(i + 1, n), at(i, n)},
                                   {at(0, i + 1), at(0, i)},
                                   {at(n, i), at(n, i + 1)}})
            square(below + a, below + b, b, a);
    }
    return m;
}

class Refinement : public testing::Test {
protected:
    void check(const CellNode& node, const Cell& cell) {
        const CellNode* at = trisect::detail::unfolded(&node);
        if (at->is_leaf()) return check_leaf(*at, cell);
        check(*at->child(0).node, cell.below(at->axis(), at->splitter()));
        check(*at->child(1).node, cell.above(at->axis(), at->splitter()));
    }
    void check_leaf(const CellNode& leaf, const Cell& cell) {
        ++leaves_;
        largest_ = std::max(largest_, leaf.size());
        const PolygonList& list = leaf.polygons();
        std::set<std::uint32_t> listed;
        for (std::size_t i = 0; i < list.size(); ++i) {
            listed.insert(list[i].facet);
            EXPECT_EQ(cell.contains(list[i].box()), i < list.contained());
        }
        EXPECT_EQ(listed.size(), list.size());
        for (const PolygonRef& r : root_->polygons())
            EXPECT_EQ(cell.meets(r.box()), listed.contains(r.facet));
        EXPECT_TRUE(cell.contains(leaf.reference()));
        const auto change =
            trisect::detail::trace_winding(all_, false, root_->reference(), leaf.reference());
        EXPECT_EQ(root_->winding() + change.value_or(leaf.winding() - root_->winding()),
                  leaf.winding());
    }

    const CellNode* root_ = nullptr;
    std::vector<PolygonRef> all_;
    std::uint64_t largest_ = 0;
    std::size_t leaves_ = 0;
};

TEST_F(Refinement, LeavesListWhatMeetsTheirCells) {
    const Solid part = Solid::from_mesh(balls());
    part.refine(1);
    root_ = trisect::detail::state_of(part)->root().node.get();
    all_.assign(root_->polygons().begin(), root_->polygons().end());
    check(*root_, Cell{});
    EXPECT_GT(leaves_, 16U);
    EXPECT_LT(largest_, trisect::detail::refinable_leaf);
}

// A reference point above a diagonal cannot be moved along z past it: the cell of a quarter of the
// plate stayed whole, and a small cut in it took as long as all of it.
TEST_F(Refinement, PlatesOfSquaresAreDividedEverywhere) {
    for (const auto& [width, depth] :
         {std::pair{8.0, 8.0}, {8.0, -8.0}, {16.0, 8.0}, {8.0, 24.0}, {40.0, 8.0}}) {
        PolygonMesh mesh = plate(64, width, std::abs(depth));
        if (depth < 0)
            for (auto& p : mesh.points) p = {-p[1], p[0], p[2]};
        const Solid part = Solid::from_mesh(mesh);
        part.refine(1);
        root_ = trisect::detail::state_of(part)->root().node.get();
        all_.assign(root_->polygons().begin(), root_->polygons().end());
        largest_ = 0;
        check(*root_, Cell{});
        EXPECT_LT(largest_, trisect::detail::refinable_leaf) << width << " by " << depth;
    }
}

Solid less_boxes(const Solid& part, std::uint32_t threads, EvaluateStats& stats) {
    EvaluateOptions options;
    options.threads = threads;
    Solid rest = part;
    for (const double x : {99'000.0, -99'500.0, 151'999.0})
        rest = evaluate(rest - Solid::from_mesh(trisect::make_box({x - 2'000, -1'000, -900},
                                                                  {x + 2'000, 900, 1'000})),
                        options, &stats);
    return rest;
}

TEST(RefinementBefore, ChangesNoByteOfWhatFollows) {
    const Solid lazy = Solid::from_mesh(balls());
    EvaluateStats of_lazy;
    const PolygonMesh expected = less_boxes(lazy, 1, of_lazy).to_mesh();
    for (const std::uint32_t threads : {1U, 2U, 8U}) {
        const Solid part = Solid::from_mesh(balls());
        part.refine(threads);
        EvaluateStats stats;
        const PolygonMesh mesh = less_boxes(part, threads, stats).to_mesh();
        EXPECT_EQ(stats.cells, of_lazy.cells);
        EXPECT_TRUE(mesh.points == expected.points);
        ASSERT_EQ(mesh.face_count(), expected.face_count());
        for (std::size_t f = 0; f < mesh.face_count(); ++f)
            EXPECT_TRUE(std::ranges::equal(mesh.face(f), expected.face(f)));
    }
}

}  // namespace

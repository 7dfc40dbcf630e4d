// SPDX-License-Identifier: Apache-2.0
//
// Outer loops and holes from directed edges of a planar region.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <trisect/brep/planar_loops.h>
#include <trisect/bsp/assembly/parts/boundary_parts.h>
#include <trisect/bsp/assembly/parts/edge_chains.h>

namespace trisect::detail {

/// Makes the loops of one region after the other; holds scratch memory. The answers refer to the
/// region given last.
///
/// Loops start at their lexicographically smallest vertex (by the two axes across the dominant one
/// of the plane) and are ordered by it, so the result depends on the exact points alone. At a
/// vertex where the region touches itself every wedge of it keeps its own pair of edges.
class FaceLoops {
public:
    explicit FaceLoops(const Workbench& bench) : bench_(bench) {}

    /// The region that `edges` bound. All edges lie in the plane of `support`, whose outward normal
    /// is that plane's, or its opposite when `flipped`; the region is to the left of every edge.
    /// O(n log n). \throw Error Internal when the edges do not form closed loops.
    void set_region(PlaneId support, bool flipped, std::span<const BoundaryEdge> edges);

    [[nodiscard]] std::size_t loop_count() const { return loops_.size(); }
    /// Whether no loop passes a vertex twice, nor two loops the same one.
    [[nodiscard]] bool are_simple() const { return are_simple_; }
    /// The axes that the region is seen along from outside.
    [[nodiscard]] PlaneProjection::Axes axes() const {
        return right_handed_ ? PlaneProjection::Axes{u_, v_} : PlaneProjection::Axes{v_, u_};
    }
    /// Points in order, the region to the left seen from outside.
    [[nodiscard]] std::span<const PointId> loop(std::size_t i) const {
        return std::span(points_).subspan(loops_[i].begin, loops_[i].size);
    }
    /// The plane that cuts out the edge of a loop from its i-th point on.
    [[nodiscard]] PlaneId line_from(std::size_t loop, std::size_t i) const {
        return edges_[edge_at_[loops_[loop].begin + i]].line.plane;
    }
    [[nodiscard]] bool has_holes() const {
        return std::any_of(loops_.begin(), loops_.end(), [](const Loop& l) { return !l.outer; });
    }
    /// Faces: each is an outer loop, followed by the holes in it; numbers of loops. Outer loops in
    /// their order. O(n log n). The spans are valid until the next call.
    [[nodiscard]] std::span<const std::vector<std::uint32_t>> faces();

private:
    class Figure;
    struct Loop {
        std::size_t begin = 0;  // into points_
        std::size_t size = 0;
        bool outer = true;
    };

    [[nodiscard]] int left_of(std::size_t edge, PointId p) const;
    [[nodiscard]] int compare(PointId a, PointId b) const;
    [[nodiscard]] std::span<const std::pair<PointId, std::uint32_t>> leaving(PointId p) const;
    [[nodiscard]] std::size_t continuation(std::size_t arriving, PointId at) const;
    void chain_all();
    void chain_from(std::size_t start);
    void add_loop();
    [[nodiscard]] bool is_outer(std::size_t smallest) const;
    void order_loops();

    const Workbench& bench_;
    std::span<const BoundaryEdge> edges_;
    int u_ = 0;
    int v_ = 1;
    bool right_handed_ = true;
    bool are_simple_ = true;
    EdgeChains chains_;
    std::vector<std::pair<PointId, std::uint32_t>> by_start_;
    std::vector<bool> used_;
    std::vector<std::uint32_t> chain_;  // edges of the loop in the making
    std::vector<PointId> points_;
    std::vector<std::uint32_t> edge_at_;  // by place in points_: the edge that leaves it
    std::vector<Loop> loops_;
    std::vector<std::vector<std::uint32_t>> faces_;
};

}  // namespace trisect::detail

// SPDX-License-Identifier: Apache-2.0
//
// EdgeSplitter: insertion of vertices that lie inside edges (T-vertices).
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include <trisect/bsp/assembly/parts/boundary_facet.h>
#include <trisect/bsp/assembly/parts/looked_edges.h>
#include <trisect/bsp/assembly/parts/vertex_boxes.h>
#include <trisect/bsp/assembly/parts/vertex_columns.h>
#include <trisect/bsp/assembly/parts/vertex_grid.h>
#include <trisect/bsp/cells/workbench.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

/// Splits edges at the candidate vertices that lie inside them. Holds scratch memory.
///
/// An edge looks at few candidates that are not near it: where they are many, some cubes of a grid,
/// or, if it is long, a column along an axis, or O(log n) boxes of a tree over them; else those
/// whose range along the longest axis meets its own. Of many, edges with the same ends look once:
/// mostly two facets have one.
class EdgeSplitter {
public:
    EdgeSplitter(const Workbench& bench, const PoolVector<BoundaryFacet>& facets)
        : bench_(bench), facets_(facets) {}
    void clear();
    void add_candidate(PointId p);
    /// Appends the parts of the edges to `out`, each edge's parts in order. `threads` as in
    /// ParallelParts; if not 1 the bench has to be shared.
    void split(std::span<const BoundaryEdge> edges, BoundaryEdges& out, std::uint32_t threads = 1);

private:
    using Candidate = VertexBoxes::Vertex;
    // Built once several edges needed it, on whichever thread the next one is.
    class BuiltOnce {
    public:
        /// False for the first ones, which look at all vertices: that is cheaper for so few.
        [[nodiscard]] bool is_worth_building() {
            constexpr int few = 16;
            return is_built_.load(std::memory_order_relaxed) ||
                   uses_.fetch_add(1, std::memory_order_relaxed) >= few;
        }
        template <class Build>
        void by(const Build& build) {
            if (is_built_.load(std::memory_order_acquire)) return;
            const std::lock_guard lock(mutex_);
            if (is_built_.load(std::memory_order_relaxed)) return;
            build();
            is_built_.store(true, std::memory_order_release);
        }
        void clear() {
            is_built_.store(false, std::memory_order_relaxed);
            uses_.store(0, std::memory_order_relaxed);
        }

    private:
        std::atomic<bool> is_built_{false};
        std::atomic<int> uses_{0};
        std::mutex mutex_;
    };
    void sort_candidates(std::span<const BoundaryEdge> edges);
    [[nodiscard]] double short_length(std::span<const BoundaryEdge> edges) const;
    void split_in_parts(std::span<const BoundaryEdge> edges, BoundaryEdges& out, std::size_t count,
                        std::uint32_t threads);
    void build_boxes(std::span<const BoundaryEdge> edges, std::uint32_t threads);
    void find_inside(const BoundaryEdge& e, PoolVector<PointId>& inside);
    void find_inside_sorted(const BoundaryEdge& e, PoolVector<PointId>& inside);
    void find_inside_near(const BoundaryEdge& e, PoolVector<PointId>& inside);
    [[nodiscard]] std::optional<std::size_t> axis_of_columns(const BoundaryEdge& e) const;
    void look_at(const BoundaryEdge& e, const Candidate& candidate,
                 PoolVector<PointId>& inside) const;
    void sort_inside(const BoundaryEdge& e, int axis, std::span<PointId> inside) const;

    const Workbench& bench_;
    const PoolVector<BoundaryFacet>& facets_;
    PoolVector<Candidate> candidates_;
    bool are_many_ = false;
    VertexGrid grid_;                       // of many candidates
    std::array<VertexColumns, 3> columns_;  // of these, once edges are long and along an axis
    VertexBoxes boxes_;                     // once edges are long
    std::array<BuiltOnce, 3> has_columns_;
    BuiltOnce has_boxes_;
    std::vector<bool> is_listed_;  // by point: among the candidates
    std::size_t axis_ = 0;         // that they are sorted along
    double widest_ = 0;            // error of a candidate or an end
    PoolVector<PointId> inside_;   // of one edge, if candidates are few
    LookedEdges looked_;           // if they are many
};

}  // namespace trisect::detail

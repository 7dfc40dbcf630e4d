// SPDX-License-Identifier: Apache-2.0
//
// AxisFaces: axis-perpendicular faces of a result, outlined plane by plane.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <trisect/bsp/assembly/parts/boundary_parts.h>
#include <trisect/bsp/cells/occupancy_grid.h>
#include <trisect/kernel/support/as_index.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

/// For an assembly that joins all facets of a plane. Takes the facets of those planes in which the
/// sum of all parts is sure to be all that is written: each of their facets has changed, and in
/// every cell that they reach into all polygons are axis-perpendicular.
class AxisFaces {
public:
    /// What one leaf lists.
    struct Leaf {
        const PolygonList* polygons = nullptr;
        Cell cell;
        bool complemented = false;
        /// Not null: `polygons` are its facets.
        const OccupancyGrid* occupancy = nullptr;
    };

    /// For all sources of the parts. They must be listed, and outlive it. `threads` as in
    /// ParallelParts.
    [[nodiscard]] static std::unique_ptr<AxisFaces> of(BoundaryParts& parts, std::uint32_t threads);

    AxisFaces() = default;
    AxisFaces(const AxisFaces&) = delete;
    AxisFaces& operator=(const AxisFaces&) = delete;
    virtual ~AxisFaces() = default;

    /// \pre the facets of the parts are numbered, and none of them has edges.
    virtual void choose(std::span<const Leaf> leaves) = 0;
    /// Whether make_edges() makes the edges of a facet: nothing else may.
    [[nodiscard]] bool takes(std::int32_t facet) const {
        return !taken_.empty() && taken_[as_index(facet)];
    }
    /// How many facets are taken, and how many parts of facets.
    [[nodiscard]] std::size_t taken_count() const { return taken_count_; }
    /// How many leaves were read for that.
    [[nodiscard]] std::size_t read_count() const { return read_count_; }
    /// Whether make_edges() makes all edges that there are: then all vertices are different,
    /// nothing is left to join, and outlines turn at all vertices but corners of facets that pass
    /// through.
    [[nodiscard]] bool takes_all() const { return takes_all_; }
    [[nodiscard]] std::size_t part_count() const { return part_count_; }
    /// Whether a leaf lists nothing but axis-perpendicular polygons, and facets are taken.
    [[nodiscard]] bool is_across_axes(std::size_t leaf) const {
        return taken_count_ != 0 && across_[leaf];
    }

    /// The edges that an axis-perpendicular leaf has of facets that are not taken: vertices of
    /// theirs may lie in the edges to be made.
    virtual void note_vertices(std::span<const BoundaryEdge> edges) = 0;
    /// Appends the edges of all faces of the planes taken, named after the first facet of each
    /// plane and facing, with all vertices that lie inside them.
    virtual void make_edges(BoundaryEdges& edges) = 0;
    /// Appends all vertices known to make_edges() that may lie inside an edge noted before.
    virtual void add_vertices_in(const BoundaryEdge& edge, PoolVector<PointId>& out) = 0;

protected:
    std::size_t read_count_ = 0;
    std::vector<bool> across_;  // by leaf
    std::vector<bool> taken_;
    std::size_t taken_count_ = 0;
    std::size_t part_count_ = 0;
    bool takes_all_ = false;
};

}  // namespace trisect::detail

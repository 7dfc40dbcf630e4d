// SPDX-License-Identifier: Apache-2.0
//
// SplitVertices: vertices of cut facets as split points.
#pragma once

#include <cstdint>
#include <span>

#include <trisect/bsp/assembly/parts/boundary_parts.h>
#include <trisect/bsp/measure/split_point.h>
#include <trisect/kernel/support/as_index.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

/// Units for the boxes of all sources, in which vertices lie.
[[nodiscard]] SplitUnits units_of(const BoundaryParts& parts);

class SplitVertices {
public:
    SplitVertices(const BoundaryParts& parts, const SplitUnits& units)
        : bench_(parts.bench), units_(units) {}

    /// For the ends of edges.
    void make(std::span<const BoundaryEdge> edges);
    [[nodiscard]] const SplitPoint& operator[](PointId p) const { return points_[as_index(p)]; }
    /// What coordinates are off by at most, in units.
    [[nodiscard]] double error() const { return error_; }

private:
    void make(PointId p);

    const Workbench& bench_;
    const SplitUnits& units_;
    PoolVector<SplitPoint> points_;
    PoolVector<std::uint8_t> is_made_;
    double error_ = 0;
};

/// The axis to which a facet is perpendicular, by its corners or its plane, or -1.
[[nodiscard]] int axis_across(const BoundaryFacet& facet);

}  // namespace trisect::detail

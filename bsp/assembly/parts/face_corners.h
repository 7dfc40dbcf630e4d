// SPDX-License-Identifier: Apache-2.0
//
// FaceCorners: corners of a face for its triangulation.
#pragma once

#include <cstdint>
#include <span>

#include <trisect/brep/planar_loops.h>
#include <trisect/bsp/cells/point_order.h>
#include <trisect/bsp/cells/workbench.h>
#include <trisect/kernel/support/as_index.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

/// Points of a workbench by their rounded coordinates. Few turns need more, and a Point holds its
/// three planes, a kilobyte. Keeps its memory.
class FaceCorners final : public RoundedPoints {
public:
    explicit FaceCorners(const Workbench& bench) : bench_(bench) {}

    void clear() {
        points_.clear();
        nearest_.clear();
        exact_.clear();
        exact_of_.clear();
    }
    /// `nearest` as RoundedPoints has it.
    void add(PointId point, const Approximation& nearest) {
        points_.push_back(point);
        nearest_.push_back(nearest);
        exact_of_.push_back(-1);
    }
    [[nodiscard]] std::size_t size() const { return points_.size(); }
    [[nodiscard]] PointId point(std::uint32_t i) const { return points_[i]; }
    [[nodiscard]] std::span<const PointId> points() const { return points_; }

    [[nodiscard]] std::span<const Approximation> nearest() const override { return nearest_; }
    // Each is computed once: where corners lie on one line all turns are exact.
    [[nodiscard]] HomogeneousPoint homogeneous(std::uint32_t i) const override {
        std::int32_t& known = exact_of_[i];
        if (known < 0) {
            known = static_cast<std::int32_t>(exact_.size());
            exact_.push_back(bench_.homogeneous(points_[i]));
        }
        return exact_[as_index(known)];
    }
    [[nodiscard]] int compare_along(std::uint32_t a, std::uint32_t b, int axis) const override {
        return detail::compare_along(bench_, points_[a], points_[b], axis);
    }

private:
    const Workbench& bench_;
    PoolVector<PointId> points_;
    PoolVector<Approximation> nearest_;
    mutable PoolVector<HomogeneousPoint> exact_;  // of those that needed it
    mutable PoolVector<std::int32_t> exact_of_;   // by corner
};

}  // namespace trisect::detail

// SPDX-License-Identifier: Apache-2.0
//
// Winding numbers along a segment parallel to an axis.
// Moving a reference point through a splitting plane needs them. Seen along the axis the segment
// is a point, so a facet is met or missed by three signs of 2x2 determinants; nearly all are
// decided in doubles.
#pragma once

#include <optional>
#include <vector>

#include <trisect/bsp/cells/cell_tree.h>

namespace trisect::detail {

/// The trace of one segment from `from` to `to`, which differ along `axis` only. Facets are given
/// one by one; those that doubles cannot decide are kept and traced exactly at the end.
class AxisTrace {
public:
    AxisTrace(const FinePoint& from, const FinePoint& to, int axis);

    void add(const PolygonRef& polygon);
    /// Change of the winding number, for polygons read with their own orientation or, when
    /// `flipped`, with the other one. Nothing when the segment is degenerate.
    [[nodiscard]] std::optional<int> change(bool flipped) const;
    /// Start again on the same segment.
    void clear() {
        decided_ = 0;
        uncertain_.clear();
    }

private:
    [[nodiscard]] bool decide(const PolygonRef& polygon);

    FinePoint from_;
    FinePoint to_;
    std::size_t axis_;
    std::array<double, 2> at_{};  // the segment seen along the axis
    double at_error_ = 0;
    int decided_ = 0;
    std::vector<PolygonRef> uncertain_;
};

}  // namespace trisect::detail

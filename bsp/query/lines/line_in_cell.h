// SPDX-License-Identifier: Apache-2.0
//
// LineInCell: the contacts of a line within a closed cell.
#pragma once

#include <array>
#include <optional>

#include <trisect/bsp/cells/cell.h>
#include <trisect/bsp/query/index/index_polygons.h>
#include <trisect/bsp/query/lines/index_line.h>

namespace trisect::detail {

/// Doubles with errors first, exact where these do not decide. What is on the cell's border counts
/// where the polygon enters the cell. The line must outlive it.
class LineInCell {
public:
    LineInCell(const IndexLine& line, const Cell& cell);

    /// Of a contact in one point.
    [[nodiscard]] bool contains(const IndexPolygons& polygons, IndexPolygons::Id id,
                                const LineContact& contact) const;
    /// Of an interval: the part in the cell, perhaps a point.
    [[nodiscard]] std::optional<ContactEnds> clipped(const IndexPolygons& polygons,
                                                     IndexPolygons::Id id,
                                                     const LineContact& contact) const;

private:
    [[nodiscard]] static bool has_wall(std::int64_t position);

    const IndexLine& line_;
    Cell cell_;
    bool known_ = false;  // the following
    // Of the parameters at which the line enters and leaves the cell.
    double enter_lo_ = 0;
    double enter_hi_ = 0;
    double leave_lo_ = 0;
    double leave_hi_ = 0;
};

}  // namespace trisect::detail

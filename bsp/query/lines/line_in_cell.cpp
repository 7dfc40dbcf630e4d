// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/query/lines/line_in_cell.h>

#include <algorithm>
#include <cmath>

#include <trisect/kernel/number/error_bounds.h>

namespace trisect::detail {

bool LineInCell::has_wall(std::int64_t position) {
    return position > -universe_limit && position < universe_limit;
}

LineInCell::LineInCell(const IndexLine& line, const Cell& cell)
    : line_(line),
      cell_(cell),
      known_(line.is_moderate()),
      enter_lo_(-HUGE_VAL),
      enter_hi_(-HUGE_VAL),
      leave_lo_(HUGE_VAL),
      leave_hi_(HUGE_VAL) {
    for (std::size_t k = 0; known_ && k < 3; ++k) {
        const double origin_error = line.origin().error();
        for (const bool upper : {false, true}) {
            const std::int64_t position = upper ? cell.hi[k] : cell.lo[k];
            if (!has_wall(position)) continue;
            const double wall = rounded_position(position);
            const double wall_error = std::fabs(wall) * last_place;
            const double way = wall - line.origin()[k];
            if (line.is_parallel(k)) {
                const double slack = wall_error + 2 * origin_error + std::fabs(way) * last_place;
                known_ = known_ && (upper ? way > slack : way < -slack);
                continue;
            }
            const double d = line.direction()[k];
            const double t = way / d;
            const double e =
                std::fabs(t) * (0x1p-50 + line.direction_error() / std::fabs(d) * 1.01) +
                (wall_error + origin_error) / std::fabs(d) * 1.01 + 0x1p-1000;
            known_ = known_ && line.direction_error() < 0.5 * std::fabs(d) && e < HUGE_VAL;
            if ((d > 0) == upper) {
                leave_lo_ = std::min(leave_lo_, t - e);
                leave_hi_ = std::min(leave_hi_, t + e);
            } else {
                enter_lo_ = std::max(enter_lo_, t - e);
                enter_hi_ = std::max(enter_hi_, t + e);
            }
        }
    }
}

bool LineInCell::contains(const IndexPolygons& polygons, IndexPolygons::Id id,
                          const LineContact& contact) const {
    if (known_) {
        if (contact.lo > enter_hi_ && contact.hi < leave_lo_) return true;
        if (contact.hi < enter_lo_ || contact.lo > leave_hi_) return false;
    }
    const ContactEnds ends = ends_of(polygons, id, line_, contact);
    const IndexPoint p = line_.at(ends.enter);
    bool on_wall = false;
    for (std::size_t k = 0; k < 3; ++k) {
        const int above = has_wall(cell_.lo[k]) ? p.compare_fine(k, cell_.lo[k]) : 1;
        const int below = has_wall(cell_.hi[k]) ? p.compare_fine(k, cell_.hi[k]) : -1;
        if (above < 0 || below > 0) return false;
        on_wall = on_wall || above == 0 || below == 0;
    }
    return !on_wall || polygons.enters(id);
}

std::optional<ContactEnds> LineInCell::clipped(const IndexPolygons& polygons, IndexPolygons::Id id,
                                               const LineContact& contact) const {
    ContactEnds ends = ends_of(polygons, id, line_, contact);
    for (std::size_t k = 0; k < 3; ++k) {
        const int direction = line_.exact_direction()[k].sign();
        for (const bool upper : {false, true}) {
            const std::int64_t position = upper ? cell_.hi[k] : cell_.lo[k];
            if (!has_wall(position)) continue;
            if (direction == 0) {
                const int s = line_.origin().compare_fine(k, position);
                if (upper ? s > 0 : s < 0) return std::nullopt;
                continue;
            }
            const RayParameter t =
                line_.meet(Plane::axis_aligned(static_cast<int>(k), splitting_scale, position));
            if ((direction > 0) == upper) {
                if (t < ends.leave) ends.leave = t;
            } else if (t > ends.enter) {
                ends.enter = t;
            }
        }
    }
    if (ends.enter > ends.leave || !polygons.enters(id)) return std::nullopt;
    return ends;
}

}  // namespace trisect::detail

// SPDX-License-Identifier: Apache-2.0
//
// Near cells first: rings of cells around a range, each clipped to the bounds of what is occupied.
// A range that lies far away starts with the first ring that reaches the bounds. The points in ring
// r are at least r - 1 whole cells away from whatever made the range.

#include <trisect/bsp/hierarchies/partitions/grid_level.h>

#include <cmath>

namespace trisect::hierarchies {

namespace {

constexpr std::int64_t farthest_cell = std::int64_t{1} << 31;

std::int32_t clamped(std::int64_t v) {
    return static_cast<std::int32_t>(std::clamp(v, -farthest_cell + 2, farthest_cell - 2));
}

}  // namespace

double power_of_two_above(double v) {
    int e = 0;
    const double m = std::frexp(v, &e);
    return std::ldexp(1.0, m == 0.5 ? e - 1 : e);
}

void GridLevel::close() {
    if (cells_.size() == 0) return;
    bounds_ = {cells_.place(0), cells_.place(0)};
    for (std::size_t c = 1; c < cells_.size(); ++c)
        for (std::size_t k = 0; k < 3; ++k) {
            bounds_.lo[k] = std::min(bounds_.lo[k], cells_.place(c)[k]);
            bounds_.hi[k] = std::max(bounds_.hi[k], cells_.place(c)[k]);
        }
}

CellRange GridLevel::grown(const CellRange& range, std::int64_t by) {
    CellRange r;
    for (std::size_t k = 0; k < 3; ++k) {
        r.lo[k] = clamped(range.lo[k] - by);
        r.hi[k] = clamped(range.hi[k] + by);
    }
    return r;
}

CellRange GridLevel::common(const CellRange& range) const {
    CellRange r;
    for (std::size_t k = 0; k < 3; ++k) {
        r.lo[k] = std::max(range.lo[k], bounds_.lo[k]);
        r.hi[k] = std::min(range.hi[k], bounds_.hi[k]);
        if (r.lo[k] > r.hi[k]) return nothing();
    }
    return r;
}

std::int64_t GridLevel::first_ring(const CellRange& start) const {
    std::int64_t r = 0;
    for (std::size_t k = 0; k < 3; ++k)
        r = std::max({r, std::int64_t{bounds_.lo[k]} - start.hi[k],
                      std::int64_t{start.lo[k]} - bounds_.hi[k]});
    return r;
}

std::int64_t GridLevel::last_ring(const CellRange& start) const {
    std::int64_t r = 0;
    for (std::size_t k = 0; k < 3; ++k)
        r = std::max({r, std::int64_t{start.lo[k]} - bounds_.lo[k],
                      std::int64_t{bounds_.hi[k]} - start.hi[k]});
    return r;
}

}  // namespace trisect::hierarchies

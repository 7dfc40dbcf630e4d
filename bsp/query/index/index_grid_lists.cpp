// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/query/index/index_grid_lists.h>

#include <algorithm>
#include <cmath>

#include <trisect/bsp/query/index/triangle_in_boxes.h>

namespace trisect::detail {

IndexGridLists::IndexGridLists(const IndexPolygons& polygons, const IndexGrid& grid, double margin)
    : polygons_(polygons), grid_(grid), block_(grid.block()), windings_(polygons) {
    for (std::size_t k = 0; k < 3; ++k) {
        scale_[k] = 1 / block_.size[k];
        margin_[k] = 0x1p-10 + margin * scale_[k];
    }
}

BlockItem IndexGridLists::item(Id id) const {
    BlockItem out;
    out.id = id;
    out.is_triangle = polygons_.is_triangle(id);
    if (!out.is_triangle) {
        const DoubleBox box = polygons_.bounds(id);
        const bool everywhere = polygons_.is_unbounded(id);
        for (std::size_t k = 0; k < 3; ++k) {
            out.lo[k] = (box.lo[k] - block_.origin[k]) * scale_[k];
            out.hi[k] = (box.hi[k] - block_.origin[k]) * scale_[k];
            if (!everywhere) continue;
            out.lo[k] = -0x1p40;
            out.hi[k] = 0x1p40;
        }
        return out;
    }
    out.lo.fill(HUGE_VAL);
    out.hi.fill(-HUGE_VAL);
    for (int i = 0; i < 3; ++i) {
        const LatticePoint& c = polygons_.corner(id, i);
        auto& p = out.corner[static_cast<std::size_t>(i)];
        for (std::size_t k = 0; k < 3; ++k) {
            p[k] = (c[static_cast<int>(k)].to_double() - block_.origin[k]) * scale_[k];
            out.lo[k] = std::min(out.lo[k], p[k]);
            out.hi[k] = std::max(out.hi[k], p[k]);
        }
    }
    return out;
}

IndexGridLists::Range IndexGridLists::range_of(const BlockItem& item) const {
    Range r;
    for (std::size_t k = 0; k < 3; ++k) {
        const auto last = static_cast<double>(grid_.n[k] - 1);
        const double lo = item.lo[k] - margin_[k];
        const double hi = item.hi[k] + margin_[k];
        r.lo[k] = static_cast<std::uint16_t>(lo > 0 ? std::min(lo, last) : 0);
        r.hi[k] = static_cast<std::uint16_t>(hi > 0 ? std::min(hi, last) : 0);
    }
    return r;
}

bool IndexGridLists::is_large(const Range& r) {
    return (r.hi[0] - r.lo[0] + 1) * (r.hi[1] - r.lo[1] + 1) * (r.hi[2] - r.lo[2] + 1) > 8;
}

template <class F>
void IndexGridLists::for_range(const Range& r, const F& f) const {
    for (std::uint32_t z = r.lo[2]; z <= r.hi[2]; ++z)
        for (std::uint32_t y = r.lo[1]; y <= r.hi[1]; ++y)
            for (std::uint32_t x = r.lo[0]; x <= r.hi[0]; ++x) f(grid_.cell(x, y, z));
}

// Counts, then fills.
bool IndexGridLists::list(std::span<const Id> ids) {
    windings_.reset(block_.origin, block_.size, grid_.n);
    begin_.assign(grid_.count() + 1, 0);
    ranges_.resize(ids.size());
    for (std::size_t i = 0; i < ids.size(); ++i) {
        const BlockItem polygon = item(ids[i]);
        if (!windings_.add(polygon)) return false;
        const Range r = ranges_[i] = range_of(polygon);
        if (is_large(r)) {
            list_large(polygon, r);
        } else {
            for_range(r, [&](std::size_t cell) { ++begin_[cell + 1]; });
        }
    }
    for (const auto& [cell, id] : large_) ++begin_[cell + 1];
    for (std::size_t c = 0; c + 1 < begin_.size(); ++c) begin_[c + 1] += begin_[c];
    listed_.resize(begin_.back());
    std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
    for (std::size_t i = 0; i < ids.size(); ++i)
        if (!is_large(ranges_[i]))
            for_range(ranges_[i], [&](std::size_t cell) { listed_[next[cell]++] = ids[i]; });
    for (const auto& [cell, id] : large_) listed_[next[cell]++] = id;
    ranges_ = {};
    large_ = {};
    return true;
}

std::size_t IndexGridLists::bytes() const {
    return (begin_.size() + listed_.size() + windings_.windings().size()) * sizeof(Id);
}

void IndexGridLists::list_large(const BlockItem& item, const Range& r) {
    if (!item.is_triangle) {
        for_range(
            r, [&](std::size_t c) { large_.emplace_back(static_cast<std::uint32_t>(c), item.id); });
        return;
    }
    const TriangleInBoxes triangle(item.corner);
    const double half = 0.5 + std::max({margin_[0], margin_[1], margin_[2]});
    for (std::uint32_t z = r.lo[2]; z <= r.hi[2]; ++z)
        for (std::uint32_t y = r.lo[1]; y <= r.hi[1]; ++y)
            for (std::uint32_t x = r.lo[0]; x <= r.hi[0]; ++x)
                if (triangle.may_meet({x + 0.5, y + 0.5, z + 0.5}, half))
                    large_.emplace_back(static_cast<std::uint32_t>(grid_.cell(x, y, z)), item.id);
}

}  // namespace trisect::detail

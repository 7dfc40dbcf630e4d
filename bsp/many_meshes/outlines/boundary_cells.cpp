// SPDX-License-Identifier: Apache-2.0
//
// Places of coordinates do not decrease along an axis, however they are rounded. So boxes in
// different cells do not meet.

#include <trisect/bsp/many_meshes/outlines/boundary_cells.h>

#include <algorithm>
#include <cmath>

namespace trisect::detail {

namespace {

constexpr double cells_a_facet = 4;
constexpr double most_along = 512;
constexpr double most_cells = 0x1p26;

constexpr BoundaryCells::Part unknown = ~BoundaryCells::Part{0};

}  // namespace

BoundaryCells::BoundaryCells(const OutlineBox& all, std::size_t facets) : low_(all.lo) {
    std::array<double, 3> extent{};
    double volume = 1;
    for (std::size_t k = 0; k < 3; ++k) {
        extent[k] = std::max(all.hi[k] - all.lo[k], 1.0);
        volume *= extent[k];
    }
    const double wanted = std::min(cells_a_facet * static_cast<double>(facets + 1), most_cells);
    const double side = std::cbrt(volume / wanted);
    std::size_t cells = 1;
    for (std::size_t k = 0; k < 3; ++k) {
        const double along = std::clamp(std::floor(extent[k] / side), 1.0, most_along);
        scale_[k] = along / extent[k];
        counts_[k] = static_cast<std::size_t>(along) + 3;
        cells *= counts_[k];
    }
    parts_.assign(cells, unknown);
}

std::size_t BoundaryCells::place(double at, std::size_t k) const {
    if (!(at >= low_[k])) return 0;
    const double i = (at - low_[k]) * scale_[k] + 1;
    const auto last = static_cast<double>(counts_[k] - 1);
    return static_cast<std::size_t>(std::min(i, last));
}

void BoundaryCells::occupy(const OutlineBox& facet) {
    std::array<std::size_t, 3> first{};
    std::array<std::size_t, 3> last{};
    for (std::size_t k = 0; k < 3; ++k) {
        first[k] = place(facet.lo[k], k);
        last[k] = place(facet.hi[k], k);
    }
    for (std::size_t z = first[2]; z <= last[2]; ++z)
        for (std::size_t y = first[1]; y <= last[1]; ++y)
            for (std::size_t x = first[0]; x <= last[0]; ++x)
                parts_[(z * counts_[1] + y) * counts_[0] + x] = occupied;
}

BoundaryCells::Part BoundaryCells::part_of(const OutlineBox& box) const {
    std::array<std::size_t, 3> first{};
    std::array<std::size_t, 3> last{};
    for (std::size_t k = 0; k < 3; ++k) {
        first[k] = place(box.lo[k], k);
        last[k] = place(box.hi[k], k);
    }
    Part part = occupied;
    for (std::size_t z = first[2]; z <= last[2]; ++z)
        for (std::size_t y = first[1]; y <= last[1]; ++y)
            for (std::size_t x = first[0]; x <= last[0]; ++x) {
                part = parts_[(z * counts_[1] + y) * counts_[0] + x];
                if (part == occupied) return occupied;
            }
    return part;
}

// The first cell is in the layer around all.
void BoundaryCells::find_parts() {
    part_count_ = 1;
    for (std::size_t cell = 0; cell < parts_.size(); ++cell)
        if (parts_[cell] == unknown) fill(cell, part_count_++);
}

void BoundaryCells::fill(std::size_t cell, Part part) {
    const std::array<std::size_t, 3> strides{1, counts_[0], counts_[0] * counts_[1]};
    const auto visit = [&](std::size_t c) {
        if (parts_[c] != unknown) return;
        parts_[c] = part;
        open_.push_back(c);
    };
    visit(cell);
    while (!open_.empty()) {
        const std::size_t c = open_.back();
        open_.pop_back();
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t at = c / strides[k] % counts_[k];
            if (at > 0) visit(c - strides[k]);
            if (at + 1 < counts_[k]) visit(c + strides[k]);
        }
    }
}

OutlineBox outline_box(const Box& positions) {
    OutlineBox out;
    for (std::size_t k = 0; k < 3; ++k) {
        out.lo[k] = static_cast<double>(positions.lo[k]) - 2;
        out.hi[k] = static_cast<double>(positions.hi[k]) + 2;
    }
    return out;
}

}  // namespace trisect::detail

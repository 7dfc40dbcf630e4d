// SPDX-License-Identifier: Apache-2.0
//
// IndexItem: the box of a part of a polygon, in floats.
// An index is built from such items.
#pragma once

#include <array>
#include <cstddef>

#include <trisect/bsp/query/index/index_polygons.h>

namespace trisect::detail {

/// A part of a polygon: its box relative to the model's middle, rounded outwards.
struct IndexItem {
    std::array<float, 3> lo{};
    std::array<float, 3> hi{};
    IndexPolygons::Id id = 0;
};

/// A cell, relative to the model's middle.
struct FloatBox {
    std::array<float, 3> lo{};
    std::array<float, 3> hi{};
    [[nodiscard]] float extent(std::size_t k) const { return hi[k] - lo[k]; }
    [[nodiscard]] float area() const {
        return extent(0) * extent(1) + extent(1) * extent(2) + extent(2) * extent(0);
    }
};

}  // namespace trisect::detail

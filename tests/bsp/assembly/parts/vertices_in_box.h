// SPDX-License-Identifier: Apache-2.0
//
// Vertices that an index finds in a box, against all that are there.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include <trisect/bsp/assembly/parts/vertex_boxes.h>

namespace vertices_in_box {

using Vertex = trisect::detail::VertexBoxes::Vertex;
using Point = std::array<double, 3>;

/// 400 of them; coordinates are what `at` gives.
template <class At>
std::vector<Vertex> random_vertices(const At& at) {
    std::vector<Vertex> out;
    for (int i = 0; i < 400; ++i) out.push_back({{at(), at(), at()}, i});
    return out;
}

/// Expects that the index finds those in a box, and no vertex twice. False where it refuses the
/// box; then it is to find nothing.
template <class Index>
bool expect_all_found(const Index& index, std::span<const Vertex> vertices, const Point& lo,
                      const Point& hi) {
    std::vector<int> found(vertices.size());
    const bool is_done = index.for_each_near(lo, hi, [&](std::span<const Vertex> part) {
        for (const auto& v : part) ++found[static_cast<std::size_t>(v.point)];
    });
    if (!is_done) {
        EXPECT_EQ(static_cast<std::size_t>(std::ranges::count(found, 0)), vertices.size());
        return false;
    }
    for (const auto& v : vertices) {
        bool is_in = true;
        for (std::size_t k = 0; k < 3; ++k) is_in = is_in && lo[k] <= v.c[k] && v.c[k] <= hi[k];
        const int times = found[static_cast<std::size_t>(v.point)];
        EXPECT_LE(times, 1);
        if (is_in) {
            EXPECT_EQ(times, 1);
        }
    }
    return true;
}

}  // namespace vertices_in_box

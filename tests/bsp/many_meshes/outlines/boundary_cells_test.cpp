// SPDX-License-Identifier: Apache-2.0
//
// Cells around boundaries (boundary_cells.h), and boxes that are clear of others
// (settled_parts.h), against looking at all of them.

#include <trisect/bsp/many_meshes/outlines/boundary_cells.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <trisect/bsp/many_meshes/outlines/settled_parts.h>

namespace {

using trisect::detail::BoundaryCells;
using trisect::detail::Box;
using trisect::detail::ClearBox;
using trisect::detail::OutlineBox;

OutlineBox around(const std::array<double, 3>& at, double reach) {
    OutlineBox box;
    for (std::size_t k = 0; k < 3; ++k) {
        box.lo[k] = at[k] - reach;
        box.hi[k] = at[k] + reach;
    }
    return box;
}

TEST(BoundaryCells, InsideAndOutsideOfASphere) {
    BoundaryCells cells(around({0, 0, 0}, 100), 20000);
    std::mt19937 random(20311);
    std::normal_distribution<double> component;
    for (int i = 0; i < 60000; ++i) {
        const std::array<double, 3> d{component(random), component(random), component(random)};
        const double scale = 96 / std::hypot(d[0], d[1], d[2]);
        cells.occupy(around({scale * d[0], scale * d[1], scale * d[2]}, 4));
    }
    cells.find_parts();
    ASSERT_EQ(cells.part_count(), 3U);
    const BoundaryCells::Part inside = cells.part_of(around({0, 0, 0}, 0));
    EXPECT_NE(inside, BoundaryCells::occupied);
    EXPECT_NE(inside, BoundaryCells::outside);
    std::uniform_real_distribution<double> at(-150, 150);
    std::size_t known = 0;
    for (int i = 0; i < 5000; ++i) {
        const std::array<double, 3> p{at(random), at(random), at(random)};
        const double length = std::hypot(p[0], p[1], p[2]);
        const BoundaryCells::Part part = cells.part_of(around(p, 2));
        known += part == BoundaryCells::occupied ? 0 : 1;
        if (part != BoundaryCells::occupied) {
            EXPECT_EQ(part, length < 96 ? inside : BoundaryCells::outside);
        }
    }
    EXPECT_GT(known, 3000U);
    EXPECT_EQ(cells.part_of(around({0, 0, 0}, 1000)), BoundaryCells::occupied);
    EXPECT_EQ(cells.part_of(around({1e9, -1e9, 0}, 1)), BoundaryCells::outside);
}

TEST(ClearBox, HasNothingThatABoxMeets) {
    std::mt19937 random(20312);
    std::uniform_int_distribution<std::int64_t> at(0, 10000);
    for (int round = 0; round < 200; ++round) {
        std::vector<Box> boxes;
        std::array<std::vector<std::uint32_t>, 2> halves;
        for (std::uint32_t i = 0; i < 20; ++i) {
            Box b;
            for (std::size_t k = 0; k < 3; ++k) {
                b.lo[k] = at(random);
                b.hi[k] = b.lo[k] + 300;
            }
            halves[b.lo[0] < 5000 ? 0 : 1].push_back(i);
            boxes.push_back(b);
        }
        if (halves[0].empty() || halves[1].empty()) continue;
        const ClearBox clear = ClearBox().without(boxes, halves[1], halves[0]);
        EXPECT_FALSE(clear.is_all());
        for (int i = 0; i < 100; ++i) {
            const std::array<double, 3> p{static_cast<double>(at(random)),
                                          static_cast<double>(at(random)),
                                          static_cast<double>(at(random))};
            if (!clear.has(around(p, 10))) continue;
            for (const std::uint32_t other : halves[1])
                EXPECT_FALSE(outline_box(boxes[other]).meets(around(p, 10)));
        }
    }
    EXPECT_TRUE(ClearBox().is_all());
}

}  // namespace

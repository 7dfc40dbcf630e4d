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

// Walls around two rooms in a row, of small boxes; the wall between them has a hole if wanted.
BoundaryCells two_rooms(bool has_hole) {
    BoundaryCells cells(around({0, 0, 0}, 64), 500);
    for (double x = -60; x <= 60; x += 2)
        for (double y = -30; y <= 30; y += 2)
            for (double z = -30; z <= 30; z += 2) {
                const bool is_side = std::abs(y) == 30 || std::abs(z) == 30 || std::abs(x) == 60;
                const bool is_hole = has_hole && std::abs(y) <= 6 && std::abs(z) <= 6;
                if (is_side || (x == 0 && !is_hole)) cells.occupy(around({x, y, z}, 1));
            }
    cells.find_parts();
    return cells;
}

TEST(BoundaryCells, RoomsHangTogetherByAHoleAlone) {
    for (const bool has_hole : {false, true}) {
        const BoundaryCells cells = two_rooms(has_hole);
        const BoundaryCells::Part left = cells.part_of(around({-30, 0, 0}, 1));
        const BoundaryCells::Part right = cells.part_of(around({30, 0, 0}, 1));
        EXPECT_NE(left, BoundaryCells::occupied);
        EXPECT_NE(left, BoundaryCells::outside);
        EXPECT_NE(right, BoundaryCells::outside);
        EXPECT_EQ(left == right, has_hole);
        EXPECT_EQ(cells.part_count(), has_hole ? 3U : 4U);
        EXPECT_EQ(cells.part_of(around({0, 20, 0}, 1)), BoundaryCells::occupied);
        EXPECT_EQ(cells.part_of(around({0, 0, 63}, 1)), BoundaryCells::outside);
    }
}

// A box beside a facet, in the same cell, is not beside it in small ones.
TEST(BoundaryCells, SmallCellsSayMoreThanTheirCell) {
    BoundaryCells cells(around({0, 0, 0}, 100), 0);
    cells.occupy(around({0, 0, 0}, 1));
    cells.find_parts();
    EXPECT_EQ(cells.part_of(around({0, 0, 0}, 0.5)), BoundaryCells::occupied);
    EXPECT_EQ(cells.part_of(around({70, 70, 70}, 20)), BoundaryCells::outside);
    EXPECT_EQ(cells.part_of(around({0, 70, 0}, 20)), BoundaryCells::outside);
}

// What is enclosed in small cells alone is no part.
TEST(BoundaryCells, APocketIsNoPart) {
    BoundaryCells cells(around({0, 0, 0}, 128), 8);
    for (double x = -8; x <= 8; x += 2)
        for (double y = -8; y <= 8; y += 2)
            for (double z = -8; z <= 8; z += 2)
                if (std::abs(x) == 8 || std::abs(y) == 8 || std::abs(z) == 8)
                    cells.occupy(around({x, y, z}, 1));
    cells.find_parts();
    EXPECT_EQ(cells.part_count(), 2U);
    EXPECT_EQ(cells.part_of(around({0, 0, 0}, 0.5)), BoundaryCells::occupied);
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

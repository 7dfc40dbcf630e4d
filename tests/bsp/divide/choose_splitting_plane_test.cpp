// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/divide/choose_splitting_plane.h>

#include <array>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace trisect::detail {
namespace {

// Boxes one unit wide in a row along x, half a unit from their neighbours.
std::vector<PackedBox> row_of_boxes(std::int64_t begin, std::int64_t end) {
    std::vector<PackedBox> row;
    for (std::int64_t x = begin; x < end; ++x) {
        Box b;
        b.lo = {2 * x, 0, 0};
        b.hi = {2 * x + 1, 9, 9};
        row.push_back(PackedBox::of(Frame{}, b));
    }
    return row;
}

CellOperand operand_of(const std::vector<PackedBox>& row) {
    CellOperand o;
    o.embedded = true;
    o.is_list = true;
    o.entries = row.data();
    o.count = static_cast<std::uint32_t>(row.size());
    o.box = box_of(row.data(), row.size());
    return o;
}

class SplittingPlaneOfRows : public testing::Test {
protected:
    void set(std::vector<PackedBox> a, std::vector<PackedBox> b) {
        a_ = std::move(a);
        b_ = std::move(b);
        operands_ = {operand_of(a_), operand_of(b_)};
        task_.operands = operands_;
    }
    // The last position below the plane; it is across x.
    std::int64_t last_below() {
        const auto splitter = choose_splitting_plane(task_, 0);
        EXPECT_TRUE(splitter && splitter->axis == 0);
        return splitter ? splitter->last_below() : -1;
    }

    std::vector<PackedBox> a_;
    std::vector<PackedBox> b_;
    std::array<CellOperand, 2> operands_;
    CellTask task_;
};

TEST_F(SplittingPlaneOfRows, TrimsTheLongerPartThatIsAlone) {
    set(row_of_boxes(0, 30), row_of_boxes(20, 60));
    // The first row ends at 59, and the boxes from 60 on are alone.
    EXPECT_EQ(last_below(), 59);
}

TEST_F(SplittingPlaneOfRows, HalvesTheOverlapWhereLittleIsAlone) {
    set(row_of_boxes(0, 30), row_of_boxes(5, 35));
    // From 10 to 59.
    EXPECT_EQ(last_below(), 34);
}

TEST_F(SplittingPlaneOfRows, WhatMayMeetItselfIsNowhereAlone) {
    set(row_of_boxes(0, 30), row_of_boxes(20, 60));
    operands_[1].embedded = false;
    EXPECT_EQ(last_below(), 39);
}

TEST_F(SplittingPlaneOfRows, WhatIsApartIsHalved) {
    set(row_of_boxes(0, 30), row_of_boxes(40, 60));
    EXPECT_EQ(last_below(), 59);
}

}  // namespace
}  // namespace trisect::detail

// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/divide/choose_splitting_plane.h>

#include <array>
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

class TrimmingPlane : public testing::Test {
protected:
    TrimmingPlane(const std::vector<PackedBox>& a, const std::vector<PackedBox>& b)
        : a_(a), b_(b), operands_{operand_of(a_), operand_of(b_)} {
        task_.operands = operands_;
    }

    std::vector<PackedBox> a_;
    std::vector<PackedBox> b_;
    std::array<CellOperand, 2> operands_;
    CellTask task_;
};

class RowsThatOverlap : public TrimmingPlane {
protected:
    RowsThatOverlap() : TrimmingPlane(row_of_boxes(0, 30), row_of_boxes(20, 60)) {}
};

TEST_F(RowsThatOverlap, WallEndsTheLongerPartThatIsAlone) {
    const auto splitter = trimming_plane(task_, 10, 0);
    ASSERT_TRUE(splitter.has_value());
    EXPECT_EQ(splitter->axis, 0);
    // The first row ends at 59, and the boxes from 60 on are alone.
    EXPECT_EQ(splitter->last_below(), 59);
}

TEST_F(RowsThatOverlap, NothingIsPeeledOffWhereTooFewAreAlone) {
    EXPECT_TRUE(trimming_plane(task_, 30, 0).has_value());
    EXPECT_FALSE(trimming_plane(task_, 31, 0).has_value());
}

TEST_F(RowsThatOverlap, WhatMayMeetItselfIsNowhereAlone) {
    operands_[1].embedded = false;
    const auto splitter = trimming_plane(task_, 10, 0);
    ASSERT_TRUE(splitter.has_value());
    EXPECT_EQ(splitter->last_below(), 39);
}

class RowsApart : public TrimmingPlane {
protected:
    RowsApart() : TrimmingPlane(row_of_boxes(0, 30), row_of_boxes(40, 60)) {}
};

TEST_F(RowsApart, NothingIsContested) { EXPECT_FALSE(trimming_plane(task_, 1, 0).has_value()); }

class RowWithinARow : public TrimmingPlane {
protected:
    RowWithinARow() : TrimmingPlane(row_of_boxes(0, 30), row_of_boxes(12, 20)) {}
};

TEST_F(RowWithinARow, BothEndsOfTheLongerRowAreAlone) {
    EXPECT_EQ(trimming_plane(task_, 5, 0)->last_below(), 23);
    EXPECT_TRUE(trimming_plane(task_, 12, 0).has_value());
    EXPECT_FALSE(trimming_plane(task_, 13, 0).has_value());
}

}  // namespace
}  // namespace trisect::detail

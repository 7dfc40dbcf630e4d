// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/divide/crowded_cell.h>

#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

namespace trisect::detail {
namespace {

// Operands of one box each, all of a size.
class BoxesInACell : public testing::Test {
protected:
    void add(std::int64_t x, std::int64_t width) {
        Box b;
        b.lo = {x, 0, 0};
        b.hi = {x + width - 1, 9, 9};
        entries_.push_back(PackedBox::of(Frame{}, b));
    }
    bool run() {
        operands_.clear();
        for (const PackedBox& e : entries_) {
            CellOperand o;
            o.is_list = true;
            o.entries = &e;
            o.count = 1;
            o.box = e;
            operands_.push_back(o);
        }
        CellTask task;
        task.has_frame = true;
        task.operands = operands_;
        return is_crowded(task);
    }
    std::vector<PackedBox> entries_;
    std::vector<CellOperand> operands_;
};

TEST_F(BoxesInACell, AreCrowdedWhereTheyAreNearlyTheSame) {
    for (std::int64_t i = 0; i < 8; ++i) add(i, 100);
    EXPECT_TRUE(run());
}

TEST_F(BoxesInACell, AreNotSideBySide) {
    for (std::int64_t i = 0; i < 8; ++i) add(100 * i, 100);
    EXPECT_FALSE(run());
}

TEST_F(BoxesInACell, AreNotInARowWhereEachMeetsItsNeighbours) {
    for (std::int64_t i = 0; i < 8; ++i) add(50 * i, 100);
    EXPECT_FALSE(run());
}

}  // namespace
}  // namespace trisect::detail

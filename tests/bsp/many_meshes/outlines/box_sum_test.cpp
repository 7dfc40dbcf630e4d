// SPDX-License-Identifier: Apache-2.0
//
// One box against many (box_sum.h), as OutlineBox has it.

#include <trisect/bsp/many_meshes/outlines/box_sum.h>

#include <cstddef>
#include <random>

#include <gtest/gtest.h>

namespace {

using trisect::Approximation;
using trisect::detail::BoxProbe;
using trisect::detail::BoxSum;
using trisect::detail::OutlineBox;

TEST(BoxSum, IsTheBoxOfAll) {
    std::mt19937 random(1);
    std::uniform_int_distribution<int> any(-4, 4);
    EXPECT_EQ(BoxSum().box().lo, OutlineBox::none().lo);
    EXPECT_EQ(BoxSum().box().hi, OutlineBox::none().hi);
    for (int turn = 0; turn < 50; ++turn) {
        OutlineBox naive = OutlineBox::none();
        BoxSum sum;
        OutlineBox last;
        for (int i = 0; i < 20; ++i) {
            OutlineBox b;
            for (std::size_t k = 0; k < 3; ++k) {
                b.lo[k] = any(random);
                b.hi[k] = b.lo[k] + any(random) + 4;
            }
            EXPECT_EQ(BoxProbe(last).meets(b), last.meets(b));
            last = b;
            naive.add(b);
            sum.add(b);
            EXPECT_EQ(sum.box().lo, naive.lo);
            EXPECT_EQ(sum.box().hi, naive.hi);
            EXPECT_EQ(BoxSum(b).box().lo, b.lo);
            EXPECT_EQ(BoxSum(b).box().hi, b.hi);
        }
    }
}

TEST(BoxSum, AddsPointsWithTheirErrors) {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> any(-1, 1);
    OutlineBox naive = OutlineBox::none();
    BoxSum sum;
    for (int i = 0; i < 200; ++i) {
        const Approximation p{{any(random), any(random), any(random)},
                              i % 3 == 0 ? 0 : 1e-3 * (1 + any(random))};
        naive.add(p);
        sum.add(p);
        EXPECT_EQ(sum.box().lo, naive.lo);
        EXPECT_EQ(sum.box().hi, naive.hi);
    }
}

}  // namespace

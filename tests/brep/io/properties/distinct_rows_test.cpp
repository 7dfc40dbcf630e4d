// SPDX-License-Identifier: Apache-2.0
#include <trisect/brep/io/properties/distinct_rows.h>

#include <trisect/brep/corner_properties.h>

#include <gtest/gtest.h>

#include <random>

namespace {

using namespace trisect;
using namespace trisect::detail;

TEST(DistinctRows, AreNumberedAsTheyAppear) {
    const DistinctRows rows =
        distinct_rows({2, {3, 4, 1, 2, 3, 4, 1, absent_number, 1, -absent_number, 1, 2}});
    EXPECT_EQ(rows.number, (std::vector<std::uint32_t>{0, 1, 0, 2, 2, 1}));
    EXPECT_EQ(rows.first, (std::vector<std::size_t>{0, 1, 3}));
}

TEST(DistinctRows, MayKeepTheOrderOfVertices) {
    const DistinctRows rows = distinct_rows_by_vertex({2, {2, 9, 0, 9, 1, 9, 0, 8, 2, 9}});
    EXPECT_EQ(rows.number, (std::vector<std::uint32_t>{3, 0, 2, 1, 3}));
    EXPECT_EQ(rows.first, (std::vector<std::size_t>{1, 3, 2, 0}));
}

TEST(DistinctRows, ZerosOfEitherSignDiffer) {
    EXPECT_EQ(distinct_rows({1, {0.0, -0.0, 0.0}}).number, (std::vector<std::uint32_t>{0, 1, 0}));
}

TEST(DistinctRows, AgreeWithALook) {
    std::mt19937 random(5);
    NumberRows rows{2, {}};
    for (int i = 0; i < 600; ++i) rows.values.push_back(static_cast<double>(random() % 5));
    const DistinctRows distinct = distinct_rows(rows);
    for (std::size_t a = 0; a < rows.count(); ++a)
        for (std::size_t b = 0; b < rows.count(); ++b) {
            const bool same = rows.values[2 * a] == rows.values[2 * b] &&
                              rows.values[2 * a + 1] == rows.values[2 * b + 1];
            ASSERT_EQ(distinct.number[a] == distinct.number[b], same);
        }
}

}  // namespace

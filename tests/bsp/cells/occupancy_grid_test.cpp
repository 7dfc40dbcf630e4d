// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/cells/occupancy_grid.h>

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <random>

namespace {

using trisect::detail::axis_units_limit;
using trisect::detail::transpose;
using trisect::detail::unit_bits;
using trisect::detail::UnitRows;

constexpr std::uint64_t seed = 20261201;

TEST(OccupancyGrid, RowsOfAnySizeAreTransposed) {
    std::mt19937_64 engine(seed);
    for (std::size_t size = 1; size <= axis_units_limit; ++size) {
        UnitRows rows{};
        for (std::size_t r = 0; r < size; ++r) rows[r] = engine() & unit_bits(0, size);
        UnitRows turned = rows;
        transpose(turned, size);
        for (std::size_t r = 0; r < axis_units_limit; ++r)
            for (std::size_t b = 0; b < axis_units_limit; ++b)
                ASSERT_EQ(turned[b] >> r & 1, rows[r] >> b & 1)
                    << "size " << size << ", row " << r << ", bit " << b;
    }
}

}  // namespace

// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/cells/occupancy_grid.h>

#include <algorithm>
#include <bit>

namespace trisect::detail {

// Swaps quarters, then quarters of quarters (Warren, "Hacker's Delight", section 7-3).
void transpose(UnitRows& rows, std::size_t size) {
    const std::size_t whole = std::bit_ceil(size);
    std::size_t n = whole / 2;
    std::uint64_t mask = ~std::uint64_t{0} / ((std::uint64_t{1} << n) + 1);
    for (; n != 0; n /= 2, mask ^= mask << n) {
        for (std::size_t i = 0; i < whole; i = (i + n + 1) & ~n) {
            const std::uint64_t t = (rows[i] >> n ^ rows[i + n]) & mask;
            rows[i] ^= t << n;
            rows[i + n] ^= t;
        }
    }
}

std::vector<OccupancyGrid::Layer> OccupancyGrid::layers(std::size_t axis) const {
    std::vector<Layer> out(planes[axis].size() - 1);
    const std::size_t row_count = planes[1].size() - 1;
    for (std::size_t z = 0; z + 1 < planes[2].size(); ++z) {
        const std::uint64_t* const rows = units.data() + z * row_count;
        if (axis == 2) {
            std::copy(rows, rows + row_count, out[z].begin());
        } else if (axis == 1) {
            for (std::size_t y = 0; y < row_count; ++y) out[y][z] = rows[y];
        } else {
            Layer across{};
            std::copy(rows, rows + row_count, across.begin());
            transpose(across, std::max(row_count, out.size()));
            for (std::size_t x = 0; x < out.size(); ++x) out[x][z] = across[x];
        }
    }
    return out;
}

std::size_t OccupancyGrid::bytes() const {
    std::size_t out =
        units.size() * sizeof(std::uint64_t) + parts.size() * sizeof(Part) + facets.bytes();
    for (const auto& p : planes) out += p.size() * sizeof(Int128);
    return out;
}

}  // namespace trisect::detail

// SPDX-License-Identifier: Apache-2.0
//
// A counting sort by the cell of a coarse grid, cells in the order of their bits taken in turns
// from the three axes. Each part of the points counts for itself, so that all parts can write at
// once.

#include <trisect/bsp/query/points/place_order.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include <trisect/kernel/support/parallel_parts.h>

namespace trisect::detail {

namespace {

constexpr unsigned most_bits = 5;  // of an axis

// Cells of a grid of 2^bits along each axis of the solid's box.
class PlaceCells {
public:
    PlaceCells(const IndexBase& index, unsigned bits) : last_((1U << bits) - 1) {
        const double unit = std::ldexp(1.0, index.lattice().exponent);
        for (std::size_t k = 0; k < 3; ++k) {
            const double extent = (index.hi()[k] - index.lo()[k]) * unit;
            from_[k] = index.lo()[k] * unit;
            scale_[k] = extent > 0 ? static_cast<double>(1U << bits) / extent : 0;
        }
        for (std::uint32_t i = 0; i <= last_; ++i)
            for (unsigned b = 0; b < bits; ++b) spread_[i] |= (i >> b & 1U) << (3 * b);
    }
    [[nodiscard]] std::uint32_t of(const std::array<double, 3>& p) const {
        return along(p, 0) | along(p, 1) << 1U | along(p, 2) << 2U;
    }

private:
    [[nodiscard]] std::uint32_t along(const std::array<double, 3>& p, std::size_t k) const {
        const double t = (p[k] - from_[k]) * scale_[k];
        if (!(t > 0)) return 0;  // also for no number
        return spread_[t < last_ ? static_cast<std::uint32_t>(t) : last_];
    }
    std::uint32_t last_;
    std::array<double, 3> from_{};
    std::array<double, 3> scale_{};
    std::array<std::uint32_t, 1U << most_bits> spread_{};
};

}  // namespace

std::vector<std::uint32_t> in_order_of_places(const IndexBase& index,
                                              std::span<const std::array<double, 3>> points,
                                              unsigned threads) {
    // About as many cells as points: finer, the table would take longer than the points.
    const unsigned bits =
        std::min(most_bits, static_cast<unsigned>(std::bit_width(points.size())) / 3);
    const PlaceCells cells(index, bits);
    const std::size_t count = std::size_t{1} << (3 * bits);
    std::vector<std::uint16_t> cell(points.size());
    const ParallelParts parts(points.size(), threads);
    std::vector<std::vector<std::uint32_t>> begin(parts.count());
    parts.for_each([&](std::size_t part, std::size_t first, std::size_t end) {
        begin[part].assign(count, 0);
        for (std::size_t i = first; i < end; ++i) {
            const std::uint32_t c = cells.of(points[i]);
            cell[i] = static_cast<std::uint16_t>(c);
            ++begin[part][c];
        }
    });
    std::uint32_t sum = 0;
    for (std::size_t c = 0; c < count; ++c)
        for (auto& of_part : begin) {
            const std::uint32_t n = of_part[c];
            of_part[c] = sum;
            sum += n;
        }
    std::vector<std::uint32_t> order(points.size());
    parts.for_each([&](std::size_t part, std::size_t first, std::size_t end) {
        for (std::size_t i = first; i < end; ++i)
            order[begin[part][cell[i]]++] = static_cast<std::uint32_t>(i);
    });
    return order;
}

}  // namespace trisect::detail

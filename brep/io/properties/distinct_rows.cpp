// SPDX-License-Identifier: Apache-2.0
#include <trisect/brep/io/properties/distinct_rows.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

namespace trisect::detail {
namespace {

std::uint64_t bits_of(double value) {
    return std::bit_cast<std::uint64_t>(std::isnan(value) ? std::numeric_limits<double>::quiet_NaN()
                                                          : value);
}

}  // namespace

DistinctRows distinct_rows(const NumberRows& rows) {
    const std::size_t n = rows.count();
    const auto compare = [&](std::size_t a, std::size_t b) {
        for (std::size_t i = 0; i < rows.width; ++i) {
            const std::uint64_t x = bits_of(rows.values[a * rows.width + i]);
            const std::uint64_t y = bits_of(rows.values[b * rows.width + i]);
            if (x != y) return x < y ? -1 : 1;
        }
        return 0;
    };
    std::vector<std::size_t> order(n);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        const int sign = compare(a, b);
        return sign != 0 ? sign < 0 : a < b;
    });
    // The first row of each run of equal ones stands for them.
    std::vector<std::size_t> leader(n);
    for (std::size_t i = 0; i < n; ++i)
        leader[order[i]] =
            i != 0 && compare(order[i - 1], order[i]) == 0 ? leader[order[i - 1]] : order[i];
    DistinctRows out;
    out.number.resize(n);
    for (std::size_t row = 0; row < n; ++row) {
        if (leader[row] == row) {
            out.number[row] = static_cast<std::uint32_t>(out.first.size());
            out.first.push_back(row);
        } else {
            out.number[row] = out.number[leader[row]];
        }
    }
    return out;
}

DistinctRows distinct_rows_by_vertex(const NumberRows& rows) {
    const DistinctRows found = distinct_rows(rows);
    std::vector<std::uint32_t> order(found.first.size());
    std::iota(order.begin(), order.end(), 0U);
    const auto vertex = [&](std::uint32_t i) { return rows.values[found.first[i] * rows.width]; };
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return vertex(a) < vertex(b); });
    DistinctRows out;
    std::vector<std::uint32_t> place(order.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) {
        place[order[i]] = i;
        out.first.push_back(found.first[order[i]]);
    }
    out.number.reserve(found.number.size());
    for (const std::uint32_t n : found.number) out.number.push_back(place[n]);
    return out;
}

}  // namespace trisect::detail

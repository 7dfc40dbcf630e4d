// SPDX-License-Identifier: Apache-2.0
//
// Distinct rows of numbers: vertices that formats have per combination.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace trisect::detail {

/// Rows of `width` numbers, one after the other.
struct NumberRows {
    std::size_t width = 0;
    std::vector<double> values;
    [[nodiscard]] std::size_t count() const { return width == 0 ? 0 : values.size() / width; }
};

/// Distinct rows, numbered as they first appear. Rows are equal where their bits are, but for
/// absent numbers, which are all alike. O(n log n), whatever the numbers are.
struct DistinctRows {
    std::vector<std::uint32_t> number;  ///< by row
    std::vector<std::size_t> first;     ///< by number: the first such row
};

/// \pre width > 0, fewer than 2^32 rows
[[nodiscard]] DistinctRows distinct_rows(const NumberRows& rows);

/// The same, numbered by the first column, which rows of one number have in common, and then as
/// they appear: vertices that are not repeated keep their order.
[[nodiscard]] DistinctRows distinct_rows_by_vertex(const NumberRows& rows);

}  // namespace trisect::detail

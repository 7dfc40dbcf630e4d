// SPDX-License-Identifier: Apache-2.0
//
// Points in the order of their places.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/bsp/query/index/index_core.h>

namespace trisect::detail {

/// The numbers of all points, given in the user's units, along a curve that fills the solid's box:
/// neighbours in the order are mostly neighbours in space. Points in one cell of a coarse grid keep
/// their order.
[[nodiscard]] std::vector<std::uint32_t> in_order_of_places(
    const IndexBase& index, std::span<const std::array<double, 3>> points, unsigned threads);

}  // namespace trisect::detail

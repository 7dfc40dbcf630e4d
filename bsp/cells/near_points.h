// SPDX-License-Identifier: Apache-2.0
//
// Groups of possibly equal points of a workbench, for exact comparison.
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include <trisect/bsp/cells/workbench.h>

namespace trisect::detail {

/// Calls `visit` for every group of two points or more, each sorted by id. Points of equal value
/// are always in one group; points of different value may be, when they are very close. The order
/// of the groups depends on the points only. O(n log n). `visit` is called by this thread;
/// `threads` as in ParallelParts.
void for_each_near_group(const Workbench& bench,
                         const std::function<void(std::span<const PointId>)>& visit,
                         std::uint32_t threads = 1);

}  // namespace trisect::detail

// SPDX-License-Identifier: Apache-2.0
//
// Points that are equal under different names.
#pragma once

#include <cstdint>

#include <trisect/bsp/assembly/parts/boundary_parts.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

/// By point: one of those that are equal to it. That is a corner of a source if there is one, of
/// the one with that serial first, else the point made first. `threads` as in ParallelParts.
[[nodiscard]] PoolVector<PointId> representatives(BoundaryParts& parts, std::uint64_t serial,
                                                  std::uint32_t threads = 1);
/// By point: itself.
[[nodiscard]] PoolVector<PointId> points_as_named(const BoundaryParts& parts);

}  // namespace trisect::detail

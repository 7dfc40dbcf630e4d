// SPDX-License-Identifier: Apache-2.0
//
// Plane sections of an index.
#pragma once

#include <vector>

#include <trisect/bsp/query/index/index_core.h>

namespace trisect::detail {

[[nodiscard]] std::vector<SectionRegion> section(const IndexCore& core, const Plane& plane);
[[nodiscard]] PlaneRelation relation_to(const IndexCore& core, const Plane& plane);

}  // namespace trisect::detail

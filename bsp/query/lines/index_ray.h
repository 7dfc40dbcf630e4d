// SPDX-License-Identifier: Apache-2.0
//
// Ray queries of an index.
#pragma once

#include <optional>
#include <vector>

#include <trisect/bsp/query/index/index_core.h>
#include <trisect/bsp/query/lines/index_line.h>

namespace trisect::detail {

/// The first piece of the boundary on the line, and all of them (see RayHit). Handles of places are
/// set when the core has them.
[[nodiscard]] std::optional<RayHit> first_hit(const IndexCore& core, const IndexLine& line);
[[nodiscard]] std::vector<RayHit> all_hits(const IndexCore& core, const IndexLine& line);

/// The first hit's face and bounds of its parameter only.
[[nodiscard]] std::optional<FacetHit> first_facet(const IndexCore& core, const IndexLine& line);

}  // namespace trisect::detail

// SPDX-License-Identifier: Apache-2.0
//
// Memory of the facts of nodes.
#pragma once

#include <cstddef>

#include <trisect/bsp/cells/cell_tree.h>

namespace trisect::detail {

/// Bytes of the facts of a node that queries have made: bounds, and the index of a leaf or the
/// block of an inner node with what hangs on it. Those of other nodes are not counted.
[[nodiscard]] std::size_t query_fact_bytes(const CellNode& node);

}  // namespace trisect::detail

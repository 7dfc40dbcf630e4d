// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/query/index/fact_bytes.h>

#include <trisect/bsp/query/index/branch_block.h>
#include <trisect/bsp/query/index/coarse_map.h>
#include <trisect/bsp/query/index/index_core.h>
#include <trisect/bsp/query/index/indexed_leaf.h>

namespace trisect::detail {

std::size_t query_fact_bytes(const CellNode& node) {
    std::size_t bytes = node.bounds_fact().get() != nullptr ? sizeof(NodeBounds) : 0;
    const NodeFact* const index = node.index_fact().get();
    if (index == nullptr) return bytes;
    if (node.is_leaf()) return bytes + static_cast<const IndexedLeaf&>(*index).stats().bytes;
    bytes += sizeof(BranchBlock);
    const FactSlot& root = static_cast<const BranchBlock&>(*index).root_fact();
    if (const NodeFact* const map = root.get())
        bytes += static_cast<const CoarseMap&>(*map).bytes();
    return bytes;
}

}  // namespace trisect::detail

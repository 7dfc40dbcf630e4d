// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/query/index/branch_block.h>

#include <bit>
#include <memory>

#include <trisect/bsp/query/index/index_core.h>

namespace trisect::detail {

namespace {

// Its last bits are 0.
constexpr double no_wall = 0x1p1000;

}  // namespace

const BranchBlock& BranchBlock::of(const CellNode& node) {
    // The block looks at facts of leaves, which may have the same lock.
    for (int i = 0; node.index_fact().get() == nullptr && i < 2; ++i) {
        const CellNode& child = refined(*node.child(i).node);
        for (int j = 0; !child.is_leaf() && j < 2; ++j) (void)refined(*child.child(j).node);
    }
    return static_cast<const BranchBlock&>(
        node.index_fact().get_or([&] { return std::make_unique<const BranchBlock>(node); }));
}

BranchBlock::BranchBlock(const CellNode& node) : node_(node) {
    std::array<const CellNode*, 7> nodes{&node};
    walls_.fill(no_wall);
    for (std::size_t at = 0; at < 7; ++at) {
        if (nodes[at] == nullptr) continue;
        const CellNode& n = *nodes[at];
        const auto bits = std::bit_cast<std::uint64_t>(rounded_position(n.splitter()));
        walls_[at] = std::bit_cast<double>((bits & ~std::uint64_t{3}) |
                                           static_cast<std::uint64_t>(n.axis()));
        for (std::size_t i = 0; at < 3 && i < 2; ++i) {
            const CellNode& child = refined(*n.child(static_cast<int>(i)).node);
            if (!child.is_leaf()) nodes[2 * at + 1 + i] = &child;
        }
    }
}

BranchBlock::Next BranchBlock::find_next(int way) const {
    const CellNode* node = &node_;
    bool turned = false;
    std::size_t at = 0;
    for (int level = 2; level >= 0; --level) {
        if (walls_[at] == no_wall) break;
        const int side = way >> level & 1;
        const CellRef& child = refined(*node).child(side);
        turned = turned != child.complemented;
        node = child.node.get();
        at = 2 * at + 1 + static_cast<std::size_t>(side);
    }
    const CellNode& end = refined(*node);
    Next next;
    if (!end.is_leaf()) {
        next = Next::block(of(end), turned);
    } else if (end.size() == 0) {
        next = Next::empty((end.winding() > 0) != turned);
    } else if (const NodeFact* const fact = end.index_fact().get()) {
        next = Next::leaf(static_cast<const IndexedLeaf&>(*fact), turned);
    }
    if (next.is_known())
        next_[static_cast<std::size_t>(way)].store(next.word_, std::memory_order_release);
    return next;
}

}  // namespace trisect::detail

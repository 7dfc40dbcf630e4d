// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <chrono>
#include <memory>
#include <vector>

#include <trisect/bsp/cells/deferred_leaf.h>
#include <trisect/bsp/cells/lazy_tree.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/query/index/branch_block.h>
#include <trisect/bsp/query/index/coarse_map.h>
#include <trisect/bsp/query/index/index_core.h>

namespace trisect::detail {

namespace {

const NodeBounds* known_bounds(const CellNode& node) {
    return static_cast<const NodeBounds*>(node.bounds_fact().get());
}

void add(Box& box, const PolygonList& list) {
    if (list.has_all_facets()) {
        box.add(list.whole_source()->box());
        return;
    }
    for (const PolygonRef r : list) box.add(r.box());
}

// What a deferred leaf lists is a part of what its operands do; it is not arranged for its bounds.
Box leaf_bounds(const CellNode& leaf) {
    Box box;
    if (leaf.size() == 0) return box;
    if (const DeferredLeaf* const deferred = leaf.deferred()) {
        for (const DeferredLeaf::Operand& operand : deferred->operands) add(box, operand.polygons);
    } else {
        add(box, leaf.polygons());
    }
    return box;
}

const NodeBounds& keep_bounds(const CellNode& node, const CellNode& queried, const Box& box) {
    const auto make = [&] {
        auto fact = std::make_unique<NodeBounds>();
        fact->box = box;
        fact->queried = &queried;
        return fact;
    };
    return static_cast<const NodeBounds&>(node.bounds_fact().get_or(make));
}

// A boundary that may cross itself is made free of that first.
Solid resolved(const Solid& solid) {
    return state_of(solid)->embedded ? solid : evaluate(Expression(solid));
}

}  // namespace

const NodeBounds& node_bounds(const CellNode& node) {
    if (const NodeBounds* const known = known_bounds(node)) return *known;
    // Children first, and refinements of leaves; nodes are put off until theirs are known.
    std::vector<const CellNode*> pending{&node};
    for (;;) {
        const CellNode& n = *pending.back();
        Box box;
        const CellNode* queried = &n;
        if (n.is_leaf()) {
            if (const CellNode* const refinement = n.refinement()) {
                const NodeBounds* const known = known_bounds(*refinement);
                if (known == nullptr) {
                    pending.push_back(refinement);
                    continue;
                }
                queried = refinement;
                box = known->box;
            } else {
                box = leaf_bounds(n);
            }
        } else {
            const std::size_t before = pending.size();
            for (int i = 0; i < 2; ++i) {
                const CellNode* const child = n.child(i).node.get();
                if (const NodeBounds* const known = known_bounds(*child)) {
                    if (!known->box.is_empty()) box.add(known->box);
                } else {
                    pending.push_back(child);
                }
            }
            if (pending.size() != before) continue;
        }
        const NodeBounds& kept = keep_bounds(n, *queried, box);
        pending.pop_back();
        if (pending.empty()) return kept;
    }
}

IndexBase::IndexBase(const Solid& s)
    : solid_(resolved(s)), state_(cut_state(solid_)), root_(state_->root()) {
    const auto start = std::chrono::steady_clock::now();
    const Box& box = bounds_of(*root_.node);
    for (std::size_t k = 0; k < 3; ++k) {
        const std::int64_t lo = box.is_empty() ? 0 : box.lo[k];
        const std::int64_t hi = box.is_empty() ? 0 : box.hi[k];
        bounded_ = bounded_ && std::max(-lo, hi) < coordinate_limit;
        // Room for the reference point of a fresh mesh.
        lo_[k] = static_cast<double>(lo - 3);
        hi_[k] = static_cast<double>(hi + 3);
    }
    if (const CellNode& node = refined(*root_.node); !node.is_leaf())
        root_block_ = &BranchBlock::of(node);
    beyond_ = state_of(solid_)->far_out;
    build_seconds_ =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

const IndexedLeaf* IndexBase::find_only_leaf() const {
    const CellNode& node = *root_.node;
    if (!node.is_leaf() || node.size() == 0) return nullptr;
    const IndexedLeaf& leaf = indexed_leaf(node, Cell{});
    only_leaf_.store(&leaf, std::memory_order_release);
    return &leaf;
}

const CoarseMap& IndexBase::find_coarse_map() const {
    const auto& map = static_cast<const CoarseMap&>(root_block_->root_fact().get_or([&] {
        return std::make_unique<const CoarseMap>(*root_.node, DoubleBox{lo_, hi_});
    }));
    coarse_map_.store(&map, std::memory_order_release);
    return map;
}

bool IndexBase::is_inside_beyond() const {
    std::int8_t known = beyond_.load(std::memory_order_relaxed);
    if (known < 0) {
        std::vector<PolygonId> on;
        known = locate_in_leaves(*this, IndexPoint(lo_), on) == Location::Inside ? 1 : 0;
        beyond_.store(known, std::memory_order_relaxed);
    }
    return known != 0;
}

}  // namespace trisect::detail

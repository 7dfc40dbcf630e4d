// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/native/native_tree.h>

#include <algorithm>
#include <cstddef>
#include <limits>

#include <trisect/kernel/error.h>

namespace trisect::detail {

namespace {

// One number is left for "none".
constexpr std::size_t most_numbered = std::numeric_limits<std::uint32_t>::max() - 1;

const CellNode* with_refinements(const CellNode* node, bool refined) {
    while (refined && node->is_leaf() && node->refinement() != nullptr) node = node->refinement();
    return node;
}

}  // namespace

NativeTree::NativeTree(const CellNode& root, bool refined) {
    visit(root, refined);
    std::ranges::stable_sort(sources_, {}, &Source::serial);
    for (std::uint32_t i = 0; const Source* s : sources_) source_numbers_[s] = i++;
}

void NativeTree::visit(const CellNode& root, bool refined) {
    struct Pending {
        const CellNode* node = nullptr;
        std::uint64_t depth = 0;
        std::size_t parent = 0;  // whose child above the splitting plane it is
        bool is_above = false;
    };
    std::vector<Pending> pending{{&root, 1, 0, false}};
    while (!pending.empty()) {
        const Pending next = pending.back();
        pending.pop_back();
        depth_ = std::max(depth_, next.depth);
        if (next.is_above) {
            nodes_[next.parent].above = nodes_.size();
            nodes_[next.parent].leaf = leaves_.size();
        }
        const CellNode* const node = with_refinements(next.node, refined);
        nodes_.push_back({node, 0, leaves_.size()});
        if (node->is_leaf()) {
            add_leaf(*node);
            continue;
        }
        pending.push_back({node->child(1).node.get(), next.depth + 1, nodes_.size() - 1, true});
        pending.push_back({node->child(0).node.get(), next.depth + 1, 0, false});
    }
}

void NativeTree::add_leaf(const CellNode& leaf) {
    leaves_.push_back(&leaf);
    const PolygonList& polygons = leaf.polygons();
    if (polygons.whole_source() != nullptr) return add(polygons.whole_source());
    for (const PolygonRef& r : polygons) {
        add(r.source);
        if (r.fragment == nullptr) continue;
        add(r.fragment);
        for (const EdgeName& e : r.fragment->edges())
            if (const Source* s = e.plane.source()) add(s);
    }
}

void NativeTree::add(const Source* source) {
    if (!source_numbers_.emplace(source, 0).second) return;
    if (sources_.size() >= most_numbered) throw LimitError("too many sources for a native file");
    sources_.push_back(source);
}

void NativeTree::add(const Fragment* fragment) {
    const auto number = static_cast<std::uint32_t>(fragments_.size());
    if (!fragment_numbers_.emplace(fragment, number).second) return;
    if (fragments_.size() >= most_numbered)
        throw LimitError("too many parts of facets for a native file");
    fragments_.push_back(fragment);
}

}  // namespace trisect::detail

// SPDX-License-Identifier: Apache-2.0
//
// Trees may be deep, so they are walked with a stack of our own. The path from the root decides
// what a leaf means: every complemented reference on it turns inside and outside around.
#include <trisect/bsp/cell_tree_view.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include <trisect/bsp/cells/cell_tree.h>
#include <trisect/bsp/cells/lazy_tree.h>
#include <trisect/kernel/error.h>

namespace trisect {
namespace {

using detail::Cell;
using detail::CellNode;
using detail::CellRef;
using detail::Fragment;
using detail::PolygonRef;

/// A node on the way: where it is and how it is to be read.
struct Visit {
    const CellNode* node = nullptr;
    bool complemented = false;
    std::size_t depth = 0;
    Cell cell;
};

Visit root_of(const Solid& solid) {
    const CellRef& root = detail::cut_state(solid)->root();
    return {root.node.get(), root.complemented, 0, Cell()};
}

Visit child_of(const Visit& visit, int i) {
    const CellRef& child = visit.node->child(i);
    const int axis = visit.node->axis();
    const std::int64_t splitter = visit.node->splitter();
    return {child.node.get(), visit.complemented != child.complemented, visit.depth + 1,
            i == 0 ? visit.cell.below(axis, splitter) : visit.cell.above(axis, splitter)};
}

bool is_inside(const Visit& leaf) { return (leaf.node->winding() > 0) != leaf.complemented; }

// --- statistics --------------------------------------------------------------------------------

void count_leaf(const Visit& leaf, CellTreeStats& stats, std::vector<const Fragment*>& fragments) {
    const auto& polygons = leaf.node->polygons();
    ++stats.leaves;
    stats.depth = std::max(stats.depth, leaf.depth);
    stats.polygons += polygons.size();
    stats.largest_leaf = std::max(stats.largest_leaf, polygons.size());
    stats.bytes += polygons.bytes();
    if (polygons.empty()) {
        ++(is_inside(leaf) ? stats.inside_leaves : stats.outside_leaves);
        return;
    }
    ++stats.listing_leaves;
    if (leaf.node->is_mixed()) ++stats.arranged_leaves;
    if (polygons.whole_source() != nullptr) return;  // no fragments
    for (const PolygonRef& polygon : polygons) {
        if (polygon.fragment != nullptr) fragments.push_back(polygon.fragment);
    }
}

void count_fragments(std::vector<const Fragment*>& fragments, CellTreeStats& stats) {
    std::sort(fragments.begin(), fragments.end());
    fragments.erase(std::unique(fragments.begin(), fragments.end()), fragments.end());
    stats.fragments = fragments.size();
    for (const Fragment* fragment : fragments) {
        stats.bytes += fragment->bytes();
    }
}

// --- boxes -------------------------------------------------------------------------------------

/// A closed interval of splitting plane positions.
struct PositionInterval {
    std::int64_t lower = 0;
    std::int64_t upper = 0;
};

/// Positions count in 1/192 of the lattice unit. Beyond the universe all positions are alike.
double fine_position(double user, Lattice lattice) {
    return std::ldexp(user, -lattice.exponent) * static_cast<double>(detail::splitting_scale);
}

std::int64_t clamped(double position) {
    constexpr auto limit = static_cast<double>(detail::universe_limit);
    return static_cast<std::int64_t>(std::clamp(position, -limit, limit));
}

PositionInterval interval_of(double lower, double upper, Lattice lattice) {
    if (!(lower <= upper)) throw UsageError("a box of cells needs lower <= upper");
    return {clamped(std::ceil(fine_position(lower, lattice))),
            clamped(std::floor(fine_position(upper, lattice)))};
}

/// A slice may lie between two positions; then `lower` is above `upper` by one and both comparisons
/// still show the side on which it is.
bool meets_below(const PositionInterval& box, std::int64_t splitter) {
    return box.lower <= splitter;
}
bool meets_above(const PositionInterval& box, std::int64_t splitter) {
    return box.upper >= splitter;
}

double user_position(std::int64_t position, Lattice lattice) {
    if (std::abs(position) == detail::universe_limit) {
        return std::copysign(std::numeric_limits<double>::infinity(),
                             static_cast<double>(position));
    }
    return std::ldexp(detail::rounded_position(position), lattice.exponent);
}

CellLeaf leaf_of(const Visit& visit, Lattice lattice) {
    CellLeaf leaf;
    for (std::size_t k = 0; k < 3; ++k) {
        leaf.lo[k] = user_position(visit.cell.lo[k], lattice);
        leaf.hi[k] = user_position(visit.cell.hi[k], lattice);
    }
    leaf.polygons = visit.node->polygons().size();
    leaf.depth = visit.depth;
    leaf.is_inside = leaf.polygons == 0 && is_inside(visit);
    leaf.is_arranged = leaf.polygons != 0 && visit.node->is_mixed();
    return leaf;
}

}  // namespace

CellTreeStats cell_tree_stats(const Solid& solid) {
    CellTreeStats stats;
    std::vector<const Fragment*> fragments;
    std::vector<Visit> stack{root_of(solid)};
    while (!stack.empty()) {
        const Visit visit = stack.back();
        stack.pop_back();
        ++stats.nodes;
        stats.bytes += sizeof(CellNode);
        if (visit.node->is_leaf()) {
            count_leaf(visit, stats, fragments);
        } else {
            stack.push_back(child_of(visit, 1));
            stack.push_back(child_of(visit, 0));
        }
    }
    count_fragments(fragments, stats);
    return stats;
}

std::vector<CellLeaf> cell_tree_leaves(const Solid& solid, const std::array<double, 3>& lower,
                                       const std::array<double, 3>& upper) {
    const Lattice lattice = solid.lattice();
    std::array<PositionInterval, 3> box;
    for (std::size_t k = 0; k < 3; ++k) box[k] = interval_of(lower[k], upper[k], lattice);
    std::vector<CellLeaf> leaves;
    std::vector<Visit> stack{root_of(solid)};
    while (!stack.empty()) {
        const Visit visit = stack.back();
        stack.pop_back();
        if (visit.node->is_leaf()) {
            leaves.push_back(leaf_of(visit, lattice));
            continue;
        }
        const PositionInterval& side = box[static_cast<std::size_t>(visit.node->axis())];
        const std::int64_t splitter = visit.node->splitter();
        if (meets_above(side, splitter)) stack.push_back(child_of(visit, 1));
        if (meets_below(side, splitter)) stack.push_back(child_of(visit, 0));
    }
    return leaves;
}

std::vector<CellTreeNode> cell_tree_nodes(const Solid& solid) {
    static_assert(cell_position_scale == detail::splitting_scale);
    struct Entry {
        Visit visit;
        std::optional<std::size_t> parent;  // whose child above it is
    };
    std::vector<CellTreeNode> nodes;
    std::vector<Entry> stack{{root_of(solid), std::nullopt}};
    while (!stack.empty()) {
        const Entry entry = std::move(stack.back());
        stack.pop_back();
        const Visit& visit = entry.visit;
        if (entry.parent) nodes[*entry.parent].above = nodes.size();
        CellTreeNode& node = nodes.emplace_back();
        if (visit.node->is_leaf()) {
            node.polygons = visit.node->polygons().size();
            node.is_inside = node.polygons == 0 && is_inside(visit);
            node.is_arranged = node.polygons != 0 && visit.node->is_mixed();
            continue;
        }
        node.axis = visit.node->axis();
        node.position = visit.node->splitter();
        stack.push_back({child_of(visit, 1), nodes.size() - 1});
        stack.push_back({child_of(visit, 0), std::nullopt});
    }
    return nodes;
}

}  // namespace trisect

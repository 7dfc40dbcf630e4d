// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/query/index/coarse_map.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

#include <trisect/bsp/query/index/index_core.h>

namespace trisect::detail {

namespace {

constexpr double most_cells = 16384;
constexpr double most_along = 128;
// By how much a cell is enlarged before it is examined, of its size: more than all rounding.
constexpr double margin = 0x1p-7;
// Of a wall's position, for rounding.
constexpr double wall_slack = 0x1p-45;
// After so many points a cell whose leaves have no index yet is given up.
constexpr std::uint8_t last_visit = 128;

// What is known of the space in a box. Unknown: a leaf there has no index yet.
enum class Space : std::uint8_t { Outside, Inside, Mixed, Unknown };

Space space(bool inside) { return inside ? Space::Inside : Space::Outside; }

// Of a box in a leaf's cell.
Space space_in_leaf(const CellNode& leaf, const DoubleBox& box) {
    if (leaf.size() == 0) return space(leaf.winding() > 0);
    const auto* const index = static_cast<const IndexedLeaf*>(leaf.index_fact().get());
    if (index == nullptr || !index->is_divided()) return Space::Unknown;
    if (const auto inside = index->beyond(box.lo, box.hi)) return space(*inside);
    return Space::Mixed;
}

struct Branch {
    const CellNode* node;
    bool turned;
    DoubleBox box;  // as far as it is in the node's cell
};

// The parts of a box on both sides of a wall.
void add_children(const Branch& at, const CellNode& n, std::vector<Branch>& pending) {
    const auto axis = static_cast<std::size_t>(n.axis());
    const double wall = rounded_position(n.splitter());
    const double slack = std::fabs(wall) * wall_slack;
    for (int i = 0; i < 2; ++i) {
        Branch next{n.child(i).node.get(), at.turned != n.child(i).complemented, at.box};
        double& end = (i == 0 ? next.box.hi : next.box.lo)[axis];
        end = i == 0 ? std::min(end, wall + slack) : std::max(end, wall - slack);
        if (next.box.lo[axis] <= next.box.hi[axis]) pending.push_back(next);
    }
}

Space space_in_tree(const CellNode& root, const DoubleBox& box) {
    std::vector<Branch> pending{{&root, false, box}};
    Space all = Space::Unknown;
    while (!pending.empty()) {
        const Branch at = pending.back();
        pending.pop_back();
        const CellNode& n = refined(*at.node);
        if (!n.is_leaf()) {
            add_children(at, n, pending);
            continue;
        }
        Space here = space_in_leaf(n, at.box);
        if (here == Space::Mixed || here == Space::Unknown) return here;
        if (at.turned) here = here == Space::Inside ? Space::Outside : Space::Inside;
        if (all != Space::Unknown && all != here) return Space::Mixed;
        all = here;
    }
    return all;
}

}  // namespace

CoarseMap::CoarseMap(const CellNode& node, const DoubleBox& box) : lo_(box.lo), node_(node) {
    std::array<double, 3> extent{};
    for (std::size_t k = 0; k < 3; ++k) extent[k] = box.hi[k] - box.lo[k];
    double size = std::max({extent[0], extent[1], extent[2]});
    const auto along = [&](std::size_t k) {
        return std::clamp(std::floor(extent[k] / size), 1.0, most_along);
    };
    while (along(0) < most_along && along(1) < most_along && along(2) < most_along &&
           along(0) * along(1) * along(2) < most_cells / 1.3)
        size *= 0.95;
    for (std::size_t k = 0; k < 3; ++k) {
        last_[k] = along(k);
        n_[k] = static_cast<std::uint32_t>(last_[k]);
        scale_[k] = last_[k] / extent[k];
    }
    states_ = std::make_unique<std::atomic<std::uint8_t>[]>(count());
}

DoubleBox CoarseMap::enlarged_cell(std::size_t cell) const {
    const std::array<std::size_t, 3> i{cell % n_[0], cell / n_[0] % n_[1], cell / n_[0] / n_[1]};
    DoubleBox box;
    for (std::size_t k = 0; k < 3; ++k) {
        box.lo[k] = lo_[k] + (static_cast<double>(i[k]) - margin) / scale_[k];
        box.hi[k] = lo_[k] + (static_cast<double>(i[k]) + 1 + margin) / scale_[k];
    }
    return box;
}

CoarseMap::Side CoarseMap::visit(std::size_t cell, std::uint8_t visits) const {
    ++visits;
    std::uint8_t state = visits;
    // The second point, the fourth, the eighth and so on.
    if (visits > 1 && std::has_single_bit(visits)) {
        const Space found = space_in_tree(node_, enlarged_cell(cell));
        if (found == Space::Mixed || (found == Space::Unknown && visits == last_visit)) {
            state = open;
        } else if (found != Space::Unknown) {
            state = found == Space::Inside ? outside + 1 : outside;
        }
    }
    states_[cell].store(state, std::memory_order_relaxed);
    return state < outside ? Side::Open : static_cast<Side>(state - outside);
}

}  // namespace trisect::detail

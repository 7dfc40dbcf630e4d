// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/query/index/coarse_map.h>

#include <algorithm>
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

struct Branch {
    const CellNode* node;
    DoubleBox box;  // as far as it is in the node's cell
};

// Bounds that were not needed yet are not made for this: they would be those of all nodes below.
bool may_have_polygons(const CellNode& node, const DoubleBox& box) {
    constexpr std::int64_t around = 3;  // positions are rounded
    if (node.size() == 0) return false;
    const NodeFact* const known = node.bounds_fact().get();
    if (known == nullptr) return true;
    const Box& bounds = static_cast<const NodeBounds&>(*known).box;
    if (bounds.is_empty()) return false;
    for (std::size_t k = 0; k < 3; ++k)
        if (box.lo[k] > static_cast<double>(bounds.hi[k] + around) ||
            box.hi[k] < static_cast<double>(bounds.lo[k] - around))
            return false;
    return true;
}

// The parts of a box on both sides of a wall.
void add_children(const Branch& at, const CellNode& n, std::vector<Branch>& pending) {
    const auto axis = static_cast<std::size_t>(n.axis());
    const double wall = rounded_position(n.splitter());
    const double slack = std::fabs(wall) * wall_slack;
    for (int i = 0; i < 2; ++i) {
        Branch next{n.child(i).node.get(), at.box};
        double& end = (i == 0 ? next.box.hi : next.box.lo)[axis];
        end = i == 0 ? std::min(end, wall + slack) : std::max(end, wall - slack);
        if (next.box.lo[axis] <= next.box.hi[axis]) pending.push_back(next);
    }
}

}  // namespace

CoarseMap::CoarseMap(const CellNode& node, const DoubleBox& box) : lo_(box.lo), node_(node) {
    std::array<double, 3> extent{};
    for (std::size_t k = 0; k < 3; ++k) extent[k] = box.hi[k] - box.lo[k];
    double size = std::max({extent[0], extent[1], extent[2]});
    const auto along = [&](std::size_t k) {
        return std::clamp(std::floor(extent[k] / size), 1.0, most_along);
    };
    const auto finer = [&] {
        double count = 1;
        for (std::size_t k = 0; k < 3; ++k) {
            if (along(k) == most_along) return false;
            count *= along(k);
        }
        return count < most_cells / 1.3;
    };
    while (finer()) size *= 0.95;
    for (std::size_t k = 0; k < 3; ++k) {
        last_[k] = along(k);
        n_[k] = static_cast<std::uint32_t>(last_[k]);
        scale_[k] = last_[k] / extent[k];
    }
    states_ = std::make_unique_for_overwrite<std::atomic<std::uint8_t>[]>(count());
    for (std::size_t cell = 0; cell < count(); ++cell)
        states_[cell].store(unseen, std::memory_order_relaxed);
}

DoubleBox CoarseMap::enlarged(std::size_t cell) const {
    const std::array<std::size_t, 3> i{cell % n_[0], cell / n_[0] % n_[1], cell / n_[0] / n_[1]};
    DoubleBox box;
    for (std::size_t k = 0; k < 3; ++k) {
        box.lo[k] = lo_[k] + (static_cast<double>(i[k]) - margin) / scale_[k];
        box.hi[k] = lo_[k] + (static_cast<double>(i[k]) + 1 + margin) / scale_[k];
    }
    return box;
}

bool CoarseMap::is_clear(std::size_t cell) const {
    std::vector<Branch> pending{{&node_, enlarged(cell)}};
    while (!pending.empty()) {
        const Branch at = pending.back();
        pending.pop_back();
        const CellNode& n = refined(*at.node);
        if (!may_have_polygons(n, at.box)) continue;
        if (n.is_leaf()) return false;
        add_children(at, n, pending);
    }
    return true;
}

}  // namespace trisect::detail

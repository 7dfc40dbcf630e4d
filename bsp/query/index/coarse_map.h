// SPDX-License-Identifier: Apache-2.0
//
// CoarseMap: parts of a tree's box without boundary.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>

#include <trisect/bsp/cells/cell_tree.h>
#include <trisect/bsp/cells/node_fact.h>
#include <trisect/bsp/query/index/double_box.h>

namespace trisect::detail {

/// A coarse grid over the box of the polygons below a node, a byte a cell. Most of the box of a
/// solid is far from its boundary; there a point needs no descent.
///
/// The second point that comes to a cell has it examined, which takes about as long as a descent:
/// so a map never costs much more than it saves. Only bounds of nodes are read for that, no index.
/// A fact of the root of a tree, whose cell is all of space. Safe to use from many threads: what
/// two of them find is the same.
class CoarseMap final : public NodeFact {
public:
    enum class Side : std::uint8_t { Open, Outside, Inside };

    /// \pre the node fills space, and the box contains all polygons below it and is not flat.
    CoarseMap(const CellNode& node, const DoubleBox& box);

    /// Of a point in the box: its side, as in a tree whose root is not complemented. Open where a
    /// polygon may meet its cell, or where that is not known yet. `is_inside()` is called once a
    /// cell, for a point that is on no polygon.
    template <class IsInside>
    [[nodiscard]] Side at(const std::array<double, 3>& p, const IsInside& is_inside) const {
        std::atomic<std::uint8_t>& cell = states_[cell_of(p)];
        const std::uint8_t state = cell.load(std::memory_order_relaxed);
        if (state < unseen) return static_cast<Side>(state);
        if (state == unseen) {
            cell.store(seen, std::memory_order_relaxed);
            return Side::Open;
        }
        Side side = Side::Open;
        if (is_clear(cell_of(p))) side = is_inside() ? Side::Inside : Side::Outside;
        cell.store(static_cast<std::uint8_t>(side), std::memory_order_relaxed);
        return side;
    }
    [[nodiscard]] std::size_t bytes() const { return sizeof(*this) + count(); }

private:
    // A cell's state is its side, or one of these.
    static constexpr std::uint8_t unseen = 3;
    static constexpr std::uint8_t seen = 4;  // by one point

    [[nodiscard]] std::size_t count() const { return std::size_t{n_[0]} * n_[1] * n_[2]; }
    [[nodiscard]] std::size_t cell_of(const std::array<double, 3>& p) const {
        std::array<std::uint32_t, 3> i{};
        for (std::size_t k = 0; k < 3; ++k) {
            const double t = (p[k] - lo_[k]) * scale_[k];
            i[k] = t > 0 ? (t < last_[k] ? static_cast<std::uint32_t>(t) : n_[k] - 1) : 0;
        }
        return (std::size_t{i[2]} * n_[1] + i[1]) * n_[0] + i[0];
    }
    // Whether no polygon meets a cell.
    [[nodiscard]] bool is_clear(std::size_t cell) const;
    [[nodiscard]] DoubleBox enlarged(std::size_t cell) const;

    std::array<double, 3> lo_{};
    std::array<double, 3> scale_{};
    std::array<double, 3> last_{};
    std::array<std::uint32_t, 3> n_{1, 1, 1};
    std::unique_ptr<std::atomic<std::uint8_t>[]> states_;
    const CellNode& node_;
};

}  // namespace trisect::detail

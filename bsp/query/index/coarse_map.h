// SPDX-License-Identifier: Apache-2.0
//
// CoarseMap: the parts of a tree's box that are inside or outside as a whole.
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
/// A cell is examined when points have come to it a few times, and again later where leaves on its
/// way had no index yet. That takes about as long as a few descents, so it never costs much more
/// than it saves. A fact of the node; of its cell, which is all of space for the root of a tree, it
/// describes the box only. Safe to use from many threads: what two of them find is the same.
class CoarseMap final : public NodeFact {
public:
    enum class Side : std::uint8_t { Outside, Inside, Open };

    /// \pre the box is not empty and contains all polygons below the node, which fills space.
    CoarseMap(const CellNode& node, const DoubleBox& box);

    /// Of a point in the box, given within a millionth of the box: where it is, as in a tree whose
    /// root is not complemented. Open where its cell is not one or the other as a whole, or where
    /// that is not known.
    [[nodiscard]] Side at(const std::array<double, 3>& p) const {
        const std::size_t cell = cell_of(p);
        const std::uint8_t state = states_[cell].load(std::memory_order_relaxed);
        if (state >= open) return state == open ? Side::Open : static_cast<Side>(state - outside);
        return visit(cell, state);
    }
    [[nodiscard]] std::size_t bytes() const { return sizeof(*this) + count(); }

private:
    // Below: how many points have come to a cell.
    static constexpr std::uint8_t open = 253;
    static constexpr std::uint8_t outside = 254;

    [[nodiscard]] std::size_t count() const { return std::size_t{n_[0]} * n_[1] * n_[2]; }
    [[nodiscard]] std::size_t cell_of(const std::array<double, 3>& p) const {
        std::array<std::uint32_t, 3> i{};
        for (std::size_t k = 0; k < 3; ++k) {
            const double t = (p[k] - lo_[k]) * scale_[k];
            i[k] = t > 0 ? (t < last_[k] ? static_cast<std::uint32_t>(t) : n_[k] - 1) : 0;
        }
        return (std::size_t{i[2]} * n_[1] + i[1]) * n_[0] + i[0];
    }
    [[nodiscard]] Side visit(std::size_t cell, std::uint8_t visits) const;
    [[nodiscard]] DoubleBox enlarged_cell(std::size_t cell) const;

    std::array<double, 3> lo_{};
    std::array<double, 3> scale_{};
    std::array<double, 3> last_{};
    std::array<std::uint32_t, 3> n_{1, 1, 1};
    std::unique_ptr<std::atomic<std::uint8_t>[]> states_;
    const CellNode& node_;
};

}  // namespace trisect::detail

// SPDX-License-Identifier: Apache-2.0
//
// LevelGrid: a box filled with tetrahedra of a body-centred cubic grid.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <trisect/brep/measure.h>
#include <trisect/kernel/point3d.h>

namespace trisect::detail {

/// In halves of cells from the low corner of the box: corners of cells are even, centres odd.
using NodePoint = std::array<std::int32_t, 3>;

/// Two cells with a common face share four tetrahedra: both centres, and an edge of the face. On
/// the sides of the box the centre of the face takes the place of the cell that is not there: it is
/// the centre -1, or one beyond the last, and lies on the side.
///
/// Corners of tetrahedra are nodes. They have numbers below size(), of which some, beside edges of
/// the box, stand for nothing.
class LevelGrid {
public:
    static constexpr int short_directions = 8;
    static constexpr int directions = 11;

    /// \throw UsageError, LimitError as make_level_set()
    LevelGrid(const Bounds& box, double edge_length, std::uint64_t most_cells);

    [[nodiscard]] std::size_t size() const { return corner_count_ + centre_count_; }
    [[nodiscard]] const std::array<std::int32_t, 3>& cells() const { return cells_; }
    [[nodiscard]] const Point3d& cell_size() const { return cell_size_; }
    /// Steps of numbers from a corner, or a centre, to the next along each axis.
    [[nodiscard]] const std::array<std::size_t, 3>& corner_steps() const { return corner_steps_; }
    [[nodiscard]] const std::array<std::size_t, 3>& centre_steps() const { return centre_steps_; }

    [[nodiscard]] std::size_t number(const NodePoint& p) const;
    [[nodiscard]] NodePoint point(std::size_t number) const;
    [[nodiscard]] Point3d place(const NodePoint& p) const;

    [[nodiscard]] bool is_node(const NodePoint& p) const;
    /// Whether it has all 14 neighbours and is on no side of the box.
    [[nodiscard]] bool is_inner(const NodePoint& p) const;

    /// Edges of the grid have a first end and a direction: from a centre to the corners of its cell
    /// (bits 0 to 2: up along x, y, z), or up along an axis to the next node of its kind (8 to 10).
    [[nodiscard]] static NodePoint along(const NodePoint& p, int direction);
    [[nodiscard]] bool is_edge(const NodePoint& p, int direction) const;

private:
    std::array<std::int32_t, 3> cells_{};
    Point3d cell_size_{};
    std::array<std::vector<double>, 3> planes_;  // from -1 on
    std::array<std::size_t, 3> corner_steps_{};
    std::array<std::size_t, 3> centre_steps_{};
    std::size_t corner_count_ = 0;
    std::size_t centre_count_ = 0;
};

}  // namespace trisect::detail

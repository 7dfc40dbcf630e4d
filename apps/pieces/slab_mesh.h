// SPDX-License-Identifier: Apache-2.0
//
// SlabMesh: the triangles of an operand near a slab, closed beyond it.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <trisect/kernel/point3d.h>

#include "edge_balance.h"
#include "triangle_stream.h"

namespace trisect::app {

/// The slab between two planes across an axis, either of which may be infinite, as its triangles
/// were chosen.
struct SlabRange {
    std::size_t axis = 0;
    double low = 0;
    double high = 0;
    double quantum = 0;  ///< a power of two; planes are odd multiples of it
    double bound = 0;    ///< a power of two beyond all coordinates
};

/// Connects corners of equal value, and closes the boundary beyond the slab.
///
/// Given are all triangles of a closed mesh that meet the slab. An edge that lost its other
/// triangle does not meet it: it is on one side, and so are the cycles that such edges form. Each
/// cycle is filled with triangles between its own corners, which are on that side too. What the
/// mesh has instead is, with these, a closed surface that is all beyond the slab, on both sides, so
/// no winding number in the slab changes.
class SlabMesh {
public:
    explicit SlabMesh(const SlabRange& range) : range_(range) {}

    void reserve(std::uint64_t triangles);
    void add(const Corners& corners);
    /// Adds what closes it, and two opposite triangles of fine coordinates beyond the slab, so that
    /// the lattice is no coarser than the quantum.
    void close();

    [[nodiscard]] const std::vector<Point3d>& points() const { return points_; }
    [[nodiscard]] const std::vector<std::array<std::uint32_t, 3>>& triangles() const {
        return triangles_;
    }

private:
    std::uint32_t number_of(const Point3d& p);
    void grow_table();
    /// -1 below the slab, 1 above it, 0 in it.
    [[nodiscard]] int side_of(std::uint32_t corner) const;
    [[nodiscard]] std::vector<DirectedEdge> lost_edges() const;
    void fill(std::vector<DirectedEdge> edges);
    void fill_cycle(std::vector<std::uint32_t> cycle);
    void fill_from_afar(const std::vector<std::uint32_t>& cycle);
    [[nodiscard]] bool are_in_line(std::uint32_t a, std::uint32_t b, std::uint32_t c) const;
    void add_fine_triangles();

    SlabRange range_;
    std::vector<Point3d> points_;
    std::vector<std::array<std::uint32_t, 3>> triangles_;
    std::vector<std::uint32_t> table_;  // numbers of points + 1, by their values
};

}  // namespace trisect::app

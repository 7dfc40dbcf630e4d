// SPDX-License-Identifier: Apache-2.0
//
// ObstacleMesh: tetrahedra around and inside of a solid.
// Each has the triangles of the boundary that it meets.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/bsp/hierarchies/pairs/triangle_boxes.h>
#include <trisect/bsp/hierarchies/partitions/delaunay.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>

namespace trisect::hierarchies {

/// The convex hull of up to eight points that are known within `error`, and a box around it.
struct PointHull {
    std::array<std::array<double, 3>, 8> point{};
    std::size_t count = 0;
    double error = 0;
    Box box;

    /// Of points; makes the box.
    PointHull(std::span<const std::array<double, 3>> points, double error);
    PointHull() = default;
};

/// A Delaunay mesh of the vertices of a model. It does not have to conform to the boundary: a
/// triangle is listed by every tetrahedron that it may meet, at most `most_entries` on the average,
/// for which vertices are left out where it takes that.
///
/// Value type. Cost: O(n log n) and a walk through the tetrahedra of each triangle.
class ObstacleMesh {
public:
    static constexpr std::size_t most_entries = 48;

    ObstacleMesh() = default;
    explicit ObstacleMesh(const detail::InterferenceModelData& model);

    [[nodiscard]] const DelaunayMesh& mesh() const { return mesh_; }
    [[nodiscard]] std::span<const std::uint32_t> list(std::uint32_t tetrahedron) const {
        return std::span(entries_).subspan(first_[tetrahedron],
                                           first_[tetrahedron + 1] - first_[tetrahedron]);
    }
    [[nodiscard]] const Box& box(std::uint32_t tetrahedron) const { return boxes_[tetrahedron]; }
    /// The twelve at the surface of the cube.
    [[nodiscard]] std::span<const std::uint32_t> outermost() const { return outermost_; }
    /// The mesh's points are in these units of A's lattice, a power of two. 1 where coordinates are
    /// whole; else such that doubles are whole, where the largest one allows that.
    [[nodiscard]] double unit() const { return unit_; }
    /// The nearest place. \pre magnitudes below 2^62 units.
    [[nodiscard]] IntegerPoint place(const std::array<double, 3>& p) const;
    /// Whether a place is in the cube.
    [[nodiscard]] bool contains(const IntegerPoint& p) const;
    /// False only when they are certainly apart.
    [[nodiscard]] bool may_meet(std::uint32_t tetrahedron, const PointHull& hull) const;

    [[nodiscard]] std::size_t entry_count() const { return entries_.size(); }
    [[nodiscard]] std::size_t bytes() const {
        return mesh_.bytes() + boxes_.size() * sizeof(Box) +
               (first_.size() + entries_.size()) * sizeof(std::uint32_t);
    }

private:
    /// False when there would be too many entries.
    [[nodiscard]] bool make_lists(const detail::InterferenceModelData& model);
    void make_boxes();

    [[nodiscard]] std::array<std::array<double, 3>, 4> corners_of(std::uint32_t tetrahedron) const;

    double unit_ = 1;
    DelaunayMesh mesh_;
    std::vector<Box> boxes_;
    std::vector<std::uint32_t> first_;
    std::vector<std::uint32_t> entries_;
    std::vector<std::uint32_t> outermost_;
};

}  // namespace trisect::hierarchies

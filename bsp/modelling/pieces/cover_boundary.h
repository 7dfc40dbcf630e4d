// SPDX-License-Identifier: Apache-2.0
//
// CoverBoundary: triangles of a boundary with planes, boxes and neighbours.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/brep/lattice_mesh.h>
#include <trisect/bsp/modelling/pieces/convex_cover.h>
#include <trisect/kernel/plane.h>
#include <trisect/kernel/side.h>

namespace trisect::detail {

/// A box of lattice points, closed.
struct PointBox {
    std::array<double, 3> lo;
    std::array<double, 3> hi;

    explicit PointBox(const LatticePoint& p) : lo(p.doubles()), hi(p.doubles()) {}
    void add(const LatticePoint& p);
    [[nodiscard]] bool overlaps(const PointBox& o) const;
};

class CoverBoundary {
public:
    using Triangle = std::array<std::uint32_t, 3>;

    /// \pre each edge is between two triangles; the mesh outlives this
    CoverBoundary(const LatticeMesh& mesh, CoverSide side);

    [[nodiscard]] std::size_t size() const { return mesh_.triangles.size(); }
    [[nodiscard]] const Triangle& triangle(std::uint32_t t) const { return mesh_.triangles[t]; }
    [[nodiscard]] const LatticePoint& point(std::uint32_t v) const { return mesh_.points[v]; }
    /// Below it is the side on which bodies lie.
    [[nodiscard]] const Plane& plane(std::uint32_t t) const { return planes_[t]; }
    /// Across the edge from corner k to the next one.
    [[nodiscard]] std::uint32_t neighbour(std::uint32_t t, std::size_t k) const {
        return neighbours_[t][k];
    }
    /// All points are below a plane or on it, and so on.
    [[nodiscard]] bool are_below(std::span<const std::uint32_t> points, const Plane& plane);
    [[nodiscard]] bool are_above(std::span<const std::uint32_t> points, const Plane& plane);
    [[nodiscard]] bool are_on(std::span<const std::uint32_t> points, const Plane& plane);
    /// Whether the triangle's box meets another one; a cheaper kind of work.
    [[nodiscard]] bool is_near(std::uint32_t t, const PointBox& box) {
        ++boxes_compared_;
        return boxes_[t].overlaps(box);
    }
    /// Whether so much was done that no body should grow any more.
    [[nodiscard]] bool is_spent() const;

    /// Marks of triangles, all of which go when they are begun anew.
    void begin_marks() { ++mark_; }
    void mark(std::uint32_t t) { marks_[t] = mark_; }
    [[nodiscard]] bool is_marked(std::uint32_t t) const { return marks_[t] == mark_; }

private:
    [[nodiscard]] Side side(std::uint32_t v, const Plane& plane);

    const LatticeMesh& mesh_;
    std::vector<Plane> planes_;
    std::vector<PointBox> boxes_;
    std::vector<Triangle> neighbours_;
    std::vector<std::uint32_t> marks_;
    std::uint32_t mark_ = 0;
    std::size_t sides_found_ = 0;
    std::size_t boxes_compared_ = 0;
};

}  // namespace trisect::detail

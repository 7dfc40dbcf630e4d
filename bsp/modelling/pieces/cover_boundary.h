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
    /// Work of another kind that takes as long.
    void count_sides(std::size_t n) { sides_found_ += n; }
    /// Whether so much was done for a body of so many triangles that it should not grow any more.
    [[nodiscard]] bool is_spent(std::size_t triangles) const;

    /// Begins a body: what was noted and counted for the last one is gone.
    void begin_body();
    void mark(std::uint32_t t) { marks_[t] = body_; }
    [[nodiscard]] bool is_marked(std::uint32_t t) const { return marks_[t] == body_; }
    /// Whether a body is on one side of a triangle's plane; of its corners all but those that were
    /// added last were found so before.
    [[nodiscard]] bool has_on_one_side(std::uint32_t t, std::span<const std::uint32_t> corners,
                                       std::span<const std::uint32_t> added);

private:
    [[nodiscard]] Side side(std::uint32_t v, const Plane& plane);

    const LatticeMesh& mesh_;
    std::vector<Plane> planes_;
    std::vector<PointBox> boxes_;
    std::vector<Triangle> neighbours_;
    std::vector<std::uint32_t> marks_;
    std::vector<std::uint32_t> has_below_;  // the last body of which all corners so far are there
    std::vector<std::uint32_t> has_above_;
    std::uint32_t body_ = 0;
    std::size_t sides_found_ = 0;
    std::size_t boxes_compared_ = 0;
};

}  // namespace trisect::detail

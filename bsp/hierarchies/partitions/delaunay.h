// SPDX-License-Identifier: Apache-2.0
//
// DelaunayMesh: a Delaunay tetrahedralisation of a cube with given points.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include <trisect/bsp/hierarchies/partitions/sphere_signs.h>

namespace trisect::hierarchies {

/// A Delaunay triangulation of points and the corners of a cube around them: no point is inside of
/// the sphere of a tetrahedron. Of points on a common sphere any mesh will do; which one it is
/// depends on the points alone.
///
/// Invariants: tetrahedra are positive, fill the cube and meet face to face; neighbour i is across
/// the face opposite corner i, `none` on the surface of the cube.
///
/// Points may be given in any order and more than once. Cost: O(n) tetrahedra for points on
/// surfaces in practice, O(n²) at worst; so points are left out when there are more than
/// `most_per_point` tetrahedra a point. Value type; nothing recurses.
///
/// Source: A. Bowyer, Computing Dirichlet tessellations, and D. Watson, Computing the n-dimensional
/// Delaunay tessellation (Computer Journal 24, 1981); the order of points is that of N. Amenta, S.
/// Choi and G. Rote, Incremental constructions con BRIO (SoCG 2003).
class DelaunayMesh {
public:
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
    static constexpr std::size_t most_per_point = 24;

    struct Tetrahedron {
        std::array<std::uint32_t, 4> corner{};
        std::array<std::uint32_t, 4> neighbour{};
    };

    DelaunayMesh() = default;
    /// \pre coordinates below 2^53 in magnitude.
    explicit DelaunayMesh(std::span<const IntegerPoint> points);

    [[nodiscard]] std::span<const Tetrahedron> tetrahedra() const { return tetrahedra_; }
    [[nodiscard]] const IntegerPoint& point(std::uint32_t corner) const { return points_[corner]; }
    [[nodiscard]] std::size_t point_count() const { return points_.size(); }
    [[nodiscard]] const IntegerPoint& low() const { return points_[0]; }
    [[nodiscard]] const IntegerPoint& high() const { return points_[7]; }

    /// The tetrahedron that contains a point of the closed cube (one of them, when it is on a
    /// face), by a walk that starts at another one and adds its steps to `steps`.
    [[nodiscard]] std::uint32_t locate(const IntegerPoint& p, std::uint32_t start,
                                       std::uint64_t& steps) const;

    /// Checks all invariants with exact signs; O(n), and O(n · points) for spheres. For tests.
    [[nodiscard]] bool is_valid(bool all_spheres) const;

    [[nodiscard]] std::size_t bytes() const {
        return points_.size() * sizeof(IntegerPoint) + tetrahedra_.size() * sizeof(Tetrahedron);
    }

private:
    struct Side {
        std::uint32_t tetrahedron = 0;
        std::uint32_t face = 0;
    };
    /// A face of a cavity from inside, and from outside where there is one.
    struct SplittingPlane {
        Side inside;
        Side outside;
    };
    struct Edge {
        std::uint64_t key = 0;  // both corners
        Side side;
    };

    void fill_cube();
    void remove_free();
    void insert(std::uint32_t corner);
    void find_cavity(std::uint32_t start, const IntegerPoint& p);
    void fill_cavity(std::uint32_t corner);
    /// The face of a tetrahedron that is across to another one; 4 where none is.
    [[nodiscard]] std::uint32_t face_towards(std::uint32_t t, std::uint32_t neighbour) const;
    [[nodiscard]] std::array<IntegerPoint, 4> corners_of(const Tetrahedron& t) const;

    std::vector<IntegerPoint> points_;  // the cube's corners first
    std::vector<Tetrahedron> tetrahedra_;
    // Of the insertion that is under way.
    std::vector<std::uint32_t> mark_;  // by tetrahedron: the last insertion that looked at it
    std::vector<std::uint32_t> cavity_;
    std::vector<SplittingPlane> surface_;
    std::vector<Edge> edges_;
    std::vector<std::uint32_t> free_;  // places of tetrahedra that are no more
    std::uint32_t insertion_ = 0;
    std::uint32_t last_ = 0;
};

}  // namespace trisect::hierarchies

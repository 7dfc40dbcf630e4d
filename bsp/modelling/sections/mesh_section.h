// SPDX-License-Identifier: Apache-2.0
//
// MeshSection: sections of a mesh with parallel planes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/brep/exact_mesh.h>
#include <trisect/brep/polygon_mesh.h>
#include <trisect/brep/primitives/point_2d.h>
#include <trisect/bsp/modelling/slice_frame.h>

namespace trisect::detail {

/// Directed sides of a region that is on their left, seen from where the normal points. At each
/// corner as many come as go.
struct SectionSides {
    std::vector<Point2d> corners;
    std::vector<std::array<std::uint32_t, 2>> sides;
    bool is_exact = true;  ///< no corner was rounded
};

/// One of the planes, with the triangles that may have a point in it, by rising number.
struct SectionPlane {
    double height = 0;
    std::span<const std::uint32_t> triangles;
};

/// The winding number of the sides is that of the mesh, whether it meets itself or not. Where a
/// plane goes through corners or faces, the section is that of a plane right below or above it.
class MeshSection {
public:
    using Triangle = std::array<std::uint32_t, 3>;

    /// Refers to the mesh.
    explicit MeshSection(const ExactMesh& mesh, const SliceFrame& frame = SliceFrame());
    /// Of triangles.
    explicit MeshSection(const PolygonMesh& mesh, const SliceFrame& frame = SliceFrame());

    [[nodiscard]] std::uint32_t triangle_count() const {
        return static_cast<std::uint32_t>(triangles_.size());
    }
    /// Heights between which a triangle certainly lies.
    [[nodiscard]] std::array<double, 2> range_of(std::uint32_t triangle) const;

    /// Whether some triangle lies in the plane: if none does, both sections are one region.
    [[nodiscard]] bool has_face_in(const SectionPlane& plane) const;

    /// Corners are rounded to doubles, once; where the boundary goes straight on there is none.
    /// Linear in the triangles of the plane. For any thread.
    enum class Place : std::uint8_t { Below, Above };
    [[nodiscard]] SectionSides right(const SectionPlane& plane, Place place) const;

    [[nodiscard]] const SliceFrame& frame() const { return frame_; }
    [[nodiscard]] std::uint32_t point_count() const {
        return static_cast<std::uint32_t>(near_.size());
    }
    [[nodiscard]] const Triangle& triangle(std::uint32_t t) const { return triangles_[t]; }
    /// A point, rounded where it is no double.
    [[nodiscard]] const Point3d& near(std::uint32_t v) const { return near_[v]; }
    [[nodiscard]] bool is_double(std::uint32_t v) const { return is_double_[v] != 0; }
    /// Normal . near(v); along an axis exact.
    [[nodiscard]] double level(std::uint32_t v) const { return level_[v]; }
    /// Null where all points are doubles of a mesh of doubles.
    [[nodiscard]] const ExactMesh* exact_mesh() const { return exact_; }
    /// -1 below, 0 on, 1 above the plane at a height. Exact.
    [[nodiscard]] int side(std::uint32_t v, double height) const {
        if (error_.empty() && level_[v] != height) return level_[v] > height ? 1 : -1;
        return side_in_doubt(v, height);
    }

private:
    void find_levels();
    [[nodiscard]] int side_in_doubt(std::uint32_t v, double height) const;

    SliceFrame frame_;
    std::vector<Triangle> triangles_;
    std::vector<Point3d> near_;            // by point: rounded where it is no double
    std::vector<std::uint8_t> is_double_;  // by point
    std::vector<double> level_;            // by point: normal . near, along an axis exact
    std::vector<double> error_;            // by point, of its level; empty along an axis
    const ExactMesh* exact_ = nullptr;     // of points that are no doubles
};

/// Planes with their triangles, found in one walk over the mesh. O(n log m + output)
class SectionStack {
public:
    /// Heights in any order. \throw LimitError beyond 2^31 pairs of a triangle and a plane
    SectionStack(const MeshSection& mesh, std::span<const double> heights);

    /// Different heights.
    [[nodiscard]] std::size_t size() const { return heights_.size(); }
    /// By rising height. Refers to this.
    [[nodiscard]] SectionPlane plane(std::size_t i) const {
        return {heights_[i], std::span(triangles_).subspan(begin_[i], begin_[i + 1] - begin_[i])};
    }
    /// Heights, rising.
    [[nodiscard]] std::span<const double> heights() const { return heights_; }

private:
    static constexpr std::size_t most_sides = std::size_t{1} << 31U;

    std::vector<double> heights_;
    std::vector<std::size_t> begin_;        // by plane, and the end
    std::vector<std::uint32_t> triangles_;  // of all planes
};

}  // namespace trisect::detail

// SPDX-License-Identifier: Apache-2.0
//
// MspGeometry: numbered planes, points and polygons of an MspTree.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/bsp/msp_tree.h>
#include <trisect/kernel/plane.h>
#include <trisect/kernel/point.h>
#include <trisect/kernel/predicates.h>

namespace trisect::detail::msp {

using PlaneIndex = std::uint32_t;
using PointIndex = std::uint32_t;
using Label = MspTree::Ref;  ///< a leaf: what a point, an open edge or a face is

/// Of two entities that contain a point, the representative: the lower dimension, then the smaller
/// handle.
[[nodiscard]] inline Label more_specific(Label a, Label b) {
    if (a.kind() != b.kind()) return a.kind() > b.kind() ? a : b;
    return a.entity() < b.entity() ? a : b;
}

/// A corner of a polygon and the edge that leaves it. What lies on the border of the cell in which
/// the polygon is being worked on is dead: it is not part of the open cell.
struct Corner {
    PointIndex point = 0;
    PlaneIndex edge_plane = 0;  ///< meets the support in the edge's line
    Label vertex;               ///< what the corner is: a vertex, or within an edge or face
    Label edge;                 ///< what the open edge is: an edge, or within a face
    bool vertex_is_dead = false;
    bool edge_is_dead = false;
};

/// A convex polygon; corners counter-clockwise seen from above the support. Corners may be
/// straight.
struct Fragment {
    PlaneIndex support = 0;
    Label face;
    std::uint32_t first_corner = 0;
    std::uint32_t corner_count = 0;
};

/// A place where a plane meets a fragment's border.
struct BorderPoint {
    PointIndex point = 0;
    Label label;
    bool is_dead = false;
};

/// Immutable planes and points, growing lists of them. For one thread.
class MspGeometry {
public:
    PlaneIndex add_plane(const Plane& plane);
    /// A point that three planes name. `exact` saves looking for its coordinates.
    PointIndex add_point(const std::array<PlaneIndex, 3>& planes, const Point& exact);
    PointIndex meet(PlaneIndex p, PlaneIndex q, PlaneIndex r);

    [[nodiscard]] const Plane& plane(PlaneIndex i) const { return planes_[i]; }
    [[nodiscard]] std::vector<Plane>& planes() { return planes_; }
    [[nodiscard]] const std::array<PlaneIndex, 3>& planes_of(PointIndex i) const {
        return points_[i].planes;
    }
    [[nodiscard]] const Approximation& approximation(PointIndex i) const {
        return points_[i].approximation;
    }

    /// Symbolic, filtered, exact.
    [[nodiscard]] Side side(PointIndex point, PlaneIndex plane) const;
    [[nodiscard]] std::strong_ordering compare(PointIndex a, PointIndex b, int axis) const;
    /// Lexicographic.
    [[nodiscard]] std::strong_ordering compare(PointIndex a, PointIndex b) const;

    [[nodiscard]] std::span<Corner> corners(const Fragment& f) {
        return std::span(corners_).subspan(f.first_corner, f.corner_count);
    }
    [[nodiscard]] std::span<const Corner> corners(const Fragment& f) const {
        return std::span(corners_).subspan(f.first_corner, f.corner_count);
    }
    [[nodiscard]] std::uint32_t add_corners(std::span<const Corner> corners);

    /// Cuts a fragment into its parts on both sides. `sides` has one entry for each corner.
    /// What lies on the plane is dead in both parts.
    /// \pre the plane runs through the interior.
    struct Cut {
        Fragment below;
        Fragment above;
        std::array<BorderPoint, 2> ends;  ///< of the common edge, as they are in the whole
    };
    [[nodiscard]] Cut cut(const Fragment& f, PlaneIndex plane, std::span<const Side> sides);

private:
    struct Record {
        std::array<PlaneIndex, 3> planes{};
        bool is_lattice = false;
        LatticePoint lattice;
        Approximation approximation;
    };
    [[nodiscard]] HomogeneousPoint homogeneous(const Record& p) const;

    std::vector<Plane> planes_;
    std::vector<Record> points_;
    std::vector<Corner> corners_;
    std::vector<Corner> below_;  // scratch of cut
    std::vector<Corner> above_;
};

}  // namespace trisect::detail::msp

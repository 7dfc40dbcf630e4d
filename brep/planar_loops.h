// SPDX-License-Identifier: Apache-2.0
//
// PlanarLoops: the loops of a planar face as a two-dimensional figure.
// Its form keeps corners at the same place from interfering. The builder and the triangulation
// share it.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <trisect/kernel/plane.h>
#include <trisect/kernel/point.h>

namespace trisect {

using IndexLoop = std::vector<std::uint32_t>;

/// Points by their doubles; what these leave open is computed when it is needed.
class RoundedPoints {
public:
    RoundedPoints() = default;
    RoundedPoints(const RoundedPoints&) = delete;
    RoundedPoints& operator=(const RoundedPoints&) = delete;
    virtual ~RoundedPoints() = default;
    /// Correctly rounded coordinates, and how far they may be off: 0 where they are the lattice
    /// point itself.
    [[nodiscard]] virtual std::span<const Approximation> nearest() const = 0;
    [[nodiscard]] virtual HomogeneousPoint homogeneous(std::uint32_t i) const = 0;
    /// The exact order along a coordinate axis: -1, 0 or 1.
    [[nodiscard]] virtual int compare_along(std::uint32_t a, std::uint32_t b, int axis) const = 0;
};

/// Points of one plane, projected along its dominant axis and seen from above. All answers are
/// exact: doubles with an error bound first, integers otherwise.
class PlaneProjection {
public:
    PlaneProjection(const Plane& plane, std::span<const Point> points);
    /// The points must live as long as the projection.
    PlaneProjection(const Plane& plane, const RoundedPoints& points);

    /// Rounded coordinates of a point in the projection.
    [[nodiscard]] double u(std::uint32_t i) const { return rounded(i, axes_.u); }
    [[nodiscard]] double v(std::uint32_t i) const { return rounded(i, axes_.v); }
    /// Lexicographic order in the projection.
    [[nodiscard]] std::strong_ordering compare(std::uint32_t a, std::uint32_t b) const;
    /// Whether rounded coordinates are the exact ones.
    [[nodiscard]] bool is_lattice(std::uint32_t i) const {
        return rounded_ != nullptr ? nearest_[i].error == 0 : points_[i].is_lattice();
    }
    /// 1 when a, b, c turn left, 0 when they lie on one line.
    [[nodiscard]] int orientation(std::uint32_t a, std::uint32_t b, std::uint32_t c) const;

    /// The axes that a figure above or below a plane is seen along: from above, `u` to `v` is a
    /// quarter turn to the left.
    struct Axes {
        int u = 0;
        int v = 1;
    };
    [[nodiscard]] static Axes axes_of(const Plane& plane, bool from_below = false);
    /// Orientation by certified doubles, 0 for unknown.
    [[nodiscard]] static int filtered_orientation(const Approximation& a, const Approximation& b,
                                                  const Approximation& c, Axes axes);
    [[nodiscard]] static int exact_orientation(const HomogeneousPoint& a, const HomogeneousPoint& b,
                                               const HomogeneousPoint& c, Axes axes);

private:
    [[nodiscard]] double rounded(std::uint32_t i, int axis) const {
        return approximation(i).c[static_cast<std::size_t>(axis)];
    }
    [[nodiscard]] const Approximation& approximation(std::uint32_t i) const {
        return rounded_ != nullptr ? nearest_[i] : points_[i].approximation();
    }
    [[nodiscard]] HomogeneousPoint homogeneous(std::uint32_t i) const {
        return rounded_ != nullptr ? rounded_->homogeneous(i) : points_[i].homogeneous();
    }
    [[nodiscard]] LatticePoint lattice(std::uint32_t i) const;
    [[nodiscard]] int lattice_orientation(std::uint32_t a, std::uint32_t b, std::uint32_t c) const;

    std::span<const Point> points_;
    const RoundedPoints* rounded_ = nullptr;  // in place of these
    std::span<const Approximation> nearest_;
    Axes axes_;
};

/// The corners of a face, linked to loops whose interior wedges are disjoint.
///
/// A *place* is a point of the projection that has corners; its number is its lexicographic rank.
/// At a place with several corners, each outgoing edge is linked to the incoming edge that ends the
/// interior wedge to its left, so no wedge contains an edge. Hence a hole that touches the outline
/// has become part of it, an outline that is cut by what touches it has come apart, and the
/// loops that remain do not touch each other (a loop may still touch itself).
class PlanarLoops {
public:
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

    struct Corner {
        std::uint32_t point = 0;  ///< the caller's index
        std::uint32_t place = 0;
        std::uint32_t prev = 0;
        std::uint32_t next = 0;
    };

    /// O(n log n). \pre the loops bound a region to their left and its points are on the plane.
    /// \throw Error Internal when they do not and it shows.
    PlanarLoops(const Plane& plane, std::span<const Point> points, std::span<const IndexLoop> loops)
        : PlanarLoops(PlaneProjection(plane, points), loops) {}
    PlanarLoops(const PlaneProjection& projection, std::span<const IndexLoop> loops);

    [[nodiscard]] std::size_t corner_count() const { return corners_.size(); }
    [[nodiscard]] std::span<const Corner> corners() const { return corners_; }
    [[nodiscard]] const Corner& corner(std::uint32_t c) const { return corners_[c]; }
    [[nodiscard]] std::uint32_t place_of(std::uint32_t c) const { return corners_[c].place; }
    [[nodiscard]] std::uint32_t prev(std::uint32_t c) const { return corners_[c].prev; }
    [[nodiscard]] std::uint32_t next(std::uint32_t c) const { return corners_[c].next; }
    /// All corners, by place.
    [[nodiscard]] std::span<const std::uint32_t> corners_in_order() const { return order_; }
    /// A corner of each outline, or hole, at its first place; ordered by these places.
    [[nodiscard]] std::span<const std::uint32_t> outlines() const { return outlines_; }
    [[nodiscard]] std::span<const std::uint32_t> holes() const { return holes_; }

    /// Of three places.
    [[nodiscard]] int orientation(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
        return projection_.orientation(point_at_[a], point_at_[b], point_at_[c]);
    }
    /// At a corner: 1 when its interior angle is below 180 degrees.
    [[nodiscard]] int turn(std::uint32_t c) const {
        return orientation(place_of(prev(c)), place_of(c), place_of(next(c)));
    }
    // Edge c leaves corner c. Members that detail::SweepLine needs:
    [[nodiscard]] std::uint32_t from(std::uint32_t edge) const { return place_of(edge); }
    [[nodiscard]] std::uint32_t to(std::uint32_t edge) const { return place_of(next(edge)); }
    [[nodiscard]] int above(std::uint32_t edge, std::uint32_t place) const {
        return orientation(from(edge), to(edge), place);
    }

private:
    void number_places();
    void join_edges_at(std::span<const std::uint32_t> corners);
    void find_loops();
    void connect(std::uint32_t a, std::uint32_t b) {
        corners_[a].next = b;
        corners_[b].prev = a;
    }

    PlaneProjection projection_;
    std::vector<Corner> corners_;
    std::vector<std::uint32_t> point_at_;  // by place
    std::vector<std::uint32_t> order_;     // corners by place
    std::vector<std::uint32_t> outlines_;
    std::vector<std::uint32_t> holes_;
};

/// The connected pieces of a planar region, each with its outline first, then its holes. No two
/// loops of the result touch.
[[nodiscard]] std::vector<std::vector<IndexLoop>> connected_regions(
    const Plane& plane, std::span<const Point> points, std::span<const IndexLoop> loops);

}  // namespace trisect

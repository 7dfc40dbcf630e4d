// SPDX-License-Identifier: Apache-2.0
//
// Exact signs that involve two posed solids.
// One solid's lattice is the frame. Planes of the other are pulled back into it, n' = M^T n, d' =
// S d + n·t, which needs no division and no moved vertex. Three stages as in predicates.h:
//   1. symbolic  by name (a vertex of a face that is coplanar);
//   2. filtered  doubles with a derived bound. Only here are points "moved", with an error bound;
//   3. exact     integers of 128 bits where the pose's numbers are short and the products fit,
//                else integers on the stack, as long as they have to be
//                (kernel/number/bounded_int.h). Counted as narrow up to 256 bits: corners of
//                lattices up to 26 bits under rotations by small quaternions need about 110,
//                under doubles 170.
// The bounds on bits are derived in moved_predicates.cpp.
//
// Everything here has lazy parts and is for one thread.
#pragma once

#include <array>
#include <cstddef>

#include <trisect/kernel/number/bounded_int.h>
#include <trisect/kernel/plane.h>
#include <trisect/kernel/point.h>
#include <trisect/kernel/pose/relative_pose.h>
#include <trisect/kernel/wide_int.h>

namespace trisect::detail {

/// A point as exact homogeneous integers x / w, w > 0.
struct IntPoint {
    IntVector x;
    BoundedInt w;
};
[[nodiscard]] IntPoint exact_point(const Point& p);

/// The direction between two points of one solid, up to a positive factor; in that solid's lattice.
class Direction {
public:
    Direction() = default;
    /// \pre from != to
    Direction(const Point& from, const Point& to);

    [[nodiscard]] const IntVector& exact() const { return v_; }
    /// Doubles within relative_error of the exact components, which are scaled so that they cannot
    /// overflow in products of three; 0 where components are too far apart for that.
    [[nodiscard]] const std::array<double, 3>& approx() const { return f_; }
    static constexpr double relative_error = 0x1p-51;
    [[nodiscard]] Direction operator-() const;
    /// The direction of the sum of two vectors: strictly between them, for the exact stage of tests
    /// that need some point of an arc. \pre not opposite.
    [[nodiscard]] static Direction between(const Direction& a, const Direction& b, int weight_a = 1,
                                           int weight_b = 1);

private:
    void make_doubles();
    IntVector v_;
    std::array<double, 3> f_{};
};

/// A plane of one solid seen from the other one's lattice.
class PulledPlane {
public:
    /// `pose` takes the other solid's lattice into the plane's. Both must outlive this.
    PulledPlane(const Plane& plane, const RelativePose& pose);

    /// Which side a point of the other solid is on: 1 above (where the plane's normal points to).
    [[nodiscard]] int side_of(const Point& p) const;
    /// Sign of n'·v for a direction of the other solid.
    [[nodiscard]] int along(const Direction& v) const;
    /// For a plane of the other solid known to be parallel: 1 when the normals point the same way.
    [[nodiscard]] int sense_of(const Plane& parallel) const;
    /// Whether a plane of the other solid is this one: the same points.
    [[nodiscard]] bool is_same_as(const Plane& other) const;

    [[nodiscard]] const IntVector& normal() const { return exact().n; }
    [[nodiscard]] const BoundedInt& offset() const { return exact().d; }

private:
    struct Exact {
        IntVector n;
        BoundedInt d;
        bool narrow = false;  // values at lattice points fit 256 bits
    };
    // In 128 bits, with bounds on the lengths of the numbers; n_bits is 128 where they do not fit.
    struct Short {
        std::array<Int128, 3> n{};
        Int128 d = 0;
        int n_bits = 128;
    };
    [[nodiscard]] const Exact& exact() const;
    [[nodiscard]] const Short& short_numbers() const;
    [[nodiscard]] int exact_side_of(const Point& p) const;

    const Plane* plane_;
    const RelativePose* pose_;
    std::array<double, 3> fn_{};
    std::array<double, 3> fn_error_{};
    double fd_ = 0;
    double fd_error_ = 0;
    mutable bool known_ = false;
    mutable bool short_known_ = false;
    mutable Short short_;
    mutable Exact exact_;
};

/// A point of the other solid brought into the frame: doubles with an error bound for filters, and
/// exactly, as (M x + t w) / (S w), on demand.
class MovedPoint {
public:
    MovedPoint(const Point& p, const RelativePose& pose) : point_(&p), pose_(&pose) {}

    [[nodiscard]] const Point& point() const { return *point_; }
    [[nodiscard]] const RelativePose& pose() const { return *pose_; }
    /// \pre the pose has doubles
    [[nodiscard]] const Approximation& approximation() const {
        if (!approximated_) {
            approximation_ = pose_->move(point_->approximation());
            approximated_ = true;
        }
        return approximation_;
    }
    /// M x + t w and w; the place is x / (S w).
    [[nodiscard]] const IntPoint& exact() const;
    /// Whether a point of the frame's solid is just there.
    [[nodiscard]] bool is_at(const Point& p) const;
    /// M x + t of a lattice point, below 2^87. \pre the pose has short numbers
    [[nodiscard]] std::array<Int128, 3> short_numbers() const;

private:
    const Point* point_;
    const RelativePose* pose_;
    mutable Approximation approximation_;
    mutable bool approximated_ = false;
    mutable bool known_ = false;
    mutable IntPoint exact_;
};

/// Sign of det(q - p, s - r, r - p) for an edge (p, q) of the frame's solid and an edge (r, s) of
/// the other one: positive when a line from above through a triangle counter-clockwise in p, q
/// passes on the triangle's side of the edge. Zero when the lines meet or are parallel.
[[nodiscard]] int orientation(const Point& p, const Point& q, const MovedPoint& r,
                              const MovedPoint& s);

/// Sign of the component `axis` of (q - p) × (r - p), r of the other solid.
[[nodiscard]] int planar_orientation(const Point& p, const Point& q, const MovedPoint& r, int axis);

/// Sign of det(a, b, M c): two directions of the frame's solid, one of the other.
[[nodiscard]] int determinant_sign(const Direction& a, const Direction& b, const Direction& c,
                                   const RelativePose& pose);

}  // namespace trisect::detail

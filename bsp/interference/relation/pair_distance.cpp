// SPDX-License-Identifier: Apache-2.0
//
// Distances are those of the user's space, boxes are in A's lattice. A difference d there is L d in
// the world, L the matrix of A's pose times the unit; |L d| >= σ |d| with σ² at least the least
// eigenvalue of L^T L, which a row's diagonal entry minus the others bounds (Gershgorin); for a
// rotation that is 1 up to rounding. For a matrix far from that σ >= |det| / |L|² serves.
//
// Where A is not turned at all L is a power of two. Where the least and the largest bound are
// within 2^-44 of each other, triangles are compared in A's lattice and distances multiplied.
// Entries known within 2^-50 of themselves change L^T L by less than 2^-49 and rounding by 2^-50 of
// the sum of magnitudes of its terms, which is at most σ² (1 + 2^-40); three such entries, halved
// by the root, are below 2^-47.
//
// Triangles are compared in the world's directions about a corner r of A's: L (p - r) and L (m q +
// t - r). With row sums of |L| at most R, entries known within 2^-50 of themselves, differences at
// most g, and δ the error of a difference: errors are below R (δ + u g) + R g (2^-50 + 3 u) < R
// (1.01 δ + 2^-49 g).

#include <trisect/bsp/interference/relation/pair_distance.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <trisect/bsp/interference/boxes/obb_fit.h>
#include <trisect/bsp/interference/boxes/triangle_filter.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/number/error_bounds.h>

namespace trisect::detail {

namespace {

// Bounds of |L d| / |d|; the upper one is infinite where L is not nearly a similarity.
struct Stretch {
    double least = 0;
    double most = std::numeric_limits<double>::infinity();
};

Stretch stretch_of(const std::array<Vector3, 3>& l) {
    double least = std::numeric_limits<double>::infinity();
    double most = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        double diagonal = 0;
        double rest = 0;
        for (std::size_t j = 0; j < 3; ++j) {
            double g = 0;
            for (std::size_t k = 0; k < 3; ++k) g += l[k][i] * l[k][j];
            (i == j ? diagonal : rest) += std::abs(g);
        }
        least = std::min(least, diagonal - rest);
        most = std::max(most, diagonal + rest);
    }
    if (most - least <= 0x1p-44 * most)
        return {std::sqrt(least) * (1 - 0x1p-47), std::sqrt(most) * (1 + 0x1p-47)};
    const double det = std::abs(dot(l[0], cross(l[1], l[2])));
    const double by_det = most > 0 ? (det - 0x1p-45 * most * std::sqrt(most)) / most : 0;
    return {
        std::max({0.0, least > 0 ? std::sqrt(least) * surely_less : 0.0, by_det * surely_less})};
}

}  // namespace

PairDistance::PairDistance(const Boundary& a, const Pose& pose_a, const Boundary& b,
                           const Pose& pose_b)
    : a_(&a), b_(&b), map_(approximate_map(pose_a, a.lattice, pose_b, b.lattice)) {
    if (!map_.is_usable()) {
        const RelativePose exact = relative_pose(pose_a, a.lattice, pose_b, b.lattice);
        if (exact.has_doubles()) map_ = approximate_map(exact);
        if (!map_.is_usable()) throw LimitError("distances need poses within the range of doubles");
    }
    const auto m = pose_a.approximate();
    for (std::size_t i = 0; i < 3; ++i) {
        double row = 0;
        for (std::size_t j = 0; j < 3; ++j) {
            stretch_[i][j] = std::ldexp(m[4 * i + j], a.lattice.exponent);
            row += std::abs(stretch_[i][j]);
        }
        row_ = std::max(row_, row * (1 + 0x1p-48));
    }
    error_ = a.position_error + map_.error_below(b.largest, b.position_error);
    const Stretch stretch = stretch_of(stretch_);
    least_ = stretch.least;
    most_ = stretch.most;
    if (pose_a.is_translation()) least_ = most_ = std::ldexp(1.0, a.lattice.exponent);
}

DistanceCandidate PairDistance::compare(std::uint32_t i, std::uint32_t j, double nearest) {
    const TriangleCorners p = a_->corners_of(i);
    TriangleCorners q = b_->corners_of(j);
    for (auto& corner : q) corner = map_(corner);
    DistanceCandidate c = most_ < std::numeric_limits<double>::infinity()
                              ? compare_in_lattice(p, q, nearest)
                              : compare_in_world(p, q, nearest);
    c.a = i;
    c.b = j;
    if (c.bounds.lower <= 0 && compare_triangles(p, q, error_) == PairVerdict::Crossing) {
        c.crossing = true;
        c.bounds = {0, 0};
    }
    return c;
}

DistanceCandidate PairDistance::compare_in_lattice(const TriangleCorners& p,
                                                   const TriangleCorners& q, double nearest) {
    // The origin is A's first corner, as below.
    TriangleCorners from_p;
    TriangleCorners from_q;
    double g = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        from_p[k] = minus(p[k], p[0]);
        from_q[k] = minus(q[k], p[0]);
        for (std::size_t i = 0; i < 3; ++i)
            g = std::max({g, std::abs(from_p[k][i]), std::abs(from_q[k][i])});
    }
    const double error = error_ + 0x1p-52 * g;
    DistanceCandidate c;
    if (are_certainly_farther(from_p, from_q, nearest / least_ * slightly_more, error, way_)) {
        c.bounds = {nearest * slightly_more, std::numeric_limits<double>::infinity()};
        return c;
    }
    c.closest = closest_points(from_p, from_q);
    way_ = way_between(from_p, from_q, c.closest);
    const DistanceBounds b = certify(from_p, from_q, c.closest, error);
    c.closest.squared *= least_ * least_;
    c.bounds = {b.lower * least_ * slightly_less, b.upper * most_ * slightly_more};
    return c;
}

DistanceCandidate PairDistance::compare_in_world(const TriangleCorners& p, const TriangleCorners& q,
                                                 double nearest) {
    const Vector3 r = p[0];
    double g = 0;
    const auto placed = [&](const Vector3& x) {
        const Vector3 d = minus(x, r);
        for (const double c : d) g = std::max(g, std::abs(c));
        return Vector3{dot(stretch_[0], d), dot(stretch_[1], d), dot(stretch_[2], d)};
    };
    TriangleCorners in_world_p;
    TriangleCorners in_world_q;
    for (std::size_t k = 0; k < 3; ++k) {
        in_world_p[k] = placed(p[k]);
        in_world_q[k] = placed(q[k]);
    }
    const double error = row_ * (1.01 * error_ + 0x1p-49 * g);
    DistanceCandidate c;
    if (are_certainly_farther(in_world_p, in_world_q, nearest, error, way_)) {
        c.bounds = {nearest * slightly_more, std::numeric_limits<double>::infinity()};
        return c;
    }
    c.closest = closest_points(in_world_p, in_world_q);
    way_ = way_between(in_world_p, in_world_q, c.closest);
    c.bounds = certify(in_world_p, in_world_q, c.closest, error);
    return c;
}

}  // namespace trisect::detail

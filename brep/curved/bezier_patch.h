// SPDX-License-Identifier: Apache-2.0
//
// BezierPatch: a tensor-product Bézier surface, polynomial or rational.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/brep/polygon_mesh.h>

namespace trisect {

/// The surface S(u, v) = Σ w_ij B_i(u) B_j(v) P_ij / Σ w_ij B_i(u) B_j(v) over 0 <= u, v <= 1, with
/// Bernstein polynomials B (Farin, Curves and Surfaces for CAGD, chapters 14 and 15). All weights
/// are positive, so the surface lies within the convex hull of its control points.
///
/// The patch is exactly what its doubles say: nothing is rounded when it is made. Seen from the
/// side to which S_u × S_v points, u turns counter-clockwise into v; on the boundary of a solid
/// that side is outside.
///
/// Value type.
class BezierPatch {
public:
    static constexpr std::size_t max_degree = 24;

    /// Control points row by row: point i·(degree_v + 1) + j belongs to B_i(u) B_j(v). No weights
    /// mean 1 each.
    /// \throw UsageError for degrees of 0 or beyond max_degree, wrong counts, numbers that are not
    /// finite, weights that are not positive, and weights or coordinates beyond 2^±300.
    BezierPatch(std::size_t degree_u, std::size_t degree_v, std::vector<Point3d> points,
                std::vector<double> weights = {});

    [[nodiscard]] std::size_t degree_u() const { return degree_u_; }
    [[nodiscard]] std::size_t degree_v() const { return degree_v_; }
    [[nodiscard]] std::span<const Point3d> points() const { return points_; }
    /// As many as points; all 1 for a polynomial patch.
    [[nodiscard]] std::span<const double> weights() const { return weights_; }
    [[nodiscard]] const Point3d& point(std::size_t i, std::size_t j) const {
        return points_[i * (degree_v_ + 1) + j];
    }
    [[nodiscard]] double weight(std::size_t i, std::size_t j) const {
        return weights_[i * (degree_v_ + 1) + j];
    }

    friend bool operator==(const BezierPatch&, const BezierPatch&) = default;

private:
    std::size_t degree_u_;
    std::size_t degree_v_;
    std::vector<Point3d> points_;
    std::vector<double> weights_;
};

/// A point of a surface in doubles: every coordinate is within `error` of the exact one.
struct CertifiedPoint {
    Point3d position{};
    double error = 0;
};

/// \throw UsageError unless 0 <= u, v <= 1. Cost: O(degree^3).
[[nodiscard]] CertifiedPoint evaluate(const BezierPatch& patch, double u, double v);

}  // namespace trisect

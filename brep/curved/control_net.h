// SPDX-License-Identifier: Apache-2.0
//
// ControlNet: homogeneous control points of a sub-patch, with one error bound.
// It can be halved, and gives hulls and bounds on derivatives. All are certified.
#pragma once

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include <trisect/brep/curved/bezier_patch.h>
#include <trisect/brep/polygon_mesh.h>

namespace trisect::detail {

/// (w x, w y, w z, w)
using Homogeneous = std::array<double, 4>;

/// All numbers from lo to hi.
struct Range {
    double lo = 0;
    double hi = 0;
};
/// Of each coordinate of a vector.
using VectorRange = std::array<Range, 3>;

/// The second derivatives of a surface over a unit square of parameters, in the user's units.
struct SecondDerivatives {
    VectorRange uu{};
    VectorRange uv{};
    VectorRange vv{};
};

class ControlNet {
public:
    explicit ControlNet(const BezierPatch& patch);
    /// A curve as a net of degree 0 in v.
    ControlNet(std::size_t degree, const std::vector<Point3d>& points,
               const std::vector<double>& weights);

    [[nodiscard]] std::size_t degree_u() const { return degree_u_; }
    [[nodiscard]] std::size_t degree_v() const { return degree_v_; }

    /// The halves below and above u = 1/2, each over a unit square again.
    [[nodiscard]] std::pair<ControlNet, ControlNet> halves_in_u() const;
    [[nodiscard]] std::pair<ControlNet, ControlNet> halves_in_v() const;
    [[nodiscard]] CertifiedPoint at(double u, double v) const;
    /// The corner u, v of 0 and 1, which is a control point.
    [[nodiscard]] CertifiedPoint corner(std::size_t u, std::size_t v) const;

    /// The control points in space: the surface is within `radius` of their convex hull.
    struct Hull {
        std::vector<Point3d> points;
        double radius = 0;
    };
    [[nodiscard]] Hull hull() const;
    /// Certified; infinite where weights are too near to 0 for doubles.
    [[nodiscard]] SecondDerivatives second_derivatives() const;
    /// The longest way through control points in a direction: which one to halve.
    [[nodiscard]] double length_in_u() const;
    [[nodiscard]] double length_in_v() const;

    /// Under x' = m x + t, row by row, where each number of the exact map is within 2^-50 of its
    /// magnitude of what is given.
    [[nodiscard]] ControlNet moved(const std::array<double, 12>& map) const;

private:
    ControlNet() = default;

    void add(const Point3d& p, double w);
    [[nodiscard]] const Homogeneous& net(std::size_t i, std::size_t j) const {
        return net_[i * (degree_v_ + 1) + j];
    }
    [[nodiscard]] CertifiedPoint projected(const Homogeneous& h, double error) const;

    std::size_t degree_u_ = 0;
    std::size_t degree_v_ = 0;
    std::vector<Homogeneous> net_;
    double error_ = 0;    // of each number in net_
    double largest_ = 0;  // bound on their magnitudes
};

}  // namespace trisect::detail

// SPDX-License-Identifier: Apache-2.0

#include <trisect/brep/curved/bezier_patch.h>

#include <cmath>
#include <string>
#include <utility>

#include <trisect/brep/curved/control_net.h>
#include <trisect/kernel/error.h>

namespace trisect {

namespace {

void require_degree(std::size_t degree, const char* direction) {
    if (degree == 0 || degree > BezierPatch::max_degree)
        throw UsageError("a Bezier patch of degree " + std::to_string(degree) + " in " + direction +
                         ": must be 1 to " + std::to_string(BezierPatch::max_degree));
}

}  // namespace

BezierPatch::BezierPatch(std::size_t degree_u, std::size_t degree_v, std::vector<Point3d> points,
                         std::vector<double> weights)
    : degree_u_(degree_u),
      degree_v_(degree_v),
      points_(std::move(points)),
      weights_(std::move(weights)) {
    require_degree(degree_u, "u");
    require_degree(degree_v, "v");
    const std::size_t count = (degree_u + 1) * (degree_v + 1);
    if (points_.size() != count)
        throw UsageError("a Bezier patch of degrees " + std::to_string(degree_u) + " and " +
                         std::to_string(degree_v) + " has " + std::to_string(count) +
                         " control points, not " + std::to_string(points_.size()));
    if (weights_.empty()) weights_.assign(count, 1.0);
    if (weights_.size() != count)
        throw UsageError("a Bezier patch with " + std::to_string(count) + " control points and " +
                         std::to_string(weights_.size()) + " weights");
    // Products and squares of these neither overflow nor vanish.
    constexpr double limit = 0x1p300;
    for (std::size_t i = 0; i < count; ++i) {
        for (const double c : points_[i])
            if (!(std::abs(c) <= limit))
                throw UsageError("a coordinate of control point " + std::to_string(i) +
                                 " is not finite or beyond 2^300");
        if (!(weights_[i] >= 1 / limit && weights_[i] <= limit))
            throw UsageError("the weight of control point " + std::to_string(i) +
                             " is not a positive number between 2^-300 and 2^300");
    }
}

CertifiedPoint evaluate(const BezierPatch& patch, double u, double v) {
    if (!(u >= 0 && u <= 1 && v >= 0 && v <= 1)) throw UsageError("a parameter outside of 0 to 1");
    return detail::ControlNet(patch).at(u, v);
}

}  // namespace trisect

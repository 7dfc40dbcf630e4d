// SPDX-License-Identifier: Apache-2.0
//
// TriangleNormal: the normal of a triangle in doubles.
#pragma once

#include <cmath>
#include <cstddef>

#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/number/vector3.h>

namespace trisect::detail {

/// To find what most triangles are not, without making their planes.
struct TriangleNormal {
    Vector3 n{};
    Vector3 error{};

    TriangleNormal() = default;
    TriangleNormal(const Vector3& a, const Vector3& b, const Vector3& c) {
        const Vector3 v = minus(b, a);
        const Vector3 w = minus(c, a);
        for (std::size_t k = 0; k < 3; ++k) {
            const double s = v[(k + 1) % 3] * w[(k + 2) % 3];
            const double t = v[(k + 2) % 3] * w[(k + 1) % 3];
            n[k] = s - t;
            error[k] = bound_slack * minor_rounding * (std::fabs(s) + std::fabs(t));
        }
    }
    [[nodiscard]] std::size_t longest_axis() const {
        std::size_t axis = 0;
        for (std::size_t k = 1; k < 3; ++k)
            if (std::fabs(n[k]) > std::fabs(n[axis])) axis = k;
        return axis;
    }
};

/// Whether the normals surely have different lines. With a = A + e and b = B + f a component of
/// a × b is off by at most |A| |f| + |e| |B| + |e| |f| for each of its products, besides rounding.
[[nodiscard]] inline bool are_surely_askew(const TriangleNormal& a, const TriangleNormal& b) {
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t i = (k + 1) % 3;
        const std::size_t j = (k + 2) % 3;
        const double s = a.n[i] * b.n[j];
        const double t = a.n[j] * b.n[i];
        const auto off = [&](std::size_t p, std::size_t q) {
            return std::fabs(a.n[p]) * b.error[q] + a.error[p] * (std::fabs(b.n[q]) + b.error[q]);
        };
        const double error = off(i, j) + off(j, i) + minor_rounding * (std::fabs(s) + std::fabs(t));
        if (std::fabs(s - t) > bound_slack * error) return true;
    }
    return false;
}

}  // namespace trisect::detail

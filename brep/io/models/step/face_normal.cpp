// SPDX-License-Identifier: Apache-2.0
#include <trisect/brep/io/models/step/face_normal.h>

#include <trisect/brep/exact_rational.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace trisect::detail {
namespace {

std::optional<Point3d> unit_vector(const Point3d& v) {
    const double length = std::hypot(v[0], v[1], v[2]);
    if (!(length > 0) || !std::isfinite(length)) return std::nullopt;
    return Point3d{v[0] / length, v[1] / length, v[2] / length};
}

/// The area vector over the sum of what it is a difference of: small where much cancels.
std::optional<Point3d> rounded_normal(std::span<const Point3d> points,
                                      std::span<const std::uint32_t> polygon) {
    Point3d sum{};
    double size = 0;
    const Point3d& o = points[polygon[0]];
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
        const Point3d& a = points[polygon[i]];
        const Point3d& b = points[polygon[i + 1]];
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t u = (k + 1) % 3;
            const std::size_t v = (k + 2) % 3;
            const double s = (a[u] - o[u]) * (b[v] - o[v]);
            const double t = (a[v] - o[v]) * (b[u] - o[u]);
            sum[k] += s - t;
            size += std::fabs(s) + std::fabs(t);
        }
    }
    const double length = std::hypot(sum[0], sum[1], sum[2]);
    const bool is_good = size < 1e290 && length > 1e-280 && length > 1e-2 * size;
    return is_good ? unit_vector(sum) : std::nullopt;
}

std::optional<Point3d> exact_normal(std::span<const Point3d> points,
                                    std::span<const std::uint32_t> polygon) {
    using ExactVector = std::array<ExactRational, 3>;
    const auto from_first = [&](std::uint32_t c) {
        ExactVector d;
        for (std::size_t k = 0; k < 3; ++k)
            d[k] = ExactRational::from_double(points[c][k]) -
                   ExactRational::from_double(points[polygon[0]][k]);
        return d;
    };
    ExactVector sum;
    ExactVector a = from_first(polygon[1]);
    for (std::size_t i = 2; i < polygon.size(); ++i) {
        ExactVector b = from_first(polygon[i]);
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t u = (k + 1) % 3;
            const std::size_t v = (k + 2) % 3;
            sum[k] += a[u] * b[v] - a[v] * b[u];
        }
        a = std::move(b);
    }
    // Against the largest component, so that nothing overflows.
    ExactRational largest;
    for (const ExactRational& c : sum) {
        const ExactRational size = c.sign() < 0 ? -c : c;
        if ((size - largest).sign() > 0) largest = size;
    }
    if (largest.sign() == 0) return std::nullopt;
    Point3d out{};
    for (std::size_t k = 0; k < 3; ++k) out[k] = (sum[k] / largest).to_double();
    return unit_vector(out);
}

}  // namespace

std::optional<Point3d> face_normal(std::span<const Point3d> points,
                                   std::span<const std::uint32_t> polygon) {
    if (const auto normal = rounded_normal(points, polygon)) return normal;
    return exact_normal(points, polygon);
}

double distance_from_plane(std::span<const Point3d> points, std::span<const std::uint32_t> polygon,
                           const Point3d& normal) {
    double most = 0;
    const Point3d& o = points[polygon[0]];
    for (const std::uint32_t c : polygon) {
        double sum = 0;
        for (std::size_t k = 0; k < 3; ++k) sum += (points[c][k] - o[k]) * normal[k];
        most = std::max(most, std::fabs(sum));
    }
    return most;
}

}  // namespace trisect::detail

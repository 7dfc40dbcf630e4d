// SPDX-License-Identifier: Apache-2.0
//
// The closest points of two triangles apart from each other lie on two sides, or one of them is a
// corner. All nine pairs of sides and six of a corner and a triangle are tried (Ericson, Real-Time
// Collision Detection, 5.1.5 and 5.1.9), without any care for rounding: what comes out is certified
// afterwards.
//
// Above: points of both triangles are so far from each other. Below: a plane across the way between
// them has one triangle on each side; the distance of the triangles' extents along that way bounds
// theirs, for any direction whatever. With g the largest coordinate and e the error of coordinates,
// a point with weights is known within e + 4 u g a coordinate, so its distance to another within
// √3·2 (e + 4 u g) and a rounding; an extent along n within |n| (√3 e + 4 √3 u g). Both are below
// 4 e + 2^-48 g; dividing and roots have a relative error below 2^-50.

#include <trisect/bsp/interference/boxes/triangle_distance.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <trisect/bsp/interference/boxes/obb_fit.h>
#include <trisect/kernel/number/error_bounds.h>

namespace trisect::detail {

namespace {

double clamp01(double v) { return v > 0 ? (v < 1 ? v : 1) : 0; }

Vector3 combined(const TriangleCorners& t, const std::array<double, 3>& w) {
    Vector3 r{};
    for (std::size_t k = 0; k < 3; ++k) r[k] = (w[0] * t[0][k] + w[1] * t[1][k]) + w[2] * t[2][k];
    return r;
}

class ClosestSearch {
public:
    ClosestSearch(const TriangleCorners& p, const TriangleCorners& q) : p_(p), q_(q) {
        best_.squared = std::numeric_limits<double>::infinity();
    }
    ClosestPoints run() {
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j) sides(i, j);
        for (std::size_t i = 0; i < 3; ++i) {
            corner(p_[i], q_, i, true);
            corner(q_[i], p_, i, false);
        }
        return best_;
    }

private:
    void sides(std::size_t i, std::size_t j) {
        const std::size_t i1 = (i + 1) % 3;
        const std::size_t j1 = (j + 1) % 3;
        const Vector3 d1 = minus(p_[i1], p_[i]);
        const Vector3 d2 = minus(q_[j1], q_[j]);
        const Vector3 r = minus(p_[i], q_[j]);
        const double a = dot(d1, d1);
        const double e = dot(d2, d2);
        const double b = dot(d1, d2);
        const double c = dot(d1, r);
        const double f = dot(d2, r);
        const double det = a * e - b * b;
        double s = det > 0 ? clamp01((b * f - c * e) / det) : 0;
        double t = e > 0 ? (b * s + f) / e : 0;
        if (!(t >= 0 && t <= 1)) {
            t = clamp01(t);
            s = a > 0 ? clamp01((b * t - c) / a) : 0;
        }
        Vector3 way{};
        for (std::size_t k = 0; k < 3; ++k) way[k] = (r[k] + s * d1[k]) - t * d2[k];
        const double square = dot(way, way);
        if (!(square < best_.squared)) return;
        best_.squared = square;
        best_.on_p = best_.on_q = {};
        best_.on_p[i] = 1 - s;
        best_.on_p[i1] = s;
        best_.on_q[j] = 1 - t;
        best_.on_q[j1] = t;
    }

    // A corner above the inside of a triangle; beyond its sides the pairs of sides do it.
    void corner(const Vector3& x, const TriangleCorners& t, std::size_t i, bool of_p) {
        const Vector3 u = minus(t[1], t[0]);
        const Vector3 v = minus(t[2], t[0]);
        const Vector3 w = minus(x, t[0]);
        const Vector3 n = cross(u, v);
        const double nn = dot(n, n);
        if (!(nn > 0)) return;
        const double height = dot(n, w);
        if (!(height * height < best_.squared * nn)) return;
        const double beta = dot(cross(w, v), n) / nn;
        const double gamma = dot(cross(u, w), n) / nn;
        if (!(beta >= 0 && gamma >= 0 && beta + gamma <= 1)) return;
        best_.squared = height * height / nn;
        std::array<double, 3> one{};
        one[i] = 1;
        const std::array<double, 3> inside{1 - beta - gamma, beta, gamma};
        best_.on_p = of_p ? one : inside;
        best_.on_q = of_p ? inside : one;
    }

    const TriangleCorners& p_;
    const TriangleCorners& q_;
    ClosestPoints best_;
};

}  // namespace

bool are_certainly_farther(const TriangleCorners& p, const TriangleCorners& q, double limit,
                           double error, const Vector3& first) {
    double g = 0;
    for (const auto* t : {&p, &q})
        for (const Vector3& c : *t)
            for (const double v : c) g = std::max(g, std::abs(v));
    // Squares of what is compared are known up to six roundings.
    const double wanted = (limit + 4 * error + 0x1p-48 * g) * slightly_more;
    const double square = wanted * wanted;
    const auto apart_along = [&](const Vector3& n) {
        const std::array<double, 3> a{dot(n, p[0]), dot(n, p[1]), dot(n, p[2])};
        const std::array<double, 3> b{dot(n, q[0]), dot(n, q[1]), dot(n, q[2])};
        const double gap = std::max(std::min({b[0], b[1], b[2]}) - std::max({a[0], a[1], a[2]}),
                                    std::min({a[0], a[1], a[2]}) - std::max({b[0], b[1], b[2]}));
        return gap > 0 && gap * gap > square * dot(n, n);
    };
    if (apart_along(first)) return true;
    Vector3 centres{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k) centres[k] += q[i][k] - p[i][k];
    return apart_along(centres) || apart_along(cross(minus(p[1], p[0]), minus(p[2], p[0]))) ||
           apart_along(cross(minus(q[1], q[0]), minus(q[2], q[0])));
}

Vector3 way_between(const TriangleCorners& p, const TriangleCorners& q,
                    const ClosestPoints& closest) {
    return minus(combined(q, closest.on_q), combined(p, closest.on_p));
}

ClosestPoints closest_points(const TriangleCorners& p, const TriangleCorners& q) {
    return ClosestSearch(p, q).run();
}

DistanceBounds certify(const TriangleCorners& p, const TriangleCorners& q,
                       const ClosestPoints& closest, double error) {
    double g = 0;
    for (const auto* t : {&p, &q})
        for (const Vector3& c : *t)
            for (const double v : c) g = std::max(g, std::abs(v));
    const double slack = 4 * error + 0x1p-48 * g;
    const Vector3 way = way_between(p, q, closest);
    const double length = std::sqrt(dot(way, way));
    DistanceBounds r;
    r.upper = length * slightly_more + slack;
    if (!(length > 0)) return r;
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (std::size_t i = 0; i < 3; ++i) {
        low = std::min(low, dot(way, q[i]));
        high = std::max(high, dot(way, p[i]));
    }
    r.lower = std::max(0.0, (low - high) / length * slightly_less - slack);
    return r;
}

}  // namespace trisect::detail

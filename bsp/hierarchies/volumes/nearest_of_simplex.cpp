// SPDX-License-Identifier: Apache-2.0
//
// By cases, from the corners up (Ericson, Real-Time Collision Detection, 2005, section 5.1). A
// tetrahedron's nearest point is in one of the faces that have the origin on their other side, or
// the origin itself. Flat simplices fall to their sides.

#include <trisect/bsp/hierarchies/volumes/nearest_of_simplex.h>

#include <limits>

namespace trisect::hierarchies {

namespace {

using detail::cross;
using detail::dot;
using detail::minus;
using detail::Vector3;

// A point of a face of the simplex, and which corners the face has, as bits.
struct SimplexNearest {
    Vector3 point{};
    unsigned used = 0;
    double square = std::numeric_limits<double>::infinity();

    SimplexNearest() = default;
    SimplexNearest(const Vector3& p, unsigned u) : point(p), used(u), square(dot(p, p)) {}
    void take(const SimplexNearest& o) {
        if (o.square < square) *this = o;
    }
};

Vector3 between(const Vector3& a, const Vector3& b, double t) {
    Vector3 r;
    for (std::size_t k = 0; k < 3; ++k) r[k] = a[k] + t * (b[k] - a[k]);
    return r;
}

using Points = std::array<Vector3, 4>;

SimplexNearest of_segment(const Points& p, unsigned i, unsigned j) {
    const Vector3 way = minus(p[j], p[i]);
    const double along = -dot(p[i], way);
    const double length = dot(way, way);
    if (!(along > 0)) return {p[i], 1U << i};
    if (!(along < length)) return {p[j], 1U << j};
    return {between(p[i], p[j], along / length), 1U << i | 1U << j};
}

SimplexNearest of_triangle(const Points& p, unsigned i, unsigned j, unsigned k) {
    const Vector3 u = minus(p[j], p[i]);
    const Vector3 v = minus(p[k], p[i]);
    const Vector3 n = cross(u, v);
    const double nn = dot(n, n);
    // Weights of j and k of the foot of the perpendicular.
    const double wj = -dot(cross(p[i], v), n);
    const double wk = -dot(cross(u, p[i]), n);
    if (wj > 0 && wk > 0 && wj + wk < nn) {
        const double s = wj / nn;
        const double t = wk / nn;
        Vector3 foot;
        for (std::size_t c = 0; c < 3; ++c) foot[c] = p[i][c] + s * u[c] + t * v[c];
        return {foot, 1U << i | 1U << j | 1U << k};
    }
    SimplexNearest r = of_segment(p, i, j);
    r.take(of_segment(p, j, k));
    r.take(of_segment(p, i, k));
    return r;
}

SimplexNearest of_tetrahedron(const Points& p) {
    const double volume = dot(minus(p[3], p[0]), cross(minus(p[1], p[0]), minus(p[2], p[0])));
    constexpr unsigned face[4][4] = {{0, 1, 2, 3}, {0, 1, 3, 2}, {0, 2, 3, 1}, {1, 2, 3, 0}};
    SimplexNearest r;
    for (const auto& [i, j, k, opposite] : face) {
        const Vector3 n = cross(minus(p[j], p[i]), minus(p[k], p[i]));
        const double inside = dot(n, minus(p[opposite], p[i]));
        const double origin = -dot(n, p[i]);
        // Where there is no volume every face is as good as outside.
        if (volume == 0 || (inside > 0) != (origin > 0)) r.take(of_triangle(p, i, j, k));
    }
    if (r.used == 0) return {Vector3{}, 15U};
    return r;
}

}  // namespace

Vector3 Simplex::nearest() {
    SimplexNearest r;
    if (count_ == 1) r = {point_[0], 1U};
    if (count_ == 2) r = of_segment(point_, 0, 1);
    if (count_ == 3) r = of_triangle(point_, 0, 1, 2);
    if (count_ == 4) r = of_tetrahedron(point_);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count_; ++i)
        if ((r.used >> i & 1U) != 0) point_[kept++] = point_[i];
    count_ = kept;
    return r.point;
}

}  // namespace trisect::hierarchies

// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/interference/certificate/certified_tetrahedron.h>

#include <algorithm>
#include <cstddef>
#include <utility>

#include <trisect/bsp/interference/certificate/certified_polygon.h>

namespace trisect::detail::certified {

namespace {

constexpr std::array<std::array<std::size_t, 2>, 6> edges{
    {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};
// Three corners and the one that is not of the face.
constexpr std::array<std::array<std::size_t, 4>, 4> faces{
    {{0, 1, 2, 3}, {0, 1, 3, 2}, {0, 2, 3, 1}, {1, 2, 3, 0}}};

ExactPoint edge_of(const Tetrahedron& t, std::size_t i, std::size_t j) { return minus(t[j], t[i]); }
ExactPoint normal_of(const Tetrahedron& t, const std::array<std::size_t, 4>& face) {
    return cross(edge_of(t, face[0], face[1]), edge_of(t, face[0], face[2]));
}
bool is_flat(const Tetrahedron& t) {
    return dot(normal_of(t, faces[0]), edge_of(t, 0, 3)).sign() == 0;
}

// The planes of its faces, which it is above.
std::array<SeparatingPlane, 4> planes_of(const Tetrahedron& t) {
    std::array<SeparatingPlane, 4> r;
    for (std::size_t i = 0; i < 4; ++i) {
        ExactPoint n = normal_of(t, faces[i]);
        if (dot(n, edge_of(t, faces[i][0], faces[i][3])).sign() < 0)
            for (ExactRational& c : n) c = -c;
        r[i] = {n, -dot(n, t[faces[i][0]])};
    }
    return r;
}

}  // namespace

bool is_within(const Tetrahedron& t, const Boundary& boundary,
               const std::vector<CertifiedTriangle>& triangles) {
    if (is_flat(t)) return false;
    const std::array<SeparatingPlane, 4> planes = planes_of(t);
    const auto reaches_in = [&](const CertifiedTriangle& triangle) {
        std::vector<Polygon> rest{{boundary.at(triangle.vertex[0]), boundary.at(triangle.vertex[1]),
                                   boundary.at(triangle.vertex[2])}};
        for (const SeparatingPlane& plane : planes) rest = beside(rest, plane, 1);
        return !rest.empty();
    };
    std::array<IntegerPlane, 4> sides;
    for (std::size_t i = 0; i < 4; ++i) sides[i] = IntegerPlane(planes[i]);
    for (const CertifiedTriangle& triangle : triangles) {
        const bool is_outside = std::ranges::any_of(sides, [&](const IntegerPlane& plane) {
            return std::ranges::all_of(triangle.vertex, [&](VertexId v) {
                return plane.side_of(boundary.points()[v.index]) <= 0;
            });
        });
        if (!is_outside && reaches_in(triangle)) return false;
    }
    ExactPoint middle;
    for (std::size_t k = 0; k < 3; ++k)
        middle[k] = (t[0][k] + t[1][k] + t[2][k] + t[3][k]) / ExactRational(4);
    return boundary.locate(middle) == Where::Inside;
}

bool keep_overlapping(const Tetrahedron& a, const Tetrahedron& b, const Piece& to_a,
                      const std::function<bool(const Polynomial&)>& is_positive) {
    if (is_flat(a) || is_flat(b)) return false;
    std::array<PolynomialVector, 4> moved;
    for (std::size_t i = 0; i < 4; ++i) moved[i] = to_a.point(b[i]);
    // From corner j of B to corner i of A, times the weight.
    const auto overtakes = [&](const PolynomialVector& direction) {
        for (std::size_t i = 0; i < 4; ++i)
            for (std::size_t j = 0; j < 4; ++j)
                if (is_positive(dot(direction, to_a.w * constant(a[i]) - moved[j]))) return true;
        return false;
    };
    const auto both_overtake = [&](const PolynomialVector& n) {
        if (n[0].is_zero() && n[1].is_zero() && n[2].is_zero()) return true;  // no plane at all
        return overtakes(n) && overtakes(PolynomialVector{} - n);
    };
    for (const auto& f : faces) {
        if (!both_overtake(constant(normal_of(a, f)))) return false;
        if (!both_overtake(cross(to_a.direction(edge_of(b, f[0], f[1])),
                                 to_a.direction(edge_of(b, f[0], f[2])))))
            return false;
    }
    for (const auto& [i, j] : edges)
        for (const auto& [k, l] : edges)
            if (!both_overtake(cross(constant(edge_of(a, i, j)), to_a.direction(edge_of(b, k, l)))))
                return false;
    return true;
}

}  // namespace trisect::detail::certified

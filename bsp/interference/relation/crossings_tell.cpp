// SPDX-License-Identifier: Apache-2.0
//
// At a point within both triangles, with nothing else of the boundaries around it, these are two
// planes that cross: each boundary passes from the inside of the other solid to its outside.
//
// The point is found in A's lattice. In B's it is x = N (p - t), N the inverse of the map's matrix
// in doubles. Whatever N is, the image of x in A is some r from p, and a map that differs from the
// exact one by E takes points that are R apart in B to points at least R / |N| (1 - |I - N M|)
// apart; with I - N M below 2^-10, exact points within r + E + error of p in A are within 2 |N| (r
// + E + error) of x.

#include <trisect/bsp/interference/relation/crossings_tell.h>

#include <algorithm>
#include <cmath>

#include <trisect/bsp/interference/boxes/crossing_place.h>
#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/number/vector3.h>

namespace trisect::detail {

namespace {

using Matrix = std::array<Vector3, 3>;

// Rows. Meaningless for a singular matrix, which is seen afterwards.
Matrix inverse_of(const Matrix& m) {
    const Vector3 c0 = cross(m[1], m[2]);
    const Vector3 c1 = cross(m[2], m[0]);
    const Vector3 c2 = cross(m[0], m[1]);
    const double det = dot(m[0], c0);
    Matrix n{};
    for (std::size_t i = 0; i < 3; ++i) n[i] = {c0[i] / det, c1[i] / det, c2[i] / det};
    return n;
}

struct PointInB {
    Vector3 at{};
    double reach = 0;
};

std::optional<PointInB> point_in_b(const CrossingPlace& place, const ApproximateMap& to_a,
                                   double largest_of_b) {
    const Matrix n = inverse_of(to_a.m);
    double size = 0;
    double off = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        double row = 0;
        double row_off = 0;
        for (std::size_t j = 0; j < 3; ++j) {
            row += std::fabs(n[i][j]);
            double product = i == j ? -1.0 : 0.0;
            for (std::size_t k = 0; k < 3; ++k) product += n[i][k] * to_a.m[k][j];
            row_off += std::fabs(product);
        }
        size = std::max(size, row);
        off = std::max(off, row_off);
    }
    if (!(off < 0x1p-10) || !(3 * to_a.m_error * size < 0x1p-10)) return std::nullopt;
    PointInB x;
    const Vector3 from = minus(place.at, to_a.t);
    for (std::size_t i = 0; i < 3; ++i) x.at[i] = dot(n[i], from);
    const double residual = largest_component(minus(to_a(x.at), place.at));
    const double error =
        to_a.error_below(std::max(largest_of_b, largest_component(x.at)), 0) + residual;
    x.reach = 2 * bound_slack * size *
              (error + place.error + unit_roundoff * largest_component(place.at));
    return x;
}

}  // namespace

bool crossing_tells(const Boundary& a, std::uint32_t i, const Boundary& b, std::uint32_t j,
                    const ApproximateMap& to_a) {
    if (a.is_clear(i) && b.is_clear(j)) return true;
    TriangleCorners q = b.corners_of(j);
    for (auto& corner : q) corner = to_a(corner);
    const double error = std::max(a.position_error, to_a.error_below(b.largest, b.position_error));
    const auto place = crossing_place(a.corners_of(i), q, error);
    if (!place || !a.is_alone_at(i, place->at, place->error)) return false;
    const auto in_b = point_in_b(*place, to_a, b.largest);
    return in_b && b.is_alone_at(j, in_b->at, in_b->reach);
}

}  // namespace trisect::detail

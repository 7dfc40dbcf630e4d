// SPDX-License-Identifier: Apache-2.0
//
// A bundle of needles fills its axis-parallel box badly and a box along the needles well
// [Gottschalk, Lin, Manocha 1996]. Only the six axes of the boxes are tried as separating ones, and
// the one across the longest axes of both: needles that pass each other are parted by no other one.
// A missed separation costs time, nothing else.
//
// Errors. Let R be the largest coordinate relative to the frame's origin and u = 2^-53. Axes are
// checked to be orthonormal up to 2^-48 for each product, so A·Aᵀ - 1 and with it Aᵀ·A - 1 is below
// 2^-46 in norm. A coordinate along an axis is computed within 2^-49·R. The extent of another box
// along an axis d is that of the points Σ s_i·a_i with s_i between its bounds; for a point p of the
// box with s_i = p·a_i this differs from p·d by at most 2^-46·|p|·|d| < 2^-45·R, and sums of six
// terms add less than 2^-48·R. All of it is below 2^-44·R, the margin, by which an interval of one
// box and an interval of the other must be apart. Along an axis of neither box, of length 1 up to
// 2^-50, both intervals are such sums, so twice the margin is kept.

#include <trisect/brep/validate/oriented_box.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include <trisect/kernel/number/vector3.h>

namespace trisect::detail {

namespace {

Vector3 normalized(const Vector3& a) { return scaled(a, 1 / std::sqrt(dot(a, a))); }
Vector3 without(const Vector3& a, const Vector3& unit) {
    const double along = dot(a, unit);
    return {a[0] - along * unit[0], a[1] - along * unit[1], a[2] - along * unit[2]};
}

// Relative to the frame, rounded once.
Vector3 relative(const BoxFrame& frame, const LatticePoint& p) {
    return minus(p.doubles(), frame.origin.doubles());
}

bool are_orthonormal(const std::array<Vector3, 3>& axis) {
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k <= i; ++k)  // a NaN is not
            if (!(std::fabs(dot(axis[i], axis[k]) - (i == k ? 1 : 0)) < 0x1p-49)) return false;
    return true;
}

// The sum of the normals, or that of the largest triangle where they cancel; and the longest edge.
struct Directions {
    Vector3 normal{}, edge{};
};

Directions directions_of(const BoxFrame& frame, std::span<const LatticePoint> points,
                         std::span<const std::array<std::uint32_t, 3>> triangles,
                         std::span<const std::uint32_t> order) {
    Directions out;
    Vector3 largest{};
    double most = 0;
    double longest = 0;
    for (const std::uint32_t t : order) {
        std::array<Vector3, 3> p{};
        for (std::size_t i = 0; i < 3; ++i) p[i] = relative(frame, points[triangles[t][i]]);
        std::array<Vector3, 3> edge{};
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t k = 0; k < 3; ++k) edge[i][k] = p[(i + 1) % 3][k] - p[i][k];
            if (const double length = dot(edge[i], edge[i]); length > longest) {
                longest = length;
                out.edge = edge[i];
            }
        }
        const Vector3 n = cross(edge[0], edge[1]);
        for (std::size_t k = 0; k < 3; ++k) out.normal[k] += n[k];
        if (const double size = dot(n, n); size > most) {
            most = size;
            largest = n;
        }
    }
    if (dot(out.normal, out.normal) < most) out.normal = largest;
    return out;
}

// Of the numbers c · s with s between two bounds, summed up.
struct Interval {
    double least = 0;
    double most = 0;

    void add(double c, double low, double high) {
        least += c * (c > 0 ? low : high);
        most += c * (c > 0 ? high : low);
    }
};

}  // namespace

BoxFrame::BoxFrame(const LatticePoint& low, const LatticePoint& high) : origin(low) {
    const Vector3 d = relative(*this, high);
    margin = 0x1p-44 * std::max({0.0, d[0], d[1], d[2]});
}

TurnedBox::TurnedBox(const BoxFrame& frame, const LatticePoint& low_corner,
                     const LatticePoint& high_corner)
    : low(relative(frame, low_corner)), high(relative(frame, high_corner)) {}

std::optional<TurnedBox> TurnedBox::around(const BoxFrame& frame,
                                           std::span<const LatticePoint> points,
                                           std::span<const std::array<std::uint32_t, 3>> triangles,
                                           std::span<const std::uint32_t> order) {
    const Directions d = directions_of(frame, points, triangles, order);
    TurnedBox box;
    box.axis[0] = normalized(d.normal);
    // Twice, because what is left of an edge along the normal is mostly error.
    box.axis[1] =
        normalized(without(normalized(without(normalized(d.edge), box.axis[0])), box.axis[0]));
    box.axis[2] = cross(box.axis[0], box.axis[1]);
    if (!are_orthonormal(box.axis)) return std::nullopt;
    box.low.fill(std::numeric_limits<double>::infinity());
    box.high.fill(-std::numeric_limits<double>::infinity());
    for (const std::uint32_t t : order)
        for (const std::uint32_t c : triangles[t]) {
            const Vector3 p = relative(frame, points[c]);
            for (std::size_t i = 0; i < 3; ++i) {
                const double s = dot(p, box.axis[i]);
                box.low[i] = std::min(box.low[i], s);
                box.high[i] = std::max(box.high[i], s);
            }
        }
    return box;
}

bool TurnedBox::is_apart(const TurnedBox& other, const BoxFrame& frame) const {
    const double margin = frame.margin;
    std::array<Vector3, 3> c{};
    for (std::size_t i = 0; i < 3; ++i) {
        Interval of_other;
        for (std::size_t k = 0; k < 3; ++k) {
            c[i][k] = dot(axis[i], other.axis[k]);
            of_other.add(c[i][k], other.low[k], other.high[k]);
        }
        if (of_other.least > high[i] + margin || of_other.most < low[i] - margin) return true;
    }
    for (std::size_t k = 0; k < 3; ++k) {
        Interval own;
        for (std::size_t i = 0; i < 3; ++i) own.add(c[i][k], low[i], high[i]);
        if (own.least > other.high[k] + margin || own.most < other.low[k] - margin) return true;
    }
    return is_apart_across(other, 2 * margin);
}

bool TurnedBox::is_apart_across(const TurnedBox& other, double margin) const {
    const Vector3 across = cross(longest_axis(), other.longest_axis());
    const double size = length(across);
    if (!(size > 0x1p-40)) return false;
    const Vector3 direction = scaled(across, 1 / size);
    Interval own, of_other;
    for (std::size_t k = 0; k < 3; ++k) {
        own.add(dot(direction, axis[k]), low[k], high[k]);
        of_other.add(dot(direction, other.axis[k]), other.low[k], other.high[k]);
    }
    return of_other.least > own.most + margin || of_other.most < own.least - margin;
}

const Vector3& TurnedBox::longest_axis() const {
    std::size_t longest = 0;
    for (std::size_t k = 1; k < 3; ++k)
        if (high[k] - low[k] > high[longest] - low[longest]) longest = k;
    return axis[longest];
}

}  // namespace trisect::detail

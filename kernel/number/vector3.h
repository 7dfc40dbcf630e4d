// SPDX-License-Identifier: Apache-2.0
//
// Vectors of three numbers of any kind.
// Numbers are doubles, doubles with proved errors, integers or fractions.
//
// With doubles each operation rounds, in the order in which it stands here. Error bounds count on
// that order: a component of a cross product is two products and a difference, a dot product three
// products and two sums, from the first to the last.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include <trisect/kernel/lattice_point.h>

namespace trisect::detail {

template <class N>
using VectorOf = std::array<N, 3>;

using Vector3 = VectorOf<double>;

// N(...) makes a number of what GMP's operators leave unevaluated.

template <class N>
[[nodiscard]] constexpr VectorOf<N> minus(const VectorOf<N>& a, const VectorOf<N>& b) {
    return {N(a[0] - b[0]), N(a[1] - b[1]), N(a[2] - b[2])};
}

template <class N>
[[nodiscard]] constexpr VectorOf<N> plus(const VectorOf<N>& a, const VectorOf<N>& b) {
    return {N(a[0] + b[0]), N(a[1] + b[1]), N(a[2] + b[2])};
}

template <class N>
[[nodiscard]] constexpr VectorOf<N> scaled(const VectorOf<N>& a, const N& s) {
    return {N(a[0] * s), N(a[1] * s), N(a[2] * s)};
}

template <class N>
[[nodiscard]] constexpr N dot(const VectorOf<N>& a, const VectorOf<N>& b) {
    return N(N(N(a[0] * b[0]) + N(a[1] * b[1])) + N(a[2] * b[2]));
}

template <class N>
[[nodiscard]] constexpr VectorOf<N> cross(const VectorOf<N>& a, const VectorOf<N>& b) {
    return {N(N(a[1] * b[2]) - N(a[2] * b[1])), N(N(a[2] * b[0]) - N(a[0] * b[2])),
            N(N(a[0] * b[1]) - N(a[1] * b[0]))};
}

/// The largest magnitude of a component.
[[nodiscard]] inline double largest_component(const Vector3& a) {
    return std::max(std::max(std::fabs(a[0]), std::fabs(a[1])), std::fabs(a[2]));
}

/// sqrt(a · a).
[[nodiscard]] inline double length(const Vector3& a) { return std::sqrt(dot(a, a)); }

[[nodiscard]] constexpr Coordinate coordinate(const LatticePoint& p, std::size_t axis) {
    return p[static_cast<int>(axis)];
}

/// The coordinates as integers, for exact arithmetic.
[[nodiscard]] constexpr VectorOf<std::int64_t> to_integers(const LatticePoint& p) {
    return {p.x.to_integer(), p.y.to_integer(), p.z.to_integer()};
}

/// a - b, exact.
[[nodiscard]] constexpr std::int64_t difference(Coordinate a, Coordinate b) {
    return a.to_integer() - b.to_integer();
}
[[nodiscard]] constexpr VectorOf<std::int64_t> difference(const LatticePoint& a,
                                                          const LatticePoint& b) {
    return {difference(a.x, b.x), difference(a.y, b.y), difference(a.z, b.z)};
}

}  // namespace trisect::detail

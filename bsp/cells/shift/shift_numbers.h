// SPDX-License-Identifier: Apache-2.0
//
// Numbers that shifted pairs are decided in, and facets in them.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>

#include <trisect/bsp/cells/infinitesimal_shift.h>
#include <trisect/bsp/cells/shift/near_numbers.h>
#include <trisect/bsp/cells/shift/shifted_pairs.h>
#include <trisect/kernel/number/dyadic.h>
#include <trisect/kernel/number/orientation.h>
#include <trisect/kernel/number/vector3.h>
#include <trisect/kernel/wide_int.h>

namespace trisect::detail::shifted {

inline int sign_of(Int128 v) { return v > 0 ? 1 : (v < 0 ? -1 : 0); }
template <int N>
int sign_of(const WideInt<N>& v) {
    return v.sign();
}

// What both kinds of integers have in common.
template <class N>
struct Integers {
    template <class Value, class... IfOpen>
    [[nodiscard]] static int sign(const Value& v, const IfOpen&...) {
        return sign_of(v);
    }
    template <class Corners, class Normal>
    static void set_zeros(const Corners&, const Normal&) {}
    template <class... Any>
    [[nodiscard]] static bool is_in_plane(const Any&...) {
        return false;
    }
    template <class... Any>
    [[nodiscard]] static bool do_meet(const Any&...) {
        return false;
    }
    template <class Length>
    static auto minor(const Length& a, const Length& b, const Length& c, const Length& d) {
        return N::product(a, b) - N::product(c, d);
    }
    template <class Area, class Length>
    static auto dot(const std::array<Area, 3>& n, const std::array<Length, 3>& v) {
        typename N::Value sum;
        for (std::size_t k = 0; k < 3; ++k) sum += N::product(n[k], v[k]);
        return sum;
    }
    template <class Value>
    static Value sum(const Value& a, const Value& b) {
        return a + b;
    }
    template <class Value>
    static Value difference(const Value& a, const Value& b) {
        return a - b;
    }
    // As a double it is off by less than 2^-51 of it.
    template <class Value>
    [[nodiscard]] static double to_double(const Value& v) {
        return v.to_double();
    }
    template <class Value>
    [[nodiscard]] static double error_of(const Value& v) {
        return 0x1p-51 * std::fabs(v.to_double());
    }
    static void leave_open() {}
};

// Whole coordinates: lengths are below 2^54, products of two below 2^109, and values of planes
// below 2^165.
struct WholeNumbers : Integers<WholeNumbers> {
    using Length = std::int64_t;
    using Area = Int128;
    using Value = WideInt<3>;

    static Length length(Coordinate c) { return c.to_integer(); }
    static Length length(std::int32_t v) { return v; }
    static Area product(Length a, Length b) { return Int128{a} * b; }
    static Value product(Area a, Length b) { return multiply<3>(WideInt<2>(a), WideInt<1>(b)); }
    static WideInt<5> product(Area a, const Value& b) { return multiply<5>(WideInt<2>(a), b); }
    static WideInt<6> product(const Value& a, const Value& b) { return multiply<6>(a, b); }
};

// In units of 2^-fraction_limit: lengths are below 2^127, components of normals below 2^255, and
// values of planes below 3 · 2^381.
struct Fractions : Integers<Fractions> {
    using Length = WideInt<2>;
    using Area = WideInt<4>;
    using Value = WideInt<6>;

    static Length length(Coordinate c) { return {scaled_integer(c, fraction_limit)}; }
    static Length length(std::int32_t v) { return Length(std::int64_t{v}); }
    static Area product(const Length& a, const Length& b) { return multiply<4>(a, b); }
    static Value product(const Area& a, const Length& b) { return multiply<6>(a, b); }
    static WideInt<10> product(const Area& a, const Value& b) { return multiply<10>(a, b); }
    static WideInt<12> product(const Value& a, const Value& b) { return multiply<12>(a, b); }
};

template <class N>
using Lengths = std::array<typename N::Length, 3>;
template <class N>
using Normal = std::array<typename N::Area, 3>;

template <class N>
Lengths<N> lengths(const LatticePoint& p) {
    return {N::length(p.x), N::length(p.y), N::length(p.z)};
}

template <class N>
Normal<N> cross(const Lengths<N>& u, const Lengths<N>& v) {
    Normal<N> n{};
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t i = (k + 1) % 3;
        const std::size_t j = (k + 2) % 3;
        n[k] = N::minor(u[i], v[j], u[j], v[i]);
    }
    return n;
}

template <class N>
typename N::Value dot(const Normal<N>& n, const Lengths<N>& v) {
    return N::dot(n, v);
}

template <class N>
std::array<int, 3> signs_of(const N& numbers, const Normal<N>& n) {
    return {numbers.sign(n[0]), numbers.sign(n[1]), numbers.sign(n[2])};
}

// The sign of the product of a vector and the move along the axes. Components behind the first one
// that is not 0 are not looked at; one that doubles leave open is `exactly(k)`.
template <class N, class Exactly>
int sign_along(const N& numbers, const InfinitesimalShift& shift, const Normal<N>& n,
               const Exactly& exactly) {
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t k = shift.axes[i];
        const int s = numbers.sign(
            n[k], [] { return false; }, [&] { return exactly(k); });
        if (s != 0) return s * shift.signs[i];
    }
    return 0;
}
template <class N>
int sign_along(const N& numbers, const InfinitesimalShift& shift, const Normal<N>& n) {
    return sign_along(numbers, shift, n, [](std::size_t) { return std::optional<double>(); });
}

// Differences of doubles in integers; nothing where one is not whole.
inline std::optional<Lengths<WholeNumbers>> whole_difference(const Lengths<NearNumbers>& to,
                                                             const Lengths<NearNumbers>& from) {
    constexpr double most = 0x1p53;
    Lengths<WholeNumbers> out;
    for (std::size_t k = 0; k < 3; ++k) {
        if (!(std::fabs(to[k]) <= most && std::fabs(from[k]) <= most)) return std::nullopt;
        const auto a = static_cast<std::int64_t>(to[k]);
        const auto b = static_cast<std::int64_t>(from[k]);
        if (static_cast<double>(a) != to[k] || static_cast<double>(b) != from[k])
            return std::nullopt;
        out[k] = a - b;
    }
    return out;
}

// det(a - d, b - d, c - d) in integers, for what doubles leave open: off by less than 2^-51 of it.
// Nothing where they do not hold it.
template <class N>
std::optional<double> exact_determinant(const Lengths<N>& a, const Lengths<N>& b,
                                        const Lengths<N>& c, const Lengths<N>& d) {
    if constexpr (std::is_same_v<N, NearNumbers>) {
        const auto u = whole_difference(a, d);
        const auto v = whole_difference(b, d);
        const auto w = whole_difference(c, d);
        if (!u || !v || !w) return determinant_of_fractions(a, b, c, d);
        constexpr std::uint64_t short_length = std::uint64_t{1} << 41;
        std::uint64_t all = 0;
        for (const auto* row : {&*u, &*v, &*w})
            for (const std::int64_t x : *row) all |= static_cast<std::uint64_t>(x < 0 ? -x : x);
        const Normal<WholeNumbers> n = cross<WholeNumbers>(*v, *w);
        if (all >= short_length) return dot<WholeNumbers>(n, *u).to_double();
        // Minors are below 2^83, the sum of their products with lengths below 3 · 2^124.
        Int128 sum = 0;
        for (std::size_t k = 0; k < 3; ++k) sum += n[k] * (*u)[k];
        return static_cast<double>(sum);
    } else {
        return std::nullopt;
    }
}

// A component of (b - a) × (d - c), likewise.
template <class N>
std::optional<double> exact_product(const Lengths<N>& a, const Lengths<N>& b, const Lengths<N>& c,
                                    const Lengths<N>& d, std::size_t k) {
    if constexpr (std::is_same_v<N, NearNumbers>) {
        const auto u = whole_difference(b, a);
        const auto v = whole_difference(d, c);
        const std::size_t i = (k + 1) % 3;
        const std::size_t j = (k + 2) % 3;
        if (!u || !v)
            return product_of_fractions({{{a[i], a[j]}, {b[i], b[j]}}},
                                        {{{c[i], c[j]}, {d[i], d[j]}}});
        return static_cast<double>(WholeNumbers::minor((*u)[i], (*v)[j], (*u)[j], (*v)[i]));
    } else {
        return std::nullopt;
    }
}

template <class N>
struct Facet {
    std::array<Lengths<N>, 3> corners{};
    Normal<N> normal{};

    explicit Facet(const FacetCorners& points) {
        for (std::size_t i = 0; i < 3; ++i) corners[i] = lengths<N>(*points[i]);
        normal = cross<N>(minus(corners[1], corners[0]), minus(corners[2], corners[0]));
        N::set_zeros(corners, normal);
    }
    [[nodiscard]] typename N::Value value(const Lengths<N>& p) const {
        return dot<N>(normal, minus(p, corners[0]));
    }
    /// The same in integers, where doubles leave it open.
    [[nodiscard]] std::optional<double> exact_value(const Lengths<N>& p) const {
        return exact_determinant<N>(corners[1], corners[2], p, corners[0]);
    }
};

}  // namespace trisect::detail::shifted

// SPDX-License-Identifier: Apache-2.0
//
// Digits, Columns: fixed-width integers in base 2^56.
// They are the arithmetic of the exact stage of predicates.
//
// Digits of 56 bits leave room in a register: a product of two fits 128 bits sixteen bits over, so
// sums of many products are formed column by column without any carry, signs included, and carried
// once at the end. For the sums of products that determinants are made of, this takes less than
// half the time of full 64-bit limbs (WideInt), whose every step waits for the carry of the one
// before it. Internal; nothing here checks for overflow, callers prove their widths.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <trisect/kernel/wide_int.h>

namespace trisect::detail {

inline constexpr int digit_bits = 56;
inline constexpr std::int64_t digit_mask = (std::int64_t{1} << digit_bits) - 1;

/// The number Σ d_i 2^(56 i). Digits below the top one are in [0, 2^56), the top one carries the
/// sign and is below 2^62 in magnitude.
template <int N>
struct Digits {
    std::array<std::int64_t, static_cast<std::size_t>(N)> d{};

    [[nodiscard]] std::int64_t operator[](int i) const { return d[static_cast<std::size_t>(i)]; }
    std::int64_t& operator[](int i) { return d[static_cast<std::size_t>(i)]; }
};

/// The number Σ c_i 2^(56 i) with columns of any sign.
template <int N>
struct Columns {
    std::array<Int128, static_cast<std::size_t>(N)> c{};

    [[nodiscard]] Int128 operator[](int i) const { return c[static_cast<std::size_t>(i)]; }
    Int128& operator[](int i) { return c[static_cast<std::size_t>(i)]; }
};

/// sum += a b.
template <int N, int A, int B>
inline void add_product(Columns<N>& sum, const Digits<A>& a, const Digits<B>& b) {
    static_assert(A + B - 1 <= N);
    for_each_index<A>(
        [&](auto i) { for_each_index<B>([&](auto j) { sum[i + j] += Int128{a[i]} * b[j]; }); });
}

/// sum -= a b.
template <int N, int A, int B>
inline void subtract_product(Columns<N>& sum, const Digits<A>& a, const Digits<B>& b) {
    static_assert(A + B - 1 <= N);
    for_each_index<A>(
        [&](auto i) { for_each_index<B>([&](auto j) { sum[i + j] -= Int128{a[i]} * b[j]; }); });
}

/// sum = -sum where `negate`.
template <int N>
inline void negate_if(Columns<N>& sum, bool negate) {
    const Int128 mask = -Int128{negate};
    for_each_index<N>([&](auto i) { sum[i] = (sum[i] ^ mask) - mask; });
}

/// The same number with proper digits. \pre |number| < 2^(56 (R-1) + 62).
template <int R, int N>
[[nodiscard]] inline Digits<R> carried(const Columns<N>& sum) {
    Digits<R> out;
    Int128 carry = 0;
    for_each_index<R>([&](auto i) {
        if constexpr (i < N) carry += sum[i];
        if constexpr (i + 1 < R) {
            out[i] = static_cast<std::int64_t>(carry) & digit_mask;
            carry >>= digit_bits;
        } else {
            out[i] = static_cast<std::int64_t>(carry);
        }
    });
    return out;
}

template <int N>
[[nodiscard]] inline int sign_of(const Columns<N>& sum) {
    Int128 carry = 0;
    std::int64_t any = 0;  // what lies below the top column, never negative
    for_each_index<N>([&](auto i) {
        carry += sum[i];
        if constexpr (i + 1 < N) {
            any |= static_cast<std::int64_t>(carry) & digit_mask;
            carry >>= digit_bits;
        }
    });
    if (carry != 0) return carry < 0 ? -1 : 1;
    return any != 0 ? 1 : 0;
}

/// \pre the number has less than 56 (N-1) + 62 bits.
template <int N, int M>
[[nodiscard]] inline Digits<N> to_digits(const WideInt<M>& v) {
    const std::uint64_t sign = v.is_negative() ? ~std::uint64_t{0} : 0;
    Digits<N> out;
    for_each_index<N>([&](auto i) {
        constexpr int limb = digit_bits * i / 64;
        constexpr int shift = digit_bits * i % 64;
        std::uint64_t bits = limb < M ? v.limb(limb < M ? limb : 0) : sign;
        if constexpr (shift != 0) {
            const std::uint64_t next = limb + 1 < M ? v.limb(limb + 1 < M ? limb + 1 : 0) : sign;
            bits = (bits >> shift) | (next << (64 - shift));
        }
        const auto digit = static_cast<std::int64_t>(bits);
        out[i] = i + 1 < N ? digit & digit_mask : digit;
    });
    return out;
}

template <int N>
[[nodiscard]] inline Digits<N> to_digits(Int128 v) {
    Columns<1> c;
    c[0] = v;
    return carried<N>(c);
}

/// \pre the number fits into M limbs.
template <int M, int N>
[[nodiscard]] inline WideInt<M> to_wide_int(const Digits<N>& v) {
    // Each limb collects the digits that overlap it; above the top digit follows its sign.
    const std::uint64_t sign = v[N - 1] < 0 ? ~std::uint64_t{0} : 0;
    WideInt<M> out;
    for_each_index<M>([&](auto l) {
        std::uint64_t limb = 0;
        for_each_index<N>([&](auto i) {
            constexpr int at = digit_bits * i - 64 * l;
            if constexpr (at >= 0 && at < 64) {
                limb |= static_cast<std::uint64_t>(v[i]) << at;
            } else if constexpr (at < 0 && at > -64) {
                limb |= static_cast<std::uint64_t>(v[i] >> -at);
            }
        });
        if constexpr (64 * l >= digit_bits * (N - 1) + 64) limb = sign;
        out.set_limb(l, limb);
    });
    return out;
}

}  // namespace trisect::detail

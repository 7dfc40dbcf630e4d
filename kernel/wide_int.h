// SPDX-License-Identifier: Apache-2.0
//
// WideInt: signed integers of a fixed width of 64·N bits.
// They serve the exact stage of predicates.
//
// Nothing here allocates, branches on data or detects overflow: every caller states a bound that
// shows that its values fit (see plane.h and predicates.cpp). Audit builds check the bounds.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

namespace trisect {

__extension__ typedef __int128 Int128;
__extension__ typedef unsigned __int128 Uint128;

namespace detail {

// One step of a carry chain. Compilers of our time do not find the add-with-carry instruction in
// portable code, which makes chains several times longer; so it is named where it exists.
constexpr std::uint64_t add_with_carry(std::uint64_t a, std::uint64_t b, unsigned char& carry) {
#if defined(__x86_64__)
    if (!std::is_constant_evaluated()) {
        unsigned long long sum = 0;
        carry = __builtin_ia32_addcarryx_u64(carry, a, b, &sum);
        return sum;
    }
#endif
    const Uint128 s = Uint128{a} + b + carry;
    carry = static_cast<unsigned char>(s >> 64);
    return static_cast<std::uint64_t>(s);
}

constexpr std::uint64_t subtract_with_borrow(std::uint64_t a, std::uint64_t b,
                                             unsigned char& borrow) {
#if defined(__x86_64__)
    if (!std::is_constant_evaluated()) {
        unsigned long long difference = 0;
#if defined(__clang__)
        borrow = __builtin_ia32_subborrow_u64(borrow, a, b, &difference);
#else
        borrow = __builtin_ia32_sbb_u64(borrow, a, b, &difference);
#endif
        return difference;
    }
#endif
    const Uint128 s = Uint128{a} - b - borrow;
    borrow = static_cast<unsigned char>((s >> 64) & 1U);
    return static_cast<std::uint64_t>(s);
}

// f(0), ..., f(N - 1) with the index as a constant: loops over limbs are unrolled at every
// optimisation level, and limbs live in registers.
template <int N, class F>
constexpr void for_each_index(F&& f) {
    [&f]<int... I>(std::integer_sequence<int, I...>) { (f(std::integral_constant<int, I>{}), ...); }
    (std::make_integer_sequence<int, N>{});
}

}  // namespace detail

/// Two's complement integer of N 64-bit limbs, least significant limb first.
///
/// Arithmetic is modulo 2^(64 N), exact whenever the true result fits. Products name the width of
/// their result, because a product of an A-limb and a B-limb number rarely needs A+B limbs.
template <int N>
class WideInt {
    static_assert(N >= 1);

public:
    constexpr WideInt() = default;
    constexpr WideInt(
        std::int64_t v) {  // NOLINT(google-explicit-constructor): a number is a number
        limb_[0] = static_cast<std::uint64_t>(v);
        fill_from(1, v < 0);
    }
    constexpr WideInt(int v) : WideInt(static_cast<std::int64_t>(v)) {}
    constexpr WideInt(Int128 v) {  // NOLINT(google-explicit-constructor)
        limb_[0] = static_cast<std::uint64_t>(v);
        if constexpr (N > 1) limb_[1] = static_cast<std::uint64_t>(static_cast<Uint128>(v) >> 64);
        fill_from(2, v < 0);
    }
    /// Widening keeps the value; narrowing keeps it only when it fits (the caller's promise).
    template <int M>
    constexpr explicit WideInt(const WideInt<M>& v) {
        for (int i = 0; i < N && i < M; ++i) limb_[idx(i)] = v.limb(i);
        fill_from(M, v.is_negative());
    }

    [[nodiscard]] constexpr std::uint64_t limb(int i) const { return limb_[idx(i)]; }
    constexpr void set_limb(int i, std::uint64_t v) { limb_[idx(i)] = v; }
    [[nodiscard]] constexpr bool is_negative() const {
        return static_cast<std::int64_t>(limb_[idx(N - 1)]) < 0;
    }
    [[nodiscard]] constexpr bool is_zero() const {
        std::uint64_t any = 0;
        for (auto l : limb_) any |= l;
        return any == 0;
    }
    /// -1, 0 or 1.
    [[nodiscard]] constexpr int sign() const { return is_negative() ? -1 : (is_zero() ? 0 : 1); }

    constexpr WideInt& operator+=(const WideInt& o) {
        unsigned char carry = 0;
        detail::for_each_index<N>([&](auto i) {
            limb_[idx(i)] = detail::add_with_carry(limb_[idx(i)], o.limb_[idx(i)], carry);
        });
        return *this;
    }
    constexpr WideInt& operator-=(const WideInt& o) {
        unsigned char borrow = 0;
        detail::for_each_index<N>([&](auto i) {
            limb_[idx(i)] = detail::subtract_with_borrow(limb_[idx(i)], o.limb_[idx(i)], borrow);
        });
        return *this;
    }
    friend constexpr WideInt operator+(WideInt a, const WideInt& b) { return a += b; }
    friend constexpr WideInt operator-(WideInt a, const WideInt& b) { return a -= b; }
    constexpr WideInt operator-() const { return WideInt{} - *this; }

    [[nodiscard]] constexpr WideInt abs() const { return is_negative() ? -*this : *this; }

    friend constexpr bool operator==(const WideInt&, const WideInt&) = default;
    friend constexpr std::strong_ordering operator<=>(const WideInt& a, const WideInt& b) {
        if (a.is_negative() != b.is_negative())
            return a.is_negative() ? std::strong_ordering::less : std::strong_ordering::greater;
        for (int i = N - 1; i >= 0; --i)
            if (a.limb(i) != b.limb(i)) return a.limb(i) <=> b.limb(i);
        return std::strong_ordering::equal;
    }

    /// Shift towards higher bits; bits that leave the register are lost.
    [[nodiscard]] constexpr WideInt shifted_left(int bits) const {
        WideInt r;
        const int words = bits / 64;
        const int rest = bits % 64;
        for (int i = N - 1; i >= words; --i) {
            std::uint64_t v = limb(i - words) << rest;
            if (rest != 0 && i - words > 0) v |= limb(i - words - 1) >> (64 - rest);
            r.limb_[idx(i)] = v;
        }
        return r;
    }

    /// Bits of the absolute value: 0 for 0, floor(log2|v|)+1 otherwise.
    [[nodiscard]] constexpr int bit_length() const {
        const WideInt a = abs();
        for (int i = N - 1; i >= 0; --i)
            if (a.limb(i) != 0) return 64 * i + 64 - std::countl_zero(a.limb(i));
        return 0;
    }

    /// Nearest double up to one unit in the last place; relative error at most 2^-52.
    [[nodiscard]] double to_double() const {
        const bool negative = is_negative();
        const WideInt a = abs();
        double r = 0;
        int top = N - 1;
        while (top > 0 && a.limb(top) == 0) --top;
        const int low = top >= 1 ? top - 1 : 0;
        for (int i = top; i >= low; --i) r = r * 0x1p64 + static_cast<double>(a.limb(i));
        if constexpr (N <= 17) {  // 2^(64 low) is a double: spares a call
            r *= std::bit_cast<double>(static_cast<std::uint64_t>(1023 + 64 * low) << 52);
        } else {
            if (low > 0) r = low == 1 ? r * 0x1p64 : std::ldexp(r, 64 * low);
        }
        return negative ? -r : r;
    }

private:
    static constexpr std::size_t idx(int i) { return static_cast<std::size_t>(i); }
    constexpr void fill_from(int i, bool negative) {
        for (; i < N; ++i) limb_[idx(i)] = negative ? ~std::uint64_t{0} : 0;
    }

    std::array<std::uint64_t, static_cast<std::size_t>(N)> limb_{};
};

/// The product, modulo 2^(64 R); exact when it fits into R limbs.
template <int R, int A, int B>
[[nodiscard]] constexpr WideInt<R> multiply(const WideInt<A>& a, const WideInt<B>& b) {
    if constexpr (R > A + B) return WideInt<R>(multiply<A + B>(a, b));
    WideInt<R> r;
    // Limbs as unsigned numbers, one row per limb of a.
    detail::for_each_index<(A < R ? A : R)>([&](auto i) {
        std::uint64_t carry = 0;
        detail::for_each_index<(B < R - i ? B : R - i)>([&](auto j) {
            const Uint128 t = Uint128{a.limb(i)} * b.limb(j) + r.limb(i + j) + carry;
            r.set_limb(i + j, static_cast<std::uint64_t>(t));
            carry = static_cast<std::uint64_t>(t >> 64);
        });
        if constexpr (i + B < R) r.set_limb(i + B, carry);
    });
    // That counts a negative factor 2^(64 A) too large. Masks instead of branches: signs are
    // random.
    const auto correct = [&r](auto at, const auto& v, auto limbs, bool negative) {
        const std::uint64_t mask = negative ? ~std::uint64_t{0} : 0;
        unsigned char borrow = 0;
        detail::for_each_index<(at < R ? R - at : 0)>([&](auto k) {
            std::uint64_t s = 0;
            if constexpr (k < limbs) s = v.limb(k) & mask;
            r.set_limb(at + k, detail::subtract_with_borrow(r.limb(at + k), s, borrow));
        });
    };
    using std::integral_constant;
    correct(integral_constant<int, A>{}, b, integral_constant<int, B>{}, a.is_negative());
    correct(integral_constant<int, B>{}, a, integral_constant<int, A>{}, b.is_negative());
    return r;
}

}  // namespace trisect

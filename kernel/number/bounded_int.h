// SPDX-License-Identifier: Apache-2.0
//
// BoundedInt: integers of at most 8192 bits on the stack.
// Their cost follows their actual length.
//
// The widths of numbers that belong to two posed solids differ by a factor of twenty: a corner on a
// lattice of 20 bits under a quarter turn, or the common point of three wide planes under a pose of
// 400 bits. One register for all would be slow for nearly all of them, a register for each case
// would be a hundred instances of every formula. So a number stores its length and formulas are
// written once.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>

#include <trisect/kernel/contract.h>
#include <trisect/kernel/number/vector3.h>
#include <trisect/kernel/wide_int.h>

namespace trisect::detail {

/// Sign and magnitude; limbs of 64 bits, least significant first, no leading zero. Every operation
/// is exact; a result beyond the capacity is a broken promise of the caller and leaves as an
/// internal error. Nothing allocates. Copies move the limbs in use only.
class BoundedInt {
public:
    static constexpr int capacity = 128;

    BoundedInt() noexcept = default;
    BoundedInt(std::int64_t v) noexcept  // NOLINT(google-explicit-constructor): a number
        : negative_(v < 0) {
        if (v == 0) return;
        limb_[0] = v < 0 ? ~static_cast<std::uint64_t>(v) + 1 : static_cast<std::uint64_t>(v);
        size_ = 1;
    }
    BoundedInt(int v) noexcept : BoundedInt(static_cast<std::int64_t>(v)) {}  // NOLINT
    BoundedInt(Int128 v) noexcept : negative_(v < 0) {                        // NOLINT
        const Uint128 u = v < 0 ? ~static_cast<Uint128>(v) + 1 : static_cast<Uint128>(v);
        limb_[0] = static_cast<std::uint64_t>(u);
        limb_[1] = static_cast<std::uint64_t>(u >> 64U);
        size_ = 2;
        trim();
    }
    template <int N>
    BoundedInt(const WideInt<N>& v) noexcept : negative_(v.is_negative()) {  // NOLINT
        static_assert(N <= capacity);
        const WideInt<N> a = v.abs();
        for (int i = 0; i < N; ++i) limb_[idx(i)] = a.limb(i);
        size_ = N;
        trim();
    }
    BoundedInt(const BoundedInt& o) noexcept : size_(o.size_), negative_(o.negative_) {
        copy_limbs(o);
    }
    BoundedInt& operator=(const BoundedInt& o) noexcept {
        if (this == &o) return *this;
        size_ = o.size_;
        negative_ = o.negative_;
        copy_limbs(o);
        return *this;
    }
    ~BoundedInt() = default;

    [[nodiscard]] int sign() const { return size_ == 0 ? 0 : (negative_ ? -1 : 1); }
    [[nodiscard]] bool is_zero() const { return size_ == 0; }
    /// Bits of the magnitude, 0 for 0.
    [[nodiscard]] int bit_length() const {
        return size_ == 0 ? 0 : 64 * size_ - std::countl_zero(limb_[idx(size_ - 1)]);
    }
    /// Number of zero bits below the lowest set one; 0 for 0.
    [[nodiscard]] int trailing_zeros() const {
        for (int i = 0; i < size_; ++i)
            if (limb_[idx(i)] != 0) return 64 * i + std::countr_zero(limb_[idx(i)]);
        return 0;
    }
    /// \pre bit_length() <= 126
    [[nodiscard]] Int128 to_int128() const {
        const Uint128 u = Uint128{size_ > 1 ? limb_[1] : 0} << 64U | (size_ > 0 ? limb_[0] : 0);
        return negative_ ? -static_cast<Int128>(u) : static_cast<Int128>(u);
    }
    /// \pre it fits.
    template <int N>
    [[nodiscard]] WideInt<N> to_wide() const {
        TRISECT_EXPECTS(bit_length() < 64 * N, "an integer does not fit its register");
        WideInt<N> r;
        for (int i = 0; i < size_; ++i) r.set_limb(i, limb_[idx(i)]);
        return negative_ ? -r : r;
    }
    /// The value is mantissa 2^exponent up to a relative error of 2^-52, 2^63 <= |mantissa| <=
    /// 2^64.
    struct Scaled {
        double mantissa = 0;
        int exponent = 0;
    };
    [[nodiscard]] Scaled scaled() const {
        if (size_ == 0) return {};
        const int bits = bit_length();
        std::uint64_t top = limb_[idx(size_ - 1)];
        int shift = 64 * size_ - bits;
        if (shift != 0 && size_ > 1)
            top = (top << shift) | (limb_[idx(size_ - 2)] >> (64 - shift));
        else
            top <<= shift;
        // 64 leading bits; what is cut off is below 2^-63 of the value, the conversion rounds once.
        const auto m = static_cast<double>(top);
        return {negative_ ? -m : m, bits - 64};
    }

    BoundedInt operator-() const {
        BoundedInt r(*this);
        r.negative_ = r.size_ != 0 && !r.negative_;
        return r;
    }
    friend BoundedInt operator+(const BoundedInt& a, const BoundedInt& b) {
        return sum(a, b, b.negative_);
    }
    friend BoundedInt operator-(const BoundedInt& a, const BoundedInt& b) {
        return sum(a, b, !b.negative_);
    }
    BoundedInt& operator+=(const BoundedInt& o) { return *this = sum(*this, o, o.negative_); }
    BoundedInt& operator-=(const BoundedInt& o) { return *this = sum(*this, o, !o.negative_); }

    friend BoundedInt operator*(const BoundedInt& a, const BoundedInt& b) {
        BoundedInt r;
        if (a.size_ == 0 || b.size_ == 0) return r;
        TRISECT_EXPECTS(a.size_ + b.size_ <= capacity, "an integer exceeds its bound");
        r.size_ = a.size_ + b.size_;
        r.negative_ = a.negative_ != b.negative_;
        std::uint64_t carry = 0;
        for (int j = 0; j < b.size_; ++j) {
            const Uint128 t = Uint128{a.limb_[0]} * b.limb_[idx(j)] + carry;
            r.limb_[idx(j)] = static_cast<std::uint64_t>(t);
            carry = static_cast<std::uint64_t>(t >> 64U);
        }
        r.limb_[idx(b.size_)] = carry;
        for (int i = 1; i < a.size_; ++i) {
            carry = 0;
            for (int j = 0; j < b.size_; ++j) {
                const Uint128 t =
                    Uint128{a.limb_[idx(i)]} * b.limb_[idx(j)] + r.limb_[idx(i + j)] + carry;
                r.limb_[idx(i + j)] = static_cast<std::uint64_t>(t);
                carry = static_cast<std::uint64_t>(t >> 64U);
            }
            r.limb_[idx(i + b.size_)] = carry;
        }
        r.trim();
        return r;
    }

    /// This times 2^bits.
    [[nodiscard]] BoundedInt shifted_left(int bits) const {
        BoundedInt r;
        if (size_ == 0) return r;
        const int words = bits / 64;
        const int rest = bits % 64;
        TRISECT_EXPECTS(size_ + words + 1 <= capacity, "an integer exceeds its bound");
        for (int i = 0; i < words; ++i) r.limb_[idx(i)] = 0;
        std::uint64_t carry = 0;
        for (int i = 0; i < size_; ++i) {
            r.limb_[idx(i + words)] = (limb_[idx(i)] << rest) | carry;
            carry = rest == 0 ? 0 : limb_[idx(i)] >> (64 - rest);
        }
        r.limb_[idx(size_ + words)] = carry;
        r.size_ = size_ + words + 1;
        r.negative_ = negative_;
        r.trim();
        return r;
    }
    /// The magnitude without its lowest bits, with the sign.
    [[nodiscard]] BoundedInt shifted_right(int bits) const {
        BoundedInt r;
        const int words = bits / 64;
        const int rest = bits % 64;
        if (words >= size_) return r;
        r.size_ = size_ - words;
        r.negative_ = negative_;
        for (int i = 0; i < r.size_; ++i) {
            std::uint64_t v = limb_[idx(i + words)] >> rest;
            if (rest != 0 && i + 1 < r.size_) v |= limb_[idx(i + words + 1)] << (64 - rest);
            r.limb_[idx(i)] = v;
        }
        r.trim();
        return r;
    }

    friend bool operator==(const BoundedInt& a, const BoundedInt& b) {
        return a.size_ == b.size_ && a.sign() == b.sign() && compare_magnitude(a, b) == 0;
    }
    /// -1, 0 or 1.
    [[nodiscard]] friend int compare_magnitude(const BoundedInt& a, const BoundedInt& b) {
        if (a.size_ != b.size_) return a.size_ < b.size_ ? -1 : 1;
        for (int i = a.size_ - 1; i >= 0; --i)
            if (a.limb_[idx(i)] != b.limb_[idx(i)])
                return a.limb_[idx(i)] < b.limb_[idx(i)] ? -1 : 1;
        return 0;
    }
    [[nodiscard]] int size() const { return size_; }
    [[nodiscard]] std::uint64_t limb(int i) const { return limb_[idx(i)]; }

private:
    static constexpr std::size_t idx(int i) { return static_cast<std::size_t>(i); }
    void copy_limbs(const BoundedInt& o) noexcept {
        for (int i = 0; i < o.size_; ++i) limb_[idx(i)] = o.limb_[idx(i)];
    }
    void trim() {
        while (size_ > 0 && limb_[idx(size_ - 1)] == 0) --size_;
        if (size_ == 0) negative_ = false;
    }
    static BoundedInt sum(const BoundedInt& a, const BoundedInt& b, bool b_negative) {
        BoundedInt r;
        if (a.negative_ == b_negative || a.size_ == 0 || b.size_ == 0) {
            const BoundedInt& l = a.size_ >= b.size_ ? a : b;
            const BoundedInt& s = a.size_ >= b.size_ ? b : a;
            unsigned char carry = 0;
            int i = 0;
            for (; i < s.size_; ++i)
                r.limb_[idx(i)] = add_with_carry(l.limb_[idx(i)], s.limb_[idx(i)], carry);
            for (; i < l.size_; ++i) r.limb_[idx(i)] = add_with_carry(l.limb_[idx(i)], 0, carry);
            r.size_ = l.size_;
            if (carry != 0) {
                TRISECT_EXPECTS(r.size_ < capacity, "an integer exceeds its bound");
                r.limb_[idx(r.size_++)] = 1;
            }
            r.negative_ = a.size_ == 0 ? b_negative : a.negative_;
            if (r.size_ == 0) r.negative_ = false;
            return r;
        }
        const int c = compare_magnitude(a, b);
        if (c == 0) return r;
        const BoundedInt& l = c > 0 ? a : b;
        const BoundedInt& s = c > 0 ? b : a;
        unsigned char borrow = 0;
        int i = 0;
        for (; i < s.size_; ++i)
            r.limb_[idx(i)] = subtract_with_borrow(l.limb_[idx(i)], s.limb_[idx(i)], borrow);
        for (; i < l.size_; ++i) r.limb_[idx(i)] = subtract_with_borrow(l.limb_[idx(i)], 0, borrow);
        r.size_ = l.size_;
        r.negative_ = c > 0 ? a.negative_ : b_negative;
        r.trim();
        return r;
    }

    int size_ = 0;
    bool negative_ = false;
    std::array<std::uint64_t, static_cast<std::size_t>(capacity)> limb_;  // [size_, ...) unset
};

/// The greatest common divisor of the magnitudes; gcd(a, 0) = |a|. Binary; about 10 ns a bit.
[[nodiscard]] inline BoundedInt gcd(BoundedInt a, BoundedInt b) {
    if (a.sign() < 0) a = -a;
    if (b.sign() < 0) b = -b;
    if (a.is_zero()) return b;
    if (b.is_zero()) return a;
    const int za = a.trailing_zeros();
    const int zb = b.trailing_zeros();
    a = a.shifted_right(za);
    b = b.shifted_right(zb);
    for (;;) {
        const int c = compare_magnitude(a, b);
        if (c == 0) return a.shifted_left(za < zb ? za : zb);
        if (c < 0) std::swap(a, b);
        a -= b;
        a = a.shifted_right(a.trailing_zeros());
    }
}

/// a / b where b divides a. By Jebelean's exact division from the lowest limb up.
[[nodiscard]] BoundedInt divided_exactly(const BoundedInt& a, const BoundedInt& b);

using IntVector = std::array<BoundedInt, 3>;

[[nodiscard]] inline BoundedInt cross(const IntVector& a, const IntVector& b, std::size_t axis) {
    const std::size_t j = (axis + 1) % 3;
    const std::size_t k = (axis + 2) % 3;
    return a[j] * b[k] - a[k] * b[j];
}
[[nodiscard]] inline BoundedInt determinant(const IntVector& a, const IntVector& b,
                                            const IntVector& c) {
    return a[0] * cross(b, c, 0) + a[1] * cross(b, c, 1) + a[2] * cross(b, c, 2);
}

}  // namespace trisect::detail

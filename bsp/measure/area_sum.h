// SPDX-License-Identifier: Apache-2.0
//
// AreaSum: the sum of the lengths of integer vectors, with an error bound.
//
// A vector is scaled by a power of two so that its largest component has 62 bits: m + f, f below 1.
// X is the root of |m|² in doubles, within 2^-51, so that |m|² - X² is an integer of few bits, and
// with one step of Newton's iteration
//
//     |m + f| = X + (|m|² - X² + 2 m·f) / 2X
//
// up to 2^-100 of the length. The sum is one of pairs of doubles (double_pair.h).
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include <trisect/kernel/number/double_pair.h>
#include <trisect/kernel/number/power_of_two.h>
#include <trisect/kernel/wide_int.h>

namespace trisect::detail {

class AreaSum {
public:
    /// Adds the length of a vector of components below 2^126, each off by at most `error`.
    void add(const std::array<Int128, 3>& vector, double error = 0) {
        std::array<Uint128, 3> size{};
        Uint128 all = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            size[i] = static_cast<Uint128>(vector[i] < 0 ? -vector[i] : vector[i]);
            all |= size[i];
        }
        error_ += 2 * error;
        if (all == 0) return;
        const int shift = bit_width(all) - 62;
        std::array<std::int64_t, 3> m{};
        double twice_rest = 0;
        Int128 square = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            m[i] = static_cast<std::int64_t>(shift >= 0 ? size[i] >> shift : size[i] << -shift);
            square += Int128{m[i]} * m[i];
            if (shift <= 0) continue;
            const auto rest =
                static_cast<std::uint64_t>(size[i] - (static_cast<Uint128>(m[i]) << shift));
            twice_rest += 2 * static_cast<double>(m[i]) * static_cast<double>(rest);
        }
        if (shift > 0) twice_rest *= power_of_two(-shift);
        const auto root = static_cast<std::int64_t>(std::sqrt(to_double(square)));
        const double missing = to_double(square - Int128{root} * root) + twice_rest;
        const auto rough = static_cast<double>(root);
        const auto tail = static_cast<double>(root - static_cast<std::int64_t>(rough));
        const double unit = power_of_two(shift);
        sum_ = detail::add(sum_, two_sum(rough * unit, (tail + missing / (2 * rough)) * unit));
        ++count_;
    }
    void add(const AreaSum& other) {
        sum_ = detail::add(sum_, other.sum_);
        error_ += other.error_;
        count_ += other.count_ + 1;
    }

    [[nodiscard]] const DoublePair& sum() const { return sum_; }
    /// Every length, and every addition, is off by 2^-100 of what has come together.
    [[nodiscard]] double error() const {
        return 1.001 * error_ + 0x1p-98 * static_cast<double>(count_ + 1) * sum_.high;
    }

private:
    static int bit_width(Uint128 v) {
        const auto high = static_cast<std::uint64_t>(v >> 64);
        return high != 0 ? 128 - std::countl_zero(high)
                         : 64 - std::countl_zero(static_cast<std::uint64_t>(v));
    }
    // Within two roundings.
    static double to_double(Int128 v) {
        return static_cast<double>(static_cast<std::int64_t>(v >> 64)) * 0x1p64 +
               static_cast<double>(static_cast<std::uint64_t>(v));
    }

    DoublePair sum_;
    double error_ = 0;
    std::size_t count_ = 0;
};

}  // namespace trisect::detail

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
            // Its first 63 bits.
            const Uint128 rest = size[i] << (128 - shift);
            twice_rest += static_cast<double>(m[i]) *
                          static_cast<double>(static_cast<std::int64_t>(rest >> 65));
        }
        const auto root = static_cast<std::int64_t>(std::sqrt(to_double(square)));
        const double missing = to_double(square - Int128{root} * root) + twice_rest * 0x1p-62;
        const auto rough = static_cast<double>(root);
        const auto tail = static_cast<double>(root - static_cast<std::int64_t>(rough));
        const double unit = power_of_two(shift);
        const DoublePair sum = two_sum(block_.high, rough * unit);
        block_ = {sum.high, block_.low + (sum.low + (tail + missing / (2 * rough)) * unit)};
        if (++in_block_ == block) end_block();
    }
    void add(AreaSum other) {
        other.end_block();
        sum_ = detail::add(sum_, other.sum_);
        error_ += other.error_;
        blocks_ += other.blocks_ + 1;
    }

    [[nodiscard]] DoublePair sum() const {
        return detail::add(sum_, two_sum(block_.high, block_.low));
    }
    /// 0 where nothing was added. Every length is off by 2^-100 of itself. The low part of a block
    /// is below 2^-53 of its sum for each of its terms, and rounded with each: 2^-87 of the sum in
    /// all. The additions of blocks are off by 2^-103 of the sum each.
    [[nodiscard]] double error() const {
        return 1.001 * error_ + (0x1p-86 + 0x1p-102 * static_cast<double>(blocks_)) * sum().high;
    }

private:
    static int bit_width(Uint128 v) {
        const auto high = static_cast<std::uint64_t>(v >> 64);
        return high != 0 ? 128 - std::countl_zero(high)
                         : 64 - std::countl_zero(static_cast<std::uint64_t>(v));
    }
    // Off by two roundings and by 2^11: that much of a square, or of what is missing of one, which
    // is divided by a root of 62 bits, is nothing.
    static double to_double(Int128 v) {
        constexpr std::uint64_t low = (std::uint64_t{1} << 63) - 1;
        return static_cast<double>(static_cast<std::int64_t>(v >> 63)) * 0x1p63 +
               static_cast<double>(static_cast<std::int64_t>(static_cast<std::uint64_t>(v) & low));
    }
    void end_block() {
        sum_ = sum();
        block_ = {};
        in_block_ = 0;
        ++blocks_;
    }

    // Additions of pairs wait for each other, so most go without putting low parts in order.
    static constexpr std::size_t block = 1024;
    DoublePair block_;
    std::size_t in_block_ = 0;
    DoublePair sum_;  // of the blocks before
    std::size_t blocks_ = 0;
    double error_ = 0;
};

}  // namespace trisect::detail

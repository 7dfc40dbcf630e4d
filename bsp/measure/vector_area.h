// SPDX-License-Identifier: Apache-2.0
//
// VectorArea: twice the vector area of a planar facet.
//
// A sum over the edges around it. The cross products of whole coordinates have fewer than 124 bits,
// and what they sum up to is no larger than the facet, so sums go modulo 2^128. Rests are less than
// 1 (see volume_sum.h, whose bounds hold for every component).
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include <trisect/bsp/measure/split_point.h>
#include <trisect/kernel/wide_int.h>

namespace trisect::detail {

class VectorArea {
public:
    void add(const SplitWhole& o, const SplitWhole& p, const SplitWhole& q) {
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t j = (i + 1) % 3;
            const std::size_t k = (i + 2) % 3;
            whole_[i] += static_cast<Uint128>(Int128{p[j] - o[j]} * (q[k] - o[k]) -
                                              Int128{p[k] - o[k]} * (q[j] - o[j]));
        }
    }
    /// `slack` as in VolumeSum: 2^-48 and what coordinates are off by.
    void add(const SplitPoint& o, const SplitPoint& p, const SplitPoint& q, double slack) {
        add(o.whole, p.whole, q.whole);
        if (o.is_whole() && p.is_whole() && q.is_whole()) return;
        double size = 8;
        std::array<double, 3> u{};
        std::array<double, 3> v{};
        std::array<double, 3> x{};
        std::array<double, 3> y{};
        for (std::size_t i = 0; i < 3; ++i) {
            u[i] = static_cast<double>(p.whole[i] - o.whole[i]);
            v[i] = static_cast<double>(q.whole[i] - o.whole[i]);
            x[i] = p.rest[i] - o.rest[i];
            y[i] = q.rest[i] - o.rest[i];
            size += std::fabs(u[i]) + std::fabs(v[i]);
        }
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t j = (i + 1) % 3;
            const std::size_t k = (i + 2) % 3;
            rest_[i] += (u[j] * y[k] + x[j] * (v[k] + y[k])) - (u[k] * y[j] + x[k] * (v[j] + y[j]));
        }
        error_ += 8 * slack * size;
    }

    /// A component to the nearest integers, one up or down.
    [[nodiscard]] Int128 at(std::size_t i) const {
        return static_cast<Int128>(whole_[i] + static_cast<Uint128>(static_cast<Int128>(rest_[i])));
    }
    [[nodiscard]] bool is_surely_not_0() const {
        for (std::size_t i = 0; i < 3; ++i)
            if (std::fabs(static_cast<double>(at(i))) > 1.001 * error()) return true;
        return false;
    }
    /// What a component is off by at most.
    [[nodiscard]] double error() const { return error_ == 0 ? 0 : error_ + 1; }

private:
    std::array<Uint128, 3> whole_{};
    std::array<double, 3> rest_{};
    double error_ = 0;
};

}  // namespace trisect::detail

// SPDX-License-Identifier: Apache-2.0
//
// VolumeSum: six times the volume below triangles, with an error bound.
//
// The volume of a solid is the integral of z over the projections of its faces: for a triangle
// (o, p, q) six times that is
//
//     (z_o + z_p + z_q) · ((p - o) × (q - o))_z,
//
// and closed boundaries may be fans of triangles in the planes of their faces. Whole coordinates
// have 61 bits, so a product has fewer than 64 + 124. Let a coordinate be X + x, x less than 1, off
// by at most e. With U and V the sides of the triangle and S = |U_x| + |U_y| + |V_x| + |V_y| + 8,
// what rests add to the cross product is less than 4 S, and a change of all of them by e changes it
// by less than 4 e S. All that is computed in doubles with a dozen roundings; (2^-48 + e) times
// 3 |cross| + 4 (|Z| + 6) S bounds what the term is off by.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include <trisect/bsp/measure/split_point.h>
#include <trisect/kernel/number/double_pair.h>
#include <trisect/kernel/wide_int.h>

namespace trisect::detail {

class VolumeSum {
public:
    /// `error`: what a coordinate of a point with rests may be off by, in units. Heights count from
    /// `base`, which is best amid the solid: bounds grow with them.
    explicit VolumeSum(double error = 0, std::int64_t base = 0)
        : slack_(0x1p-48 + error), base3_(3 * base) {}

    void add(const SplitWhole& o, const SplitWhole& p, const SplitWhole& q) {
        (void)add_whole(o, p, q);
    }
    void add(const SplitPoint& o, const SplitPoint& p, const SplitPoint& q) {
        const auto cross = static_cast<double>(add_whole(o.whole, p.whole, q.whole));
        const auto side = [&](const SplitPoint& to, std::size_t k) {
            return static_cast<double>(to.whole[k] - o.whole[k]);
        };
        const auto rest = [&](const SplitPoint& to, std::size_t k) {
            return to.rest[k] - o.rest[k];
        };
        const double ux = side(p, 0);
        const double uy = side(p, 1);
        const double vx = side(q, 0);
        const double vy = side(q, 1);
        const double add_to_cross = (ux * rest(q, 1) + rest(p, 0) * (vy + rest(q, 1))) -
                                    (uy * rest(q, 0) + rest(p, 1) * (vx + rest(q, 0)));
        const auto z = static_cast<double>(o.whole[2] + p.whole[2] + q.whole[2] - base3_);
        const double rest_z = o.rest[2] + p.rest[2] + q.rest[2];
        rests_ = two_sum(rests_.high, rests_.low + (rest_z * cross + (z + rest_z) * add_to_cross));
        const double size = std::fabs(ux) + std::fabs(uy) + std::fabs(vx) + std::fabs(vy) + 8;
        error_ += slack_ * (3 * std::fabs(cross) + 4 * (std::fabs(z) + 6) * size);
        ++count_;
    }
    void add(const VolumeSum& other) {
        for (std::size_t i = 0; i < limbs_.size(); ++i) limbs_[i] += other.limbs_[i];
        rests_ = detail::add(rests_, other.rests_);
        error_ += other.error_;
        count_ += other.count_;
    }

    /// What whole coordinates make, exactly.
    [[nodiscard]] WideInt<5> whole() const {
        return WideInt<5>(limbs_[0]) + WideInt<5>(limbs_[1]).shifted_left(64) +
               WideInt<5>(limbs_[2]).shifted_left(128);
    }
    [[nodiscard]] bool is_exact() const { return count_ == 0; }
    /// What rests add to that, and what it is off by at most: additions lose a rounding of each
    /// term, a thirtieth of its bound.
    [[nodiscard]] double rests() const { return rests_.high + rests_.low; }
    [[nodiscard]] double error() const { return 1.2 * error_ + 0x1p-50 * std::fabs(rests()); }

private:
    // The sum is limbs_[0] + 2^64 limbs_[1] + 2^128 limbs_[2], each far from its limits. Returns
    // the cross product.
    Int128 add_whole(const SplitWhole& o, const SplitWhole& p, const SplitWhole& q) {
        const Int128 cross =
            Int128{p[0] - o[0]} * (q[1] - o[1]) - Int128{p[1] - o[1]} * (q[0] - o[0]);
        const std::int64_t z = o[2] + p[2] + q[2] - base3_;
        const auto low = static_cast<std::uint64_t>(cross);
        const auto high = static_cast<std::int64_t>(cross >> 64);
        const Int128 by_low = static_cast<Int128>(low) * z;
        const Int128 by_high = Int128{high} * z;
        limbs_[0] += static_cast<std::uint64_t>(by_low);
        limbs_[1] += (by_low >> 64) + static_cast<std::uint64_t>(by_high);
        limbs_[2] += by_high >> 64;
        return cross;
    }

    std::array<Int128, 3> limbs_{};
    DoublePair rests_;
    double error_ = 0;
    double slack_;
    std::int64_t base3_;
    std::size_t count_ = 0;  // of terms with rests
};

}  // namespace trisect::detail

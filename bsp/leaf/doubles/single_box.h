// SPDX-License-Identifier: Apache-2.0
//
// SingleBox: a box in single precision.
// Its ends are compared three at once, without a branch.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include <trisect/kernel/number/vector3.h>
#include <trisect/kernel/support/four_floats.h>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace trisect::detail {

#if defined(__SSE2__)
/// a - b in single precision, and 0.
// From registers: numbers that are stored one by one are not at hand as four for a while.
[[nodiscard]] inline FourFloats singles_between(const Vector3& a, const Vector3& b) {
    const __m128 xy = _mm_cvtpd_ps(_mm_sub_pd(_mm_loadu_pd(a.data()), _mm_loadu_pd(b.data())));
    const __m128 z = _mm_cvtpd_ps(_mm_sub_sd(_mm_load_sd(a.data() + 2), _mm_load_sd(b.data() + 2)));
    alignas(16) std::array<float, 4> out;
    _mm_store_ps(out.data(), _mm_movelh_ps(xy, z));
    return FourFloats(out);
}
#else
[[nodiscard]] inline FourFloats singles_between(const Vector3& a, const Vector3& b) {
    const Vector3 v = minus(a, b);
    alignas(16) const std::array<float, 4> out{static_cast<float>(v[0]), static_cast<float>(v[1]),
                                               static_cast<float>(v[2]), 0};
    return FourFloats(out);
}
#endif

/// Closed. The fourth number of either end is the caller's; it must be finite.
struct alignas(16) SingleBox {
    using Four = std::array<float, 4>;
    Four lo{};
    Four down{};  ///< upper ends, with their signs turned: so a box grows as both get smaller

    [[nodiscard]] static SingleBox all_of(float end) {
        return {{-end, -end, -end, 0}, {-end, -end, -end, 0}};
    }
    /// A box that any other one enlarges.
    [[nodiscard]] static SingleBox none() { return all_of(-infinity); }
    [[nodiscard]] static SingleBox everywhere() { return all_of(infinity); }

    [[nodiscard]] float hi(std::size_t axis) const { return -down[axis]; }
    void add(const SingleBox& b) {
        lo = smaller(FourFloats(lo), FourFloats(b.lo)).numbers();
        down = smaller(FourFloats(down), FourFloats(b.down)).numbers();
    }
    /// The part in another one.
    void cut(const SingleBox& b) {
        lo = larger(FourFloats(lo), FourFloats(b.lo)).numbers();
        down = larger(FourFloats(down), FourFloats(b.down)).numbers();
    }
    [[nodiscard]] bool contains(const SingleBox& b) const {
        return ((greater(FourFloats(lo), FourFloats(b.lo)) |
                 greater(FourFloats(down), FourFloats(b.down))) &
                axes) == 0;
    }
    [[nodiscard]] bool meets(const SingleBox& b) const {
        const FourFloats zero(0);
        return ((greater(FourFloats(lo), zero - FourFloats(b.down)) |
                 greater(FourFloats(down), zero - FourFloats(b.lo))) &
                axes) == 0;
    }

    static constexpr unsigned axes = 7;  ///< bits of what is compared of four numbers
    static constexpr float infinity = std::numeric_limits<float>::infinity();
};

/// Takes boxes in doubles to single precision: from the middle of a place, rounded outwards. What
/// is far out of the place is drawn in to some way from it, so that boxes that meet in the place
/// still do.
class SinglePlace {
public:
    SinglePlace() = default;
    SinglePlace(const Vector3& lo, const Vector3& hi) {
        double extent = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            middle_[k] = lo[k] + (hi[k] - lo[k]) / 2;
            extent = std::max(extent, hi[k] - lo[k]);
        }
        // Twice as far from the middle as the place reaches. What is within that is rounded by
        // 2^-24 of it, and once more when the margin is taken off.
        farthest_ = static_cast<float>(extent);
        const float margin = 0x1p-22F * farthest_;
        margins_ = {margin, margin, margin, 0};
    }
    /// The fourth number of either end is 0.
    [[nodiscard]] SingleBox box(const Vector3& lo, const Vector3& hi) const {
        return {drawn_in(middle_, lo), drawn_in(hi, middle_)};
    }
    /// In doubles, off by no more than their rounding.
    [[nodiscard]] double lower(const SingleBox& b, std::size_t axis) const {
        return middle_[axis] + static_cast<double>(b.lo[axis]);
    }
    [[nodiscard]] double upper(const SingleBox& b, std::size_t axis) const {
        return middle_[axis] - static_cast<double>(b.down[axis]);
    }

private:
    // From one end to the other.
    [[nodiscard]] SingleBox::Four drawn_in(const Vector3& from, const Vector3& to) const {
        return (larger(smaller(singles_between(to, from), FourFloats(farthest_)),
                       FourFloats(-farthest_)) -
                FourFloats(margins_))
            .numbers();
    }
    Vector3 middle_{};
    float farthest_ = 0;
    alignas(16) SingleBox::Four margins_{};
};

}  // namespace trisect::detail

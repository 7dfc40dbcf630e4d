// SPDX-License-Identifier: Apache-2.0
//
// BoxRows: boxes in single precision, four at a time, for a sweep that looks at many pairs and
// keeps few.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace trisect::detail {

/// Boxes in the order in which they are added, each with a group. Rounded outwards: boxes that meet
/// are found to meet; a few that do not may be.
class BoxRows {
public:
    using Corner = std::array<double, 3>;

    void clear() {
        size_ = 0;
        rows_.clear();
    }
    void add(const Corner& lo, const Corner& hi, std::int32_t group) {
        if (size_ % 4 == 0) rows_.emplace_back();
        Row& r = rows_.back();
        const std::size_t i = size_ % 4;
#if defined(__SSE2__)
        const __m128d sign = _mm_set1_pd(-0.0);
        const auto outside = [&](__m128d x, __m128d toward) {
            return _mm_cvtpd_ps(_mm_add_pd(x, _mm_mul_pd(_mm_andnot_pd(sign, x), toward)));
        };
        const auto set = [&](__m128 two, float& first, float& second) {
            _mm_store_ss(&first, two);
            _mm_store_ss(&second, _mm_shuffle_ps(two, two, 1));
        };
        const __m128d down = _mm_set1_pd(-relative);
        const __m128d up = _mm_set1_pd(relative);
        set(outside(_mm_loadu_pd(lo.data()), down), r.lo[0][i], r.lo[1][i]);
        set(outside(_mm_set_pd(hi[0], lo[2]), _mm_set_pd(relative, -relative)), r.lo[2][i],
            r.hi[0][i]);
        set(outside(_mm_loadu_pd(hi.data() + 1), up), r.hi[1][i], r.hi[2][i]);
#else
        for (std::size_t k = 0; k < 3; ++k) {
            r.lo[k][i] = below(lo[k]);
            r.hi[k][i] = -below(-hi[k]);
        }
#endif
        r.group[i] = group;
        ++size_;
    }
    [[nodiscard]] std::size_t row_count() const { return rows_.size(); }
    /// Of the first box in a row.
    [[nodiscard]] float first_low(std::size_t row) const { return rows_[row].lo[0][0]; }

    /// A box to be compared with the others.
    struct Probe {
        std::array<float, 3> lo;
        std::array<float, 3> hi;
        std::int32_t group;
    };
    [[nodiscard]] Probe probe(std::size_t box) const {
        const Row& r = rows_[box / 4];
        const std::size_t i = box % 4;
        return {
            {r.lo[0][i], r.lo[1][i], r.lo[2][i]}, {r.hi[0][i], r.hi[1][i], r.hi[2][i]}, r.group[i]};
    }
    [[nodiscard]] static Probe probe(const Corner& lo, const Corner& hi, std::int32_t group) {
        return {{below(lo[0]), below(lo[1]), below(lo[2])},
                {-below(-hi[0]), -below(-hi[1]), -below(-hi[2])},
                group};
    }
    /// Which boxes of a row meet the probe and are of another group, a bit for each.
    [[nodiscard]] unsigned meeting(std::size_t row, const Probe& p) const {
        const Row& r = rows_[row];
#if defined(__SSE2__)
        __m128 met = _mm_castsi128_ps(
            _mm_cmpeq_epi32(_mm_load_si128(reinterpret_cast<const __m128i*>(r.group.data())),
                            _mm_set1_epi32(p.group)));
        for (std::size_t k = 0; k < 3; ++k) {
            met = _mm_or_ps(met, _mm_cmpgt_ps(_mm_load_ps(r.lo[k].data()), _mm_set1_ps(p.hi[k])));
            met = _mm_or_ps(met, _mm_cmplt_ps(_mm_load_ps(r.hi[k].data()), _mm_set1_ps(p.lo[k])));
        }
        return ~static_cast<unsigned>(_mm_movemask_ps(met)) & 15U;
#else
        unsigned met = 0;
        for (std::size_t i = 0; i < 4; ++i) {
            bool meets = r.group[i] != p.group;
            for (std::size_t k = 0; k < 3; ++k)
                meets = meets && r.lo[k][i] <= p.hi[k] && r.hi[k][i] >= p.lo[k];
            met |= static_cast<unsigned>(meets ? 1 : 0) << i;
        }
        return met;
#endif
    }

private:
    // Places without a box meet nothing.
    struct alignas(16) Row {
        static constexpr float none = std::numeric_limits<float>::infinity();
        using Four = std::array<float, 4>;
        std::array<Four, 3> lo{Four{none, none, none, none}, Four{none, none, none, none},
                               Four{none, none, none, none}};
        std::array<Four, 3> hi{Four{-none, -none, -none, -none}, Four{-none, -none, -none, -none},
                               Four{-none, -none, -none, -none}};
        std::array<std::int32_t, 4> group{-1, -1, -1, -1};
    };
    // Rounding to single precision errs by less than 2^-24 of the number.
    static constexpr double relative = 0x1p-23;
    [[nodiscard]] static float below(double x) {
        return static_cast<float>(x - std::fabs(x) * relative);
    }

    std::vector<Row> rows_;
    std::size_t size_ = 0;
};

}  // namespace trisect::detail

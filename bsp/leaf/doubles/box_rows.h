// SPDX-License-Identifier: Apache-2.0
//
// BoxRows: boxes in single precision, four at a time, for sweeps.
// A sweep looks at many pairs and keeps few.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
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
        hulls_.clear();
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

    /// A box to be compared with the others: every number four times.
    struct alignas(16) Probe {
        std::array<std::array<float, 4>, 3> lo;
        std::array<std::array<float, 4>, 3> hi;
        std::array<std::int32_t, 4> group;
    };
    [[nodiscard]] Probe probe(std::size_t box) const {
        const Row& r = rows_[box / 4];
        const std::size_t i = box % 4;
        return probe_of({r.lo[0][i], r.lo[1][i], r.lo[2][i]}, {r.hi[0][i], r.hi[1][i], r.hi[2][i]},
                        r.group[i]);
    }
    [[nodiscard]] static Probe probe(const Corner& lo, const Corner& hi, std::int32_t group) {
        return probe_of({below(lo[0]), below(lo[1]), below(lo[2])},
                        {-below(-hi[0]), -below(-hi[1]), -below(-hi[2])}, group);
    }
    /// Which boxes of a row meet the probe and are of another group, a bit for each.
    [[nodiscard]] unsigned meeting(std::size_t row, const Probe& p) const {
        return meeting(rows_[row], p);
    }

    /// Call it when all boxes are there: then visit_meeting() looks at four rows at once.
    void add_hulls() {
        for (std::size_t row = 0; row < rows_.size(); ++row) {
            if (row % 4 == 0) hulls_.emplace_back();
            const Row& r = rows_[row];
            Row& hull = hulls_.back();
            for (std::size_t k = 0; k < 3; ++k) {
                hull.lo[k][row % 4] = *std::min_element(r.lo[k].begin(), r.lo[k].end());
                hull.hi[k][row % 4] = *std::max_element(r.hi[k].begin(), r.hi[k].end());
            }
            const bool one = std::equal(r.group.begin() + 1, r.group.end(), r.group.begin());
            hull.group[row % 4] = one ? r.group[0] : Row::mixed;
        }
    }
    /// Calls visit(row, boxes that meet the probe as above) for rows from `first` on that have
    /// some, until that is false; returns whether it never was. \pre add_hulls()
    template <class Visit>
    [[nodiscard]] bool visit_meeting(std::size_t first, const Probe& p, const Visit& visit) const {
        for (std::size_t h = first / 4; h < hulls_.size(); ++h) {
            unsigned rows = meeting(hulls_[h], p);
            if (h == first / 4) rows &= ~0U << first % 4;
            for (; rows != 0; rows &= rows - 1) {
                const std::size_t row = 4 * h + static_cast<std::size_t>(std::countr_zero(rows));
                const unsigned met = meeting(rows_[row], p);
                if (met != 0 && !visit(row, met)) return false;
            }
        }
        return true;
    }

private:
    // Places without a box meet nothing.
    struct alignas(16) Row {
        static constexpr float none = std::numeric_limits<float>::infinity();
        static constexpr std::int32_t mixed = -2;  // no group
        using Four = std::array<float, 4>;
        std::array<Four, 3> lo{Four{none, none, none, none}, Four{none, none, none, none},
                               Four{none, none, none, none}};
        std::array<Four, 3> hi{Four{-none, -none, -none, -none}, Four{-none, -none, -none, -none},
                               Four{-none, -none, -none, -none}};
        std::array<std::int32_t, 4> group{-1, -1, -1, -1};
    };
    [[nodiscard]] static Probe probe_of(const std::array<float, 3>& lo,
                                        const std::array<float, 3>& hi, std::int32_t group) {
        Probe p;
        for (std::size_t k = 0; k < 3; ++k) {
            p.lo[k].fill(lo[k]);
            p.hi[k].fill(hi[k]);
        }
        p.group.fill(group);
        return p;
    }
    [[nodiscard]] static unsigned meeting(const Row& r, const Probe& p) {
#if defined(__SSE2__)
        const auto load = [](const std::array<float, 4>& v) { return _mm_load_ps(v.data()); };
        const auto groups = [](const std::array<std::int32_t, 4>& v) {
            return _mm_load_si128(reinterpret_cast<const __m128i*>(v.data()));
        };
        __m128 met = _mm_castsi128_ps(_mm_cmpeq_epi32(groups(r.group), groups(p.group)));
        for (std::size_t k = 0; k < 3; ++k) {
            met = _mm_or_ps(met, _mm_cmpgt_ps(load(r.lo[k]), load(p.hi[k])));
            met = _mm_or_ps(met, _mm_cmplt_ps(load(r.hi[k]), load(p.lo[k])));
        }
        return ~static_cast<unsigned>(_mm_movemask_ps(met)) & 15U;
#else
        unsigned met = 0;
        for (std::size_t i = 0; i < 4; ++i) {
            bool meets = r.group[i] != p.group[i];
            for (std::size_t k = 0; k < 3; ++k)
                meets = meets && r.lo[k][i] <= p.hi[k][i] && r.hi[k][i] >= p.lo[k][i];
            met |= static_cast<unsigned>(meets ? 1 : 0) << i;
        }
        return met;
#endif
    }
    // Rounding to single precision errs by less than 2^-24 of the number.
    static constexpr double relative = 0x1p-23;
    [[nodiscard]] static float below(double x) {
        return static_cast<float>(x - std::fabs(x) * relative);
    }

    std::vector<Row> rows_;
    std::vector<Row> hulls_;  // a box for each row
    std::size_t size_ = 0;
};

}  // namespace trisect::detail

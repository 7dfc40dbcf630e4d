// SPDX-License-Identifier: Apache-2.0
//
// BoxSum, BoxProbe: one box against many.
// Two of their six ends are compared at once, without a branch.
#pragma once

#include <cstddef>

#include <trisect/bsp/many_meshes/outlines/outlined_solid.h>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace trisect::detail {

#if defined(__SSE2__)

/// The box of all boxes that were added.
class BoxSum {
public:
    BoxSum() : BoxSum(OutlineBox::none()) {}
    explicit BoxSum(const OutlineBox& b)
        : lo_(_mm_loadu_pd(b.lo.data())),
          lo_hi_(_mm_set_pd(b.hi[0], b.lo[2])),
          hi_(_mm_loadu_pd(b.hi.data() + 1)) {}
    void add(const OutlineBox& b) {
        const __m128d lo_hi = _mm_set_pd(b.hi[0], b.lo[2]);
        lo_ = _mm_min_pd(lo_, _mm_loadu_pd(b.lo.data()));
        lo_hi_ = _mm_move_sd(_mm_max_pd(lo_hi_, lo_hi), _mm_min_pd(lo_hi_, lo_hi));
        hi_ = _mm_max_pd(hi_, _mm_loadu_pd(b.hi.data() + 1));
    }
    void add(const Approximation& p) {
        const __m128d xy = _mm_loadu_pd(p.c.data());
        const __m128d z = _mm_set1_pd(p.c[2]);
        const __m128d error = _mm_set1_pd(p.error);
        const __m128d rounding = _mm_set1_pd(OutlineBox::rounding_of(p));
        const auto margin = [&](__m128d at) {
            return _mm_add_pd(error, _mm_mul_pd(rounding, _mm_andnot_pd(_mm_set1_pd(-0.0), at)));
        };
        const __m128d hi_xy = _mm_add_pd(xy, margin(xy));
        const __m128d lo_hi = _mm_unpacklo_pd(_mm_sub_pd(z, margin(z)), hi_xy);
        lo_ = _mm_min_pd(lo_, _mm_sub_pd(xy, margin(xy)));
        lo_hi_ = _mm_move_sd(_mm_max_pd(lo_hi_, lo_hi), _mm_min_pd(lo_hi_, lo_hi));
        hi_ = _mm_max_pd(hi_, _mm_unpackhi_pd(hi_xy, _mm_add_pd(z, margin(z))));
    }
    [[nodiscard]] OutlineBox box() const {
        OutlineBox out;
        _mm_storeu_pd(out.lo.data(), lo_);
        _mm_storel_pd(out.lo.data() + 2, lo_hi_);
        _mm_storeh_pd(out.hi.data(), lo_hi_);
        _mm_storeu_pd(out.hi.data() + 1, hi_);
        return out;
    }

private:
    __m128d lo_;     // of the first two axes
    __m128d lo_hi_;  // of the third axis, and of the first one
    __m128d hi_;     // of the last two axes
};

/// A box that many are compared with.
class BoxProbe {
public:
    explicit BoxProbe(const OutlineBox& b)
        : lo_(_mm_loadu_pd(b.lo.data())),
          lo_z_(_mm_set1_pd(b.lo[2])),
          hi_(_mm_loadu_pd(b.hi.data())),
          hi_z_(_mm_set1_pd(b.hi[2])) {}
    [[nodiscard]] bool meets(const OutlineBox& b) const {
        const __m128d along_xy = _mm_and_pd(_mm_cmple_pd(_mm_loadu_pd(b.lo.data()), hi_),
                                            _mm_cmple_pd(lo_, _mm_loadu_pd(b.hi.data())));
        const __m128d along_z = _mm_and_pd(_mm_cmple_pd(_mm_set1_pd(b.lo[2]), hi_z_),
                                           _mm_cmple_pd(lo_z_, _mm_set1_pd(b.hi[2])));
        return _mm_movemask_pd(_mm_and_pd(along_xy, along_z)) == 3;
    }

private:
    __m128d lo_;  // of the first two axes
    __m128d lo_z_;
    __m128d hi_;
    __m128d hi_z_;
};

#else

class BoxSum {
public:
    BoxSum() : box_(OutlineBox::none()) {}
    explicit BoxSum(const OutlineBox& b) : box_(b) {}
    void add(const OutlineBox& b) { box_.add(b); }
    void add(const Approximation& p) { box_.add(p); }
    [[nodiscard]] const OutlineBox& box() const { return box_; }

private:
    OutlineBox box_;
};

class BoxProbe {
public:
    explicit BoxProbe(const OutlineBox& b) : box_(b) {}
    [[nodiscard]] bool meets(const OutlineBox& b) const { return box_.meets(b); }

private:
    OutlineBox box_;
};

#endif

}  // namespace trisect::detail

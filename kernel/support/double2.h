// SPDX-License-Identifier: Apache-2.0
//
// Double2: two doubles in one vector register, like Float4.
#pragma once

#include <cstdint>
#include <cstring>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace trisect::detail {

__extension__ typedef double Double2 __attribute__((vector_size(16)));
/// What comparisons give: lanes of some integer of 64 bits.
using Mask2 = decltype(Double2{} > Double2{});

[[nodiscard]] inline Double2 both(double v) { return Double2{v, v}; }

/// From two that are side by side.
[[nodiscard]] inline Double2 load(const double* from) {
    Double2 v;
    std::memcpy(&v, from, sizeof(v));
    return v;
}

/// The second one where one of them is not a number.
[[nodiscard]] inline Double2 smaller(Double2 a, Double2 b) {
#if defined(__SSE2__)
    return reinterpret_cast<Double2>(
        _mm_min_pd(reinterpret_cast<__m128d>(a), reinterpret_cast<__m128d>(b)));
#else
    return Double2{a[0] < b[0] ? a[0] : b[0], a[1] < b[1] ? a[1] : b[1]};
#endif
}

/// The second one where one of them is not a number.
[[nodiscard]] inline Double2 larger(Double2 a, Double2 b) {
#if defined(__SSE2__)
    return reinterpret_cast<Double2>(
        _mm_max_pd(reinterpret_cast<__m128d>(a), reinterpret_cast<__m128d>(b)));
#else
    return Double2{a[0] > b[0] ? a[0] : b[0], a[1] > b[1] ? a[1] : b[1]};
#endif
}

/// `a` where the mask is set.
[[nodiscard]] inline Double2 choose(Mask2 m, Double2 a, Double2 b) {
    return reinterpret_cast<Double2>((m & reinterpret_cast<Mask2>(a)) |
                                     (~m & reinterpret_cast<Mask2>(b)));
}

/// Bit i is set where number i is.
[[nodiscard]] inline unsigned bits_of(Mask2 m) {
#if defined(__SSE2__)
    return static_cast<unsigned>(_mm_movemask_pd(reinterpret_cast<__m128d>(m)));
#else
    return (m[0] != 0 ? 1U : 0U) | (m[1] != 0 ? 2U : 0U);
#endif
}

/// Bit i is set where a is at most b.
[[nodiscard]] inline unsigned where_at_most(Double2 a, Double2 b) {
    const Mask2 m = a <= b;
    return bits_of(m);
}

}  // namespace trisect::detail

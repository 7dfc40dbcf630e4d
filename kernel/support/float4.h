// SPDX-License-Identifier: Apache-2.0
//
// Float4: four floats in one vector register.
// It uses the vector extension of g++ and clang. Operators work lane by lane; a comparison gives
// Mask4.
#pragma once

#include <cmath>
#include <cstdint>

#if defined(__SSE__)
#include <xmmintrin.h>
#endif

namespace trisect::detail {

__extension__ typedef float Float4 __attribute__((vector_size(16)));
/// What comparisons give: lanes of int, or of long where that has 32 bits.
using Mask4 = decltype(Float4{} > Float4{});

[[nodiscard]] inline Float4 all_lanes(float v) { return Float4{v, v, v, v}; }

[[nodiscard]] inline Float4 magnitude(Float4 v) {
    constexpr std::int32_t most = 0x7fffffff;
    return reinterpret_cast<Float4>(reinterpret_cast<Mask4>(v) & Mask4{most, most, most, most});
}

[[nodiscard]] inline Float4 larger(Float4 a, Float4 b) {
#if defined(__SSE__)
    return reinterpret_cast<Float4>(
        _mm_max_ps(reinterpret_cast<__m128>(a), reinterpret_cast<__m128>(b)));
#else
    Float4 r = a;
    for (int i = 0; i < 4; ++i) r[i] = a[i] > b[i] ? a[i] : b[i];
    return r;
#endif
}

/// \pre no lane is negative
[[nodiscard]] inline Float4 square_root(Float4 v) {
#if defined(__SSE__)
    return reinterpret_cast<Float4>(_mm_sqrt_ps(reinterpret_cast<__m128>(v)));
#else
    Float4 r = v;
    for (int i = 0; i < 4; ++i) r[i] = std::sqrt(v[i]);
    return r;
#endif
}

/// Bit i is set where lane i is.
[[nodiscard]] inline unsigned bits_of(Mask4 m) {
#if defined(__SSE__)
    return static_cast<unsigned>(_mm_movemask_ps(reinterpret_cast<__m128>(m)));
#else
    return (m[0] != 0 ? 1U : 0U) | (m[1] != 0 ? 2U : 0U) | (m[2] != 0 ? 4U : 0U) |
           (m[3] != 0 ? 8U : 0U);
#endif
}

}  // namespace trisect::detail

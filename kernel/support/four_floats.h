// SPDX-License-Identifier: Apache-2.0
//
// FourFloats: single-precision arithmetic on four numbers at a time.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace trisect::detail {

/// Rounded as four single operations are. No operand may be a NaN.
class FourFloats {
public:
#if defined(__SSE2__)
    /// \pre aligned to 16 bytes
    explicit FourFloats(const std::array<float, 4>& v) : v_(_mm_load_ps(v.data())) {}
    explicit FourFloats(float all) : v_(_mm_set1_ps(all)) {}

    friend FourFloats operator+(FourFloats a, FourFloats b) { return _mm_add_ps(a.v_, b.v_); }
    friend FourFloats operator-(FourFloats a, FourFloats b) { return _mm_sub_ps(a.v_, b.v_); }
    friend FourFloats operator*(FourFloats a, FourFloats b) { return _mm_mul_ps(a.v_, b.v_); }
    friend FourFloats smaller(FourFloats a, FourFloats b) { return _mm_min_ps(a.v_, b.v_); }
    friend FourFloats larger(FourFloats a, FourFloats b) { return _mm_max_ps(a.v_, b.v_); }
    /// Where a > b, a bit for each of the four.
    friend unsigned greater(FourFloats a, FourFloats b) {
        return static_cast<unsigned>(_mm_movemask_ps(_mm_cmpgt_ps(a.v_, b.v_)));
    }
    [[nodiscard]] std::array<float, 4> numbers() const {
        alignas(16) std::array<float, 4> out;
        _mm_store_ps(out.data(), v_);
        return out;
    }
    /// Whole numbers, rounded towards zero. \pre they have 31 bits
    [[nodiscard]] std::array<std::int32_t, 4> truncated() const {
        alignas(16) std::array<std::int32_t, 4> out;
        _mm_store_si128(reinterpret_cast<__m128i*>(out.data()), _mm_cvttps_epi32(v_));
        return out;
    }

private:
    FourFloats(__m128 v) : v_(v) {}  // NOLINT(google-explicit-constructor)
    __m128 v_;
#else
    explicit FourFloats(const std::array<float, 4>& v) : v_(v) {}
    explicit FourFloats(float all) : v_{all, all, all, all} {}

    friend FourFloats operator+(const FourFloats& a, const FourFloats& b) {
        return each(a, b, [](float x, float y) { return x + y; });
    }
    friend FourFloats operator-(const FourFloats& a, const FourFloats& b) {
        return each(a, b, [](float x, float y) { return x - y; });
    }
    friend FourFloats operator*(const FourFloats& a, const FourFloats& b) {
        return each(a, b, [](float x, float y) { return x * y; });
    }
    friend FourFloats smaller(const FourFloats& a, const FourFloats& b) {
        return each(a, b, [](float x, float y) { return std::min(x, y); });
    }
    friend FourFloats larger(const FourFloats& a, const FourFloats& b) {
        return each(a, b, [](float x, float y) { return std::max(x, y); });
    }
    friend unsigned greater(const FourFloats& a, const FourFloats& b) {
        unsigned bits = 0;
        for (std::size_t i = 0; i < 4; ++i) bits |= (a.v_[i] > b.v_[i] ? 1U : 0U) << i;
        return bits;
    }
    [[nodiscard]] const std::array<float, 4>& numbers() const { return v_; }
    [[nodiscard]] std::array<std::int32_t, 4> truncated() const {
        std::array<std::int32_t, 4> out;
        for (std::size_t i = 0; i < 4; ++i) out[i] = static_cast<std::int32_t>(v_[i]);
        return out;
    }

private:
    template <class Operation>
    static FourFloats each(const FourFloats& a, const FourFloats& b, const Operation& operation) {
        std::array<float, 4> out;
        for (std::size_t i = 0; i < 4; ++i) out[i] = operation(a.v_[i], b.v_[i]);
        return FourFloats(out);
    }
    std::array<float, 4> v_;
#endif
};

}  // namespace trisect::detail

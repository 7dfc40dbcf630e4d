// SPDX-License-Identifier: Apache-2.0
//
// IndexLeaf: a cell of an index that polygons enter, and the planes of these in single precision.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace trisect::detail {

/// Lists the polygons that meet a cell. A cell of a grid also has their planes, see LeafPlanes, and
/// knows its corners.
struct IndexLeaf {
    std::uint32_t first = 0;  ///< of the tree's list
    std::uint32_t count = 0;
    std::uint32_t planes = 0xffffffffU;  ///< of the tree's array of floats, if any
    std::int32_t winding = 0;            ///< at the reference
    /// The corners of the cell whose membership is known, and those of them that are inside; bit
    /// x + 2 y + 4 z. None without planes.
    std::uint8_t known = 0;
    std::uint8_t inside = 0;
    /// Where points are that lie strictly above, or strictly below, all the planes: 0 outside,
    /// 1 inside, otherwise not known.
    std::uint8_t above = unknown;
    std::uint8_t below = unknown;

    mutable std::uint64_t outside_above = 0;  ///< see LeafSheets; 0 while not known
    mutable std::uint64_t inside_below = 0;
    /// Regions that were traced, see `remembered`; 0 for none.
    mutable std::array<std::uint64_t, 2> regions{};

    static constexpr std::uint8_t unknown = 2;
    [[nodiscard]] bool has_planes() const { return planes != 0xffffffffU; }
};

/// The planes of a leaf's polygons in the coordinates of its cell, which run from 0 to 1: a x + b y
/// + c z + d with coefficients of at most 1 up to d, upwards is outwards. All a, then all
/// b and so on; `stride` of each, at least four.
///
/// A plane meets the cell or comes near it, so |d| < 4; a, b, c and d are within 2^-21 of those of
/// the real plane divided by its largest coefficient, or all of them are 0. Rounding of coordinates
/// between -1/4 and 5/4 and of the sum adds less than 2^-19. So a sign is sure when the value is
/// above `unsure`.
struct LeafPlanes {
    static constexpr float unsure = 0x1p-17F;
    static constexpr std::uint32_t stride_of(std::uint32_t count) { return count < 4 ? 4 : count; }

    const float* first = nullptr;
    std::uint32_t stride = 4;

    [[nodiscard]] float at(std::uint32_t i, const std::array<float, 3>& p) const {
        const float* f = first + i;
        return f[0] * p[0] + f[stride] * p[1] + f[2 * stride] * p[2] + f[3 * stride];
    }
};

/// Four floats or integers at once.
using Float4 = float __attribute__((vector_size(16)));
using Int4 = std::int32_t __attribute__((vector_size(16)));

[[nodiscard]] inline Float4 load4(const float* p) {
    Float4 v;
    std::memcpy(&v, p, sizeof v);
    return v;
}
/// On which planes' sure sides a point is, a bit each.
struct PlaneSides {
    std::uint64_t above = 0;
    std::uint64_t below = 0;
};

[[nodiscard]] inline std::uint64_t signs4(Int4 v) {
#if defined(__SSE2__)
    return static_cast<std::uint64_t>(_mm_movemask_ps(reinterpret_cast<__m128>(v)));
#else
    return static_cast<std::uint64_t>((v[0] & 1) | (v[1] & 2) | (v[2] & 4) | (v[3] & 8));
#endif
}

/// \pre 0 < count <= 64.
[[nodiscard]] inline PlaneSides sides_of(const LeafPlanes& planes, std::uint32_t count,
                                         const std::array<float, 3>& p) {
    const Float4 x = {p[0], p[0], p[0], p[0]};
    const Float4 y = {p[1], p[1], p[1], p[1]};
    const Float4 z = {p[2], p[2], p[2], p[2]};
    constexpr float e = LeafPlanes::unsure;
    const Float4 up = {e, e, e, e};
    const Float4 down = -up;
    PlaneSides out;
    const std::uint32_t s = planes.stride;
    // The last four overlap those before; fewer than four are repeated.
    for (std::uint32_t i = 0;; i += 4) {
        if (i + 4 > s) i = s - 4;
        const float* f = planes.first + i;
        const Float4 v =
            load4(f) * x + load4(f + s) * y + (load4(f + 2 * s) * z + load4(f + 3 * s));
        out.above |= signs4(v > up) << i;
        out.below |= signs4(v < down) << i;
        if (i + 4 >= s) break;
    }
    const std::uint64_t all = ~std::uint64_t{0} >> (64 - count);
    return {out.above & all, out.below & all};
}

}  // namespace trisect::detail

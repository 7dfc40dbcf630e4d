// SPDX-License-Identifier: Apache-2.0
//
// IndexLeaf: a mixed cell of an index, with planes and corners.
// Those of the polygons that enter it are in single precision.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include <trisect/kernel/support/float4.h>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace trisect::detail {

/// Lists the polygons that meet a cell. A cell of a grid also has their planes, see LeafPlanes, has
/// its corners, and mostly has the corners of triangles, see LeafCorners.
struct IndexLeaf {
    std::uint32_t first = 0;  ///< of the tree's list
    std::uint32_t count = 0;
    std::uint32_t planes = 0xffffffffU;  ///< of the tree's array of floats, if any
    std::int32_t winding = 0;            ///< at the reference
    float step = 0;                      ///< of LeafCorners; 0 when there are none
    /// The corners of the cell whose membership is known, and those of them that are inside; bit
    /// x + 2 y + 4 z. None without planes.
    std::uint8_t known = 0;
    std::uint8_t inside = 0;
    /// Where points are that lie strictly above, or strictly below, all the planes: 0 outside,
    /// 1 inside, otherwise not known.
    std::uint8_t above = unknown;
    std::uint8_t below = unknown;
    /// Of a leaf without corners, see `remember`; 0 for none.
    mutable std::array<std::uint64_t, 2> regions{};

    static constexpr std::uint8_t unknown = 2;
    [[nodiscard]] bool has_planes() const { return planes != 0xffffffffU; }
    [[nodiscard]] bool has_corners() const { return step != 0; }
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
    /// Sides of so many are known at once, a bit each.
    static constexpr std::uint32_t most = 64;
    static constexpr std::uint32_t stride_of(std::uint32_t count) { return count < 4 ? 4 : count; }

    const float* first = nullptr;
    std::uint32_t stride = 4;

    [[nodiscard]] float at(std::uint32_t i, const std::array<float, 3>& p) const {
        const float* f = first + i;
        return f[0] * p[0] + f[stride] * p[1] + f[2 * stride] * p[2] + f[3 * stride];
    }
};

/// The corners of a leaf's triangles, rounded to 16 bits: in steps from the middle of the cell.
/// Nine numbers a polygon, the three x first; for what is no triangle, or a far too large one, all
/// of them are 0. They follow the planes.
///
/// They decide how a line runs past a triangle: with `d` its direction and a, b, c the corners seen
/// from a point of it, the signs of d · (a × b), d · (b × c), d · (c × a). In steps components of
/// a, b, c are below D = 2^16. They err by 0.53: 1/2 for the corner, the rest for the point, which
/// is known within 2^-23 of the cell (2^-7.6 steps) and rounded thrice. With components of d below
/// E that err by 1/25, a determinant errs by (6.4 E + D/4) D from these and by 30 · 2^-24 E D^2 =
/// 0.12 E D for rounding of its terms; all that is below 7 E D + 2^30.
struct LeafCorners {
    static constexpr std::int32_t most_steps = 32000;
    /// Triangles that reach farther from the cell's middle, in cells, are left out.
    static constexpr double farthest = 64;
    static constexpr std::uint32_t each = 9;
    /// How many floats they take: of the last triangle one number more is read.
    static constexpr std::uint32_t floats(std::uint32_t count) { return (each * count + 2) / 2; }
    [[nodiscard]] static float bound(float e) { return 0x1p19F * e + 0x1p30F; }
};

/// Whether a line passes by a triangle, goes through it, or undecided.
enum class LineSide : std::int8_t { Beside, Through, Unsure };

/// A line through a point of a leaf's cell, in steps from its middle.
class LeafLine {
public:
    using Vector = std::array<float, 3>;

    /// `place`: in the cell, from -1/4 to 5/4.
    LeafLine(float step, const Vector& place) : per_cell_(1 / step) {
        for (std::size_t k = 0; k < 3; ++k) p_[k] = steps(place[k]);
    }
    /// Towards a corner of the cell.
    void aim_at_corner(unsigned corner) {
        Vector d{};
        for (std::size_t k = 0; k < 3; ++k)
            d[k] = steps((corner >> k & 1U) != 0 ? 1.F : 0.F) - p_[k];
        set(d);
    }
    /// Along the normal of a plane whose largest coefficient is 1.
    void aim_along(const LeafPlanes& planes, std::uint32_t i) {
        constexpr float length = 0x1p14F;  // so that 2^-21 of it is little
        const float* f = planes.first + i;
        set({f[0] * length, f[planes.stride] * length, f[2 * planes.stride] * length});
    }
    /// A triangle of a leaf that has corners.
    [[nodiscard]] LineSide at(const float* corners, std::uint32_t triangle) const {
        const unsigned char* t = reinterpret_cast<const unsigned char*>(corners) +
                                 std::size_t{2} * LeafCorners::each * triangle;
        return at(numbers(t), numbers(t + 6), numbers(t + 12));
    }
    /// The first three lanes are the corners, each within 1/2 of where it is.
    [[nodiscard]] LineSide at(Float4 x, Float4 y, Float4 z) const {
        x -= all_lanes(p_[0]);
        y -= all_lanes(p_[1]);
        z -= all_lanes(p_[2]);
        // Lane i: corner i, and the one after it.
        const Float4 u = next(x);
        const Float4 v = next(y);
        const Float4 w = next(z);
        const Float4 e = all_lanes(d_[0]) * (y * w - z * v) + all_lanes(d_[1]) * (z * u - x * w) +
                         all_lanes(d_[2]) * (x * v - y * u);
        const unsigned left = bits_of(e > all_lanes(bound_)) & 7U;
        const unsigned right = bits_of(e < all_lanes(-bound_)) & 7U;
        if (left != 0 && right != 0) return LineSide::Beside;
        return left == 7 || right == 7 ? LineSide::Through : LineSide::Unsure;
    }

private:
    [[nodiscard]] float steps(float place) const { return (place - 0.5F) * per_cell_; }
    void set(const Vector& d) {
        d_ = d;
        float e = 0;
        for (const float v : d) e = v > e ? v : (-v > e ? -v : e);
        bound_ = LeafCorners::bound(e);
    }
    // Three numbers of 16 bits, and one that does not matter.
    [[nodiscard]] static Float4 numbers(const unsigned char* p) {
#if defined(__SSE2__)
        const __m128i v = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(p));
        return _mm_cvtepi32_ps(_mm_srai_epi32(_mm_unpacklo_epi16(v, v), 16));
#else
        std::array<std::int16_t, 4> v;
        std::memcpy(v.data(), p, sizeof v);
        return Float4{static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2]),
                      0};
#endif
    }
    [[nodiscard]] static Float4 next(Float4 v) {
#if defined(__SSE2__)
        return _mm_shuffle_ps(v, v, _MM_SHUFFLE(3, 0, 2, 1));
#else
        return Float4{v[1], v[2], v[0], v[3]};
#endif
    }

    float per_cell_;
    float bound_ = 0;
    Vector p_{};
    Vector d_{};
};

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

/// \pre 0 < count <= LeafPlanes::most.
[[nodiscard]] inline PlaneSides sides_of(const LeafPlanes& planes, std::uint32_t count,
                                         const std::array<float, 3>& p) {
    const Float4 x = all_lanes(p[0]);
    const Float4 y = all_lanes(p[1]);
    const Float4 z = all_lanes(p[2]);
    const Float4 up = all_lanes(LeafPlanes::unsure);
    const Float4 down = -up;
    PlaneSides out;
    const std::uint32_t s = planes.stride;
    // The last four overlap those before; fewer than four are repeated.
    for (std::uint32_t i = 0;; i += 4) {
        if (i + 4 > s) i = s - 4;
        const float* f = planes.first + i;
        const Float4 v =
            load4(f) * x + load4(f + s) * y + (load4(f + 2 * s) * z + load4(f + 3 * s));
        out.above |= std::uint64_t{bits_of(v > up)} << i;
        out.below |= std::uint64_t{bits_of(v < down)} << i;
        if (i + 4 >= s) break;
    }
    const std::uint64_t all = ~std::uint64_t{0} >> (64 - count);
    return {out.above & all, out.below & all};
}

/// Of each corner of a cell, how many planes have it surely on the side on which they surely have
/// a point; a few are counted twice. Not more than 64 + 3 planes.
[[nodiscard]] inline std::array<std::uint8_t, 8> planes_together(const LeafPlanes& planes,
                                                                 const std::array<float, 3>& p) {
    const Float4 x = all_lanes(p[0]);
    const Float4 y = all_lanes(p[1]);
    const Float4 z = all_lanes(p[2]);
    const Float4 up = all_lanes(LeafPlanes::unsure);
    const Float4 one = all_lanes(1);
    Mask4 low{};  // a byte for each corner
    Mask4 high{};
    const auto byte = [](Mask4 m, unsigned i) {
        const std::int32_t v = std::int32_t{1} << (8 * i);
        return m & Mask4{v, v, v, v};
    };
    const std::uint32_t s = planes.stride;
    for (std::uint32_t i = 0;; i += 4) {
        if (i + 4 > s) i = s - 4;
        const float* f = planes.first + i;
        const Float4 a = load4(f);
        const Float4 b = load4(f + s);
        const Float4 c = load4(f + 2 * s);
        const Float4 d = load4(f + 3 * s);
        const Float4 v = a * x + b * y + (c * z + d);
        const auto above = reinterpret_cast<Float4>((v > up) & reinterpret_cast<Mask4>(one));
        const auto below = reinterpret_cast<Float4>((v < -up) & reinterpret_cast<Mask4>(one));
        const Float4 side = above - below;
        const Float4 da = d + a;
        const Float4 dab = da + b;
        const Float4 db = d + b;
        low += byte(d * side > up, 0) + byte(da * side > up, 1) + byte(db * side > up, 2) +
               byte(dab * side > up, 3);
        high += byte((d + c) * side > up, 0) + byte((da + c) * side > up, 1) +
                byte((db + c) * side > up, 2) + byte((dab + c) * side > up, 3);
        if (i + 4 >= s) break;
    }
    const auto sum = [](Mask4 m) { return m[0] + m[1] + m[2] + m[3]; };
    const std::array<std::int32_t, 2> both{sum(low), sum(high)};
    std::array<std::uint8_t, 8> out{};
    for (unsigned c = 0; c < 8; ++c)
        out[c] = static_cast<std::uint8_t>(both[c / 4] >> (8 * (c % 4)) & 0xff);
    return out;
}

}  // namespace trisect::detail

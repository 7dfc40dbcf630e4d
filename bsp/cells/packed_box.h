// SPDX-License-Identifier: Apache-2.0
//
// PackedBox: a box of 16-bit numbers and its polygon, in sixteen bytes.
// The partition moves lists of them. Most of the time of a large evaluation goes into reading and
// writing these lists, so bytes count; the boxes lie beside the names because looking corners up
// misses caches.
//
// Rounding loses nothing that matters. All positions are rounded down to multiples of a power of
// two, and splitting planes are put between such multiples only: then a position is below the
// splitting plane exactly if its rounded value is. Boxes rounded outwards would not do: a mesh
// whose triangles end at a splitting plane would have them on both sides, nothing would ever
// separate, and refinement would not end.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

#include <trisect/bsp/cells/cell.h>

namespace trisect::detail {

/// Rounded positions are within ±packed_limit; what lies farther out is drawn in to that.
inline constexpr int packed_limit = 32000;

/// How positions are rounded: position c is floor((c - origin) / 2^shift).
struct Frame {
    std::array<std::int64_t, 3> origin{};
    int shift = 0;

    /// A frame in which all of a box lies within the limits, as fine as possible.
    [[nodiscard]] static Frame covering(const Box& box) {
        Frame f;
        std::int64_t extent = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            f.origin[k] = box.lo[k] + (box.hi[k] - box.lo[k]) / 2;
            extent = std::max(extent, box.hi[k] - box.lo[k]);
        }
        while ((extent >> f.shift) >= 2 * (packed_limit - 1)) ++f.shift;
        return f;
    }
    [[nodiscard]] std::int16_t at(std::size_t axis, std::int64_t c) const {
        const std::int64_t q = (c - origin[axis]) >> shift;
        return static_cast<std::int16_t>(std::clamp<std::int64_t>(q, -packed_limit, packed_limit));
    }
    [[nodiscard]] bool covers(std::size_t axis, std::int64_t c) const {
        const std::int64_t q = (c - origin[axis]) >> shift;
        return q > -packed_limit && q < packed_limit;
    }
    /// The splitting plane below rounded position q: the last lattice position below it.
    [[nodiscard]] std::int64_t last_below(std::size_t axis, int q) const {
        return origin[axis] + (static_cast<std::int64_t>(q) << shift) - 1;
    }
    /// The rounded position above a splitting plane; nothing when the splitting plane is not
    /// between two of them.
    [[nodiscard]] std::optional<int> first_above(std::size_t axis, std::int64_t last) const {
        const std::int64_t c = last + 1;
        if (!covers(axis, c) || last_below(axis, at(axis, c)) != last) return std::nullopt;
        return at(axis, c);
    }
};

/// A box in a frame. The upper ends are negated, so that a union is a minimum of all lanes and an
/// intersection test one comparison.
struct alignas(16) PackedBox {
    std::array<std::int16_t, 3> lo{packed_limit, packed_limit, packed_limit};
    std::array<std::int16_t, 3> minus_hi{packed_limit, packed_limit, packed_limit};
    std::uint32_t id = 0;  ///< of the polygon; its use is up to the list

    static PackedBox of(const Frame& frame, const Box& box, std::uint32_t id = 0) {
        PackedBox p;
        for (std::size_t k = 0; k < 3; ++k) {
            p.lo[k] = frame.at(k, box.lo[k]);
            p.minus_hi[k] = static_cast<std::int16_t>(-frame.at(k, box.hi[k]));
        }
        p.id = id;
        return p;
    }
    [[nodiscard]] int low(std::size_t axis) const { return lo[axis]; }
    [[nodiscard]] int high(std::size_t axis) const { return -minus_hi[axis]; }
    [[nodiscard]] bool is_empty() const {
        return low(0) > high(0) || low(1) > high(1) || low(2) > high(2);
    }
    [[nodiscard]] PackedBox intersected(const PackedBox& b) const {
        PackedBox r;
        for (std::size_t k = 0; k < 3; ++k) {
            r.lo[k] = std::max(lo[k], b.lo[k]);
            r.minus_hi[k] = std::max(minus_hi[k], b.minus_hi[k]);
        }
        return r;
    }
    void add(const PackedBox& b) {
        for (std::size_t k = 0; k < 3; ++k) {
            lo[k] = std::min(lo[k], b.lo[k]);
            minus_hi[k] = std::min(minus_hi[k], b.minus_hi[k]);
        }
    }
    [[nodiscard]] bool contains(const PackedBox& b) const {
        for (std::size_t k = 0; k < 3; ++k)
            if (b.lo[k] < lo[k] || b.minus_hi[k] < minus_hi[k]) return false;
        return true;
    }
};
static_assert(sizeof(PackedBox) == 16);

/// One load and one store; compilers copy the members one by one.
inline void copy(const PackedBox& from, PackedBox* to) {
#if defined(__SSE2__)
    _mm_store_si128(reinterpret_cast<__m128i*>(to),
                    _mm_load_si128(reinterpret_cast<const __m128i*>(&from)));
#else
    *to = from;
#endif
}

/// The reach of a box, prepared for many intersection tests.
class PackedReach {
public:
    explicit PackedReach(const PackedBox& box) {
        // lo <= box.high and -hi <= -box.low in all lanes; the lanes of the id always pass.
        std::array<std::int16_t, 8> l{};
        for (std::size_t k = 0; k < 3; ++k) {
            l[k] = static_cast<std::int16_t>(box.high(k));
            l[k + 3] = static_cast<std::int16_t>(-box.low(k));
        }
        l[6] = l[7] = 0x7fff;
#if defined(__SSE2__)
        limits_ = _mm_loadu_si128(reinterpret_cast<const __m128i*>(l.data()));
#else
        limits_ = l;
#endif
    }
    [[nodiscard]] bool meets(const PackedBox& box) const {
#if defined(__SSE2__)
        const __m128i lanes = _mm_load_si128(reinterpret_cast<const __m128i*>(&box));
        return _mm_movemask_epi8(_mm_cmpgt_epi16(lanes, limits_)) == 0;
#else
        bool out = false;
        for (std::size_t k = 0; k < 3; ++k)
            out = out || box.lo[k] > limits_[k] || box.minus_hi[k] > limits_[k + 3];
        return !out;
#endif
    }

private:
#if defined(__SSE2__)
    __m128i limits_;
#else
    std::array<std::int16_t, 8> limits_{};
#endif
};

/// A point in a frame, as the box that holds it alone. `Whole`: its coordinates are.
template <bool Whole = false>
[[nodiscard]] inline PackedBox packed_point(const Frame& frame, const LatticePoint& p) {
    PackedBox b;
    for (std::size_t k = 0; k < 3; ++k) {
        const Coordinate c = p[static_cast<int>(k)];
        b.lo[k] = frame.at(k, Whole ? c.to_integer() : position_of(c));
        b.minus_hi[k] = static_cast<std::int16_t>(-b.lo[k]);
    }
    return b;
}

/// The box of three boxes.
[[nodiscard]] inline PackedBox box_of_three(const PackedBox& a, const PackedBox& b,
                                            const PackedBox& c) {
    PackedBox r;
#if defined(__SSE2__)
    const auto lanes = [](const PackedBox& p) {
        return _mm_load_si128(reinterpret_cast<const __m128i*>(&p));
    };
    _mm_store_si128(reinterpret_cast<__m128i*>(&r),
                    _mm_min_epi16(_mm_min_epi16(lanes(a), lanes(b)), lanes(c)));
#else
    r.add(a);
    r.add(b);
    r.add(c);
#endif
    return r;
}

/// The box of a list.
[[nodiscard]] inline PackedBox box_of(const PackedBox* list, std::size_t count) {
    PackedBox all;
#if defined(__SSE2__)
    const auto* lanes = reinterpret_cast<const __m128i*>(list);
    __m128i least = _mm_load_si128(reinterpret_cast<const __m128i*>(&all));
    __m128i other = least;
    std::size_t i = 0;
    for (; i + 4 <= count; i += 4) {
        least = _mm_min_epi16(least, _mm_load_si128(lanes + i));
        other = _mm_min_epi16(other, _mm_load_si128(lanes + i + 1));
        least = _mm_min_epi16(least, _mm_load_si128(lanes + i + 2));
        other = _mm_min_epi16(other, _mm_load_si128(lanes + i + 3));
    }
    for (; i < count; ++i) least = _mm_min_epi16(least, _mm_load_si128(lanes + i));
    _mm_store_si128(reinterpret_cast<__m128i*>(&all), _mm_min_epi16(least, other));
#else
    for (std::size_t i = 0; i < count; ++i) all.add(list[i]);
#endif
    all.id = 0;
    return all;
}

}  // namespace trisect::detail

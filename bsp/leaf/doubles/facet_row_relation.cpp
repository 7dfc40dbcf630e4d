// SPDX-License-Identifier: Apache-2.0
//
// The tests of filtered_pairs.cpp on two triangles in doubles, of four pairs in single precision:
// the sides of the corners, and the order of the points where edges pierce the other support. Most
// of what boxes leave is parted by a plane, half of the rest is apart along the line that the
// supports have in common, and what crosses surely needs no more from doubles than the ends of the
// segment.
//
// Bounds, with u = 2^-24; see facet_rows.cpp for coordinates, which are at most 1 in magnitude, and
// values v of planes, which are off by less than b.
//
// The line's direction d is the product of the normals, of which no component is above 1. They are
// off by t and t' each: by rounding to single and before that, as doubles, by 2^-52 times the sum
// of the minors' permanents, which is the slope (filtered_facets.cpp); t has four times both. So d
// is off by less than 2.1 (t + t') + 6 u in each component; with t and t' at least 4 u that is
// below 3 (t + t'). Where the largest component of d is above three times that the angle between d
// and the true direction is acute, so the order of points of the line is that of their products
// with d, the computed one: it is one linear function for all points.
//
// Such a product s has three terms of at most 2, with coordinates and products rounded, and two
// sums: it is off by less than 24 u. Where an edge with the values v and -w at its ends pierces,
// λ = v / (v + w) is off by less than b / (true v + w), that is 4/3 b / (v + w) as v and w are
// above 4 b, and by 4 u for rounding. The product there is s + λ (s' - s) and so off by 4/3 b |s' -
// s| / (v + w), 48 u for rounding λ, 24 u for the products, and 30 u for its own operations, as s
// is at most 6; 2 b |s' - s| / (v + w) + 128 u is taken, which has room for what the comparison of
// two such numbers rounds.

#include <trisect/bsp/leaf/doubles/facet_rows.h>

#include <array>
#include <cstddef>
#include <cstdint>

#include <trisect/kernel/number/vector3.h>
#include <trisect/kernel/support/float4.h>
#include <trisect/kernel/support/wide_clones.h>

namespace trisect::detail {

namespace {

using Four = std::array<float, 4>;
using RowNumbers = const std::array<Four, 4>*;
using Vectors = std::array<Float4, 3>;

Float4 load(const Four& v) {
    Float4 out;
    __builtin_memcpy(&out, v.data(), sizeof out);
    return out;
}

// Rows become columns.
std::array<Float4, 4> transposed(const Four& a, const Four& b, const Four& c, const Four& d) {
    const Float4 p = load(a);
    const Float4 q = load(b);
    const Float4 r = load(c);
    const Float4 s = load(d);
    const Float4 low = __builtin_shufflevector(p, q, 0, 4, 1, 5);
    const Float4 high = __builtin_shufflevector(p, q, 2, 6, 3, 7);
    const Float4 other_low = __builtin_shufflevector(r, s, 0, 4, 1, 5);
    const Float4 other_high = __builtin_shufflevector(r, s, 2, 6, 3, 7);
    return {__builtin_shufflevector(low, other_low, 0, 1, 4, 5),
            __builtin_shufflevector(low, other_low, 2, 3, 6, 7),
            __builtin_shufflevector(high, other_high, 0, 1, 4, 5),
            __builtin_shufflevector(high, other_high, 2, 3, 6, 7)};
}

// Four facets side by side.
struct Facets {
    std::array<Vectors, 3> corners;
    Vectors normal;
    Float4 offset;
    Float4 bound;
    Float4 tilt;

    explicit Facets(const std::array<RowNumbers, 4>& numbers) {
        const auto columns = [&](std::size_t i) {
            return transposed((*numbers[0])[i], (*numbers[1])[i], (*numbers[2])[i],
                              (*numbers[3])[i]);
        };
        for (std::size_t c = 0; c < 3; ++c) {
            const std::array<Float4, 4> four = columns(c);
            corners[c] = {four[0], four[1], four[2]};
            normal[c] = four[3];
        }
        const std::array<Float4, 4> four = columns(3);
        offset = four[0];
        bound = four[1];
        tilt = four[2];
    }
};

Float4 only(Mask4 lanes, Float4 v) {
    return reinterpret_cast<Float4>(reinterpret_cast<Mask4>(v) & lanes);
}

// Values of the planes of `other` at the corners.
struct Values {
    Vectors at;
    std::array<Mask4, 3> above;
    std::array<Mask4, 3> below;

    Values(const Facets& facets, const Facets& other) {
        const Float4 bound = all_lanes(4) * other.bound;
        for (std::size_t c = 0; c < 3; ++c) {
            const Vectors& p = facets.corners[c];
            at[c] = (other.normal[0] * p[0] + other.normal[1] * p[1]) +
                    (other.normal[2] * p[2] - other.offset);
            above[c] = at[c] > bound;
            below[c] = at[c] < -bound;
        }
    }
    [[nodiscard]] Mask4 are_off() const {
        return (above[0] & above[1] & above[2]) | (below[0] & below[1] & below[2]);
    }
    [[nodiscard]] Mask4 are_sure() const {
        return (above[0] | below[0]) & (above[1] | below[1]) & (above[2] | below[2]);
    }
};

// Where triangles enter the other support and leave it on the way around their outlines: products
// with the line's direction, and what they are off by.
struct LineIntervals {
    Float4 up{};
    Float4 up_error{};
    Float4 down{};
    Float4 down_error{};

    LineIntervals(const Facets& facets, const Values& values, Float4 bound,
                  const Vectors& direction) {
        const Vectors along{dot(facets.corners[0], direction), dot(facets.corners[1], direction),
                            dot(facets.corners[2], direction)};
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t j = i == 2 ? 0 : i + 1;
            // Each lane has one edge of either kind if its values are sure; elsewhere this may be
            // a division by zero.
            const Mask4 upwards = values.below[i] & values.above[j];
            const Mask4 downwards = values.above[i] & values.below[j];
            const Float4 slope =
                (along[j] - along[i]) * (all_lanes(1) / (values.at[i] - values.at[j]));
            const Float4 at = along[i] + values.at[i] * slope;
            const Float4 steepness = magnitude(slope);
            up = up + only(upwards, at);
            up_error = up_error + only(upwards, steepness);
            down = down + only(downwards, at);
            down_error = down_error + only(downwards, steepness);
        }
        const Float4 twice = bound + bound;
        up_error = up_error * twice + all_lanes(0x1p-17F);
        down_error = down_error * twice + all_lanes(0x1p-17F);
    }
};

std::array<unsigned, 3> bits_of_each(const std::array<Mask4, 3>& masks) {
    return {bits_of(masks[0]), bits_of(masks[1]), bits_of(masks[2])};
}

TRISECT_WIDE_CLONES void relate_four(const std::array<RowNumbers, 4>& first,
                                     const std::array<RowNumbers, 4>& second,
                                     FacetRows::Relation& out) {
    const Facets a(first);
    const Facets b(second);
    const Values of_a(a, b);
    const Values of_b(b, a);
    const Vectors& n = a.normal;
    const Vectors& m = b.normal;
    const Vectors direction{n[1] * m[2] - n[2] * m[1], n[2] * m[0] - n[0] * m[2],
                            n[0] * m[1] - n[1] * m[0]};
    const Float4 longest =
        larger(larger(magnitude(direction[0]), magnitude(direction[1])), magnitude(direction[2]));
    const Mask4 off = of_a.are_off() | of_b.are_off();
    const Mask4 sure =
        of_a.are_sure() & of_b.are_sure() & ~off & (longest > all_lanes(10) * (a.tilt + b.tilt));
    // In that direction the first one begins where it goes up through the other support, the second
    // one where it goes down.
    const LineIntervals s(a, of_a, b.bound, direction);
    const LineIntervals t(b, of_b, a.bound, direction);
    const Float4 starts_error = s.up_error + t.down_error;
    const Float4 ends_error = s.down_error + t.up_error;
    const Float4 before_error = s.down_error + t.down_error;
    const Float4 behind_error = s.up_error + t.up_error;
    const Float4 later_start = t.down - s.up;
    const Float4 earlier_end = s.down - t.up;
    const Mask4 starts = later_start > starts_error;
    const Mask4 ends = earlier_end > ends_error;
    const Mask4 ordered = (starts | (later_start < -starts_error)) &
                          (ends | (earlier_end < -ends_error)) & (s.down - t.down > before_error) &
                          (t.up - s.up > behind_error);
    const Mask4 apart = (t.down - s.down > before_error) | (s.up - t.up > behind_error);
    out.apart = bits_of(off | (sure & apart));
    out.crosses = bits_of(sure & ordered);
    out.above = {bits_of_each(of_a.above), bits_of_each(of_b.above)};
    out.starts = bits_of(starts);
    out.ends = bits_of(ends);
}

}  // namespace

FacetRows::Relation FacetRows::relate(const std::array<Pair, 4>& pairs) const {
    std::array<RowNumbers, 4> first;
    std::array<RowNumbers, 4> second;
    for (std::size_t i = 0; i < 4; ++i) {
        first[i] = &singles_[pairs[i][0]].numbers;
        second[i] = &singles_[pairs[i][1]].numbers;
    }
    Relation out;
    relate_four(first, second, out);
    return out;
}

}  // namespace trisect::detail

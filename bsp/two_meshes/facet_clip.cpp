// SPDX-License-Identifier: Apache-2.0
//
// A triangle is cut by the six sides of the box in single precision, in units of the frame, which
// go up to 2^15. Differences of coordinates from the origin are rounded to 2^-10 there, and so is
// every corner that is made, a few times: less than 2^-6. A splitting plane lies less than one
// lattice unit beside the side of the box that stands for it, and a point between two lattice
// positions belongs to either. The margin is a lattice unit and a 16th.

#include <trisect/bsp/two_meshes/facet_clip.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include <trisect/kernel/support/four_floats.h>

namespace trisect::detail {

namespace {

// Three coordinates, and a fourth number so that four are computed at once.
using ClippedCorner = std::array<float, 4>;

// A convex polygon: a triangle that at most six planes have cut, each of which adds one corner, but
// for roundings.
struct ClippedTriangle {
    static constexpr std::size_t most_corners = 16;
    using Corners = std::array<ClippedCorner, most_corners>;

    alignas(16) std::array<Corners, 2> both;  // those before the last cut are the other ones
    ClippedCorner* corners = both[0].data();
    std::size_t size = 0;
    bool is_known = true;  // there was room for all corners

    [[nodiscard]] FourFloats at(std::size_t i) const { return FourFloats(corners[i]); }
    [[nodiscard]] FourFloats low() const {
        FourFloats low = at(0);
        for (std::size_t i = 1; i < size; ++i) low = smaller(low, at(i));
        return low;
    }
    [[nodiscard]] FourFloats high() const {
        FourFloats high = at(0);
        for (std::size_t i = 1; i < size; ++i) high = larger(high, at(i));
        return high;
    }
    // Leaves what has sign · coordinate <= sign · limit.
    void cut(std::size_t axis, float limit, float sign) {
        const std::span<const ClippedCorner> in(corners, size);
        corners = both[corners == both[0].data() ? 1 : 0].data();
        size = 0;
        const ClippedCorner* a = &in.back();
        float at_a = sign * ((*a)[axis] - limit);
        for (const ClippedCorner& b : in) {
            const float at_b = sign * (b[axis] - limit);
            is_known = is_known && size + 2 <= most_corners;
            if (!is_known) return;
            if ((at_a <= 0) != (at_b <= 0)) {
                const FourFloats from(*a);
                const FourFloats t(at_a / (at_a - at_b));
                ClippedCorner& c = corners[size++];
                c = (from + t * (FourFloats(b) - from)).numbers();
                c[axis] = limit;
            }
            if (at_b <= 0) corners[size++] = b;
            a = &b;
            at_a = at_b;
        }
    }
    // Leaves what lies between the limits, if anything reaches beyond them.
    void cut_between(std::size_t axis, float low, float high) {
        const auto reaches = [&](float limit, float sign) {
            for (std::size_t i = 0; i < size; ++i)
                if (sign * corners[i][axis] > sign * limit) return true;
            return false;
        };
        if (reaches(low, -1)) cut(axis, low, -1);
        if (reaches(high, 1)) cut(axis, high, 1);
    }
};

}  // namespace

FacetClip::FacetClip(const Frame& frame, const LatticeMesh& mesh)
    : mesh_(mesh),
      scale_(std::ldexp(1.0, -frame.shift)),
      margin_(std::ldexp(1.0F, -frame.shift) + 0x1p-4F) {
    for (std::size_t k = 0; k < 3; ++k) origin_[k] = static_cast<double>(frame.origin[k]);
}

PackedBox FacetClip::clipped(std::uint32_t facet, const PackedBox& within) const {
    ClippedTriangle part;
    for (const std::uint32_t v : mesh_.triangles[facet]) {
        const LatticePoint& p = mesh_.points[v];
        for (std::size_t k = 0; k < 3; ++k)
            part.corners[part.size][k] =
                static_cast<float>((p[static_cast<int>(k)].to_double() - origin_[k]) * scale_);
        part.corners[part.size++][3] = 0;
    }
    PackedBox out = within;
    out.id = facet;
    for (std::size_t k = 0; k < 3; ++k) {
        part.cut_between(k, static_cast<float>(within.low(k)) - margin_,
                         static_cast<float>(within.high(k) + 1) + margin_);
        if (!part.is_known) return out;
        if (part.size == 0) return PackedBox{};
    }
    const FourFloats margin(margin_);
    const ClippedCorner low = (part.low() - margin).numbers();
    const ClippedCorner high = (part.high() + margin).numbers();
    for (std::size_t k = 0; k < 3; ++k) {
        const auto below = static_cast<std::int16_t>(std::floor(low[k]));
        const auto above = static_cast<std::int16_t>(-std::floor(high[k]));
        out.lo[k] = std::max(out.lo[k], below);
        out.minus_hi[k] = std::max(out.minus_hi[k], above);
    }
    return out;
}

}  // namespace trisect::detail

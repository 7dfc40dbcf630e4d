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

    [[nodiscard]] ClippedCorner low() const {
        ClippedCorner low = corners[0];
        for (std::size_t i = 1; i < size; ++i)
            for (std::size_t k = 0; k < 4; ++k) low[k] = std::min(low[k], corners[i][k]);
        return low;
    }
    [[nodiscard]] ClippedCorner high() const {
        ClippedCorner high = corners[0];
        for (std::size_t i = 1; i < size; ++i)
            for (std::size_t k = 0; k < 4; ++k) high[k] = std::max(high[k], corners[i][k]);
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
                const float t = at_a / (at_a - at_b);
                ClippedCorner& c = corners[size++];
                for (std::size_t k = 0; k < 4; ++k) c[k] = (*a)[k] + t * (b[k] - (*a)[k]);
                c[axis] = limit;
            }
            if (at_b <= 0) corners[size++] = b;
            a = &b;
            at_a = at_b;
        }
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
        const float low = static_cast<float>(within.low(k)) - margin_;
        const float high = static_cast<float>(within.high(k) + 1) + margin_;
        if (part.low()[k] < low) part.cut(k, low, -1);
        if (part.size != 0 && part.high()[k] > high) part.cut(k, high, 1);
        if (!part.is_known) return out;
        if (part.size == 0) return PackedBox{};
    }
    const ClippedCorner low = part.low();
    const ClippedCorner high = part.high();
    for (std::size_t k = 0; k < 3; ++k) {
        const auto below = static_cast<std::int16_t>(std::floor(low[k] - margin_));
        const auto above = static_cast<std::int16_t>(-std::floor(high[k] + margin_));
        out.lo[k] = std::max(out.lo[k], below);
        out.minus_hi[k] = std::max(out.minus_hi[k], above);
    }
    return out;
}

}  // namespace trisect::detail

// SPDX-License-Identifier: Apache-2.0
//
// A line from the point leaves the mesh's box at the nearest end of an axis, nearly along it, so
// that it passes by most facets. Whether it goes through one is exact, in special position as well.

#include <trisect/bsp/two_meshes/point_side.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <random>

#include <trisect/bsp/cells/shift/shifted_pairs.h>

namespace trisect::detail {

namespace {

// Those outside are not on a face of the box.
LatticePoint beside(const Box& box, const LatticePoint& point, std::size_t axis, bool high,
                    std::minstd_rand& random) {
    std::array<std::int64_t, 3> out{};
    for (std::size_t k = 0; k < 3; ++k) {
        const std::int64_t at = position_of(point[static_cast<int>(k)]);
        const std::int64_t width = (box.hi[k] - box.lo[k]) / 64 + 8;
        const auto draw = static_cast<std::int64_t>(random() & 0x7fffffffU);
        out[k] = at + static_cast<std::int64_t>(static_cast<double>(width) *
                                                (static_cast<double>(draw) * 0x1p-30 - 1));
        if (k == axis) out[k] = high ? std::max(box.hi[k], at) + 2 : std::min(box.lo[k], at) - 2;
        out[k] = std::clamp(out[k], -coordinate_limit + 1, coordinate_limit - 1);
    }
    return {out[0], out[1], out[2]};
}

bool is_outside(const Box& box, const LatticePoint& p, std::size_t axis) {
    const std::int64_t at = position_of(p[static_cast<int>(axis)]);
    return at > box.hi[axis] + 1 || at < box.lo[axis] - 1;
}

}  // namespace

PointSide::PointSide(const LatticeMesh& mesh, bool is_second, const InfinitesimalShift& shift,
                     bool outer_below)
    : mesh_(mesh), shift_(shift), is_second_(is_second), outer_below_(outer_below) {
    for (const LatticePoint& p : mesh.points) box_.add(p);
}

std::optional<bool> PointSide::is_below(const LatticePoint& point) const {
    std::minstd_rand random(1);
    constexpr std::size_t tries = 12;
    for (std::size_t i = 0; i < tries; ++i) {
        const std::size_t axis = i % 3;
        const std::int64_t at = position_of(point[static_cast<int>(axis)]);
        const bool high = (box_.hi[axis] - at < at - box_.lo[axis]) == (i < tries / 2);
        const LatticePoint to = beside(box_, point, axis, high, random);
        if (!is_outside(box_, to, axis)) continue;
        const std::optional<int> up = passages(point, to);
        if (!up) continue;
        if (*up == 0) return outer_below_;
        if (*up == (outer_below_ ? -1 : 1)) return !outer_below_;
        return std::nullopt;
    }
    return std::nullopt;
}

// Upwards, less those downwards.
std::optional<int> PointSide::passages(const LatticePoint& from, const LatticePoint& to) const {
    std::array<double, 3> low{};
    std::array<double, 3> high{};
    for (std::size_t k = 0; k < 3; ++k) {
        const double a = from[static_cast<int>(k)].to_double();
        const double b = to[static_cast<int>(k)].to_double();
        low[k] = std::min(a, b);
        high[k] = std::max(a, b);
    }
    int up = 0;
    for (const auto& t : mesh_.triangles) {
        const FacetCorners facet{&mesh_.points[t[0]], &mesh_.points[t[1]], &mesh_.points[t[2]]};
        bool meets = true;
        for (int k = 0; k < 3 && meets; ++k) {
            const double a = (*facet[0])[k].to_double();
            const double b = (*facet[1])[k].to_double();
            const double c = (*facet[2])[k].to_double();
            const auto i = static_cast<std::size_t>(k);
            meets = std::min({a, b, c}) <= high[i] && std::max({a, b, c}) >= low[i];
        }
        if (!meets) continue;
        const std::optional<int> passage = passage_shifted(from, to, is_second_, facet, shift_);
        if (!passage) return std::nullopt;
        up += *passage;
    }
    return up;
}

}  // namespace trisect::detail

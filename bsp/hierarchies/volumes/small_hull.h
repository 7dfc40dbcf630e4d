// SPDX-License-Identifier: Apache-2.0
//
// SmallHull: the convex hull of a few points, enlarged by a radius.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include <trisect/bsp/hierarchies/pairs/tree_frame.h>
#include <trisect/bsp/interference/boxes/obb_fit.h>

namespace trisect::hierarchies {

/// conv(points) + ball(radius), in units of a TreeFrame. Whatever it was made from is inside,
/// exactly. In floats, coordinate by coordinate, so that an extreme point is found four at a time.
struct SmallHull {
    static constexpr std::size_t most = 24;

    std::array<std::array<float, most>, 3> x;  ///< places past `count` are copies of the first
    std::uint32_t count = 0;
    float radius = 0;
    float largest = 0;  ///< magnitude of a coordinate

    /// Around points that are known within `error` in each coordinate, |x_k| <= 2. Few points are
    /// corners themselves; of many, extreme ones are, and the radius says how far the others stand
    /// out. O(points). \pre not empty
    [[nodiscard]] static SmallHull around(std::span<const detail::Vector3> points, double error);
    /// Around the image under the map.
    [[nodiscard]] SmallHull moved(const FrameMap& map) const;

    [[nodiscard]] detail::Vector3 point(std::size_t i) const {
        return {static_cast<double>(x[0][i]), static_cast<double>(x[1][i]),
                static_cast<double>(x[2][i])};
    }
    /// The sum of the extents of the points.
    [[nodiscard]] float size() const { return size_; }

private:
    friend class SmallHullBuilder;
    void finish(double radius);
    float size_ = 0;
};

/// How far to go for a lower bound of a distance.
enum class GapEffort : std::uint8_t {
    Sign,  ///< until it is positive
    Value  ///< until it is within a sixteenth of what can be had
};

/// A lower bound of the distance of two hulls; 0 where they meet, or are so near that floats cannot
/// decide. `direction` is where the search begins, from a to b, and becomes the direction of the
/// bound; 0 where nothing is known. Some ten nanoseconds if the direction still separates them, up
/// to a microsecond where they meet.
///
/// Gilbert, Johnson and Keerthi's iteration (1988) proposes directions; every one of them gives a
/// bound by the extreme points of both, rounded down, so the iteration itself need not be right.
[[nodiscard]] double gap_of(const SmallHull& a, const SmallHull& b, GapEffort effort,
                            detail::Vector3& direction);

}  // namespace trisect::hierarchies

// SPDX-License-Identifier: Apache-2.0
//
// Part: a piece of a solid, for the checkers of certificates.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include <trisect/bsp/interference/certificate/certified_boundary.h>
#include <trisect/bsp/interference/certificate/certified_points.h>

namespace trisect::detail::certified {

/// A closed surface of triangles, taken with signs: it may cover itself, what counts is how often
/// it winds around points. All that it winds around is in the convex hull of its corners, and no
/// corner is there without need: where it winds around nothing there are none.
class Part {
public:
    Part() = default;
    /// The whole solid. \pre the triangles fill its faces
    Part(const Boundary& boundary, const std::vector<CertifiedTriangle>& triangles);

    [[nodiscard]] const std::vector<IntegerPoint>& points() const { return points_; }
    [[nodiscard]] const std::vector<std::array<std::uint32_t, 3>>& triangles() const {
        return triangles_;
    }
    /// What is below a plane, and above it: together they wind around points as often as this does,
    /// and none of their corners is on the wrong side. The plane has a normal.
    [[nodiscard]] std::pair<Part, Part> divided(const IntegerPlane& plane) const;

private:
    class Divider;
    void simplify();
    std::vector<IntegerPoint> points_;
    std::vector<std::array<std::uint32_t, 3>> triangles_;
};

}  // namespace trisect::detail::certified

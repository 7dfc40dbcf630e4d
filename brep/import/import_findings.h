// SPDX-License-Identifier: Apache-2.0
//
// Findings about a face, worded once for both importers.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include <trisect/brep/validate/defect.h>

namespace trisect::detail {

/// Adds a defect for each of `faces`; `place_of(f)` is called for those that are listed.
template <class PlaceOf>
void add_face_defects(ValidationReport& report, DefectKind kind,
                      std::span<const std::uint32_t> faces, const char* what, PlaceOf&& place_of) {
    for (const std::uint32_t f : faces)
        report.add(kind, [&] {
            const Point3d place = place_of(f);
            return Defect{kind,
                          {},
                          {f},
                          place,
                          "face " + std::to_string(f) + " at " + place_text(place) + ": " + what};
        });
}

inline constexpr const char* degenerate_face_text = "all corners lie on one line; left out";

/// Newell's normal of a loop of double points, relative to its first corner.
template <class PointOf>
std::array<double, 3> newell_normal(std::span<const std::uint32_t> loop, const PointOf& point_of) {
    std::array<double, 3> n{};
    const Point3d origin = point_of(loop[0]);
    const auto relative = [&](std::uint32_t c) {
        const Point3d p = point_of(c);
        return Point3d{p[0] - origin[0], p[1] - origin[1], p[2] - origin[2]};
    };
    Point3d a = relative(loop[1]);
    for (std::size_t i = 2; i < loop.size(); ++i) {
        const Point3d b = relative(loop[i]);
        n[0] += a[1] * b[2] - a[2] * b[1];
        n[1] += a[2] * b[0] - a[0] * b[2];
        n[2] += a[0] * b[1] - a[1] * b[0];
        a = b;
    }
    return n;
}

/// Whether rounding turned a face over or made it flat: `before` and `after` give the points of its
/// corners in units of their own. The doubles' normals decide, so a sliver whose own orientation
/// doubles cannot decide may be missed; nothing depends on it.
template <class Before, class After>
bool is_flipped(std::span<const std::uint32_t> loop, const Before& before, const After& after) {
    if (loop.size() < 3) return false;
    const auto was = newell_normal(loop, before);
    const auto is = newell_normal(loop, after);
    const double dot = was[0] * is[0] + was[1] * is[1] + was[2] * is[2];
    const bool had_area = was[0] != 0 || was[1] != 0 || was[2] != 0;
    return had_area && dot <= 0;
}

}  // namespace trisect::detail

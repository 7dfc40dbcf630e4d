// SPDX-License-Identifier: Apache-2.0
//
// Arcs of tool paths, and their chords.
#pragma once

#include <trisect/kernel/point3d.h>

#include <vector>

namespace trisect::app {

/// A circular arc in a plane of two axes; a helix where the third coordinate changes.
struct Arc {
    Point3d from{};
    Point3d to{};
    Point3d center{};  ///< its coordinate along the third axis does not count
    int plane = 0;     ///< 0: x and y, 1: z and x, 2: y and z
    bool is_clockwise = false;
};

/// The ends of chords whose middle is no farther than `deviation` from the arc; the last one is
/// the arc's end as it is. An arc that ends where it begins is a full circle.
/// \throw UsageError when the ends have different distances from the centre (by more than a
/// thousandth of them and 0.002), or none; for more than a million chords
[[nodiscard]] std::vector<Point3d> chords_of(const Arc& arc, double deviation);

/// The centre of an arc of that radius; a negative one means the longer arc.
/// \throw UsageError when there is none
[[nodiscard]] Point3d center_by_radius(const Arc& arc, double radius);

}  // namespace trisect::app

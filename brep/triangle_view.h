// SPDX-License-Identifier: Apache-2.0
//
// TriangleView: a mesh of triangles in memory of a caller.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include <trisect/kernel/point3d.h>

namespace trisect {

/// Points and triangles that others own, such as arrays of another language; they must not change
/// while a call works on them. Promises nothing, like PolygonMesh. Value type of two pointers.
struct TriangleView {
    std::span<const Point3d> points;
    std::span<const std::array<std::uint32_t, 3>> triangles;
};

}  // namespace trisect

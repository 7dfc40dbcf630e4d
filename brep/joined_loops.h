// SPDX-License-Identifier: Apache-2.0
//
// Loops of a planar face as one polygon with bridges, and back.
// Meshes have faces of one loop. A face with holes becomes one by bridges: segments inside the face
// that the polygon runs along twice, once each way. They bound nothing, so the face is the same
// set.
#pragma once

#include <trisect/brep/planar_loops.h>
#include <trisect/brep/triangulate.h>

#include <optional>
#include <span>
#include <vector>

namespace trisect {

/// The loops joined to one, by sides of triangles between loops, one bridge fewer than loops that
/// do not touch. Starts with the first corner of the first loop. Nothing when the triangles are not
/// those of triangulate() for these loops, when the face is not connected, or when loops touch in
/// corners with different indices: then the triangles will do. O(n log n).
[[nodiscard]] std::optional<IndexLoop> joined_loops(std::span<const IndexLoop> loops,
                                                    std::span<const IndexTriangle> triangles);

/// The loops of a polygon without the sides that it runs along in both directions: those of
/// joined_loops(), each with its least corner first, in the order of these corners. The polygon
/// itself when it has no such sides, or when a loop without them is shorter than three corners, one
/// repeats a corner, or a corner is in none. O(n log n).
[[nodiscard]] std::vector<IndexLoop> parted_loops(std::span<const std::uint32_t> polygon);

}  // namespace trisect

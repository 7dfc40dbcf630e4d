// SPDX-License-Identifier: Apache-2.0
//
// Exact contact of two lattice triangles beyond their shared corners and edges.
// Corners and edges are shared by name. A contact comes with a witness.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include <trisect/kernel/lattice_point.h>
#include <trisect/kernel/point.h>

namespace trisect::detail {

enum class ContactKind : std::uint8_t {
    None,    ///< disjoint, or nothing but the shared corners and edges
    Touch,   ///< a point, or a segment that lies on an edge of both
    Cross,   ///< a segment through the inside of one of them
    Overlap  ///< coplanar with a common area
};

struct PairContact {
    ContactKind kind = ContactKind::None;
    Point witness;  ///< a point of the contact that is not a shared corner, if kind is not None
};

using IndexedTriangle = std::array<std::uint32_t, 3>;

/// \pre neither triangle is degenerate; equal corners have equal indices.
/// Two triangles with the same three corners give None: they are found as duplicate faces.
[[nodiscard]] PairContact find_contact(std::span<const LatticePoint> points,
                                       const IndexedTriangle& a, const IndexedTriangle& b);

}  // namespace trisect::detail

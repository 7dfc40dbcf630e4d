// SPDX-License-Identifier: Apache-2.0
//
// Minkowski sums and differences of solids, and of regions of the plane.
#pragma once

#include <cstddef>
#include <cstdint>

#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid.h>

namespace trisect {

struct MinkowskiOptions {
    EvaluateOptions evaluate = {};
    /// Which solids count as convex.
    enum class Convex : std::uint8_t {
        Exactly,
        /// Also those that miss it by no more than a rounding of their corners to doubles, which
        /// has dented flat faces: their hulls are taken. Much faster for solids that were turned.
        WithinRounding
    } convex = Convex::Exactly;
    /// Most convex pieces whose union is taken.
    std::size_t most_pieces = 100'000;
};

/// All sums of a point of `a` and a point of `b`.
///
/// Of convex solids the hull of the sums of corners; else the union of convex pieces: sums of
/// convex bodies between corners of `a`, which hold its boundary, with `b`, or with those of `b`.
/// Exact where corners, and sums of a corner of each, are doubles; others are rounded first, once
/// each. \throw UnsupportedError for an unbounded set, LimitError beyond the pieces, what
/// evaluate() throws
[[nodiscard]] Solid minkowski_sum(const Solid& a, const Solid& b,
                                  const MinkowskiOptions& options = {});

/// All points to which `b` can be moved, by them as vectors, so that it is within `a`: what is left
/// of `a` when its boundary is swept by `b` turned about the origin. `a` itself where `b` is empty,
/// since all of space is no solid that others could go on with. Exact as minkowski_sum().
[[nodiscard]] Solid minkowski_difference(const Solid& a, const Solid& b,
                                         const MinkowskiOptions& options = {});

/// The sum of regions of the plane, as prisms between z = 0 and z = 1: what the convolution of
/// their outlines goes around, or, of a region with holes, of the outlines of its triangles. Sums
/// of corners are rounded, once each, and so are corners that are no doubles before. \throw
/// LimitError beyond so many pairs of outlines as pieces are allowed
[[nodiscard]] Solid minkowski_sum_of_regions(const Solid& a, const Solid& b,
                                             const MinkowskiOptions& options = {});

}  // namespace trisect

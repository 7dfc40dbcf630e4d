// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/many_meshes/outlines/boundary_sides.h>

namespace trisect::detail {

namespace {

BoundaryCells cells_around(const OutlinedSolid& solid) {
    BoundaryCells out(solid.box, solid.facets.size());
    for (const OutlineBox& b : solid.boxes) out.occupy(b);
    out.find_parts();
    return out;
}

}  // namespace

BoundarySides::BoundarySides(const OutlinedSolid& solid)
    : cells_(cells_around(solid)), sides_(cells_.part_count(), OutlineSide::Unknown) {
    set(BoundaryCells::outside, solid.open_far_out ? OutlineSide::Open : OutlineSide::Closed);
}

}  // namespace trisect::detail

// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/many_meshes/special_pairs.h>

#include <trisect/bsp/cells/shift/shifted_pairs.h>

namespace trisect::detail {

std::optional<FacetCrossing> SpecialPairs::crossing(std::uint32_t first, std::uint32_t second) {
    if (are_known_in_plane(first, second)) {
        look_at_plane(first, second, planes_[first].turned == planes_[second].turned, false);
        return std::nullopt;
    }
    const InfinitesimalShift shift =
        meshes_.shifts->of_pair(meshes_.slot_of(first), meshes_.slot_of(second));
    const ShiftedPair pair =
        relate_shifted(meshes_.lattice_corners(first), meshes_.lattice_corners(second), shift);
    if (pair.touches) {
        special_.note(first);
        special_.note(second);
    }
    switch (pair.kind) {
        case ShiftedPair::Kind::Apart:
            break;
        case ShiftedPair::Kind::Crossing:
            return FacetCrossing{{first, second}, pair.ends};
        case ShiftedPair::Kind::Equal:
        case ShiftedPair::Kind::Coplanar:
            note_plane(first, second, pair.same_side);
            look_at_plane(first, second, pair.same_side, pair.kind == ShiftedPair::Kind::Equal);
            break;
    }
    return std::nullopt;
}

// Where long facets cover a face in two ways, all its pairs come here, so that a pair in a plane
// must not take arithmetic each time.
void SpecialPairs::note_plane(std::uint32_t first, std::uint32_t second, bool same_side) {
    if (planes_.empty()) planes_.resize(meshes_.facet_count());
    InPlane& a = planes_[first];
    InPlane& b = planes_[second];
    if (a.of == none && b.of == none) a = {first, false};
    if (a.of == none) {
        a = {b.of, b.turned == same_side};
    } else if (b.of == none) {
        b = {a.of, a.turned == same_side};
    }
}

// Two facets that cover a part of a plane. Where one operand leaves open what is above it and the
// other one what is below, nothing is open to both, and nothing of no thickness may be either.
void SpecialPairs::look_at_plane(std::uint32_t first, std::uint32_t second, bool same_side,
                                 bool are_equal) {
    const std::uint32_t first_slot = meshes_.slot_of(first);
    const std::uint32_t second_slot = meshes_.slot_of(second);
    const bool below_first = meshes_.is_open_below(first_slot, second_slot);
    // As seen from the first one.
    const bool below_second = meshes_.is_open_below(second_slot, first_slot) == same_side;
    const bool are_opposite = below_first != below_second;
    const InPlane& in_plane = planes_[first];
    const Key128 key{std::uint64_t{in_plane.of} << 1 | (in_plane.turned ? 1U : 0U),
                     std::uint64_t{first_slot} << 32 | second_slot};
    const bool is_known = !are_opposite || settled_.find(key) >= 0;
    if (is_known && special_.has(first) && special_.has(second)) return;
    const Overlap overlap = are_equal ? Overlap::Insides
                                      : coplanar_overlap(meshes_.lattice_corners(first),
                                                         meshes_.lattice_corners(second));
    if (overlap == Overlap::None) return;
    special_.note(first);
    special_.note(second);
    if (overlap != Overlap::Insides || is_known) return;
    settled_.insert(key, 0);
    const std::uint32_t above = below_first ? second_slot : first_slot;
    const std::uint32_t below = below_first ? first_slot : second_slot;
    special_.want({above,
                   below,
                   normal_signs(meshes_.lattice_corners(first)),
                   {growth_along(above, first), -growth_along(below, first)}});
}

// Whether an operand grows upwards in the plane of a facet, or downwards; 0 where the centre is in
// it, so that the moves decide.
int SpecialPairs::growth_along(std::uint32_t slot, std::uint32_t facet) const {
    const OperandShifts::Growth& g = meshes_.shifts->growth(slot);
    InfinitesimalShift shift;
    shift.growth = g.sign;
    shift.centre = g.centre;
    const FacetCorners corners = meshes_.lattice_corners(facet);
    const int side = side_of_shifted(corners, shift);
    shift.signs = {-1, -1, -1};
    return side == side_of_shifted(corners, shift) ? side : 0;
}

}  // namespace trisect::detail

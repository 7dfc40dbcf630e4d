// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/many_meshes/special_pairs.h>

#include <array>

#include <trisect/bsp/cells/shift/shifted_pairs.h>

namespace trisect::detail {

std::optional<FacetCrossing> SpecialPairs::crossing(std::uint32_t first, std::uint32_t second) {
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
            look_at_plane(first, second, pair.same_side, pair.kind == ShiftedPair::Kind::Equal);
            break;
    }
    return std::nullopt;
}

// Two facets that cover a part of a plane. Where one operand leaves open what is above it and the
// other one what is below, nothing is open to both, and nothing of no thickness may be either.
void SpecialPairs::look_at_plane(std::uint32_t first, std::uint32_t second, bool same_side,
                                 bool are_equal) {
    const std::uint32_t first_slot = meshes_.slot_of(first);
    const std::uint32_t second_slot = meshes_.slot_of(second);
    const auto& operands = meshes_.operands->operands;
    const bool below_first = operands[first_slot].is_open_below();
    // As seen from the first one.
    const bool below_second = operands[second_slot].is_open_below() == same_side;
    OperandShifts::Wanted wanted;
    if (below_first != below_second) {
        wanted.above = below_first ? second_slot : first_slot;
        wanted.below = below_first ? first_slot : second_slot;
        wanted.direction = normal_signs(meshes_.lattice_corners(first));
        wanted.growth = {growth_along(wanted.above, first), -growth_along(wanted.below, first)};
    }
    const bool is_known = below_first == below_second || special_.is_wanted(wanted);
    if (is_known && special_.has(first) && special_.has(second)) return;
    const Overlap overlap = are_equal ? Overlap::Insides
                                      : coplanar_overlap(meshes_.lattice_corners(first),
                                                         meshes_.lattice_corners(second));
    if (overlap == Overlap::None) return;
    special_.note(first);
    special_.note(second);
    if (overlap == Overlap::Insides && !is_known) special_.want(wanted);
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

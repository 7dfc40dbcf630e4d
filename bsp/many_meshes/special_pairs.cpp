// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/many_meshes/special_pairs.h>

#include <algorithm>
#include <cstddef>

#include <trisect/bsp/cells/shift/shifted_pairs.h>

namespace trisect::detail {

void SpecialPairs::look_at_planes(std::span<const InCell> first, std::span<const InCell> second) {
    while (!first.empty() && !second.empty()) {
        const std::uint32_t plane = std::min(first[0].plane, second[0].plane);
        const auto take = [&](std::span<const InCell>& all) {
            std::size_t n = 0;
            while (n < all.size() && all[n].plane == plane) ++n;
            const auto of_plane = all.first(n);
            all = all.subspan(n);
            return of_plane;
        };
        const auto one = take(first);
        const auto other = take(second);
        if (!one.empty() && !other.empty()) look_at_plane(one, other);
    }
}

// Of two operands, each facing one of two ways, enough is known once nothing more can be wanted.
void SpecialPairs::look_at_plane(std::span<const InCell> first, std::span<const InCell> second) {
    const auto groups_of = [&](std::span<const InCell> all, std::vector<std::uint32_t>& out) {
        std::vector<std::uint64_t> known;
        for (const InCell& f : all) {
            const std::uint64_t group =
                std::uint64_t{f.slot} << 1 | (in_plane(f.facet).turned ? 1U : 0U);
            const auto at = std::ranges::find(known, group);
            out.push_back(static_cast<std::uint32_t>(at - known.begin()));
            if (at == known.end()) known.push_back(group);
        }
        return known.size();
    };
    std::vector<std::uint32_t> of_first;
    std::vector<std::uint32_t> of_second;
    groups_of(first, of_first);
    const std::size_t width = groups_of(second, of_second);
    std::vector<std::uint8_t> is_enough(first.size() * width, 0);
    for (std::size_t i = 0; i < first.size(); ++i)
        for (std::size_t j = 0; j < second.size(); ++j) {
            const InCell& a = first[i];
            const InCell& b = second[j];
            std::uint8_t& enough = is_enough[of_first[i] * width + of_second[j]];
            if (enough != 0 && special_.has(a.facet) && special_.has(b.facet)) continue;
            if (!a.box.meets(b.box)) continue;
            const bool same_side = in_plane(a.facet).turned == in_plane(b.facet).turned;
            enough = look_at_plane(a.facet, b.facet, same_side, false) ? 1 : 0;
        }
}

std::optional<FacetCrossing> SpecialPairs::crossing(std::uint32_t first, std::uint32_t second) {
    const InPlane of_first = in_plane(first);
    const InPlane of_second = in_plane(second);
    if (of_first.of != none && of_first.of == of_second.of) {
        look_at_plane(first, second, of_first.turned == of_second.turned, false);
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
    if (meshes_.planes.of(first).way != 0) return;
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
bool SpecialPairs::look_at_plane(std::uint32_t first, std::uint32_t second, bool same_side,
                                 bool are_equal) {
    const std::uint32_t first_slot = meshes_.slot_of(first);
    const std::uint32_t second_slot = meshes_.slot_of(second);
    const bool below_first = meshes_.is_open_below(first_slot, second_slot);
    // As seen from the first one.
    const bool below_second = meshes_.is_open_below(second_slot, first_slot) == same_side;
    const bool are_opposite = below_first != below_second;
    const InPlane plane = in_plane(first);
    const Key128 key{std::uint64_t{plane.of} << 1 | (plane.turned ? 1U : 0U),
                     std::uint64_t{first_slot} << 32 | second_slot};
    const bool is_known = !are_opposite || settled_.find(key) >= 0;
    if (is_known && special_.has(first) && special_.has(second)) return true;
    const Overlap overlap = are_equal ? Overlap::Insides
                                      : coplanar_overlap(meshes_.lattice_corners(first),
                                                         meshes_.lattice_corners(second));
    if (overlap == Overlap::None) return is_known;
    special_.note(first);
    special_.note(second);
    if (overlap != Overlap::Insides || is_known) return is_known;
    settled_.insert(key, 0);
    const std::uint32_t above = below_first ? second_slot : first_slot;
    const std::uint32_t below = below_first ? first_slot : second_slot;
    special_.want({above,
                   below,
                   normal_signs(meshes_.lattice_corners(first)),
                   {growth_along(above, first), -growth_along(below, first)}});
    return true;
}

// Whether an operand that grows does so upwards in the plane of a facet, or downwards; 0 where the
// centre is in it, so that the moves decide.
int SpecialPairs::growth_along(std::uint32_t slot, std::uint32_t facet) const {
    const OperandShifts::Growth& g = meshes_.shifts->growth(slot);
    InfinitesimalShift shift;
    shift.growth = 1;
    shift.centre = g.centre;
    const FacetCorners corners = meshes_.lattice_corners(facet);
    const int side = side_of_shifted(corners, shift);
    shift.signs = {-1, -1, -1};
    return side == side_of_shifted(corners, shift) ? side : 0;
}

}  // namespace trisect::detail

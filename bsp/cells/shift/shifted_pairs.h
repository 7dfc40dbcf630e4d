// SPDX-License-Identifier: Apache-2.0
//
// ShiftedPair: relation of two facets under an infinitesimal shift of one mesh.
// So moved, two meshes are in general position: edges pass by edges and corners by planes on a
// definite side, and every question about pairs of facets has the same kind of answer. Exact.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include <trisect/bsp/cells/crossings.h>
#include <trisect/bsp/cells/infinitesimal_shift.h>
#include <trisect/kernel/lattice_point.h>

namespace trisect::detail {

/// The corners of a facet.
using FacetCorners = std::array<const LatticePoint*, 3>;

/// Two facets, the second one of the mesh that is moved.
struct ShiftedPair {
    enum class Kind : std::uint8_t {
        Apart,
        Crossing,
        Equal,     ///< they have the same corners; nothing else is said
        Coplanar,  ///< in one plane, hence apart; `touches` is not set
    };
    Kind kind = Kind::Apart;
    bool touches = false;  ///< without the shift they may have a point in common otherwise
    bool is_above =
        false;  ///< of coplanar and equal ones: the second one is moved above the first one
    bool same_side = false;  ///< of those, and of equal ones: they face the same way
    /// In one plane, of which the second one is moved to both sides; `kind` then is that of any
    /// others.
    bool is_torn = false;
    /// Of a crossing, as in FacetCrossing. Places are those without the shift.
    std::array<FacetCrossing::End, 2> ends;
};

[[nodiscard]] ShiftedPair relate_shifted(const FacetCorners& first, const FacetCorners& second,
                                         const InfinitesimalShift& shift);
/// The same in two ways: in doubles, and nothing where they leave a sign open that is no
/// orientation of four whole points, and in integers. Answers agree, but for the last bits of ends.
[[nodiscard]] std::optional<ShiftedPair> relate_in_doubles(const FacetCorners& first,
                                                           const FacetCorners& second,
                                                           const InfinitesimalShift& shift);
[[nodiscard]] ShiftedPair relate_exactly(const FacetCorners& first, const FacetCorners& second,
                                         const InfinitesimalShift& shift);

/// What two facets of one plane have in common, without the shift: nothing, a part of their
/// outlines, or more.
enum class Overlap : std::uint8_t { None, Outlines, Insides };
[[nodiscard]] Overlap coplanar_overlap(const FacetCorners& first, const FacetCorners& second);

/// The signs of a facet's normal.
[[nodiscard]] std::array<int, 3> normal_signs(const FacetCorners& facet);

/// 1 where a facet of the other mesh in the plane of this one is moved above it, -1 below it.
/// Where corners do not move.
[[nodiscard]] int side_of_shifted(const FacetCorners& facet, const InfinitesimalShift& shift);
/// The same for two facets of one plane, the second one of the mesh that is moved; 0 where it goes
/// to both sides.
[[nodiscard]] int side_of_shifted(const FacetCorners& first, const FacetCorners& second,
                                  const InfinitesimalShift& shift);

/// Whether the line from one point to another one goes through a facet of the other mesh: 1
/// upwards, -1 downwards, 0 not at all. Where corners move, the line moves with its first point.
/// Nothing where an edge of the facet is parallel to it and would touch it. `is_second`: the points
/// are moved.
[[nodiscard]] std::optional<int> passage_shifted(const LatticePoint& from, const LatticePoint& to,
                                                 bool is_second, const FacetCorners& facet,
                                                 const InfinitesimalShift& shift);

/// -1 where an edge comes first through the one and then through the other of two facets of the
/// other mesh, 1 the other way; 0 where both are of one plane. `is_second`: the edge is of the mesh
/// that is moved. \pre it goes through both
[[nodiscard]] int order_along_shifted(const LatticePoint& from, const LatticePoint& to,
                                      bool is_second, const FacetCorners& one,
                                      const FacetCorners& other, const InfinitesimalShift& shift);

}  // namespace trisect::detail

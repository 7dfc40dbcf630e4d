// SPDX-License-Identifier: Apache-2.0
//
// CommonSegments: segments that the parts of two crossing facets have in common.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/bsp/leaf/doubles/filtered_facets.h>
#include <trisect/bsp/many_meshes/outlines/outlined_solid.h>
#include <trisect/bsp/many_meshes/shifted_points.h>
#include <trisect/kernel/support/flat_map.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

/// A part of the segment of two crossing facets.
struct CommonSegment {
    /// An edge of one of the parts pierces the other part.
    struct End {
        Approximation at;
        std::uint32_t edge = 0;  ///< of the solid whose edge it is
        bool of_second = false;
    };
    std::array<End, 2> ends;  ///< in the direction of the crossing's
};

/// Facets of two solids, with their planes, one crossing after the other; keeps its memory.
class CommonSegments {
public:
    /// `exact` answers what doubles do not decide.
    CommonSegments(const ManyMeshes& meshes, const ShiftedPoints& exact)
        : meshes_(meshes), exact_(exact) {}

    [[nodiscard]] const ManyMeshes& meshes() const { return meshes_; }
    /// The solids of all that follows.
    void start(const OutlinedSolid& first, const OutlinedSolid& second);
    /// False where that fails. \pre the facets at these places cross so
    [[nodiscard]] bool find(const std::array<std::uint32_t, 2>& places,
                            const FacetCrossing& crossing);
    /// In their order along the crossing.
    [[nodiscard]] std::span<const CommonSegment> segments() const { return segments_; }
    /// Of one of the solids; good until the next one is made.
    [[nodiscard]] const FilteredPlane& plane(std::size_t solid, std::uint32_t place);
    /// Of any facet.
    [[nodiscard]] FilteredPlane plane_of(const OutlinedSolid::Facet& facet) const;

private:
    /// Where an edge of a part meets the line of the crossing.
    struct Passage {
        /// Before the crossing's segment, at its first end, inside, at its last end, behind it.
        enum class Where : std::uint8_t { Before, Start, Inside, End, Behind };
        Where where = Where::Before;
        bool of_second = false;
        bool enters = false;  ///< the part lies behind it
        std::uint32_t edge = 0;
    };
    struct InnerPassage : Passage {
        std::uint32_t cutter = 0;
        double along = 0;
        Approximation at;
    };
    void set_way();
    [[nodiscard]] int side(std::size_t solid, std::uint32_t vertex, const FilteredPlane& plane);
    [[nodiscard]] int exact_side(std::size_t solid, std::uint32_t vertex);
    void note_short_segments() const;
    [[nodiscard]] bool list_passages(std::size_t solid, const OutlinedSolid::Facet& facet,
                                     const FilteredPlane& other);
    [[nodiscard]] bool place_own(Passage& p, std::int8_t own) const;
    [[nodiscard]] bool place_on_line(InnerPassage& p, const OutlinedSolid::Facet& facet,
                                     const FacetCrossing& line, const FilteredPlane& other) const;
    [[nodiscard]] bool set_place(InnerPassage& p, const std::array<std::uint32_t, 3>& facets,
                                 const FacetCrossing& line, const FilteredPlane& other) const;
    [[nodiscard]] bool begin_inside(std::size_t solid, const OutlinedSolid::Facet& facet,
                                    bool& inside) const;
    [[nodiscard]] bool sort_inside();
    [[nodiscard]] bool walk(const std::array<const OutlinedSolid::Facet*, 2>& facets);
    [[nodiscard]] bool end_of_crossing(std::size_t k, CommonSegment::End& out,
                                       const OutlinedSolid::Facet& owner) const;

    const ManyMeshes& meshes_;
    const ShiftedPoints& exact_;
    std::array<const OutlinedSolid*, 2> solids_{};
    struct MadePlane {
        std::uint32_t turn = 0;  // of the solids for which it was made last
        std::uint32_t number = 0;
    };
    std::array<PoolVector<MadePlane>, 2> plane_of_;  // by place
    std::uint32_t turn_ = 0;
    PoolVector<FilteredPlane> planes_;
    FlatMap sides_;  // of vertices that doubles leave open, and whether moves decided them
    std::vector<CommonSegment> segments_;
    // Of one crossing:
    const FacetCrossing* crossing_ = nullptr;
    std::size_t axis_ = 0;  // along which the segment is longest, and which way
    double way_ = 1;
    std::vector<Passage> passages_;
    std::vector<InnerPassage> inside_;
};

}  // namespace trisect::detail

// SPDX-License-Identifier: Apache-2.0
//
// WholeFacetPairs: crossings between two lists of facets, by doubles.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/bsp/leaf/doubles/facet_rows.h>
#include <trisect/bsp/leaf/doubles/narrow_boxes.h>
#include <trisect/bsp/leaf/doubles/single_box.h>
#include <trisect/bsp/leaf/doubles/triangle_relation.h>
#include <trisect/bsp/many_meshes/outlines/outlined_solid.h>

namespace trisect::detail {

/// Facets are whole ones; their boxes may be of parts. One pair of lists after the other; keeps its
/// memory.
class WholeFacetPairs {
public:
    explicit WholeFacetPairs(const ManyMeshes& meshes) : meshes_(meshes) {}

    /// Begins two lists, of so many facets together. `near`: a point near all of them. `reach`:
    /// boxes that meet, do so in a place that meets it.
    void start(std::size_t count, const Vector3& near, const SingleBox& reach);
    /// Facets of the second list come first.
    void add(std::uint32_t slot, std::uint32_t number, const SingleBox& box);
    void end_second() { second_ = names_.size(); }
    /// Facets of one plane do not cross, where they have the same number: by place in the order in
    /// which they were added, 0 where nothing is known.
    void leave_out_planes(std::span<const std::uint32_t> known) { known_planes_ = known; }
    /// False where they are too far apart for doubles.
    [[nodiscard]] bool find();

    /// Places in either list.
    using Places = std::array<std::uint32_t, 2>;
    struct Crossing {
        Places places{};
        std::array<FacetCrossing::End, 2> ends;
    };
    /// In the order of the first places, and then of the second ones.
    [[nodiscard]] std::span<const Crossing> crossings() const { return crossings_; }
    /// Pairs that doubles leave open.
    [[nodiscard]] std::span<const Places> doubtful() const { return doubtful_; }
    /// Of which boxes meet.
    [[nodiscard]] std::size_t box_pairs() const { return box_pair_count_; }

private:
    struct Name {
        std::uint32_t slot = 0;
        std::uint32_t number = 0;
    };
    // Made of those that have a partner.
    struct Facet {
        std::array<Vector3, 3> corners;
        alignas(16) std::array<FacetRows::Four, 3> singles;  // from the point near all of them
        FilteredPlane plane;
    };
    void list_box_pairs();
    void list_met(std::size_t first);
    [[nodiscard]] bool make_planes();
    void compare_planes();
    void relate_listed();
    void relate(const FacetRows::Pair& pair);
    void keep(const FacetRows::Pair& pair, const TriangleRelation& relation);
    [[nodiscard]] TriangleAndPlane triangle(std::size_t i) const {
        return {facets_[i].corners, facets_[i].plane};
    }
    [[nodiscard]] Places places(const FacetRows::Pair& pair) const {
        return {pair[0] - static_cast<std::uint32_t>(second_), pair[1]};
    }

    const ManyMeshes& meshes_;
    std::vector<Name> names_;
    std::vector<Facet> facets_;
    std::size_t second_ = 0;  // facets of the second list
    Vector3 near_{};
    NarrowBoxes boxes_;                      // of the second list
    std::vector<NarrowBoxes::Ends> probes_;  // of the first one
    std::vector<std::uint64_t> met_;         // by one of these
    FacetRows planes_;
    std::span<const std::uint32_t> known_planes_;
    // A facet of the first list with four of the second one, of which some boxes meet.
    struct BoxPairs {
        std::uint32_t first = 0;
        std::uint32_t row = 0;
        unsigned met = 0;
    };
    std::vector<BoxPairs> box_pairs_;
    std::size_t box_pairs_listed_ = 0;       // there is room for more
    std::vector<std::uint64_t> are_met_;     // of the second list
    std::vector<std::uint8_t> has_partner_;  // by place
    std::vector<FacetRows::Pair> pairs_;     // that planes do not part, not yet related
    std::vector<Crossing> crossings_;
    std::vector<Places> doubtful_;
    std::size_t box_pair_count_ = 0;
};

}  // namespace trisect::detail

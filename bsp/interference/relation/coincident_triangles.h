// SPDX-License-Identifier: Apache-2.0
//
// CoincidentTriangles: coincident triangles of two placed boundaries, and their consequences.
// No triangles are compared for these.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <trisect/bsp/interference/boxes/approximate_map.h>
#include <trisect/bsp/interference/relation/boundary_flags.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>
#include <trisect/bsp/interference/relation/meeting_pairs.h>
#include <trisect/bsp/interference/relation/quick_relation.h>

namespace trisect::detail {

/// Pairs of triangles with the same three corners, exactly. For the relation alone: contacts that
/// matter nowhere else are not listed.
class CoincidentTriangles {
public:
    static constexpr std::uint32_t none = 0xffffffffU;

    /// Linear in the sizes of the models, up to sorting. \pre neither boundary touches itself, and
    /// the poses have doubles
    explicit CoincidentTriangles(const PosedModels& models);

    /// The triangle of B that a triangle of A falls together with, or none.
    [[nodiscard]] std::uint32_t partner_of_a(std::uint32_t triangle) const {
        return partner_of_a_[triangle];
    }
    [[nodiscard]] std::uint32_t partner_of_b(std::uint32_t triangle) const {
        return partner_of_b_[triangle];
    }
    /// What they say by themselves.
    void add_flags(BoundaryFlags& flags) const;
    /// The pairs with one of them that are needed to compare cones at contact vertices and to list
    /// which shells are touched.
    void add_pairs(std::vector<MeetingPair>& pairs) const;
    /// visit(i, j, verdict) for the pairs that may meet of triangles without partner, until it
    /// returns true.
    void for_other_candidates(MeetingCollector& visit) const;

private:
    void match_vertices();
    void match_triangles();
    void mark_partial_vertices();
    [[nodiscard]] std::span<const std::uint32_t> triangles_of_b_at(std::uint32_t vertex) const;
    [[nodiscard]] bool is_partial(const ModelTriangle& of_a, std::size_t corner) const;
    [[nodiscard]] std::uint32_t partner_of_corner(const ModelTriangle& of_a,
                                                  std::size_t corner) const;
    [[nodiscard]] std::size_t corner_of_b_at(std::uint32_t triangle, std::uint32_t vertex) const;
    [[nodiscard]] MeetingPair coincident_pair(std::uint32_t i) const;
    void add_pairs_at(std::uint32_t i, std::size_t corner, std::vector<MeetingPair>& pairs) const;

    const PosedModels* models_;
    // Vertices by their places.
    std::vector<std::uint32_t> vertex_of_b_;  // at the same point, for each of A
    std::vector<std::uint32_t> vertex_of_a_;
    // Of A's: those where a triangle of either boundary has no partner.
    std::vector<bool> partial_;
    // Triangles of B by vertex: begin_[v] .. begin_[v + 1].
    std::vector<std::uint32_t> begin_;
    std::vector<std::uint32_t> at_vertex_;
    std::vector<std::uint32_t> partner_of_a_;
    std::vector<std::uint32_t> partner_of_b_;
};

/// Whether some of these pairs look as if they fell together.
[[nodiscard]] bool may_coincide(const InterferenceModelData& a, const InterferenceModelData& b,
                                const ApproximateMap& to_a, std::span<const CandidatePair> pairs);

}  // namespace trisect::detail

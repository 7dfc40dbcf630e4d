// SPDX-License-Identifier: Apache-2.0
//
// Crossing pairs of facets in leaves in general position (filtered_leaf.h).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <trisect/bsp/cells/crossings.h>
#include <trisect/bsp/leaf/doubles/box_rows.h>
#include <trisect/bsp/leaf/doubles/facet_rows.h>
#include <trisect/bsp/leaf/doubles/filtered_facets.h>
#include <trisect/kernel/support/as_index.h>

namespace trisect::detail {

/// An end of the segment that two facets have in common: an edge of one pierces the other. Where a
/// corner lies on the other one it is one of the two edges that meet there.
struct FilteredEnd {
    bool of_second = false;  ///< whose edge it is
    std::int8_t edge = 0;    ///< from that corner of the outline to the next one
    /// The edge of the other one when both edges meet there; else -1.
    std::int8_t other_edge = -1;
    Approximation at;

    /// The edge of one of the two polygons in which the end lies; -1 when it lies within.
    [[nodiscard]] int edge_of(bool second) const { return of_second == second ? edge : other_edge; }
};

/// Two polygons that cross in a segment. Each has corners on both sides of the other one's support,
/// and perhaps some on it, but no edge.
struct FilteredCrossing {
    std::array<LeafIndex, 2> items{};
    /// Bit i: corner i of the outline is above the other one's support.
    std::array<std::uint32_t, 2> above{};
    std::array<std::uint32_t, 2> on{};  ///< or on it; all others are below
    std::array<FilteredEnd, 2> ends;  ///< in the direction of the normals' product, first × second

    /// -1 below, 0 on, 1 above: a corner of one of them with respect to the other's support.
    [[nodiscard]] int side_of(bool second, std::size_t corner) const {
        const std::size_t i = second ? 1 : 0;
        if ((on[i] >> corner & 1U) != 0) return 0;
        return (above[i] >> corner & 1U) != 0 ? 1 : -1;
    }
};

/// A crossing, seen from one of its polygons.
struct FilteredContact {
    LeafIndex other = 0;
    std::int32_t crossing = 0;
    bool is_second = false;  ///< the polygon from which it is seen
};

/// Compares all polygons of different operands whose boxes meet; keeps its memory.
class FilteredPairs {
public:
    /// False when doubles cannot decide some pair. Where edges meet edges, or a corner comes near a
    /// support, that is decided exactly, unless `edges_apart`: then such a pair is one that they
    /// cannot decide. Polygons that meet in no more than a point do not cross, but are marked as
    /// touched. False also when an edge lies in a support. Counts pairs.
    [[nodiscard]] bool relate_all(FilteredFacets& facets, bool edges_apart, EvaluateStats& stats) {
        return relate(facets, {}, edges_apart, stats);
    }
    /// The pairs that doubles cannot decide, with `edges_apart`: the others are related as above.
    /// The item of the first operand comes first. \pre two operands
    using Doubtful = std::vector<std::array<LeafIndex, 2>>;
    void relate_all_but(Doubtful& doubtful, FilteredFacets& facets, EvaluateStats& stats) {
        doubtful.clear();
        doubtful_ = &doubtful;
        static_cast<void>(relate(facets, {}, true, stats));
        doubtful_ = nullptr;
    }
    /// Pairs that are known to lie in one plane are left out from here on, where they have the same
    /// number: by item, 0 where nothing is known.
    void leave_out_planes(std::span<const std::uint32_t> known) { known_planes_ = known; }
    /// relate_all(), with `edges_apart`, for pairs with at least one marked facet.
    [[nodiscard]] bool relate_marked(FilteredFacets& facets, std::span<const std::uint8_t> marks,
                                     EvaluateStats& stats) {
        return relate(facets, marks, true, stats);
    }
    /// Appends the crossings by the facets' numbers in a formula. \pre whole facets; every operand
    /// has one source
    void add_to(Crossings& crossings, const FilteredFacets& facets) const;

    [[nodiscard]] const FilteredCrossing& crossing(std::int32_t i) const {
        return crossings_[static_cast<std::size_t>(i)];
    }
    [[nodiscard]] std::span<const FilteredCrossing> crossings() const { return crossings_; }
    /// Whether an item's box meets that of all facets of some other operand. \pre two operands
    [[nodiscard]] bool is_candidate(LeafIndex item) const {
        return is_candidate_[as_index(item)] != 0;
    }
    /// Whether an item's box meets that of some facet of the other operand. \pre relate_all(), two
    /// operands
    [[nodiscard]] bool has_partner(LeafIndex item) const {
        return has_partner_[as_index(item)] != 0;
    }
    /// The boxes of all items in their order, if they are there: in all but large leaves.
    [[nodiscard]] const BoxRows* all_boxes() const { return has_all_boxes_ ? &boxes_ : nullptr; }
    /// Their planes in the same rows, if they are there: of more than two operands.
    [[nodiscard]] const FacetRows* all_planes() const {
        return has_all_boxes_ && has_planes_ ? &planes_ : nullptr;
    }
    /// Contacts of an item, by ascending `other`.
    [[nodiscard]] std::span<const FilteredContact> contacts(LeafIndex item) const {
        const auto i = as_index(item);
        return {contacts_.data() + first_contact_[i], contacts_.data() + first_contact_[i + 1]};
    }

private:
    enum class Relation : std::uint8_t { Apart, Crossing, Uncertain };
    struct Candidate {
        double lo = 0;  // along the axis of the sweep
        LeafIndex item = 0;
    };
    [[nodiscard]] bool relate(FilteredFacets& facets, std::span<const std::uint8_t> marks,
                              bool edges_apart, EvaluateStats& stats);
    [[nodiscard]] bool relate_two(FilteredFacets& facets, EvaluateStats& stats);
    [[nodiscard]] bool sweep(FilteredFacets& facets, std::span<const std::uint8_t> marks,
                             EvaluateStats& stats);
    [[nodiscard]] std::span<const std::uint64_t> find_rows(std::size_t candidate, bool all);
    void list_candidates(FilteredFacets& facets, LeafIndex few);
    void sort_candidates(const FilteredFacets& facets);
    void mark_rows(std::span<const std::uint8_t> marks);
    /// Sets all of `out` when they cross.
    [[nodiscard]] Relation relate(FilteredFacets& facets, LeafIndex s, LeafIndex t,
                                  FilteredCrossing& out) const;
    [[nodiscard]] Relation relate_outlines(FilteredFacets& facets, LeafIndex s, LeafIndex t,
                                           FilteredCrossing& out) const;
    [[nodiscard]] bool compare(FilteredFacets& facets, LeafIndex s, LeafIndex t,
                               EvaluateStats& stats);
    [[nodiscard]] bool add_pair(FilteredFacets& facets, LeafIndex s, LeafIndex t);
    [[nodiscard]] bool is_left_open(LeafIndex s, LeafIndex t);
    [[nodiscard]] bool add_pairs(FilteredFacets& facets);
    [[nodiscard]] bool add_crossing(const FilteredFacets& facets, LeafIndex s, LeafIndex t,
                                    const FacetRows::Relation& relation, unsigned i);
    void list_contacts(LeafIndex count);
    [[nodiscard]] bool are_in_plane(LeafIndex s, LeafIndex t) const {
        return !known_planes_.empty() && known_planes_[as_index(s)] != 0 &&
               known_planes_[as_index(s)] == known_planes_[as_index(t)];
    }

    bool edges_apart_ = false;
    Doubtful* doubtful_ = nullptr;  // where such pairs are taken out
    std::span<const std::uint32_t> known_planes_;
    std::vector<Candidate> candidates_;
    std::vector<std::uint8_t> is_candidate_;  // by item
    std::vector<std::uint8_t> has_partner_;   // by item
    // Of the candidates, the axis of the sweep first; where nothing is sorted, of all items.
    BoxRows boxes_;
    bool has_all_boxes_ = false;
    FacetRows planes_;  // of the same items, if no fragments are among them
    bool has_planes_ = false;
    std::vector<std::uint64_t> rows_;         // see find_rows()
    std::vector<FacetRows::Pair> pairs_;      // of candidates that planes do not part
    std::vector<std::size_t> rows_of_first_;  // of two operands: with candidates of the first
    std::vector<std::uint8_t> marked_;        // of rows, where only marked ones count
    std::vector<std::size_t> next_marked_;    // rows
    FilteredCrossing found_;                  // between the pair that is looked at
    std::vector<FilteredCrossing> crossings_;
    std::vector<FilteredContact> contacts_;
    std::vector<std::size_t> first_contact_;
};

}  // namespace trisect::detail

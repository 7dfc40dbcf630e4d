// SPDX-License-Identifier: Apache-2.0
//
// PrismArrangement: a formula over any number of prisms along one axis.
// All prisms are arranged at once, without a tree.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <trisect/bsp/cells/leaf_problem.h>
#include <trisect/bsp/cells/named_outlines.h>
#include <trisect/bsp/leaf/leaf_arrangement.h>
#include <trisect/bsp/leaf/leaf_formula.h>
#include <trisect/bsp/leaf/prism/prism_components.h>
#include <trisect/bsp/leaf/prism/prism_crossings.h>
#include <trisect/bsp/leaf/prism/prism_facets.h>
#include <trisect/bsp/leaf/prism/prism_names.h>
#include <trisect/bsp/leaf/prism/prism_walk.h>
#include <trisect/kernel/support/as_index.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

/// Like PrismLeaf, but for what is left of facets it makes outlines instead of convex pieces, so
/// its time is near linear in side faces, crossings and layers together. What bounds the result as
/// it is, without a vertex in its edges, comes out whole, the rest as LeafOutlines. Takes as many
/// threads as the options of the problem have; what comes out is the same for any number. \pre each
/// operand is all facets of one source, and no other arrangement is at work.
///
/// Not for operands of another kind, nor where side faces touch or coincide, or three of them meet
/// in a line and may go straight across each other there, or there are so many layers, or side
/// faces beside each other, that cells are the better way.
class PrismArrangement final : public LeafArrangement {
private:
    [[nodiscard]] std::optional<LeafResult> try_to_arrange(const LeafProblem& problem,
                                                           LeafFindings& findings) override;
    /// The order in which chains are walked along: by the lines of their starts.
    struct Sweep {
        struct SideFace {
            Coordinate low;
            Coordinate high;
            LeafIndex side_face = 0;
            friend bool operator<(const SideFace& a, const SideFace& b) {
                return a.low != b.low ? a.low < b.low : a.side_face < b.side_face;
            }
        };
        std::vector<SideFace> side_faces;  // by their lower ends
        std::vector<std::pair<Coordinate, std::size_t>> chains;
        std::vector<std::size_t> steps_before;  // each of the chains
    };
    struct WalkEdges;
    /// The caps in one plane.
    struct CapPlane {
        enum Sign : std::uint8_t {
            Several = 1,  // faces of operands that are not whole
            Mixed = 2     // sources, or the first one is not the first of its source
        };
        static constexpr std::size_t none = ~std::size_t{0};
        std::size_t first = none;  // that is not whole
        std::uint8_t signs = 0;
        void note(Sign sign);  // by several threads
    };
    [[nodiscard]] bool find_crossings_and_chains(const LeafProblem& problem, EvaluateStats& stats);
    [[nodiscard]] bool has_few_layers() const;
    void find_chains();
    [[nodiscard]] const FlatCorner& start_of(std::size_t chain) const {
        return names_.side_face(steps_[chain_begin_[chain]].side_face).from;
    }
    void find_sweep();
    [[nodiscard]] bool walk_chains(const LeafProblem& problem, EvaluateStats& stats);
    [[nodiscard]] std::size_t most_looked_at() const;
    [[nodiscard]] std::size_t walk_part(const LeafProblem& problem,
                                        const std::array<std::size_t, 2>& chains,
                                        PrismWalk& walk) const;
    [[nodiscard]] std::vector<PolygonRef> list_whole();
    void look_at_cap_planes();
    void put_outlines_together();
    [[nodiscard]] bool is_left_out(const PrismWalk::CapEdge& c) const {
        return c.component >= 0 && components_.is_whole(c.component);
    }
    void count_cap_edges(const PrismWalk::Found& found, WalkEdges& place) const;
    void name_cap_face(std::uint32_t face);
    void put_edges(const PrismWalk::Found& found, const WalkEdges& place);
    [[nodiscard]] NamedOutlines::Edge* put_cap_edge(const PrismWalk::CapEdge& c,
                                                    NamedOutlines::Edge* out) const;
    void name_cap_planes();
    template <class Work>
    void for_each_walk(const Work& work);

    std::uint32_t threads_ = 1;
    PrismFacets facets_;
    PrismNames names_{facets_};
    PrismCrossings crossings_;
    PrismComponents components_;
    LeafFormula formula_;
    PoolVector<PrismWalk::Step> steps_;  // chain by chain
    std::vector<std::size_t> chain_begin_;
    Sweep sweep_;
    std::vector<PrismWalk::Found> found_;      // by part of the sweep
    std::vector<CapPlane> cap_planes_;         // by position
    std::vector<std::int32_t> faces_of_caps_;  // of the outlines, by CapEdge::face; -1: none
    NamedOutlines outlines_;
};

}  // namespace trisect::detail

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
#include <vector>

#include <trisect/bsp/cells/leaf_problem.h>
#include <trisect/bsp/cells/named_outlines.h>
#include <trisect/bsp/leaf/leaf_arrangement.h>
#include <trisect/bsp/leaf/leaf_formula.h>
#include <trisect/bsp/leaf/prism/prism_components.h>
#include <trisect/bsp/leaf/prism/prism_crossings.h>
#include <trisect/bsp/leaf/prism/prism_facets.h>
#include <trisect/kernel/support/as_index.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

/// Like PrismLeaf, but for what is left of facets it makes outlines instead of convex pieces, so
/// its time is near linear in side faces, crossings and layers together. What bounds the result as
/// it is, without a vertex in its edges, comes out whole, the rest as LeafOutlines. \pre each
/// operand is all facets of one source.
///
/// Not for operands of another kind, nor where side faces touch or coincide, or three of them meet
/// in a line and may go straight across each other there, or there are so many layers, or side
/// faces beside each other, that cells are the better way.
class PrismArrangement final : public LeafArrangement {
private:
    [[nodiscard]] std::optional<LeafResult> try_to_arrange(const LeafProblem& problem,
                                                           LeafFindings& findings) override;
    // Where an interval of a side face ends: at the side face of that number, which crosses it, or
    // with the side face itself.
    using Bound = LeafIndex;
    static constexpr Bound at_from = -1;
    static constexpr Bound at_to = -2;
    /// What is inside in a layer: to the left of a side face, and to its right.
    struct Inside {
        bool left = false;
        bool right = false;
        friend bool operator==(const Inside&, const Inside&) = default;
    };
    /// A side face in the walk around its outline.
    struct Step {
        LeafIndex side_face = 0;
        bool backwards = false;  // from its `to` to its `from`
    };
    using Chain = std::span<const Step>;
    /// What a side face's face is in one layer.
    enum class Facing : std::uint8_t { None, InsideLeft, InsideRight };
    static Facing facing(const Inside& i) {
        return i.left == i.right ? Facing::None
                                 : (i.left ? Facing::InsideLeft : Facing::InsideRight);
    }
    /// An edge of a face in the plane of a cap, until it is known which components are whole.
    struct CapEdge {
        LeafIndex side_face = 0;
        Bound from = at_from;
        Bound to = at_to;
        std::uint32_t face = 0;       // twice the position, one more if it is up
        std::int32_t component = -1;  // of whose facets it is an edge if they are whole
        bool left = false;            // the face is to the left of the side face
        bool all = false;             // of the side face, where it ends
    };
    /// How much of a side face bounds the result: bits for its two halves.
    struct SideFaceState {
        unsigned whole = 0;
        unsigned outlined = 0;
        Facing facing = Facing::None;
    };
    static constexpr unsigned both_halves = 3;
    [[nodiscard]] const PrismSideFace& side_face(LeafIndex i) const {
        return facets_.side_faces()[as_index(i)];
    }
    [[nodiscard]] bool has_few_layers() const;
    void find_chains();
    [[nodiscard]] bool walk_chains(const LeafProblem& problem, EvaluateStats& stats);
    void walk_chain(Chain chain, std::span<const LeafIndex> crossed);
    void enter_component(std::int32_t component);
    void set_row(std::size_t layer, LeafIndex operand, bool in);
    void turn_over(const PrismSideFace& crossed, const PrismSideFace& by);

    void walk_side_face(const Step& step);
    void look(const PrismSideFace& w, Bound begin);
    void turn_intervals();
    [[nodiscard]] std::span<const Inside> interval(std::size_t i) const {
        return std::span(insides_).subspan(i * layers_here_, layers_here_);
    }
    [[nodiscard]] Bound end_of_interval(std::size_t i) const {
        return i + 1 < begins_.size() ? begins_[i + 1] : at_to;
    }
    [[nodiscard]] static std::array<int, 2> bounds(std::span<const Inside> layers, std::size_t i);

    void judge_side_face(LeafIndex i);
    [[nodiscard]] SideFaceState state_of(LeafIndex i) const;
    [[nodiscard]] bool is_low(const PrismSideFace& w, std::size_t half) const;
    [[nodiscard]] bool is_unbroken(std::size_t position) const;
    [[nodiscard]] bool is_same_beside(std::size_t position, std::size_t s, std::size_t t) const;
    /// Of intervals [s, t). Elsewhere neither a wall nor the cap beside it is whole.
    [[nodiscard]] bool is_all_at_end(std::size_t p, std::size_t s, std::size_t t) const {
        return (p == 0 || p + 2 == layers_here_) && s == 0 && t == begins_.size();
    }
    void add_whole(const PrismSideFace& w, const SideFaceState& state);
    void add_whole_halves(const PrismSideFace& w, const SideFaceState& state);
    void add_horizontal_edges(LeafIndex i, const SideFaceState& state);
    void note_component(LeafIndex i, std::size_t p, std::array<int, 2> bounds, bool unbroken);
    void add_cap_edges(LeafIndex i, std::size_t p, std::size_t s, std::size_t t);
    void add_side_face_edges(LeafIndex i, std::size_t p, std::size_t s, std::size_t t,
                             const SideFaceState& state);
    void add_vertical_edges(LeafIndex i, const SideFaceState& state);
    void add_upright(LeafIndex i, Bound b, bool begins, std::size_t first, std::size_t end,
                     Facing f, const SideFaceState& state);
    void add_half(LeafIndex i, const SideFaceState& state);
    void finish_caps();
    void add_cap_edge(const CapEdge& c, std::uint32_t face);

    [[nodiscard]] std::span<const PrismCorner> corners_between(LeafIndex i, std::size_t position,
                                                               bool all) const;
    [[nodiscard]] std::span<const PrismCorner> corners_upright(LeafIndex i, Bound b,
                                                               std::size_t below,
                                                               std::size_t above) const;
    template <class Out>
    static void divide(const PrismSideFace& w, NamedOutlines::Edge edge,
                       std::span<const PrismCorner> between, bool turned, const Out& out);
    [[nodiscard]] std::uint32_t face_of_wall(const PrismSideFace& w, bool left);
    [[nodiscard]] std::uint32_t face_of_side_face(LeafIndex i, Facing f,
                                                  const SideFaceState& state);
    [[nodiscard]] static NamedOutlines::Vertex vertex_of(const PrismSideFace& w,
                                                         const PrismCorner& c) {
        return NamedOutlines::Vertex::corner_of(w.facets[0].source, c.facet, c.corner);
    }
    [[nodiscard]] Coordinate height_of(const PrismSideFace& w, const PrismCorner& c) const {
        return coordinate(w.facets[0].source->corner(c.facet, c.corner), facets_.axis());
    }
    [[nodiscard]] NamedOutlines::Vertex vertex(LeafIndex i, Bound b, std::size_t position) const;
    [[nodiscard]] EdgeName side_of_bound(LeafIndex i, Bound b, bool keeps_to) const;
    [[nodiscard]] PlaneName support_of(LeafIndex i) const {
        const PolygonRef& f = side_face(i).facets[0];
        return PlaneName::support(f.source, f.facet);
    }
    [[nodiscard]] PlaneName plane_at(std::size_t position) const {
        const PolygonRef& f = facets_.cap_at(position);
        return PlaneName::support(f.source, f.facet);
    }
    [[nodiscard]] std::span<int> row(std::size_t layer) {
        return std::span(rows_).subspan(layer * row_size_, row_size_);
    }

    PrismFacets facets_;
    PrismCrossings crossings_;
    PrismComponents components_;
    LeafFormula formula_;
    PoolVector<Step> steps_;
    std::vector<std::size_t> chain_begin_;
    // Where the walk is: a row of the formula for each layer; operands that differ from what is far
    // away; components around it, of any operand but the side face's own.
    std::size_t row_size_ = 0;
    std::vector<int> rows_;
    PoolVector<LeafIndex> changed_;
    std::vector<bool> is_changed_;
    std::vector<std::int32_t> around_;
    std::vector<std::uint8_t> odd_;  // by component
    std::vector<std::int32_t> met_;
    // Of the side face that the walk is at, from its `from` on: where its intervals begin, and what
    // is beside them, from the layer below it to the one above it.
    PoolVector<Bound> begins_;
    PoolVector<Inside> insides_;
    std::size_t layers_here_ = 0;
    // Of the same side face: where the caps are that end it, below and above, and its faces by
    // facing.
    std::array<bool, 2> cap_is_left_{};
    std::array<std::int32_t, 2> faces_here_{};

    PoolVector<CapEdge> cap_edges_;
    NamedOutlines outlines_;
};

}  // namespace trisect::detail

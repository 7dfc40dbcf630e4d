// SPDX-License-Identifier: Apache-2.0
//
// PrismWalk: walks around outlines of prisms, for what bounds a result beside them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/bsp/cells/named_outlines.h>
#include <trisect/bsp/leaf/leaf_formula.h>
#include <trisect/bsp/leaf/prism/prism_components.h>
#include <trisect/bsp/leaf/prism/prism_crossings.h>
#include <trisect/bsp/leaf/prism/prism_facets.h>
#include <trisect/bsp/leaf/prism/prism_names.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

/// Follows the value of a formula along the side faces of outlines, and notes what of them bounds
/// the result. One thread uses it; several may walk around different outlines of the same prisms.
class PrismWalk {
public:
    using Bound = PrismNames::Bound;
    /// A side face in the walk around its outline.
    struct Step {
        LeafIndex side_face = 0;
        bool backwards = false;  // from its `to` to its `from`
    };
    using Chain = std::span<const Step>;
    /// An edge of a face in the plane of a cap, until it is known which components are whole.
    struct CapEdge {
        LeafIndex side_face = 0;
        Bound from = PrismNames::at_from;
        Bound to = PrismNames::at_to;
        std::uint32_t face = 0;       // twice the position, one more if it is up
        std::int32_t component = -1;  // of whose facets it is an edge if they are whole
        bool left = false;            // the face is to the left of the side face
        bool all = false;             // of the side face, where it ends
    };
    /// In the order of the walk.
    struct Found {
        PoolVector<PolygonRef> whole;  ///< facets of side faces
        PoolVector<CapEdge> cap_edges;
        NamedOutlines outlines;
    };

    /// `formula` was started. All must outlive the walk, but for the formula.
    PrismWalk(const PrismFacets& facets, const PrismCrossings& crossings,
              PrismComponents& components, const LeafFormula& formula);

    /// Around one outline. `crossed`: the side faces that a straight way from its beginning to far
    /// away crosses.
    void run(Chain chain, std::span<const LeafIndex> crossed);
    [[nodiscard]] Found& found() { return found_; }

private:
    static constexpr Bound at_from = PrismNames::at_from;
    static constexpr Bound at_to = PrismNames::at_to;
    /// What is inside in a layer: to the left of a side face, and to its right.
    struct Inside {
        bool left = false;
        bool right = false;
        friend bool operator==(const Inside&, const Inside&) = default;
    };
    /// What a side face's face is in one layer.
    enum class Facing : std::uint8_t { None, InsideLeft, InsideRight };
    static Facing facing(const Inside& i) {
        return i.left == i.right ? Facing::None
                                 : (i.left ? Facing::InsideLeft : Facing::InsideRight);
    }
    /// How much of a side face bounds the result: bits for its two halves.
    struct SideFaceState {
        unsigned whole = 0;
        unsigned outlined = 0;
        Facing facing = Facing::None;
    };
    static constexpr unsigned both_halves = 3;
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
    [[nodiscard]] std::uint32_t face_of_wall(const PrismSideFace& w, bool left);
    [[nodiscard]] std::uint32_t face_of_side_face(LeafIndex i, Facing f,
                                                  const SideFaceState& state);
    [[nodiscard]] EdgeName side_of_bound(LeafIndex i, Bound b, bool keeps_to) const;
    [[nodiscard]] std::span<int> row(std::size_t layer) {
        return std::span(rows_).subspan(layer * row_size_, row_size_);
    }

    const PrismFacets* facets_;
    const PrismCrossings* crossings_;
    PrismComponents* components_;
    PrismNames names_;
    LeafFormula formula_;
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
    Found found_;
};

}  // namespace trisect::detail

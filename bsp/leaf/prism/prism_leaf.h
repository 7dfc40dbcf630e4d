// SPDX-License-Identifier: Apache-2.0
//
// Leaf arrangement of prisms along one axis: gears, plates, extruded outlines.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <trisect/bsp/cells/leaf_problem.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/cells/workbench.h>
#include <trisect/bsp/leaf/leaf_arrangement.h>
#include <trisect/bsp/leaf/leaf_formula.h>
#include <trisect/bsp/leaf/prism/prism_crossings.h>
#include <trisect/bsp/leaf/prism/prism_facets.h>

namespace trisect::detail {

/// Arranges a leaf in which all operands are unions of prisms along a common axis and no side faces
/// touch or coincide; caps may coincide as they like. Such leaves may be much larger than others.
/// Keeps its memory from leaf to leaf; what it returns depends on the problem alone.
class PrismLeaf final : public LeafArrangement {
private:
    [[nodiscard]] std::optional<LeafResult> try_to_arrange(const LeafProblem& problem,
                                                           LeafFindings& findings) override;
    // Where an interval of a side face begins or ends: at the crossing side face, or with the side
    // face itself.
    using Bound = LeafIndex;
    static constexpr Bound open = -1;
    struct Interval {
        LeafIndex side_face = 0;
        Bound begin = open;
        Bound end = open;
    };
    // An interval that bounds the result within a layer.
    struct SideFacePart {
        Interval interval;
        std::size_t layer = 0;
        bool inside_left = false;
        bool is_ended = false;  // the next part is apart from it, though it goes on with it
    };
    // What is on one side of an interval, in the layers below and above a position.
    struct Side {
        int below = 0;
        int above = 0;
        LeafIndex representative = -1;  // the first operand of which a cap is there
        [[nodiscard]] bool bounds() const { return below != above; }
        friend bool operator==(const Side&, const Side&) = default;
    };
    using Sides = std::array<Side, 2>;  // left and right of a side face
    struct CapPart {
        WorkPolygon shape;
        bool inside_below = false;
    };
    [[nodiscard]] bool arrange_listed(const LeafProblem& problem, EvaluateStats& stats);
    void walk(LeafIndex side_face, std::size_t position);
    // Sets what is on both sides of the side face at its beginning.
    void start_walk(const PrismSideFace& side_face, std::size_t position);
    void cross(LeafIndex operand, std::size_t layer);
    [[nodiscard]] Sides sides() const;
    void add_interval(const Interval& interval, const Sides& sides, std::size_t position);
    void end_part(const Interval& interval, std::size_t position);
    [[nodiscard]] bool cut_cap(const PrismCap& cap);
    void keep_bench_small();
    [[nodiscard]] std::optional<Side> side_of_middle(const WorkPolygon& part, std::size_t position);
    [[nodiscard]] WorkPolygon cutter_of(const Interval& interval);
    [[nodiscard]] bool is_left(LeafIndex side_face, const FlatCorner& p) const;

    void emit_walls();
    void emit_side_face(std::size_t first, std::size_t last);
    void emit_side_face_part(const SideFacePart& part);
    void emit_cap(const PrismCap& cap, const CapPart& part, bool whole);

    [[nodiscard]] std::span<int> row(std::size_t layer, std::size_t side) {
        return std::span(rows_).subspan((2 * layer + side) * row_size_, row_size_);
    }
    [[nodiscard]] std::uint8_t* insides(std::size_t layer, std::size_t side) {
        return insides_.data() + (2 * layer + side) * operands_;
    }

    EvaluateStats* stats_ = nullptr;
    PrismFacets facets_;
    PrismCrossings crossings_;
    LeafFormula formula_;
    Workbench bench_;
    std::size_t operands_ = 0;
    std::size_t row_size_ = 0;
    bool keeps_common_lines_ = false;  // in which three side faces cross; straight_crossings.h
    // By layer (below or above the position) and side (left or right of the side face).
    std::vector<int> rows_;
    std::vector<std::uint8_t> insides_;
    std::array<std::vector<std::uint64_t>, 2> capped_;  // by side: a bit for each operand
    std::vector<SideFacePart> side_face_parts_;
    std::vector<std::vector<Interval>> outlines_;  // by operand: of what it represents
    std::vector<CapPart> cap_parts_;               // of one cap
    std::vector<PolygonRef> caps_;                 // what of all of them bounds the result
    std::vector<WorkPolygon> parts_;
};

}  // namespace trisect::detail

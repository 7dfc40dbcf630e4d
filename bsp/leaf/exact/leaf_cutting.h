// SPDX-License-Identifier: Apache-2.0
//
// Cutting of polygons of embedded operands, no more than the result needs.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include <trisect/bsp/leaf/exact/leaf_anchors.h>
#include <trisect/bsp/leaf/exact/leaf_windings.h>
#include <trisect/bsp/leaf/leaf_formula.h>
#include <trisect/bsp/leaf/leaf_work.h>

namespace trisect::detail {

/// A part of an item that bounds the result.
struct LeafPart {
    WorkPolygon shape;
    bool inside_above = false;  ///< the result is on the upper side of the item's support
};

/// What is left of an item.
struct LeafRemains {
    enum class Kind {
        Nothing,  ///< bounds nothing here
        Uncut,    ///< all of the item in the cell, which nothing needed to be cut from
        Parts
    };
    Kind kind = Kind::Nothing;
    bool inside_above = false;  ///< of an uncut one
};

/// Cuts an item by the other operands, one after the other. After each of them its parts are looked
/// at: a part on which the formula is decided is not cut further, one that cannot bound the result
/// is dropped, and a cut whose two sides do not differ in what matters is undone. In a union of
/// many solids most parts lie within some other solid; and of n coplanar caps that overlap each
/// other no one is cut into n² parts. Cuts along a line in which three planes meet are kept where
/// faces may go straight across each other there. Scratch memory that is kept from leaf to leaf.
class LeafCutting {
public:
    /// \pre contacts are known, all operands are embedded. `formula` must outlive the leaf.
    /// `keeps_common_lines`: cuts along a line that two cutters have in common with the item, three
    /// planes in all, are not undone (straight_crossings.h).
    void start(LeafWork& work, LeafWindings& windings, LeafAnchors& anchors, LeafFormula& formula,
               bool keeps_common_lines);

    /// An item that another one cuts or overlaps. Its parts are in parts() until the next call.
    [[nodiscard]] LeafRemains cut(LeafIndex item);
    /// An item that nothing cuts or overlaps: does it bound the result?
    [[nodiscard]] LeafRemains whole(LeafIndex item);
    [[nodiscard]] std::span<const LeafPart> parts() const { return kept_; }

private:
    // Rows of the formula above and below a part; unknown where they have not been looked for.
    struct Sides {
        std::vector<int> above;
        std::vector<int> below;
    };
    struct Part {
        WorkPolygon shape;
        Sides sides;
        std::array<double, 3> lo{};  // of a box that contains the shape
        std::array<double, 3> hi{};
        enum class State : std::uint8_t { Open, Kept, Dropped } state = State::Open;
        bool inside_above = false;
    };
    // Where an item's windings are known.
    struct Start {
        std::vector<int> windings;
        Approximation at;
        PointId vertex = -1;  // -1: the middle of the part in the cell
    };

    void set_start(const WorkPolygon& part);
    /// Of an embedded operand's item whose other operands have these winding numbers.
    void set_sides(Sides& sides, const std::vector<int>& windings) const;
    [[nodiscard]] bool may_bound(const Part& part);
    void settle(Part& part);
    void leave_to_representatives();
    void cut_by(LeafIndex operand, std::span<const LeafContact> contacts);
    void split(std::size_t first, std::span<const LeafContact> contacts);
    void split_along_edges(std::size_t first, LeafIndex other);
    void split_along_line(std::size_t first, PlaneId line, LeafIndex cutter, bool sure);
    void set_box(Part& part) const;
    [[nodiscard]] bool is_near(const Part& part, LeafIndex item) const;
    [[nodiscard]] bool is_overlapped(const Part& part, LeafIndex other);
    void find_sides(Part& part, LeafIndex operand, std::span<const LeafContact> contacts);
    [[nodiscard]] bool same_sides(std::size_t first, LeafIndex operand, bool above_matters,
                                  bool below_matters) const;
    [[nodiscard]] std::optional<int> change_to(const WorkPolygon& part,
                                               std::span<const LeafContact> cutters);
    /// Step of the cutter's operand where the way to `end` crosses it; 0 when it does not.
    [[nodiscard]] std::optional<int> crossing(LeafIndex cutter, const Approximation& end);
    [[nodiscard]] LeafRemains remains();
    [[nodiscard]] int traced_winding(const WorkPolygon& part, LeafIndex operand);
    Part& add_part();

    LeafWork* work_ = nullptr;
    LeafWindings* windings_ = nullptr;
    LeafAnchors* anchors_ = nullptr;
    LeafFormula* formula_ = nullptr;
    LeafIndex item_ = -1;
    bool keeps_common_lines_ = false;
    bool is_common_line_ = false;    // of a cutter that splits the item now
    bool has_common_lines_ = false;  // of the item
    Start start_;
    // The last answer of whole(): most items hang together with the one before.
    LeafIndex last_anchor_ = -1;
    int last_key_ = 0;
    LeafRemains last_remains_;
    std::vector<Part> parts_;  // the first count_ are in use
    std::size_t count_ = 0;
    std::vector<LeafPart> kept_;
    std::vector<char> known_;
    std::vector<int> step_;
    std::vector<int> traced_;
    std::vector<int> known_windings_;
};

}  // namespace trisect::detail

// SPDX-License-Identifier: Apache-2.0
//
// Cutting of facets in leaves in general position (filtered_leaf.h).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <trisect/bsp/leaf/doubles/filtered_facets.h>
#include <trisect/bsp/leaf/doubles/filtered_pairs.h>
#include <trisect/bsp/leaf/doubles/filtered_windings.h>
#include <trisect/bsp/leaf/leaf_formula.h>
#include <trisect/kernel/support/flat_map.h>

namespace trisect::detail {

/// A line in the support of an item: first the edges of its outline, then the cell's bounding
/// planes (2 · axis, the upper one 1 more), then its contacts in their order.
using FilteredLine = std::int16_t;
inline constexpr FilteredLine first_splitter_line = FilteredFacet::max_outline;
inline constexpr FilteredLine first_contact_line = first_splitter_line + 6;
/// Stands for the support of the item, where planes are asked for.
inline constexpr FilteredLine own_support = -1;

/// A vertex of a part: where two lines meet.
struct FilteredVertex {
    Approximation at;
    std::array<FilteredLine, 2> lines{-1, -1};
    /// When an edge of a cutter's mesh pierces the item here, so that all its facets pass: its
    /// surface and its ends.
    LeafIndex surface = -1;
    std::array<std::uint32_t, 2> pierced{};
};

/// A convex part of an item, counter-clockwise: `lines[i]` runs from vertex i to the next one.
struct FilteredPart {
    static constexpr std::size_t max_size = 24;
    enum class State : std::uint8_t { Open, Kept, Dropped };

    std::uint8_t size = 0;
    State state = State::Open;
    bool inside_above = false;
    std::int8_t winding = -1;  ///< of the operand that cuts, where a cut has decided it: 0 or 1
    std::uint32_t above = 0;   ///< bit i: the part lies above the plane of line i instead of below
    std::array<std::int16_t, max_size> vertices{};
    std::array<FilteredLine, max_size> lines{};
    std::size_t sides = 0;  ///< place of its winding numbers

    void add(std::int16_t vertex, FilteredLine line, bool is_above) {
        vertices[size] = vertex;
        lines[size] = line;
        above |= static_cast<std::uint32_t>(is_above ? 1 : 0) << size;
        ++size;
    }
};

/// Cuts an item by the other operands, one after the other, and no more than the result needs: what
/// LeafCutting does, on doubles and names. Points on a line have zero distance by name, all others
/// nearly always show in doubles; where planes are nearly parallel the exact predicates decide.
/// Keeps its memory.
class FilteredCutting {
public:
    /// \pre contacts are known. `formula` and `open` must outlive the leaf. `open`: by operand the
    /// winding number where it does not decide the formula by itself; or empty.
    void start(FilteredFacets& facets, const FilteredPairs& pairs, FilteredWindings& windings,
               LeafFormula& formula, std::span<const int> open, EvaluateStats& stats);

    /// What is left of an item. `Uncertain`: doubles cannot decide.
    enum class Remains : std::uint8_t { Uncertain, Nothing, Uncut, Parts };
    struct Result {
        Remains kind = Remains::Nothing;
        bool inside_above = false;  ///< of an uncut one
    };
    /// An item that something crosses. Its parts are in parts() until the next call.
    [[nodiscard]] Result cut(LeafIndex item);
    /// An item that nothing crosses: does it bound the result?
    [[nodiscard]] Result whole(LeafIndex item);
    /// Winding numbers by operand at some point that an item has in the cell; nothing when it may
    /// have none there. `nullopt`: doubles cannot decide. Valid until the next call.
    [[nodiscard]] std::optional<std::span<const int>> windings_on(LeafIndex item);

    [[nodiscard]] std::span<const FilteredPart> parts() const { return {parts_.data(), count_}; }
    /// The polygon of the last item with its part in the cell, or with one of its parts, as its
    /// fragment.
    [[nodiscard]] PolygonRef fragment(const FilteredPart& part);
    /// The part of the last item in the cell.
    [[nodiscard]] const FilteredPart& clipped() const { return clipped_; }
    /// Whether the last items, since start(), were cut along lines in which three planes meet and
    /// faces may go straight across each other (straight_crossings.h). Such cuts are not undone.
    [[nodiscard]] bool found_common_lines() const { return found_common_lines_; }
    /// Whether the cell's bounding planes cut anything off the last item.
    [[nodiscard]] bool was_clipped() const { return was_clipped_; }

private:
    using Signs = std::array<std::int8_t, FilteredPart::max_size>;
    enum class Split : std::uint8_t { Uncertain, Missed, Done };

    void start_item(LeafIndex item);
    [[nodiscard]] bool is_covered(LeafIndex operand, std::span<const int> windings) const;
    [[nodiscard]] bool make_shape();
    [[nodiscard]] bool clip_to_cell();
    [[nodiscard]] bool clip_at(std::size_t axis, bool high);
    void start_at(const FilteredWindings::Anchor& anchor);
    [[nodiscard]] bool add_item();
    [[nodiscard]] bool trace_start();
    [[nodiscard]] bool cut_by(LeafIndex operand, std::size_t begin, std::size_t end);
    [[nodiscard]] Split split(std::size_t part, std::size_t contact, bool sure);
    void divide(const FilteredPart& from, FilteredLine line, const Signs& signs,
                const std::array<std::int16_t, 2>& cuts, FilteredPart& below,
                FilteredPart& above) const;
    [[nodiscard]] bool find_sides(const FilteredPart& part, LeafIndex operand, std::size_t begin,
                                  std::size_t end);
    [[nodiscard]] bool change_to(const FilteredPart& part, int attempt, std::size_t begin,
                                 std::size_t end, int& change);
    [[nodiscard]] bool runs_along(const FilteredPart& part, const Signs& signs,
                                  std::size_t contact) const;
    [[nodiscard]] bool same_sides(std::size_t first, LeafIndex operand, bool above_matters,
                                  bool below_matters) const;
    void set_sides(const FilteredPart& part, std::span<const int> windings);
    void settle(FilteredPart& part);
    [[nodiscard]] Result remains() const;

    [[nodiscard]] const FilteredContact& contact(std::size_t c) const { return contacts_[c]; }
    [[nodiscard]] const FilteredCrossing& crossing_of(std::size_t c) const {
        return pairs_->crossing(contacts_[c].crossing);
    }
    [[nodiscard]] FilteredLine line_of(std::size_t contact) const {
        return static_cast<FilteredLine>(first_contact_line + line_[contact]);
    }
    /// -1, 0, 1: the side of a contact's support on which a corner of the item's outline is.
    [[nodiscard]] int side_of_corner(std::size_t contact, std::size_t corner) const {
        return crossing_of(contact).side_of(contacts_[contact].is_second, corner);
    }
    [[nodiscard]] bool join_coplanar();
    enum class Planes : std::uint8_t { Apart, Same, Opposite };
    [[nodiscard]] Planes compare_planes(LeafIndex a, LeafIndex b);
    [[nodiscard]] Approximation in_lattice(std::int16_t vertex, double extent) const;
    [[nodiscard]] int sign_at(std::int16_t vertex, std::size_t contact);
    [[nodiscard]] int sign_at_middle(const FilteredPart& part, const Approximation& middle,
                                     int attempt, std::size_t contact);
    /// The direction of a contact's line, in which it has what is below on its left.
    [[nodiscard]] LineDirection direction_of(std::size_t contact) const {
        const FilteredPlane& own = facets_->plane(item_);
        return LineDirection(own, facets_->plane(contacts_[contact].other));
    }
    /// The ends of a contact's segment in that direction.
    [[nodiscard]] const FilteredEnd& end_of(std::size_t contact, bool last) const {
        return crossing_of(contact).ends[contacts_[contact].is_second != last ? 1 : 0];
    }
    [[nodiscard]] bool is_inside_end(std::int16_t vertex, std::size_t contact, bool last,
                                     const LineDirection& direction);
    [[nodiscard]] PlaneName plane_of(FilteredLine line) const;
    [[nodiscard]] std::size_t made_plane(FilteredLine line);
    [[nodiscard]] int exact_sign(std::int16_t vertex, const Plane& plane);
    [[nodiscard]] Approximation exact_point(const std::array<FilteredLine, 2>& lines);
    [[nodiscard]] bool passes(const FilteredVertex& vertex, std::size_t contact) const;
    [[nodiscard]] bool is_end(const FilteredVertex& vertex, std::size_t contact,
                              const FilteredEnd& end) const;
    void name_pierced_edge(FilteredVertex& vertex) const;
    [[nodiscard]] Approximation middle_of(const FilteredPart& part, int attempt) const;
    [[nodiscard]] std::span<int> above(const FilteredPart& p) { return {&sides_[p.sides], row_}; }
    [[nodiscard]] std::span<int> below(const FilteredPart& p) {
        return {&sides_[p.sides + row_], row_};
    }
    FilteredPart& add_part();

    FilteredFacets* facets_ = nullptr;
    const FilteredPairs* pairs_ = nullptr;
    FilteredWindings* windings_ = nullptr;
    LeafFormula* formula_ = nullptr;
    std::span<const int> open_;
    EvaluateStats* stats_ = nullptr;
    bool keeps_common_lines_ = false;
    bool is_common_line_ = false;      // of a cutter of the part that is cut now
    bool has_common_lines_ = false;    // of the item
    bool found_common_lines_ = false;  // of some item
    std::size_t n_ = 0;                // operands
    std::size_t row_ = 0;              // of the formula
    LeafIndex item_ = -1;
    std::span<const FilteredContact> contacts_;
    std::vector<std::int16_t> line_;  // of a contact: the first one in the same plane
    std::vector<FilteredVertex> vertices_;
    // Of the item, where doubles do not decide: planes of lines, which are asked for again and
    // again, and the signs of vertices at contacts, and 1.
    std::vector<Plane> planes_;
    std::vector<std::int32_t> plane_of_line_;  // by line, the item's support first; -1: not made
    FlatMap exact_signs_;
    std::vector<FilteredPart> parts_;  // the first count_ are in use
    std::size_t count_ = 0;
    std::vector<int> sides_;  // rows above and below one part after the other
    FilteredPart clipped_;
    bool was_clipped_ = false;
    // Where the item's windings are known, and on which side of every contact that is.
    std::vector<int> start_windings_;
    std::vector<int> known_windings_;
    Approximation start_;
    std::vector<std::int8_t> start_sides_;
    // Of a fragment in the making: local ones would be filled with zeros first.
    std::array<EdgeName, FilteredPart::max_size> edges_;
    std::array<Approximation, FilteredPart::max_size> corners_;
    // Answers of whole(): most items have windings that were looked at before.
    struct Answer {
        LeafIndex windings = -1;
        int key = 0;
        Result result;
    };
    std::array<Answer, 8> answers_;
};

}  // namespace trisect::detail

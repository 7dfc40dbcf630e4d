// SPDX-License-Identifier: Apache-2.0
//
// LeafWork: shared data of the steps of a leaf arrangement.
// It has the polygons, their properties and the pieces that they are cut into.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <trisect/bsp/cells/leaf_problem.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/cells/workbench.h>
#include <trisect/kernel/support/as_index.h>

namespace trisect::detail {

/// A polygon of the leaf.
struct LeafItem {
    PolygonRef ref;
    Box box;  ///< of the polygon, within the cell
    LeafIndex operand = 0;
    LeafIndex surface = 0;          ///< one number for each operand and source in it
    std::int8_t orientation = 1;    ///< -1 when flipped
    std::int8_t side_of_reference;  ///< of the support, see LeafWindings; 2 = not computed
    bool contained = false;         ///< lies in the cell
    bool cut = false;               ///< another one runs through its interior
    bool overlapped = false;        ///< another one in its plane shares interior with it
    WorkPolygon shape;              ///< unclipped; made on demand

    [[nodiscard]] bool is_whole() const { return !cut && !overlapped; }
};

/// Contact of an item with another one, of another surface. Facets that merely share an edge or a
/// corner of their mesh have none.
struct LeafContact {
    LeafIndex other = 0;
    bool cuts = false;      ///< the other one runs through the item's interior
    bool overlaps = false;  ///< coplanar, interiors meet
};

/// A convex part of an item, on one side of everything else.
struct LeafPiece {
    LeafIndex item = 0;
    /// How winding numbers change across, as an index into `steps`; -1 when only the item's own
    /// operand changes.
    LeafIndex step = -1;
    bool dropped = false;  ///< a coincident piece represents it
    WorkPolygon shape;
};

struct LeafWork {
    Workbench bench;
    const LeafProblem* problem = nullptr;
    EvaluateStats* stats = nullptr;
    std::vector<LeafItem> items;
    std::vector<LeafPiece> pieces;  ///< those of one item in a row, items ascending
    std::vector<std::vector<int>> steps;
    std::vector<FacetName> incomplete;

    /// Forgets the last leaf and lists the polygons of this one.
    void start(const LeafProblem& leaf, EvaluateStats& counters);
    [[nodiscard]] LeafIndex item_count() const { return static_cast<LeafIndex>(items.size()); }
    [[nodiscard]] LeafItem& item(LeafIndex i) { return items[as_index(i)]; }
    [[nodiscard]] const LeafItem& item(LeafIndex i) const { return items[as_index(i)]; }
    [[nodiscard]] const LeafOperand& operand_of(const LeafItem& i) const {
        return problem->operands[as_index(i.operand)];
    }
    /// The polygon with its corners. Most facets of a leaf meet nothing and never need them.
    const WorkPolygon& shape(LeafIndex i) {
        LeafItem& it = item(i);
        if (it.shape.is_empty()) it.shape = bench.polygon(it.ref);
        return it.shape;
    }
    /// The polygon with its edge planes.
    const WorkPolygon& with_edges(LeafIndex i) {
        (void)shape(i);
        bench.with_edges(item(i).shape, item(i).ref);
        return item(i).shape;
    }
    /// Contacts of an item, by ascending `other`.
    [[nodiscard]] std::span<const LeafContact> contacts(LeafIndex i) const {
        return {contacts_.data() + first_contact_[as_index(i)],
                contacts_.data() + first_contact_[as_index(i) + 1]};
    }
    /// Takes (item, contact) pairs in any order.
    void set_contacts(std::span<const std::pair<LeafIndex, LeafContact>> pairs);

private:
    void add_operand(LeafIndex operand);
    [[nodiscard]] LeafIndex surface_of(const Source* source, LeafIndex operand);

    std::vector<LeafContact> contacts_;
    std::vector<std::size_t> first_contact_;
    FlatMap surfaces_;
};

}  // namespace trisect::detail

// SPDX-License-Identifier: Apache-2.0
//
// CellTree: the persistent partition behind a Solid. Its inner nodes cut space by axis-aligned
// walls, its leaves list the polygons of the boundary that meet their cell. Nodes are immutable and
// shared by all versions of a solid that agree there; an operation copies the paths to what it
// changes.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include <trisect/bsp/detail/cell.h>
#include <trisect/bsp/detail/source.h>

namespace trisect::detail {

/// The plane of a polygon's edge, by name: names survive when their polygon moves between cells and
/// versions, and equal names are equal planes without arithmetic.
struct PlaneName {
    enum Kind : std::uint32_t { Edge0, Edge1, Edge2, Support, Wall };

    std::uint64_t owner = 0;  ///< address of the Source, or the wall's position
    std::uint32_t facet = 0;  ///< facet of the source, or the wall's axis
    std::uint32_t kind = Support;

    [[nodiscard]] static PlaneName support(const Source* s, std::uint32_t facet) {
        return {reinterpret_cast<std::uintptr_t>(s), facet, Support};
    }
    [[nodiscard]] static PlaneName edge(const Source* s, std::uint32_t facet, int i) {
        return {reinterpret_cast<std::uintptr_t>(s), facet, static_cast<std::uint32_t>(i)};
    }
    [[nodiscard]] static PlaneName wall(int axis, std::int64_t position) {
        return {static_cast<std::uint64_t>(position), static_cast<std::uint32_t>(axis), Wall};
    }
    [[nodiscard]] bool is_wall() const { return kind == Wall; }
    [[nodiscard]] bool is_edge() const { return kind <= Edge2; }
    [[nodiscard]] const Source* source() const {
        return is_wall() ? nullptr : reinterpret_cast<const Source*>(owner);
    }
    [[nodiscard]] std::int64_t position() const { return static_cast<std::int64_t>(owner); }
    [[nodiscard]] Plane plane() const;

    friend bool operator==(const PlaneName&, const PlaneName&) = default;
};

/// An edge of a polygon: the polygon lies below the named plane, or above it.
struct EdgeName {
    PlaneName plane;
    bool above = false;
    friend bool operator==(const EdgeName&, const EdgeName&) = default;
};

/// A convex part of a facet, cut out by an operation. Edges counter-clockwise seen from above the
/// facet's support; consecutive edges lie on different lines. Immutable, reference-counted by the
/// leaves that list it.
class Fragment {
public:
    Fragment(std::vector<EdgeName> edges, const Box& box);
    Fragment(const Fragment&) = delete;
    Fragment& operator=(const Fragment&) = delete;
    [[nodiscard]] std::span<const EdgeName> edges() const { return edges_; }
    /// Contains the fragment, rounded outwards to lattice units.
    [[nodiscard]] const Box& box() const { return box_; }

    void retain() const { count_.fetch_add(1, std::memory_order_relaxed); }
    void release() const {
        if (count_.fetch_sub(1, std::memory_order_acq_rel) == 1) delete this;
    }

private:
    ~Fragment();
    std::vector<EdgeName> edges_;
    Box box_;
    mutable std::atomic<std::uint32_t> count_{0};
};

/// A polygon in a cell: a whole facet (its clipping by the cell is implied, not carried out) or a
/// fragment. `flipped` turns its orientation. A whole facet that an arrangement listed is `touched`
/// when something of another surface comes into contact with it, so that vertices may lie in its
/// edges. Trivial type; whoever stores it keeps its fragment.
///
/// A whole facet that reaches into several cells is whole in all of them or in none: an arrangement
/// that meets a facet which anything cuts, be it outside its cell, lists the facet's clipped part.
struct PolygonRef {
    const Source* source = nullptr;
    const Fragment* fragment = nullptr;
    std::uint32_t facet = 0;
    bool flipped = false;
    bool touched = false;

    [[nodiscard]] const Box& box() const {
        return fragment != nullptr ? fragment->box() : source->facet_box(facet);
    }
};

/// An owning list of polygons: keeps their fragments and sources.
class PolygonList {
public:
    PolygonList() = default;
    explicit PolygonList(std::vector<PolygonRef> refs);
    PolygonList(const PolygonList&) = delete;
    PolygonList& operator=(const PolygonList&) = delete;
    PolygonList(PolygonList&& o) noexcept : refs_(std::exchange(o.refs_, {})) {}
    PolygonList& operator=(PolygonList&& o) noexcept {
        std::swap(refs_, o.refs_);
        return *this;
    }
    ~PolygonList();
    [[nodiscard]] std::span<const PolygonRef> refs() const { return refs_; }

private:
    std::vector<PolygonRef> refs_;
};

class CellNode;

/// A shared subtree, or its complement.
struct CellRef {
    std::shared_ptr<const CellNode> node;
    bool complemented = false;
};

/// A node of the tree. Either it has a wall and two children, or it is a leaf.
///
/// Invariants of a leaf: `reference` lies in its cell and on no polygon; `winding` is the winding
/// number there (0 or 1 for results of operations); every polygon of the boundary that meets the
/// open cell is listed. A leaf without polygons is homogeneous. `mixed` leaves hold polygons that
/// an arrangement produced; vertices may lie in the middle of their edges.
class CellNode {
public:
    static std::shared_ptr<const CellNode> leaf(PolygonList polygons, const FinePoint& reference,
                                                int winding, bool mixed);
    /// All facets of a source, unrefined.
    static std::shared_ptr<const CellNode> fresh(const Source& source, const FinePoint& reference,
                                                 int winding, bool mixed);
    static std::shared_ptr<const CellNode> split(int axis, std::int64_t wall, CellRef below,
                                                 CellRef above);
    ~CellNode();
    CellNode(const CellNode&) = delete;
    CellNode& operator=(const CellNode&) = delete;

    [[nodiscard]] bool is_leaf() const { return axis_ < 0; }
    [[nodiscard]] int axis() const { return axis_; }
    [[nodiscard]] std::int64_t wall() const { return wall_; }
    [[nodiscard]] const CellRef& child(int i) const { return child_[static_cast<std::size_t>(i)]; }
    [[nodiscard]] std::span<const PolygonRef> polygons() const { return polygons_.refs(); }
    [[nodiscard]] const FinePoint& reference() const { return reference_; }
    [[nodiscard]] int winding() const { return winding_; }
    [[nodiscard]] bool is_mixed() const { return mixed_; }
    /// Polygons listed in all leaves below.
    [[nodiscard]] std::uint64_t size() const { return size_; }

private:
    CellNode() = default;

    int axis_ = -1;
    std::int64_t wall_ = 0;
    std::array<CellRef, 2> child_;
    PolygonList polygons_;
    FinePoint reference_;
    int winding_ = 0;
    bool mixed_ = false;
    std::uint64_t size_ = 0;
};

}  // namespace trisect::detail

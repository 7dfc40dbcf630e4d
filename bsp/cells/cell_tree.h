// SPDX-License-Identifier: Apache-2.0
//
// CellTree: the persistent space partition behind a Solid.
// Inner nodes divide space by axis-perpendicular splitting planes; leaves list the polygons of
// the boundary that meet their cell. Nodes are immutable and shared by all versions of a solid
// that agree there; an operation copies the paths to what it changes.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <memory>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include <trisect/bsp/cells/cell.h>
#include <trisect/bsp/cells/node_fact.h>
#include <trisect/bsp/cells/source.h>
#include <trisect/kernel/predicates.h>
#include <trisect/kernel/support/work_lock.h>

namespace trisect::detail {

/// The plane of a polygon's edge, by name: names survive when their polygon moves between cells and
/// versions, and equal names are equal planes without arithmetic.
struct PlaneName {
    enum Kind : std::uint32_t { Edge0, Edge1, Edge2, Support, SplittingPlane };

    std::uint64_t owner = 0;  ///< address of the Source, or the splitting plane's position
    std::uint32_t facet = 0;  ///< facet of the source, or the splitting plane's axis
    std::uint32_t kind = Support;

    [[nodiscard]] static PlaneName support(const Source* s, std::uint32_t facet) {
        return {reinterpret_cast<std::uintptr_t>(s), facet, Support};
    }
    [[nodiscard]] static PlaneName edge(const Source* s, std::uint32_t facet, int i) {
        return {reinterpret_cast<std::uintptr_t>(s), facet, static_cast<std::uint32_t>(i)};
    }
    [[nodiscard]] static PlaneName splitter(int axis, std::int64_t position) {
        return {static_cast<std::uint64_t>(position), static_cast<std::uint32_t>(axis),
                SplittingPlane};
    }
    [[nodiscard]] bool is_splitter() const { return kind == SplittingPlane; }
    [[nodiscard]] bool is_edge() const { return kind <= Edge2; }
    [[nodiscard]] const Source* source() const {
        return is_splitter() ? nullptr : reinterpret_cast<const Source*>(owner);
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
/// facet's support; consecutive edges lie on different lines. Its vertices are what the edges'
/// planes say; their doubles are stored for later. Immutable, reference-counted by the leaves that
/// list it. One piece of memory.
class Fragment {
public:
    /// A fragment without owners yet. `vertices[i]` is where edge i begins, in lattice units.
    [[nodiscard]] static const Fragment* make(std::span<const EdgeName> edges,
                                              std::span<const Approximation> vertices,
                                              const Box& box);
    Fragment(const Fragment&) = delete;
    Fragment& operator=(const Fragment&) = delete;
    [[nodiscard]] std::span<const EdgeName> edges() const {
        return {reinterpret_cast<const EdgeName*>(this + 1), size_};
    }
    [[nodiscard]] std::span<const Approximation> vertices() const {
        return {reinterpret_cast<const Approximation*>(edges().data() + size_), size_};
    }
    /// Contains the fragment, rounded outwards to lattice units.
    [[nodiscard]] const Box& box() const { return box_; }
    /// Of memory.
    [[nodiscard]] std::size_t bytes() const { return bytes_for(size_); }

    void retain() const { count_.fetch_add(1, std::memory_order_relaxed); }
    void release() const {
        if (count_.fetch_sub(1, std::memory_order_acq_rel) == 1) destroy();
    }

private:
    Fragment(std::size_t size, const Box& box)
        : box_(box), size_(static_cast<std::uint32_t>(size)) {}
    ~Fragment() = default;
    [[nodiscard]] static constexpr std::size_t bytes_for(std::size_t size) {
        return sizeof(Fragment) + size * (sizeof(EdgeName) + sizeof(Approximation));
    }
    void destroy() const;

    Box box_;
    std::uint32_t size_;
    mutable std::atomic<std::uint32_t> count_{0};
    // The edges follow, then the vertices.
};
static_assert(sizeof(Fragment) % alignof(EdgeName) == 0 &&
              alignof(EdgeName) == alignof(Approximation));

/// A polygon in a cell: a whole facet (its clipping by the cell is implied, not carried out) or a
/// fragment. `flipped` turns its orientation. A whole facet that an arrangement listed is `touched`
/// when something of another surface comes into contact with it, so that vertices may lie in its
/// edges. Trivial type; its owner keeps the fragment.
///
/// What cuts or touches a facet in one cell need not show in its other cells: it may be listed
/// whole there. Where any cell lists a fragment of it, it counts in each cell for what is of it
/// there.
struct PolygonRef {
    const Source* source = nullptr;
    const Fragment* fragment = nullptr;
    std::uint32_t facet = 0;
    bool flipped = false;
    bool touched = false;

    [[nodiscard]] Box box() const {
        return fragment != nullptr ? fragment->box() : source->facet_box(facet);
    }
};

/// The polygons of a leaf; keeps their fragments and sources. Immutable.
///
/// Most lists are facets of one mesh that nothing has cut or touched. Those are stored as facet
/// numbers only, four bytes each, and a list of all facets of a source stores none. A polygon is
/// therefore yielded by value.
class PolygonList {
public:
    PolygonList() = default;
    explicit PolygonList(std::vector<PolygonRef> refs);
    /// All facets of a source.
    static PolygonList all_facets(const Source& source);
    /// Whole facets of a source that nothing has touched. The first `contained` of them lie in the
    /// list's cell; of the others only the boxes are known to meet it.
    static PolygonList whole_facets(const Source& source, bool flipped,
                                    std::span<const std::uint32_t> facets, std::size_t contained);
    PolygonList(const PolygonList&) = delete;
    PolygonList& operator=(const PolygonList&) = delete;
    PolygonList(PolygonList&& o) noexcept { swap(o); }
    PolygonList& operator=(PolygonList&& o) noexcept {
        swap(o);
        return *this;
    }
    ~PolygonList();

    [[nodiscard]] std::size_t size() const { return count_; }
    [[nodiscard]] bool empty() const { return count_ == 0; }
    [[nodiscard]] PolygonRef operator[](std::size_t i) const {
        if (source_ == nullptr) return refs_[i];
        return {source_, nullptr, facets_ ? facets_[i] : static_cast<std::uint32_t>(i), flipped_,
                false};
    }

    class Iterator {
    public:
        using iterator_category = std::input_iterator_tag;
        using value_type = PolygonRef;
        using difference_type = std::ptrdiff_t;
        using pointer = void;
        using reference = PolygonRef;
        Iterator(const PolygonList* list, std::size_t i) : list_(list), i_(i) {}
        PolygonRef operator*() const { return (*list_)[i_]; }
        Iterator& operator++() {
            ++i_;
            return *this;
        }
        Iterator operator++(int) { return {list_, i_++}; }
        friend bool operator==(const Iterator&, const Iterator&) = default;

    private:
        const PolygonList* list_;
        std::size_t i_;
    };
    [[nodiscard]] Iterator begin() const { return {this, 0}; }
    [[nodiscard]] Iterator end() const { return {this, count_}; }

    /// The one source of a list of whole, untouched facets of equal orientation; else null.
    [[nodiscard]] const Source* whole_source() const { return source_; }
    /// For a list with a whole_source(): whether it has all facets of the source, in their order.
    [[nodiscard]] bool has_all_facets() const { return source_ != nullptr && !facets_; }
    /// Facet numbers of a list with a whole_source() that has not all facets.
    [[nodiscard]] std::span<const std::uint32_t> facets() const {
        return {facets_.get(), facets_ ? count_ : 0};
    }
    [[nodiscard]] bool flipped() const { return flipped_; }
    /// The first so many facets of a list with a whole_source() lie in the cell.
    [[nodiscard]] std::size_t contained() const { return contained_; }
    /// Memory behind the list.
    [[nodiscard]] std::size_t bytes() const {
        return refs_.capacity() * sizeof(PolygonRef) + facets().size_bytes();
    }

private:
    void swap(PolygonList& o) noexcept {
        std::swap(source_, o.source_);
        std::swap(facets_, o.facets_);
        std::swap(count_, o.count_);
        std::swap(contained_, o.contained_);
        std::swap(flipped_, o.flipped_);
        std::swap(refs_, o.refs_);
    }

    const Source* source_ = nullptr;
    std::unique_ptr<std::uint32_t[]> facets_;
    std::size_t count_ = 0;
    std::size_t contained_ = 0;
    bool flipped_ = false;
    std::vector<PolygonRef> refs_;
};

class CellNode;
class DeferredLeaf;

/// A shared subtree, or its complement.
struct CellRef {
    std::shared_ptr<const CellNode> node;
    bool complemented = false;
};

/// A node of the tree. Either it has a splitting plane and two children, or it is a leaf. A leaf
/// may get a refinement: the same cell with children, made once when a question needs it and kept
/// with the leaf, so that all versions that share the leaf share it too.
///
/// Invariants of a leaf: `reference` lies in its cell and on no polygon; `winding` is the winding
/// number there (0 or 1 for results of operations); every polygon of the boundary that meets the
/// open cell is listed. A leaf without polygons is homogeneous. `mixed` leaves hold polygons that
/// an arrangement produced; vertices may lie in the middle of their edges. A whole facet may be
/// listed because its box meets the cell while it does not itself; such a facet need not be part of
/// the boundary. It is one only if the leaf whose cell holds its first corner lists it.
class CellNode : public std::enable_shared_from_this<CellNode> {
public:
    static std::shared_ptr<const CellNode> leaf(PolygonList polygons, const FinePoint& reference,
                                                int winding, bool mixed);
    /// A mixed leaf that cuts its facets on the first use of its polygons. `size`: about how many
    /// they are, and not 0.
    static std::shared_ptr<const CellNode> deferred(std::unique_ptr<const DeferredLeaf> leaf,
                                                    int winding, std::uint64_t size);
    /// All facets of a source, unrefined.
    static std::shared_ptr<const CellNode> fresh(const Source& source, const FinePoint& reference,
                                                 int winding, bool mixed);
    static std::shared_ptr<const CellNode> split(int axis, std::int64_t splitter, CellRef below,
                                                 CellRef above);
    ~CellNode();
    CellNode(const CellNode&) = delete;
    CellNode& operator=(const CellNode&) = delete;

    [[nodiscard]] bool is_leaf() const { return axis_ < 0; }
    [[nodiscard]] int axis() const { return axis_; }
    [[nodiscard]] std::int64_t splitter() const { return splitter_; }
    [[nodiscard]] const CellRef& child(int i) const { return child_[static_cast<std::size_t>(i)]; }
    /// Safe from any thread; of a deferred leaf they stay where they are once they are made.
    [[nodiscard]] const PolygonList& polygons() const {
        if (deferred_ != nullptr && !is_arranged_.load(std::memory_order_acquire)) arrange();
        return polygons_;
    }
    /// How a leaf that was deferred was put, whether its polygons were requested or not.
    [[nodiscard]] const DeferredLeaf* deferred() const { return deferred_.get(); }
    [[nodiscard]] const FinePoint& reference() const { return reference_; }
    [[nodiscard]] int winding() const { return winding_; }
    [[nodiscard]] bool is_mixed() const { return mixed_; }
    /// Polygons listed in all leaves below, about so many of deferred leaves. 0 only where nothing
    /// is listed.
    [[nodiscard]] std::uint64_t size() const { return size_; }

    /// What is derived from the node, see NodeFact.
    [[nodiscard]] const FactSlot& bounds_fact() const { return bounds_fact_; }
    [[nodiscard]] const FactSlot& index_fact() const { return index_fact_; }
    [[nodiscard]] const FactSlot& boxes_fact() const { return boxes_fact_; }

    /// Of a leaf: the same cell with children, if someone has made them.
    [[nodiscard]] const CellNode* refinement() const {
        return refinement_.load(std::memory_order_acquire);
    }
    /// Of a leaf: whether it was compared as a whole with a far smaller operand. The next such
    /// operand refines it.
    [[nodiscard]] bool was_compared() const {
        return was_compared_.load(std::memory_order_relaxed);
    }
    void note_comparison() const { was_compared_.store(true, std::memory_order_relaxed); }
    /// Publishes what `make()` returns as the leaf's refinement, unless there is one; returns the
    /// one there is. Nothing is published when `make()` returns null.
    template <class Make>
    const CellNode* refine(Make&& make) const {
        const WorkLock lock(refining_);
        if (refinement() == nullptr) {
            kept_refinement_ = make();
            refinement_.store(kept_refinement_.get(), std::memory_order_release);
        }
        return refinement();
    }

private:
    CellNode() = default;
    void arrange() const;

    int axis_ = -1;
    std::int64_t splitter_ = 0;
    std::array<CellRef, 2> child_;
    mutable PolygonList polygons_;
    std::unique_ptr<const DeferredLeaf> deferred_;
    mutable std::atomic<bool> is_arranged_{false};
    mutable std::atomic<bool> was_compared_{false};
    FinePoint reference_;
    int winding_ = 0;
    bool mixed_ = false;
    std::uint64_t size_ = 0;
    FactSlot bounds_fact_;
    FactSlot index_fact_;
    FactSlot boxes_fact_;
    mutable std::atomic<const CellNode*> refinement_{nullptr};
    mutable std::shared_ptr<const CellNode> kept_refinement_;
    mutable std::mutex refining_;
};

}  // namespace trisect::detail

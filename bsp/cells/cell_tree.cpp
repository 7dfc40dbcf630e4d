// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/cells/cell_tree.h>

#include <algorithm>
#include <memory>
#include <new>

#include <trisect/bsp/cells/deferred_leaf.h>
#include <trisect/kernel/contract.h>
#include <trisect/kernel/support/work_lock.h>

namespace trisect::detail {

Plane PlaneName::plane() const {
    if (is_splitter())
        return Plane::axis_aligned(static_cast<int>(facet), splitting_scale, position());
    const Source* s = source();
    return kind == Support ? s->support(facet) : s->edge_plane(facet, static_cast<int>(kind));
}

const Fragment* Fragment::make(std::span<const EdgeName> edges,
                               std::span<const Approximation> vertices, const Box& box) {
    TRISECT_EXPECTS(edges.size() == vertices.size(), "a fragment has a vertex for each edge");
    void* memory = ::operator new(bytes_for(edges.size()));
    const auto* out = new (memory) Fragment(edges.size(), box);
    std::uninitialized_copy(edges.begin(), edges.end(), const_cast<EdgeName*>(out->edges().data()));
    std::uninitialized_copy(vertices.begin(), vertices.end(),
                            const_cast<Approximation*>(out->vertices().data()));
    for (const EdgeName& e : edges)
        if (const Source* s = e.plane.source()) s->retain();
    return out;
}

void Fragment::destroy() const {
    for (const EdgeName& e : edges())
        if (const Source* s = e.plane.source()) s->release();
    this->~Fragment();
    ::operator delete(const_cast<Fragment*>(this));
}

PolygonList::PolygonList(std::vector<PolygonRef> refs)
    : count_(refs.size()), refs_(std::move(refs)) {
    // Neighbours in a list mostly share their source: one count for every run of equal sources.
    const Source* last = nullptr;
    for (const PolygonRef& r : refs_) {
        if (r.fragment != nullptr) r.fragment->retain();
        if (r.source != last) r.source->retain();
        last = r.source;
    }
}

PolygonList PolygonList::all_facets(const Source& source) {
    PolygonList list;
    list.source_ = &source;
    source.retain();
    list.count_ = source.facet_count();
    list.contained_ = list.count_;
    return list;
}

PolygonList PolygonList::whole_facets(const Source& source, bool flipped,
                                      std::span<const std::uint32_t> facets,
                                      std::size_t contained) {
    PolygonList list;
    if (facets.empty()) return list;
    list.source_ = &source;
    source.retain();
    list.facets_ = std::make_unique_for_overwrite<std::uint32_t[]>(facets.size());
    std::copy(facets.begin(), facets.end(), list.facets_.get());
    list.count_ = facets.size();
    list.contained_ = contained;
    list.flipped_ = flipped;
    return list;
}

PolygonList::~PolygonList() {
    if (source_ != nullptr) source_->release();
    const Source* last = nullptr;
    for (const PolygonRef& r : refs_) {
        if (r.fragment != nullptr) r.fragment->release();
        if (r.source != last) r.source->release();
        last = r.source;
    }
}

std::shared_ptr<const CellNode> CellNode::leaf(PolygonList polygons, const FinePoint& reference,
                                               int winding, bool mixed) {
    struct Made : CellNode {};  // with its counts in one piece of memory
    const auto n = std::make_shared<Made>();
    n->polygons_ = std::move(polygons);
    n->reference_ = reference;
    n->winding_ = winding;
    n->mixed_ = mixed;
    n->size_ = n->polygons_.size();
    return n;
}

std::shared_ptr<const CellNode> CellNode::deferred(std::unique_ptr<const DeferredLeaf> leaf,
                                                   int winding, std::uint64_t size) {
    struct Made : CellNode {};  // with its counts in one piece of memory
    const auto n = std::make_shared<Made>();
    n->reference_ = leaf->reference;
    n->deferred_ = std::move(leaf);
    n->winding_ = winding;
    n->mixed_ = true;
    n->size_ = size;
    return n;
}

void CellNode::arrange() const {
    const WorkLock lock(deferred_->arranging());
    if (is_arranged_.load(std::memory_order_relaxed)) return;
    polygons_ = deferred_->arrange(*deferred_);
    is_arranged_.store(true, std::memory_order_release);
}

std::shared_ptr<const CellNode> CellNode::fresh(const Source& source, const FinePoint& reference,
                                                int winding, bool mixed) {
    return leaf(PolygonList::all_facets(source), reference, winding, mixed);
}

std::shared_ptr<const CellNode> CellNode::split(int axis, std::int64_t splitter, CellRef below,
                                                CellRef above) {
    TRISECT_EXPECTS(may_be_splitter(splitter), "a splitter must lie at a third of a unit");
    struct Made : CellNode {};  // with its counts in one piece of memory
    const auto n = std::make_shared<Made>();
    n->axis_ = axis;
    n->splitter_ = splitter;
    n->size_ = below.node->size() + above.node->size();
    n->child_ = {std::move(below), std::move(above)};
    return n;
}

// A chain of cuts along a part makes trees as deep as the chain is long. So nodes end one by one,
// and those to come hang on a pointer that a node of their kind does not use: no memory is needed.
CellNode::~CellNode() {
    using Ref = std::shared_ptr<const CellNode>;
    const auto unused_pointer = [](CellNode& n) -> Ref& {
        return n.is_leaf() ? n.child_[0].node : n.kept_refinement_;
    };
    Ref doomed;
    const auto doom = [&](Ref& ref) {
        if (ref == nullptr || ref.use_count() != 1) return ref.reset();
        Ref n = std::move(ref);
        unused_pointer(const_cast<CellNode&>(*n)) = std::move(doomed);  // not shared any more
        doomed = std::move(n);
    };
    const auto doom_children = [&](CellNode& n) {
        if (n.is_leaf()) return doom(n.kept_refinement_);
        for (CellRef& c : n.child_) doom(c.node);
    };
    doom_children(*this);
    while (doomed != nullptr) {
        const Ref n = std::move(doomed);
        auto& node = const_cast<CellNode&>(*n);
        doomed = std::move(unused_pointer(node));
        doom_children(node);
    }
}

}  // namespace trisect::detail

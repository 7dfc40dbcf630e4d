// SPDX-License-Identifier: Apache-2.0
//
// Splitters lie at thirds of a unit and stay there under quarter turns, mirrors and translations by
// units; so the tree keeps its shape. What has a name is renamed: sources become moved sources,
// edges of fragments planes of these, splitters moved splitters. A mirror turns the order of
// corners over, and then the first and the last edge of a triangle change places.

#include <trisect/bsp/solid/moved_tree.h>

#include <algorithm>
#include <numeric>
#include <unordered_map>
#include <utility>
#include <vector>

#include <trisect/kernel/support/deep_recursion.h>

namespace trisect::detail {

namespace {

class TreeMover {
public:
    explicit TreeMover(const LatticeMove& move) : move_(move), is_mirror_(move.is_mirror()) {}

    [[nodiscard]] CellRef moved(const CellRef& ref) {
        const CellNode& node = *ref.node;
        return {node.is_leaf() ? moved_leaf(node) : moved_split(node), ref.complemented};
    }
    [[nodiscard]] std::vector<FacetName> moved(std::span<const FacetName> names) const {
        std::unordered_map<std::uint64_t, std::uint64_t> serials;
        for (const auto& [from, to] : sources_) serials.emplace(from->serial(), to->serial());
        std::vector<FacetName> out;
        for (const FacetName& n : names)
            if (const auto at = serials.find(n.serial); at != serials.end())
                out.push_back({at->second, n.facet});
        std::ranges::sort(out);
        return out;
    }

private:
    std::shared_ptr<const CellNode> moved_split(const CellNode& node) {
        CellRef below = with_enough_stack([&] { return moved(node.child(0)); });
        CellRef above = with_enough_stack([&] { return moved(node.child(1)); });
        const int axis = move_.image_of_axis(node.axis());
        if (move_.turns_over(axis)) std::swap(below, above);
        return CellNode::split(axis, move_.applied_to_wall(node.axis(), node.splitter()),
                               std::move(below), std::move(above));
    }

    std::shared_ptr<const CellNode> moved_leaf(const CellNode& node) {
        return CellNode::leaf(moved(node.polygons()), move_.applied(node.reference()),
                              node.winding(), node.is_mixed());
    }

    PolygonList moved(const PolygonList& list) {
        if (list.whole_source() != nullptr) return moved_whole(list);
        std::vector<PolygonRef> refs;
        refs.reserve(list.size());
        const KeepFragments keep(refs);
        for (const PolygonRef& r : list) {
            PolygonRef made = r;
            made.source = moved(r.source);
            if (r.fragment != nullptr) {
                made.fragment = moved(*r.fragment);
                made.fragment->retain();
            }
            refs.push_back(made);  // there is room
        }
        return PolygonList(refs);
    }

    PolygonList moved_whole(const PolygonList& list) {
        const Source& source = *moved(list.whole_source());
        if (!list.has_all_facets())
            return PolygonList::whole_facets(source, list.flipped(), list.facets(),
                                             list.contained());
        if (!list.flipped()) return PolygonList::all_facets(source);
        std::vector<std::uint32_t> all(list.size());
        std::iota(all.begin(), all.end(), 0U);
        return PolygonList::whole_facets(source, true, all, all.size());
    }

    // Holds fragments until a list does.
    struct KeepFragments {
        explicit KeepFragments(const std::vector<PolygonRef>& kept) : refs(kept) {}
        KeepFragments(const KeepFragments&) = delete;
        KeepFragments& operator=(const KeepFragments&) = delete;
        ~KeepFragments() {
            for (const PolygonRef& r : refs)
                if (r.fragment != nullptr) r.fragment->release();
        }
        const std::vector<PolygonRef>& refs;
    };

    const Source* moved(const Source* source) {
        auto& out = sources_[source];
        if (out == nullptr) out = source->moved(move_);
        return out.get();
    }

    // Edge i begins at vertex i, in both orders.
    const Fragment* moved(const Fragment& f) {
        const auto old = f.edges();
        const std::size_t n = old.size();
        std::vector<EdgeName> edges;
        std::vector<Approximation> vertices;
        edges.reserve(n);
        vertices.reserve(n);
        for (std::size_t i = 0; i < n; ++i) {
            edges.push_back(moved(old[is_mirror_ ? n - 1 - i : i]));
            vertices.push_back(move_.applied(f.vertices()[is_mirror_ ? (n - i) % n : i]));
        }
        return Fragment::make(edges, vertices, move_.applied(f.box()));
    }

    EdgeName moved(EdgeName e) {
        if (e.plane.is_splitter()) {
            const auto axis = static_cast<int>(e.plane.facet);
            const int image = move_.image_of_axis(axis);
            e.plane = PlaneName::splitter(image, move_.applied_to_wall(axis, e.plane.position()));
            e.above = e.above != move_.turns_over(image);
            return e;
        }
        e.plane.owner = reinterpret_cast<std::uintptr_t>(moved(e.plane.source()));
        if (is_mirror_ && e.plane.kind == PlaneName::Edge0) {
            e.plane.kind = PlaneName::Edge2;
        } else if (is_mirror_ && e.plane.kind == PlaneName::Edge2) {
            e.plane.kind = PlaneName::Edge0;
        }
        return e;
    }

    LatticeMove move_;
    bool is_mirror_;
    std::unordered_map<const Source*, std::shared_ptr<const Source>> sources_;
};

}  // namespace

Box box_of(const CellRef& root) {
    Box box;
    std::vector<const CellNode*> pending{root.node.get()};
    while (!pending.empty()) {
        const CellNode& n = *pending.back();
        pending.pop_back();
        if (n.is_leaf()) {
            for (const PolygonRef& r : n.polygons())
                if (r.fragment != nullptr || !r.source->is_unbounded()) box.add(r.box());
        } else {
            for (int i = 0; i < 2; ++i) pending.push_back(n.child(i).node.get());
        }
    }
    return box;
}

std::shared_ptr<const SolidState> moved_state(const SolidState& state, const LatticeMove& move) {
    TreeMover mover(move);
    auto out = std::make_shared<SolidState>(state);
    // The root first: it moves the sources that are named.
    CellRef root = mover.moved(state.root());
    const bool turns_over = std::ranges::min(move.sign) < 0;
    const bool has_usual_offsets =
        root.node->is_leaf() || (state.tree().has_usual_offsets && !turns_over);
    out->form = CellTree{std::move(root), mover.moved(state.tree().incomplete), nullptr,
                         state.tree().may_have_straight_crossings, has_usual_offsets};
    return out;
}

}  // namespace trisect::detail

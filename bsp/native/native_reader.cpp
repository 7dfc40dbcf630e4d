// SPDX-License-Identifier: Apache-2.0
//
// Nodes are in preorder, so children have larger numbers than their parents: cells are found by one
// pass forwards, nodes are made by one pass backwards, and no depth costs stack.

#include <trisect/bsp/native/native_reader.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include <trisect/bsp/native/native_box.h>
#include <trisect/bsp/native/native_fragments.h>
#include <trisect/bsp/native/native_names.h>
#include <trisect/bsp/native/native_records.h>
#include <trisect/bsp/native/native_sources.h>
#include <trisect/kernel/support/parallel_parts.h>

namespace trisect::detail {

namespace {

using Section = NativeSection;

// A splitting plane within a cell.
void require_splitting(const NativeView& view, std::uint64_t number, const NodeRecord& n,
                       const Cell& cell) {
    if (n.position <= cell.lo[n.axis] || n.position >= cell.hi[n.axis])
        view.fail(Section::Nodes, number, "a splitting plane outside its cell");
    if (n.above <= number + 1 || n.above >= view.header().count(Section::Nodes))
        view.fail(Section::Nodes, number, "a node whose child is not there");
}

// What a pass over the nodes finds.
struct NativeNodes {
    std::vector<NodeRecord> nodes;
    std::vector<Cell> cells;             // by leaf
    std::vector<std::uint64_t> of_leaf;  // its node
};

class NodeReader {
public:
    NodeReader(const NativeView& view, std::uint64_t depth) : view_(view), depth_(depth) {}

    NativeNodes read() {
        const NativeHeader& header = view_.header();
        const std::uint64_t n = header.count(Section::Nodes);
        if (header.depth > depth_)
            throw LimitError(view_.name() + ": a tree of depth " + std::to_string(header.depth) +
                             ", deeper than the limit of " + std::to_string(depth_));
        pending_.push_back({0, Cell{}, 1});
        for (std::uint64_t i = 0; i < n; ++i) visit(i);
        if (!pending_.empty()) view_.fail(Section::Nodes, n, "a tree that is not complete");
        if (deepest_ != header.depth) view_.fail(native_place::depth, "a tree of another depth");
        if (out_.cells.size() != header.count(Section::Cells))
            view_.fail(Section::Cells, 0, "another number of cells than the tree has");
        return std::move(out_);
    }

private:
    struct Pending {
        std::uint64_t number = 0;
        Cell cell;
        std::uint64_t depth = 0;
        std::uint64_t parent = 0;  // with this node above its splitting plane; else its own number
    };

    void visit(std::uint64_t number) {
        if (pending_.empty() || pending_.back().number != number)
            view_.fail(Section::Nodes, number, "a node that is no child");
        const Pending here = pending_.back();
        pending_.pop_back();
        deepest_ = std::max(deepest_, here.depth);
        if (here.depth > view_.header().depth)
            view_.fail(Section::Nodes, number, "a node deeper than the header says");
        if (here.parent != here.number && out_.nodes[here.parent].leaf != out_.cells.size())
            view_.fail(Section::Nodes, here.parent, "a node with a wrong number of a cell");
        const NodeRecord n = node_record(view_, number);
        out_.nodes.push_back(n);
        if (n.is_leaf()) {
            if (n.leaf != out_.cells.size() || n.above != 0 || n.position != 0)
                view_.fail(Section::Nodes, number, "a cell with a wrong number");
            out_.cells.push_back(here.cell);
            out_.of_leaf.push_back(number);
            return;
        }
        require_splitting(view_, number, n, here.cell);
        const int axis = static_cast<int>(n.axis);
        pending_.push_back({n.above, here.cell.above(axis, n.position), here.depth + 1, number});
        pending_.push_back(
            {number + 1, here.cell.below(axis, n.position), here.depth + 1, number + 1});
    }

    const NativeView& view_;
    std::uint64_t depth_;
    std::vector<Pending> pending_;
    std::uint64_t deepest_ = 0;
    NativeNodes out_;
};

class Reader {
public:
    Reader(const NativeView& view, std::uint64_t depth, std::uint32_t threads)
        : view_(view), depth_(depth), threads_(threads) {}

    std::shared_ptr<const SolidState> read(bool fresh_names) {
        view_.check_all(threads_);
        records_ = source_records(view_);
        tree_ = NodeReader(view_, depth_).read();
        read_cell_records();
        const NativeNameMap names(view_, records_, fresh_names);
        sources_ = read_sources(view_, records_, names, threads_);
        fragments_ = std::make_unique<NativeFragments>(view_, sources_, threads_);
        make_leaves();
        return make_state(names);
    }

private:
    using NodePtr = std::shared_ptr<const CellNode>;

    // Lists follow each other without gaps.
    void read_cell_records() {
        const std::uint64_t n = view_.header().count(Section::Cells);
        cells_.reserve(n);
        std::uint64_t facets = 0;
        std::uint64_t polygons = 0;
        std::uint64_t listed = 0;
        for (std::uint64_t i = 0; i < n; ++i) {
            const CellRecord c = cell_record(view_, i);
            std::uint64_t none = 0;
            std::uint64_t& next = c.kind == NativeList::WholeFacets ? facets
                                  : c.kind == NativeList::Polygons  ? polygons
                                                                    : none;
            const bool is_next = c.first == next;
            next += c.count;
            listed += c.count;
            if (!is_next || !tree_.cells[i].contains(c.reference) ||
                (c.kind == NativeList::AllFacets && c.count != records_[c.source].facets()))
                view_.fail(Section::Cells, i,
                           is_next ? "a cell without its reference point or all facets"
                                   : "a list that does not begin where the last one ends");
            const bool is_whole =
                c.kind == NativeList::AllFacets || c.kind == NativeList::WholeFacets;
            if (is_whole && records_[c.source].has_planes && !records_[c.source].is_half_space())
                view_.fail(Section::Cells, i, "a cell that lists planes as facets");
            cells_.push_back(c);
        }
        if (facets != view_.header().count(Section::Facets) ||
            polygons != view_.header().count(Section::Polygons))
            view_.fail(native_place::counts, "the file has more polygons than its cells have");
        if (listed != view_.header().polygons)
            view_.fail(native_place::polygons, "another number of polygons than the cells have");
    }

    void make_leaves() {
        leaves_.resize(cells_.size());
        const ParallelParts parts(leaves_.size(), threads_, 64);
        std::vector<Box> boxes(parts.count());
        parts.for_each([&](std::size_t part, std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                leaves_[i] = leaf(i);
                add_listed(boxes[part], leaves_[i]->polygons());
            }
        });
        Box box;
        for (const Box& b : boxes) box.add(b);
        if (box != view_.header().box) view_.fail(native_place::box, "another box than the cells'");
    }

    [[nodiscard]] NodePtr leaf(std::size_t number) const {
        const NodeRecord& node = tree_.nodes[tree_.of_leaf[number]];
        return CellNode::leaf(list(number), cells_[number].reference, node.winding,
                              (node.flags & NativeNodeFlag::mixed) != 0);
    }

    [[nodiscard]] PolygonList list(std::size_t number) const {
        const CellRecord& c = cells_[number];
        switch (c.kind) {
            case NativeList::None:
                return {};
            case NativeList::AllFacets:
                require_contained(number, sources_[c.source]->box());
                return PolygonList::all_facets(*sources_[c.source]);
            case NativeList::WholeFacets:
                return whole_facets(number);
            case NativeList::Polygons:
                return polygons(c);
        }
        return {};
    }

    void require_contained(std::size_t cell, const Box& box) const {
        if (!tree_.cells[cell].contains(box))
            view_.fail(Section::Cells, cell, "a facet that reaches out of a cell");
    }

    [[nodiscard]] PolygonList whole_facets(std::size_t number) const {
        const CellRecord& c = cells_[number];
        const Source& source = *sources_[c.source];
        std::vector<std::uint32_t> facets(c.count);
        NativeCursor from(view_.records(Section::Facets, c.first, c.count));
        for (std::size_t i = 0; i < facets.size(); ++i) {
            facets[i] = from.next<std::uint32_t>();
            if (facets[i] >= source.facet_count())
                view_.fail(Section::Facets, c.first + i, "a facet that is not there");
            if (i < c.contained) require_contained(number, source.facet_box(facets[i]));
        }
        return PolygonList::whole_facets(source, c.flipped, facets, c.contained);
    }

    [[nodiscard]] PolygonList polygons(const CellRecord& c) const {
        std::vector<PolygonRef> refs(c.count);
        for (std::uint64_t i = 0; i < c.count; ++i) {
            const PolygonRecord p = polygon_record(view_, c.first + i, records_);
            const Fragment* const fragment =
                p.fragment == 0 ? nullptr : fragments_->at(p.fragment - 1, p.source, p.facet);
            refs[i] = {sources_[p.source].get(), fragment, p.facet, p.flipped, p.touched};
        }
        return PolygonList(std::move(refs));
    }

    [[nodiscard]] CellRef make_tree() {
        std::vector<NodePtr> made(tree_.nodes.size());
        for (std::size_t i = made.size(); i-- > 0;) {
            const NodeRecord& n = tree_.nodes[i];
            if (n.is_leaf()) {
                made[i] = std::move(leaves_[n.leaf]);
                continue;
            }
            const auto is_set = [&n](unsigned flag) { return (n.flags & flag) != 0; };
            made[i] = CellNode::split(
                static_cast<int>(n.axis), n.position,
                {std::move(made[i + 1]), is_set(NativeNodeFlag::below_complemented)},
                {std::move(made[n.above]), is_set(NativeNodeFlag::above_complemented)});
        }
        return {std::move(made[0]), has(NativeFlag::complemented)};
    }

    [[nodiscard]] bool has(std::uint32_t flag) const { return (view_.header().flags & flag) != 0; }

    [[nodiscard]] std::shared_ptr<const SolidState> make_state(const NativeNameMap& names) {
        const NativeHeader& header = view_.header();
        auto state = std::make_shared<SolidState>();
        CellTree tree;
        tree.root = make_tree();
        tree.incomplete = incomplete();
        tree.may_have_straight_crossings = has(NativeFlag::straight_crossings);
        tree.has_usual_offsets = has(NativeFlag::usual_offsets);
        state->lattice = Lattice{header.exponent};
        state->embedded = has(NativeFlag::embedded);
        state->whole = has(NativeFlag::whole);
        state->lattice_matters = has(NativeFlag::lattice_matters);
        state->far_out = static_cast<std::int8_t>(header.far_out);
        const CellNode& root = *tree.root.node;
        if (header.source != 0) {
            if (!root.is_leaf() || root.size() == 0)
                view_.fail(native_place::source, "an import that is not one cell");
            state->source = names(header.source);
        }
        state->form = std::move(tree);
        check_flags(*state);
        return state;
    }

    // What follows from the tree, as far as anything depends on it.
    void check_flags(const SolidState& state) const {
        const bool whole = std::ranges::all_of(
            sources_, [](const auto& s) { return s->is_half_space() || s->is_whole(); });
        const bool usual = std::ranges::all_of(tree_.nodes, [](const NodeRecord& n) {
            const std::int64_t rest =
                (n.position % splitting_scale + splitting_scale) % splitting_scale;
            return n.is_leaf() || rest == usual_splitting_offset;
        });
        if ((state.whole && !whole) || (state.tree().has_usual_offsets && !usual) ||
            (!usual && !whole) || (!state.lattice_matters && !sources_.empty()))
            view_.fail(native_place::flags, "flags that contradict the tree");
    }

    [[nodiscard]] std::vector<FacetName> incomplete() const {
        const std::uint64_t n = view_.header().count(Section::Incomplete);
        std::vector<FacetName> out;
        out.reserve(n);
        NativeCursor from(view_.records(Section::Incomplete, 0, n));
        for (std::uint64_t i = 0; i < n; ++i) {
            const auto source = from.next<std::uint32_t>();
            const auto facet = from.next<std::uint32_t>();
            if (source >= sources_.size() || facet >= sources_[source]->facet_count() ||
                (source > 0 && records_[source].same_serial))
                view_.fail(Section::Incomplete, i, "a facet that is not there");
            const FacetName name{sources_[source]->serial(), facet};
            if (!out.empty() && name < out.back())
                view_.fail(Section::Incomplete, i, "a facet out of order");
            out.push_back(name);
        }
        return out;
    }

    const NativeView& view_;
    std::uint64_t depth_;
    std::uint32_t threads_;
    std::vector<SourceRecord> records_;
    std::vector<std::shared_ptr<const Source>> sources_;
    std::unique_ptr<NativeFragments> fragments_;
    NativeNodes tree_;
    std::vector<CellRecord> cells_;
    std::vector<NodePtr> leaves_;
};

}  // namespace

std::shared_ptr<const SolidState> read_native_state(const NativeView& view, bool fresh_names,
                                                    std::uint64_t depth, std::uint32_t threads) {
    return Reader(view, depth, threads).read(fresh_names);
}

NativeLeafPlace find_leaf(const NativeView& view, std::uint64_t leaf) {
    NativeLeafPlace at;
    at.complemented = (view.header().flags & NativeFlag::complemented) != 0;
    for (;;) {
        const NodeRecord n = node_record(view, at.node);
        if (n.is_leaf()) {
            if (n.leaf != leaf) view.fail(Section::Nodes, at.node, "a cell with a wrong number");
            return at;
        }
        require_splitting(view, at.node, n, at.cell);
        const int axis = static_cast<int>(n.axis);
        const bool above = leaf >= n.leaf;
        at.cell = above ? at.cell.above(axis, n.position) : at.cell.below(axis, n.position);
        const unsigned flag =
            above ? NativeNodeFlag::above_complemented : NativeNodeFlag::below_complemented;
        at.complemented = at.complemented != ((n.flags & flag) != 0);
        at.node = above ? n.above : at.node + 1;
    }
}

}  // namespace trisect::detail

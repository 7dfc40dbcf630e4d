// SPDX-License-Identifier: Apache-2.0
//
// Which facets need work: fragments, and whole facets that something touches in a cell, because
// vertices may lie in their edges. A facet without either is whole in every cell that it reaches
// into (see PolygonRef) and passes through as it is: one byte is all that is ever written for it.
// The others are turned into convex parts with exact vertices, one for every cell.
//
// Vertices are identified by name as they are made (Workbench::meet), then by value: points whose
// certified doubles are close are compared exactly (equal_points.cpp). A second stage is
// indispensable: where several planes run through one point its names differ.
//
// T-vertices are found leaf by leaf. Every polygon that touches a closed cell is listed there, so
// the vertices of the leaf are all that can lie on an edge inside it. That keeps a search that is
// quadratic in the worst case down to a few dozen candidates.

#include <trisect/bsp/assembly/assembly_parts.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <span>
#include <utility>
#include <variant>

#include <trisect/bsp/assembly/axis/axis_faces.h>
#include <trisect/bsp/assembly/equal_points.h>
#include <trisect/bsp/assembly/list_marks.h>
#include <trisect/bsp/assembly/parts/crossing_faces.h>
#include <trisect/bsp/assembly/parts/edge_splitter.h>
#include <trisect/bsp/assembly/parts/fragment_group.h>
#include <trisect/bsp/assembly/parts/outline_edges.h>
#include <trisect/bsp/assembly/parts/sheets.h>
#include <trisect/bsp/assembly/traced/outlined_edges.h>
#include <trisect/bsp/assembly/traced/traced_facets.h>
#include <trisect/bsp/cells/deferred_leaf.h>
#include <trisect/bsp/cells/lazy_tree.h>
#include <trisect/bsp/cells/named_outlines.h>
#include <trisect/bsp/cells/polygon_in_cell.h>
#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/stop_scope.h>
#include <trisect/kernel/support/as_index.h>
#include <trisect/kernel/support/deep_recursion.h>
#include <trisect/kernel/support/parallel_parts.h>
#include <trisect/kernel/support/per_thread.h>
#include <trisect/kernel/support/pool_allocator.h>
#include <trisect/kernel/support/task_group.h>

namespace trisect::detail {

namespace {

struct AssembledLeaf {
    const CellNode* node = nullptr;
    bool complemented = false;
    Cell cell;
    std::size_t first_edge = 0;
    std::size_t end_edge = 0;
    std::size_t first_inside = 0;  // of inside_
    std::size_t end_inside = 0;
};

class Gatherer {
public:
    Gatherer(const SolidState& solid, BoundaryParts& out, bool by_planes, std::uint32_t threads)
        : solid_(solid),
          out_(out),
          by_planes_(by_planes),
          threads_(threads),
          splitter_(out.bench, out.facets) {}

    /// False where it takes the tree of the solid.
    [[nodiscard]] bool run() {
        std::visit([&](const auto& form) { gather(form); }, solid_.form);
        if (needs_tree_) return false;
        return finish() && (!may_cross_straight_ || find_lacking_crossings(out_));
    }

private:
    // One for each form: marks facets and lists leaves of which parts may be needed.
    void gather(const CellTree& tree);
    void gather(const UndividedMeshes& meshes);
    void gather(const PrismOutlines& prisms);
    void gather(const FlatPrism&) { needs_tree_ = true; }
    [[nodiscard]] bool finish();
    void list_leaves(const CellNode& node, bool complemented, const Cell& cell);
    [[nodiscard]] const DeferredLeaf* deferred(const AssembledLeaf& leaf) const;
    [[nodiscard]] const OccupancyGrid* occupancy(const AssembledLeaf& leaf) const;
    void mark_facets(const AssembledLeaf& leaf);
    void mark_leaves();
    void mark_crossed(const Crossings& crossings);
    void mark_special(const Crossings& crossings);
    [[nodiscard]] bool needs_parts(const DeferredLeaf& leaf) const;
    [[nodiscard]] bool needs_parts(const AssembledLeaf& leaf, const OccupancyGrid& occupancy) const;
    void mark_uncrossed(std::span<const UncrossedFacets> lists);
    void mark_outlines(const NamedOutlines& outlines);
    void mark_outlined(const UndividedMeshes& meshes);
    void add_outlined_edges(const UndividedMeshes& meshes);
    void number_facets();
    void reserve_names() {
        if (out_.facets.empty()) return;  // all pass through
        out_.bench.reserve(4 * out_.facets.size(), 3 * out_.facets.size());
    }
    // In special position planes and corners are not found by name (traced_facets.h).
    void reserve_names(const Crossings& crossings) {
        if (crossings.special.empty()) return reserve_names();
        // Each place where an edge pierces a facet is in two pairs.
        out_.bench.reserve_points_on_edges(4 * out_.facets.size(), out_.facets.size(),
                                           crossings.pairs.size());
    }
    void make_parts(AssembledLeaf& leaf);
    void make_list_parts(const AssembledLeaf& leaf);
    void make_part(const PolygonRef& ref, const AssembledLeaf& leaf, std::int32_t facet);
    void make_group(std::span<const PolygonRef> group, const AssembledLeaf& leaf,
                    std::int32_t facet);
    void note_part(const AssembledLeaf& leaf, BoundaryFacet& facet);
    void add_corners_near(std::span<const PointId> points, const PolygonRef& ref);
    void choose_axis_faces();
    void make_axis_faces();
    [[nodiscard]] bool conform_edges(std::size_t traced, std::size_t of_leaves);
    [[nodiscard]] bool conform_traced(std::span<BoundaryEdge> edges);
    void conform_leaves();
    void conform_leaf(const AssembledLeaf& leaf, EdgeSplitter& splitter, BoundaryEdges& out) const;
    [[nodiscard]] std::size_t table(const Source* source);
    void mark_incomplete(FacetMarks& marks) const;

    const SolidState& solid_;
    BoundaryParts& out_;
    bool by_planes_;
    std::uint32_t threads_;
    std::span<const FacetName> incomplete_;  // of a tree
    bool needs_tree_ = false;
    bool may_cross_straight_ = false;  // faces of outlines
    bool may_have_sheets_ = false;
    std::uint64_t first_serial_ = 0;  // of the mesh that stands for both where they have facets in
                                      // common; these may pass through
    bool defers_ = false;             // crossings of all leaves in general position are known
    PoolVector<AssembledLeaf> leaves_;
    ListMarks lists_;
    std::size_t last_table_ = 0;
    // Of traced facets, then of the parts, leaf by leaf, then of axis-perpendicular planes.
    BoundaryEdges edges_;
    std::unique_ptr<AxisFaces> axis_faces_;
    PoolVector<PointId> inside_;  // vertices of the latter that may lie inside edges of parts
    PoolVector<PointId> same_;
    EdgeSplitter splitter_;
    // Of the group of fragments in the making.
    FragmentGroup fragments_;
    std::vector<PolygonRef> group_;
    PoolVector<PlaneId> planes_;
    PoolVector<PointId> points_;
};

void Gatherer::gather(const CellTree& tree) {
    incomplete_ = tree.incomplete;
    out_.may_have_straight_crossings = tree.may_have_straight_crossings;
    defers_ = tree.crossings != nullptr;
    list_leaves(*tree.root.node, tree.root.complemented, Cell{});
    mark_leaves();
    if (defers_) mark_crossed(*tree.crossings);
    number_facets();
    reserve_names();
    if (defers_) trace_facets(*tree.crossings, out_, edges_, threads_);
}

// Facets whose outlines doubles do not decide are left to the parts of the tree; all of them where
// some are in special position, since vertices of others may lie inside their edges.
void Gatherer::gather(const UndividedMeshes& meshes) {
    first_serial_ = meshes.crossings->operands[0].serial;
    may_cross_straight_ = meshes.may_have_straight_crossings;
    may_have_sheets_ = meshes.may_have_sheets;
    if (meshes.equal_corners != nullptr) {
        out_.equal_corners = meshes.equal_corners.get();
        for (std::size_t i = 0; i < 2; ++i) {
            out_.equal_sources[i] = meshes.uncrossed[i].source;
            (void)table(meshes.uncrossed[i].source);
        }
    }
    for (const UndividedMeshes* m = &meshes; m != nullptr; m = m->beside.get()) {
        mark_uncrossed(m->uncrossed);
        mark_crossed(*m->crossings);
        mark_special(*m->crossings);
    }
    if (meshes.outlined != nullptr) mark_outlined(meshes);
    number_facets();
    if (meshes.outlined != nullptr) {
        add_outlined_edges(meshes);
    } else {
        reserve_names(*meshes.crossings);
        for (const UndividedMeshes* m = &meshes; m != nullptr; m = m->beside.get())
            trace_facets(*m->crossings, out_, edges_, threads_);
    }
    if (out_.stats.traced_facets == out_.facets.size()) {
        out_.are_general = meshes.outlined != nullptr && meshes.crossings->special.empty();
        return;
    }
    needs_tree_ = !meshes.crossings->special.empty() || meshes.beside != nullptr;
    if (needs_tree_) return;
    const CellTree& tree = meshes.tree->cut()->tree();
    defers_ = tree.crossings != nullptr;
    list_leaves(*tree.root.node, tree.root.complemented, Cell{});
}

void Gatherer::gather(const PrismOutlines& prisms) {
    list_leaves(*prisms.whole, false, Cell{});
    const NamedOutlines& outlines = *prisms.outlines;
    check_stop(outlines.edges.size());
    OutlineNames names;
    const auto name = [&] { names = name_outlines(outlines, out_.bench); };
    constexpr std::size_t least_edges = 4096;
    if (threads_ == 1 || outlines.edges.size() < least_edges) {
        mark_leaves();
        name();
    } else {
        both_at_once([&] { mark_leaves(); }, name);
    }
    mark_outlines(outlines);
    number_facets();
    add_outlines(outlines, std::move(names), out_, edges_);
}

// False where it takes the tree of the solid.
bool Gatherer::finish() {
    const std::size_t traced = edges_.size();
    axis_faces_ = AxisFaces::of(out_, threads_);
    if (by_planes_ && traced == 0) choose_axis_faces();
    for (AssembledLeaf& leaf : leaves_) {
        if (out_.stats.traced_facets == out_.facets.size()) break;
        check_stop(1 + leaf.node->size());
        make_parts(leaf);
    }
    const std::size_t of_leaves = edges_.size();
    make_axis_faces();
    if (!may_have_sheets_) out_.bench.end_points();
    same_ = axis_faces_->takes_all() ? points_as_named(out_)
                                     : representatives(out_, first_serial_, threads_);
    check_stop(edges_.size());
    if (!conform_edges(traced, of_leaves)) return false;
    if (may_have_sheets_) out_.bench.end_points();
    out_.representatives = std::move(same_);
    out_.are_joined = axis_faces_->takes_all();
    out_.stats.leaves = leaves_.size();
    out_.stats.axis_facets = axis_faces_->taken_count();
    out_.stats.axis_leaves = axis_faces_->read_count();
    out_.stats.parts += axis_faces_->part_count();
    out_.stats.worked_facets = out_.facets.size();
    out_.stats.edges = out_.edges.size();
    return true;
}

void Gatherer::mark_leaves() {
    for (const AssembledLeaf& leaf : leaves_) {
        check_stop(1 + leaf.node->size());
        mark_facets(leaf);
    }
    lists_.mark(out_.sources, threads_);
}

std::size_t Gatherer::table(const Source* source) {
    auto& tables = out_.sources;
    if (last_table_ < tables.size() && tables[last_table_].source() == source) return last_table_;
    const auto next = static_cast<std::int32_t>(tables.size());
    const auto [id, inserted] = out_.table_ids.insert(BoundaryParts::key_of(source), next);
    if (inserted) mark_incomplete(tables.emplace_back(source));
    return last_table_ = as_index(id);
}

void Gatherer::mark_incomplete(FacetMarks& marks) const {
    const std::uint64_t serial = marks.source()->serial();
    auto at = std::ranges::lower_bound(incomplete_, FacetName{serial, 0});
    for (; at != incomplete_.end() && at->serial == serial; ++at)
        for (const bool flipped : {false, true}) marks.set_worked(at->facet, flipped);
}

void Gatherer::list_leaves(const CellNode& node, bool complemented, const Cell& cell) {
    if (node.is_leaf()) {
        if (node.size() != 0) leaves_.push_back({&node, complemented, cell});
        return;
    }
    for (int i = 0; i < 2; ++i) {
        const CellRef& c = node.child(i);
        const Cell part = i == 0 ? cell.below(node.axis(), node.splitter())
                                 : cell.above(node.axis(), node.splitter());
        with_enough_stack([&] { list_leaves(*c.node, c.complemented != complemented, part); });
    }
}

// Whether a whole facet that a leaf lists bounds the result. It may be listed in cells that it
// passes by; the one of its first corner counts, and is not looked for any more once it was found.
// Of a facet that is worked on anyway every cell is looked at.
bool is_owned(const Cell& cell, const FacetMarks& marks, std::uint32_t facet, bool flipped) {
    return marks.is_present(facet, flipped) || marks.is_worked(facet, flipped) ||
           cell.contains(Box::of(marks.source()->corner(facet, 0)));
}

// Where the crossings of all leaves are known, those that were deferred stay so.
const DeferredLeaf* Gatherer::deferred(const AssembledLeaf& leaf) const {
    const DeferredLeaf* const d = leaf.node->deferred();
    return defers_ && d != nullptr && d->uncrossed() != nullptr ? d : nullptr;
}

// Where planes are outlined as a whole.
const OccupancyGrid* Gatherer::occupancy(const AssembledLeaf& leaf) const {
    const DeferredLeaf* const d = leaf.node->deferred();
    return by_planes_ && d != nullptr ? d->occupancy() : nullptr;
}

void Gatherer::mark_crossed(const Crossings& crossings) {
    std::vector<std::pair<std::uint64_t, FacetMarks*>> by_serial;
    for (FacetMarks& marks : out_.sources) by_serial.emplace_back(marks.source()->serial(), &marks);
    std::ranges::sort(by_serial);
    auto facet = crossings.shown.begin();
    for (std::size_t i = 0; i < crossings.operands.size(); ++i) {
        const Crossings::Operand& o = crossings.operands[i];
        const auto end =
            i + 1 < crossings.operands.size()
                ? std::lower_bound(facet, crossings.shown.end(), crossings.operands[i + 1].first)
                : crossings.shown.end();
        if (facet == end) continue;
        const auto at = std::ranges::lower_bound(by_serial, o.serial, {},
                                                 &std::pair<std::uint64_t, FacetMarks*>::first);
        FacetMarks* const marks =
            at != by_serial.end() && at->first == o.serial ? at->second : nullptr;
        for (; facet != end; ++facet) {
            if (marks == nullptr) continue;
            marks->set_present(*facet - o.first, o.inside_above);
            marks->set_worked(*facet - o.first, o.inside_above);
        }
    }
}

// Vertices of others may lie inside their edges.
void Gatherer::mark_special(const Crossings& crossings) {
    std::size_t slot = crossings.operands.size();
    auto marks = out_.sources.end();
    for (const std::uint32_t number : crossings.special) {
        const std::size_t next = crossings.operand_of(number);
        const Crossings::Operand& o = crossings.operands[next];
        if (std::exchange(slot, next) != next)
            marks = std::ranges::find(out_.sources, o.serial,
                                      [](const FacetMarks& m) { return m.source()->serial(); });
        const std::uint32_t facet = number - o.first;
        if (marks != out_.sources.end() && marks->is_present(facet, o.inside_above))
            marks->set_worked(facet, o.inside_above);
    }
}

void Gatherer::mark_facets(const AssembledLeaf& leaf) {
    const DeferredLeaf* const deferred = this->deferred(leaf);
    if (deferred != nullptr)
        for (const auto& o : deferred->operands) (void)table(o.polygons.whole_source());
    const OccupancyGrid* const occupancy = this->occupancy(leaf);
    const PolygonList& polygons = deferred != nullptr    ? *deferred->uncrossed()
                                  : occupancy != nullptr ? occupancy->facets
                                                         : leaf.node->polygons();
    if (const Source* source = polygons.whole_source();
        source != nullptr && !source->is_half_space()) {
        const std::size_t number = table(source);
        lists_.note(polygons, leaf.cell, leaf.complemented, number, out_.sources[number]);
        return;
    }
    constexpr std::size_t ahead = 8;
    for (std::size_t i = 0; i < polygons.size(); ++i) {
        // What is_owned() reads of them lies anywhere in memory.
        if (i + 2 * ahead < polygons.size()) {
            const PolygonRef next = polygons[i + 2 * ahead];
            if (!next.source->is_half_space())
                __builtin_prefetch(&next.source->mesh().triangles[next.facet]);
        }
        if (i + ahead < polygons.size()) {
            const PolygonRef next = polygons[i + ahead];
            if (!next.source->is_half_space())
                __builtin_prefetch(&next.source->corner(next.facet, 0));
        }
        const PolygonRef r = polygons[i];
        FacetMarks& marks = out_.sources[table(r.source)];
        const bool flipped = r.flipped != leaf.complemented;
        const bool plain = r.fragment == nullptr && !r.touched && !r.source->is_half_space();
        if (!plain) {
            marks.set_present(r.facet, flipped);
            marks.set_worked(r.facet, flipped);
        } else if (is_owned(leaf.cell, marks, r.facet, flipped)) {
            marks.set_present(r.facet, flipped);
        }
    }
}

void Gatherer::mark_uncrossed(std::span<const UncrossedFacets> lists) {
    for (const UncrossedFacets& list : lists) {
        FacetMarks& marks = out_.sources[table(list.source)];
        constexpr std::size_t least_part = 16384;
        ParallelParts(list.facets.size(), threads_, least_part)
            .for_each([&](std::size_t, std::size_t begin, std::size_t end) {
                for (const std::uint32_t f : std::span(list.facets).subspan(begin, end - begin))
                    marks.set_present(f, list.flipped);
            });
    }
}

void Gatherer::mark_outlines(const NamedOutlines& outlines) {
    for (const NamedOutlines::Face& f : outlines.faces) {
        FacetMarks& marks = out_.sources[table(f.source)];
        marks.set_present(f.facet, f.flipped);
        marks.set_worked(f.facet, f.flipped);
    }
    for (const NamedOutlines::Edge& e : outlines.edges)
        if (e.from.corner >= 0) (void)table(e.from.planes[0].source());
}

// Facets come in the order of the operands.
void Gatherer::mark_outlined(const UndividedMeshes& meshes) {
    const auto& operands = meshes.crossings->operands;
    std::size_t slot = 0;
    for (const OutlinedFacets::Facet& f : meshes.outlined->facets) {
        while (slot + 1 < operands.size() && operands[slot + 1].first <= f.number) ++slot;
        FacetMarks& marks = out_.sources[table(meshes.uncrossed[slot].source)];
        marks.set_present(f.number - operands[slot].first, operands[slot].inside_above);
        marks.set_worked(f.number - operands[slot].first, operands[slot].inside_above);
    }
}

void Gatherer::add_outlined_edges(const UndividedMeshes& meshes) {
    std::vector<const Source*> sources;
    for (const UncrossedFacets& list : meshes.uncrossed) sources.push_back(list.source);
    add_outlined(*meshes.outlined, *meshes.crossings, sources, out_, edges_, threads_);
}

void Gatherer::number_facets() {
    auto& tables = out_.sources;
    std::stable_sort(tables.begin(), tables.end(), [](const auto& a, const auto& b) {
        return a.source()->serial() < b.source()->serial();
    });
    last_table_ = 0;
    for (std::size_t t = 0; t < tables.size(); ++t)
        out_.table_ids.assign(BoundaryParts::key_of(tables[t].source()),
                              static_cast<std::int32_t>(t));
    constexpr std::size_t least_groups = 4096;
    const PartsOfRanges parts(
        tables.size(), [&](std::size_t t) { return tables[t].group_count(); }, threads_,
        least_groups);
    std::vector<FacetMarks::Counts> counts(parts.count());
    parts.for_each([&](std::size_t number, const PartsOfRanges::Part& p) {
        counts[number] = tables[p.range].counts(p.begin, p.end);
    });
    PoolVector<std::size_t> first(parts.count());  // number of each part
    std::size_t n = out_.facets.size();
    for (std::size_t part = 0; part < parts.count(); ++part) {
        out_.stats.whole_facets += counts[part].whole;
        first[part] = n;
        n += counts[part].worked;
    }
    out_.facets.resize(n);
    for (FacetMarks& marks : tables) marks.make_numbers();
    parts.for_each([&](std::size_t number, const PartsOfRanges::Part& p) {
        FacetMarks& marks = tables[p.range];
        marks.number_worked(p.begin, p.end, first[number]);
        BoundaryFacet* out = out_.facets.data() + first[number];
        marks.for_each_worked(p.begin, p.end, [&](std::uint32_t f, bool flipped) {
            *out++ = {marks.source(), f, flipped};
        });
    });
}

// Whether something of the leaf bounds the result, is cut or touched, and has no edges yet.
bool Gatherer::needs_parts(const DeferredLeaf& leaf) const {
    return std::ranges::any_of(leaf.operands, [&](const DeferredLeaf::Operand& o) {
        const FacetMarks& marks = out_.sources[out_.table_of(o.polygons.whole_source())];
        return std::ranges::any_of(o.polygons.facets(), [&](std::uint32_t f) {
            return (marks.takes_part(f, false) && !marks.is_traced(f, false)) ||
                   (marks.takes_part(f, true) && !marks.is_traced(f, true));
        });
    });
}

bool Gatherer::needs_parts(const AssembledLeaf& leaf, const OccupancyGrid& occupancy) const {
    return std::any_of(occupancy.facets.begin(), occupancy.facets.end(), [&](const PolygonRef& r) {
        const FacetMarks& marks = out_.sources[out_.table_of(r.source)];
        const bool flipped = r.flipped != leaf.complemented;
        return marks.takes_part(r.facet, flipped) &&
               !axis_faces_->takes(marks.number_of_worked(r.facet, flipped));
    });
}

void Gatherer::make_parts(AssembledLeaf& leaf) {
    leaf.first_edge = leaf.end_edge = edges_.size();
    if (const auto* d = deferred(leaf); d != nullptr && !needs_parts(*d)) return;
    if (const auto* p = occupancy(leaf); p != nullptr && !needs_parts(leaf, *p)) return;
    const PolygonList& polygons = leaf.node->polygons();
    if (const Source* source = polygons.whole_source()) {
        const FacetMarks& marks = out_.sources[table(source)];
        const bool flipped = polygons.flipped() != leaf.complemented;
        const auto make = [&](std::uint32_t f) {
            if (!marks.takes_part(f, flipped) || marks.is_traced(f, flipped)) return;
            const std::int32_t number = marks.number_of_worked(f, flipped);
            if (!axis_faces_->takes(number))
                make_part({source, nullptr, f, polygons.flipped(), false}, leaf, number);
        };
        if (polygons.has_all_facets()) {
            for (std::uint32_t f = 0; f < polygons.size(); ++f) make(f);
        } else {
            for (const std::uint32_t f : polygons.facets()) make(f);
        }
    } else {
        make_list_parts(leaf);
    }
    leaf.end_edge = edges_.size();
}

// Fragments of one facet come one after the other.
void Gatherer::make_list_parts(const AssembledLeaf& leaf) {
    const PolygonList& polygons = leaf.node->polygons();
    for (std::size_t i = 0; i < polygons.size();) {
        const PolygonRef r = polygons[i++];
        const FacetMarks& marks = out_.sources[table(r.source)];
        const bool flipped = r.flipped != leaf.complemented;
        if (!marks.takes_part(r.facet, flipped) || marks.is_traced(r.facet, flipped)) continue;
        const std::int32_t facet = marks.number_of_worked(r.facet, flipped);
        if (axis_faces_->takes(facet)) continue;
        // What cancels within a group is not known afterwards.
        if (r.fragment == nullptr || out_.may_have_straight_crossings ||
            !ends_at_splitters(*r.fragment, leaf.cell)) {
            make_part(r, leaf, facet);
            continue;
        }
        group_.assign(1, r);
        for (; i < polygons.size() && group_.size() < FragmentGroup::max_parts; ++i) {
            const PolygonRef next = polygons[i];
            if (next.facet != r.facet || next.source != r.source || next.flipped != r.flipped ||
                next.fragment == nullptr || !ends_at_splitters(*next.fragment, leaf.cell))
                break;
            group_.push_back(next);
        }
        make_group(group_, leaf, facet);
    }
}

// The number of parts decides what is left to join, and their leaves where.
void Gatherer::note_part(const AssembledLeaf& leaf, BoundaryFacet& facet) {
    const auto number = static_cast<std::int32_t>(&leaf - leaves_.data());
    if (!leaf.node->is_mixed() || (facet.leaf >= 0 && facet.leaf != number))
        facet.in_several_cells = true;
    facet.leaf = number;
    ++out_.stats.parts;
    ++facet.parts;
}

void Gatherer::make_group(std::span<const PolygonRef> group, const AssembledLeaf& leaf,
                          std::int32_t facet) {
    Workbench& bench = out_.bench;
    const PolygonRef& ref = group[0];
    BoundaryFacet& f = out_.facets[as_index(facet)];
    f.support = bench.plane(PlaneName::support(ref.source, ref.facet));
    if (!fragments_.join(group)) {
        for (const PolygonRef& r : group) make_part(r, leaf, facet);
        return;
    }
    for (std::size_t i = 0; i < group.size(); ++i) note_part(leaf, f);
    planes_.clear();
    for (const PlaneName& n : fragments_.lines()) planes_.push_back(bench.plane(n));
    points_.clear();
    for (const FragmentGroup::Edge& e : fragments_.edges()) {
        const auto& [p, q] = fragments_.lines_of(e.from);
        points_.push_back(
            bench.vertex(ref, f.support, planes_[p], planes_[q], fragments_.approximation(e.from)));
    }
    add_corners_near(points_, ref);
    const auto point_at = [&](std::uint8_t vertex) {
        return points_[fragments_.first_edge(vertex)];
    };
    for (const FragmentGroup::Edge& e : fragments_.edges()) {
        PointId a = point_at(e.from);
        PointId b = point_at(e.to);
        if (f.flipped) std::swap(a, b);
        edges_.push_back({a, b, facet, {planes_[e.line], e.above}});
    }
}

void Gatherer::make_part(const PolygonRef& ref, const AssembledLeaf& leaf, std::int32_t facet) {
    Workbench& bench = out_.bench;
    WorkPolygon shape = bench.polygon(ref);
    bench.with_edges(shape, ref);
    BoundaryFacet& f = out_.facets[as_index(facet)];
    f.support = shape.support;
    if (!leaf.cell.contains(ref.box()) || shape.is_empty())
        shape = bench.clipped(shape, ref.box(), leaf.cell);
    if (shape.is_empty()) return;
    note_part(leaf, f);
    if (ref.fragment != nullptr) add_corners_near({shape.points.data(), shape.points.size()}, ref);
    const std::size_t n = shape.points.size();
    for (std::size_t k = 0; k < n; ++k) {
        const std::size_t i = f.flipped ? n - 1 - k : k;
        PointId a = shape.points[i];
        PointId b = shape.points[i + 1 == n ? 0 : i + 1];
        if (f.flipped) std::swap(a, b);
        edges_.push_back({a, b, facet, shape.edges[i]});
    }
}

// A cut through a corner of the facet leaves a vertex that is named by the cut. Untouched facets
// around the corner have the corner's name only, so that name must take part in merging.
void Gatherer::add_corners_near(std::span<const PointId> points, const PolygonRef& ref) {
    if (ref.source->is_half_space()) return;
    std::array<std::array<double, 3>, 3> corners;
    for (int i = 0; i < 3; ++i)
        corners[as_index(i)] = approximate(ref.source->corner(ref.facet, i)).c;
    for (const PointId p : points) {
        if (out_.bench.is_corner(p)) continue;
        const Approximation a = out_.bench.approximation(p);
        for (int i = 0; i < 3; ++i) {
            bool near = true;
            for (std::size_t k = 0; k < 3; ++k)
                near = near && std::fabs(a.c[k] - corners[as_index(i)][k]) <= error_slack * a.error;
            if (near) (void)out_.bench.corner(ref.source, ref.facet, i);
        }
    }
}

void Gatherer::choose_axis_faces() {
    std::vector<AxisFaces::Leaf> leaves;
    leaves.reserve(leaves_.size());
    for (const AssembledLeaf& leaf : leaves_) {
        if (deferred(leaf) != nullptr) return;
        const OccupancyGrid* const p = occupancy(leaf);
        leaves.push_back(
            {p != nullptr ? &p->facets : &leaf.node->polygons(), leaf.cell, leaf.complemented, p});
    }
    axis_faces_->choose(leaves);
}

void Gatherer::make_axis_faces() {
    const auto edges_of = [&](const AssembledLeaf& leaf) {
        return std::span(edges_).subspan(leaf.first_edge, leaf.end_edge - leaf.first_edge);
    };
    for (std::size_t i = 0; i < leaves_.size(); ++i)
        if (axis_faces_->is_across_axes(i)) axis_faces_->note_vertices(edges_of(leaves_[i]));
    axis_faces_->make_edges(edges_);
    for (std::size_t i = 0; i < leaves_.size(); ++i) {
        leaves_[i].first_inside = inside_.size();
        if (axis_faces_->is_across_axes(i) && leaves_[i].node->is_mixed())
            for (const BoundaryEdge& e : edges_of(leaves_[i]))
                axis_faces_->add_vertices_in(e, inside_);
        leaves_[i].end_inside = inside_.size();
    }
}

// Where a facet is in special position, what its outline encloses may have no width, as far as the
// shift of a mesh goes: edges have no length or lie in each other. With all vertices inside them
// inserted, what is too much cancels.
// Moves those edges to the front, and overwrites others.
bool Gatherer::conform_traced(std::span<BoundaryEdge> edges) {
    splitter_.clear();
    std::size_t count = 0;
    for (const BoundaryEdge& e : edges) {
        if (!out_.facets[as_index(e.facet)].is_special) {
            out_.edges.push_back(e);
            continue;
        }
        if (e.from == e.to) continue;
        splitter_.add_candidate(e.from);
        splitter_.add_candidate(e.to);
        edges[count++] = e;
    }
    const auto special = edges.first(count);
    if (special.empty()) return true;
    if (threads_ != 1) out_.bench.share();
    if (!may_have_sheets_) {
        splitter_.split(special, out_.edges, threads_);
        return true;
    }
    BoundaryEdges conforming;
    splitter_.split(special, conforming, threads_);
    if (!remove_sheets(out_, same_, conforming)) return false;
    out_.edges.insert(out_.edges.end(), conforming.begin(), conforming.end());
    return true;
}

// Edges of traced facets in general position, and of axis-perpendicular planes, which come last,
// have all their vertices.
bool Gatherer::conform_edges(std::size_t traced, std::size_t of_leaves) {
    if (axis_faces_->takes_all()) {
        out_.edges = std::move(edges_);
        return true;
    }
    constexpr std::size_t least_edges = 16384;
    ParallelParts(edges_.size(), threads_, least_edges)
        .for_each([&](std::size_t, std::size_t begin, std::size_t end) {
            for (BoundaryEdge& e : std::span(edges_).subspan(begin, end - begin)) {
                e.from = same_[as_index(e.from)];
                e.to = same_[as_index(e.to)];
            }
        });
    if (traced == edges_.size() &&
        std::ranges::none_of(out_.facets, [](const BoundaryFacet& f) { return f.is_special; })) {
        out_.edges = std::move(edges_);
        return true;
    }
    out_.edges.reserve(edges_.size() + edges_.size() / 8);
    if (!conform_traced(std::span(edges_).first(traced))) return false;
    out_.edges.insert(out_.edges.end(), edges_.begin() + static_cast<std::ptrdiff_t>(of_leaves),
                      edges_.end());
    conform_leaves();
    return true;
}

// By several threads where there are many edges: leaves have nothing in common.
void Gatherer::conform_leaves() {
    constexpr std::size_t least_edges = 4096;
    constexpr std::size_t least_leaves = 8;
    const bool are_few = edges_.size() < least_edges;
    const ParallelParts parts(leaves_.size(), are_few ? 1 : threads_, least_leaves);
    if (parts.count() == 1) {
        for (const AssembledLeaf& leaf : leaves_) conform_leaf(leaf, splitter_, out_.edges);
        return;
    }
    out_.bench.share();
    std::vector<BoundaryEdges> conforming(parts.count());
    PerThread<EdgeSplitter> splitters;
    parts.for_each([&](std::size_t part, std::size_t begin, std::size_t end) {
        EdgeSplitter& splitter = splitters.local(
            [&] { return std::make_unique<EdgeSplitter>(out_.bench, out_.facets); });
        for (std::size_t i = begin; i < end; ++i)
            conform_leaf(leaves_[i], splitter, conforming[part]);
    });
    out_.bench.end_sharing();
    for (const BoundaryEdges& of_part : conforming)
        out_.edges.insert(out_.edges.end(), of_part.begin(), of_part.end());
}

void Gatherer::conform_leaf(const AssembledLeaf& leaf, EdgeSplitter& splitter,
                            BoundaryEdges& out) const {
    check_stop();
    const auto edges = std::span(edges_).subspan(leaf.first_edge, leaf.end_edge - leaf.first_edge);
    if (!leaf.node->is_mixed()) {
        out.insert(out.end(), edges.begin(), edges.end());
        return;
    }
    splitter.clear();
    for (const BoundaryEdge& e : edges) splitter.add_candidate(e.from);
    for (std::size_t i = leaf.first_inside; i < leaf.end_inside; ++i)
        splitter.add_candidate(same_[as_index(inside_[i])]);
    splitter.split(edges, out);
}

}  // namespace

void gather_parts(const SolidState& solid, BoundaryParts& parts, bool by_planes,
                  std::uint32_t threads) {
    if (Gatherer(solid, parts, by_planes, threads).run()) return;
    parts = BoundaryParts();
    [[maybe_unused]] const bool is_enough =
        Gatherer(*solid.lazy_tree()->cut(), parts, by_planes, threads).run();
}

}  // namespace trisect::detail

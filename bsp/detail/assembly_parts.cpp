// SPDX-License-Identifier: Apache-2.0
//
// Which facets need work: fragments, and whole facets that something touches in a cell, because
// vertices may lie in their edges. A facet without either is whole in every cell that it reaches
// into (see PolygonRef) and passes through as it is. All others are turned into convex parts with
// exact vertices, one for every cell.
//
// Vertices are identified by name as they are made (Workbench::meet), then by value: points
// whose certified doubles are close (near_points.h) are compared exactly. A second stage is
// indispensable: where several planes run through one point its names differ.
//
// T-vertices are found leaf by leaf. Every polygon that touches a closed cell is listed there, so
// the vertices of the leaf are all that can lie on an edge inside it. That keeps a search that is
// quadratic in the worst case down to a few dozen candidates.

#include <trisect/bsp/detail/assembly_parts.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include <trisect/bsp/detail/leaf_arrangement.h>
#include <trisect/bsp/detail/near_points.h>
#include <trisect/kernel/contract.h>

namespace trisect::detail {

namespace {

std::size_t u(std::int32_t i) { return static_cast<std::size_t>(i); }

struct Part {
    std::int32_t facet = -1;
    bool flipped = false;
    WorkPolygon shape;
};

struct Leaf {
    const CellNode* node = nullptr;
    bool complemented = false;
    Cell cell;
    std::size_t first_part = 0;
    std::size_t end_part = 0;
};

// What is known of the facets of one source: one entry for each facet and orientation.
class FacetTable {
public:
    struct Entry {
        bool listed = false;    // in some leaf
        bool owned = false;     // in the leaf that holds its first corner
        bool involved = false;  // cut, touched or incomplete
        bool given = false;     // as edges, although not involved
        std::int32_t index = -1;
    };
    explicit FacetTable(const Source* source)
        : source_(source), entries_(2 * std::size_t{source->facet_count()}) {}
    [[nodiscard]] const Source* source() const { return source_; }
    [[nodiscard]] std::vector<Entry>& entries() { return entries_; }
    [[nodiscard]] Entry& at(const PolygonRef& r) {
        return entries_[2 * std::size_t{r.facet} + (r.flipped ? 1 : 0)];
    }

private:
    const Source* source_;
    std::vector<Entry> entries_;
};

class Gatherer {
public:
    Gatherer(bool all, BoundaryParts& out) : all_(all), out_(out) {}

    void run(const SolidState& solid) {
        list_leaves(solid.root, Cell{});
        mark_facets();
        mark_incomplete(solid.incomplete);
        number_facets();
        make_parts();
        merge_equal_points();
        emit_edges();
    }

private:
    void list_leaves(const CellRef& ref, const Cell& cell);
    void mark_facets();
    void mark_incomplete(const std::vector<FacetName>& incomplete);
    void number_facets();
    void make_parts();
    void add_corners_near(const WorkPolygon& shape, const PolygonRef& ref);
    void merge_equal_points();
    void emit_edges();
    [[nodiscard]] FacetTable& table(const Source* source);
    PointId root(PointId p) {
        while (same_[u(p)] != p) p = same_[u(p)] = same_[u(same_[u(p)])];
        return p;
    }

    bool all_;
    BoundaryParts& out_;
    std::vector<Part> parts_;
    std::vector<Leaf> leaves_;
    std::vector<FacetTable> tables_;
    std::size_t last_table_ = 0;
    std::vector<PointId> same_;
};

FacetTable& Gatherer::table(const Source* source) {
    if (last_table_ < tables_.size() && tables_[last_table_].source() == source)
        return tables_[last_table_];
    const auto at = std::find_if(tables_.begin(), tables_.end(),
                                 [&](const FacetTable& t) { return t.source() == source; });
    last_table_ = static_cast<std::size_t>(at - tables_.begin());
    if (at == tables_.end()) tables_.emplace_back(source);
    return tables_[last_table_];
}

void Gatherer::list_leaves(const CellRef& ref, const Cell& cell) {
    const CellNode& node = *ref.node;
    if (!node.is_leaf()) {
        for (int i = 0; i < 2; ++i) {
            CellRef c = node.child(i);
            c.complemented = c.complemented != ref.complemented;
            list_leaves(c, i == 0 ? cell.below(node.axis(), node.wall())
                                  : cell.above(node.axis(), node.wall()));
        }
        return;
    }
    if (!node.polygons().empty()) leaves_.push_back({&node, ref.complemented, cell, 0, 0});
}

void Gatherer::mark_facets() {
    for (const Leaf& leaf : leaves_) {
        for (PolygonRef r : leaf.node->polygons()) {
            r.flipped = r.flipped != leaf.complemented;
            FacetTable::Entry& e = table(r.source).at(r);
            e.listed = true;
            if (r.fragment != nullptr || r.touched || r.source->is_half_space()) {
                e.involved = true;
            } else if (leaf.cell.contains(Box::of(r.source->corner(r.facet, 0)))) {
                // A facet may be listed in cells that it passes by, but not in this one.
                e.owned = true;
            }
        }
    }
}

void Gatherer::mark_incomplete(const std::vector<FacetName>& incomplete) {
    for (FacetTable& t : tables_) {
        const std::uint64_t serial = t.source()->serial();
        auto at = std::lower_bound(incomplete.begin(), incomplete.end(), FacetName{serial, 0});
        for (; at != incomplete.end() && at->serial == serial; ++at)
            for (const std::size_t side : {0U, 1U})
                t.entries()[2 * std::size_t{at->facet} + side].involved = true;
    }
}

void Gatherer::number_facets() {
    std::sort(tables_.begin(), tables_.end(), [](const FacetTable& a, const FacetTable& b) {
        return a.source()->serial() < b.source()->serial();
    });
    last_table_ = 0;
    for (FacetTable& t : tables_) {
        for (std::size_t i = 0; i < t.entries().size(); ++i) {
            FacetTable::Entry& e = t.entries()[i];
            if (!(e.involved ? e.listed : e.owned)) continue;
            e.index = static_cast<std::int32_t>(out_.facets.size());
            out_.facets.push_back(
                {t.source(), static_cast<std::uint32_t>(i / 2), (i & 1) != 0, -1});
            if (!e.involved && !all_) out_.whole.push_back(e.index);
        }
    }
}

void Gatherer::make_parts() {
    for (Leaf& leaf : leaves_) {
        leaf.first_part = parts_.size();
        for (PolygonRef r : leaf.node->polygons()) {
            r.flipped = r.flipped != leaf.complemented;
            FacetTable::Entry& e = table(r.source).at(r);
            if (!e.involved && (!all_ || !e.owned || e.given)) continue;
            WorkPolygon shape = out_.bench.polygon(r);
            out_.bench.with_edges(shape, r);
            out_.facets[u(e.index)].support = shape.support;
            if (!e.involved) {
                e.given = true;  // once is enough
            } else if (!leaf.cell.contains(r.box()) || shape.is_empty()) {
                shape = out_.bench.clipped(shape, r.box(), leaf.cell);
            }
            if (shape.is_empty()) continue;
            if (r.fragment != nullptr) add_corners_near(shape, r);
            parts_.push_back({e.index, r.flipped, std::move(shape)});
        }
        leaf.end_part = parts_.size();
    }
}

// A cut through a corner of the facet leaves a vertex that is named by the cut. Untouched facets
// around the corner know it by the corner's name only, so that name must take part in merging.
void Gatherer::add_corners_near(const WorkPolygon& shape, const PolygonRef& ref) {
    if (ref.source->is_half_space()) return;
    for (std::size_t v = 0; v < shape.points.size(); ++v) {
        if (out_.bench.is_corner(shape.points[v])) continue;
        const Approximation a = out_.bench.approximation(shape.points[v]);
        for (int i = 0; i < 3; ++i) {
            const Approximation c = approximate(ref.source->corner(ref.facet, i));
            bool near = true;
            for (std::size_t k = 0; k < 3; ++k)
                near = near && std::fabs(a.c[k] - c.c[k]) <= 1.0000001 * a.error;
            if (near) (void)out_.bench.corner(ref.source, ref.facet, i);
        }
    }
}

// Union of points that are equal under different names; the representative is a corner of a source
// if there is one, else the point made first.
void Gatherer::merge_equal_points() {
    Workbench& bench = out_.bench;
    const std::size_t n = bench.point_count();
    same_.resize(n);
    std::iota(same_.begin(), same_.end(), 0);
    const auto better = [&](PointId a, PointId b) {
        return bench.is_corner(a) != bench.is_corner(b) ? bench.is_corner(a) : a < b;
    };
    for_each_near_group(bench, [&](std::span<const PointId> group) {
        // Against one of each value: what is equal to it needs no comparison of its own.
        for (std::size_t i = 1; i < group.size(); ++i)
            for (std::size_t j = 0; j < i; ++j) {
                if (same_[u(group[j])] != group[j] || !bench.same_point(group[i], group[j]))
                    continue;
                const bool first = better(group[j], group[i]);
                same_[u(group[first ? i : j])] = group[first ? j : i];
                break;
            }
    });
}

void append_edges(const WorkPolygon& shape, std::int32_t facet, bool flipped,
                  std::vector<BoundaryEdge>& out) {
    const std::size_t n = shape.points.size();
    for (std::size_t i = 0; i < n; ++i) {
        PointId a = shape.points[i];
        PointId b = shape.points[(i + 1) % n];
        if (flipped) std::swap(a, b);
        out.push_back({a, b, facet, shape.edges[i]});
    }
}

void Gatherer::emit_edges() {
    std::vector<BoundaryEdge> local;
    std::vector<PointId> points;
    for (const Leaf& leaf : leaves_) {
        local.clear();
        for (std::size_t i = leaf.first_part; i < leaf.end_part; ++i) {
            Part& p = parts_[i];
            for (PointId& q : p.shape.points) q = root(q);
            append_edges(p.shape, p.facet, p.flipped, local);
        }
        if (leaf.node->is_mixed()) {
            points.clear();
            for (const BoundaryEdge& e : local) points.push_back(e.from);
            insert_points_on_edges(out_.bench, out_.facets, points, local);
        }
        out_.edges.insert(out_.edges.end(), local.begin(), local.end());
    }
}

// Does p lie strictly inside the edge? All three points are distinct; `along` separates the ends.
bool lies_inside(const Workbench& bench, PointId p, const BoundaryEdge& e, PlaneId support,
                 int along) {
    if (bench.side(p, support) != 0 || bench.side(p, e.line.plane) != 0) return false;
    const int from = compare_along(bench, e.from, p, along);
    const int to = compare_along(bench, p, e.to, along);
    return from == to && from != 0;
}

// The axis along which the ends of an edge are farthest apart.
int longest_axis(const Approximation& a, const Approximation& b) {
    int best = 0;
    for (int k = 1; k < 3; ++k) {
        const auto i = static_cast<std::size_t>(k);
        const auto j = static_cast<std::size_t>(best);
        if (std::fabs(a.c[i] - b.c[i]) > std::fabs(a.c[j] - b.c[j])) best = k;
    }
    return best;
}

}  // namespace

int compare_along(const Workbench& bench, PointId a, PointId b, int axis) {
    const Approximation& pa = bench.approximation(a);
    const Approximation& pb = bench.approximation(b);
    const double gap = pa.c[static_cast<std::size_t>(axis)] - pb.c[static_cast<std::size_t>(axis)];
    if (std::fabs(gap) > 1.0000001 * (pa.error + pb.error)) return gap < 0 ? -1 : 1;
    if (a == b) return 0;
    const auto order = compare_coordinate(bench.homogeneous(a), bench.homogeneous(b), axis);
    return order < 0 ? -1 : (order > 0 ? 1 : 0);
}

void insert_points_on_edges(const Workbench& bench, const std::vector<BoundaryFacet>& facets,
                            std::vector<PointId> points, std::vector<BoundaryEdge>& edges) {
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    double widest = 0;
    for (const PointId p : points) widest = std::max(widest, bench.approximation(p).error);
    const auto x_of = [&](PointId p) { return bench.approximation(p).c[0]; };
    std::sort(points.begin(), points.end(),
              [&](PointId a, PointId b) { return std::pair(x_of(a), a) < std::pair(x_of(b), b); });
    std::vector<PointId> inside;
    const std::size_t count = edges.size();
    for (std::size_t i = 0; i < count; ++i) {
        const BoundaryEdge e = edges[i];
        const Approximation& a = bench.approximation(e.from);
        const Approximation& b = bench.approximation(e.to);
        const double slack = 1.0000001 * (a.error + b.error + widest);
        const double x_lo = std::min(a.c[0], b.c[0]) - slack;
        const double x_hi = std::max(a.c[0], b.c[0]) + slack;
        const PlaneId support = facets[u(e.facet)].support;
        const int along = longest_axis(a, b);
        inside.clear();
        auto it = std::lower_bound(points.begin(), points.end(), x_lo,
                                   [&](PointId p, double x) { return x_of(p) < x; });
        for (; it != points.end() && x_of(*it) <= x_hi; ++it) {
            const PointId p = *it;
            if (p == e.from || p == e.to) continue;
            const Approximation& c = bench.approximation(p);
            if (c.c[1] < std::min(a.c[1], b.c[1]) - slack ||
                c.c[1] > std::max(a.c[1], b.c[1]) + slack ||
                c.c[2] < std::min(a.c[2], b.c[2]) - slack ||
                c.c[2] > std::max(a.c[2], b.c[2]) + slack)
                continue;
            if (lies_inside(bench, p, e, support, along)) inside.push_back(p);
        }
        if (inside.empty()) continue;
        const int direction = compare_along(bench, e.from, e.to, along);
        std::sort(inside.begin(), inside.end(), [&](PointId p, PointId q) {
            return compare_along(bench, p, q, along) == direction && p != q;
        });
        PointId from = e.from;
        for (std::size_t k = 0; k <= inside.size(); ++k) {
            const PointId to = k < inside.size() ? inside[k] : e.to;
            const BoundaryEdge part{from, to, e.facet, e.line};
            if (k == 0) {
                edges[i] = part;
            } else {
                edges.push_back(part);
            }
            from = to;
        }
    }
}

void gather_parts(const SolidState& solid, bool all, BoundaryParts& parts) {
    Gatherer(all, parts).run(solid);
}

}  // namespace trisect::detail

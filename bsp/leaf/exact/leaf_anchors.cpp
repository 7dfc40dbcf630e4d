// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/leaf/exact/leaf_anchors.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include <trisect/kernel/support/as_index.h>

namespace trisect::detail {

namespace {

constexpr LeafIndex no_edge = -1;
constexpr LeafIndex outside_cell = -2;

bool is_facet(const LeafItem& item) {
    return item.ref.fragment == nullptr && !item.ref.source->is_half_space();
}

// Whether a segment surely has a part of some length in a cell: it is clipped by the splitting
// planes, in doubles and with a margin.
bool runs_through(const Cell& cell, const LatticePoint& a, const LatticePoint& b) {
    double from = 0;
    double to = 1;
    for (int k = 0; k < 3; ++k) {
        const auto i = static_cast<std::size_t>(k);
        const auto scale = static_cast<double>(splitting_scale);
        const double p = a[k].to_double();
        const double d = b[k].to_double() - p;
        const double low = static_cast<double>(cell.lo[i]) / scale;
        const double high = static_cast<double>(cell.hi[i]) / scale;
        const double margin = 0x1p-50 * (std::fabs(low) + std::fabs(high) + std::fabs(p));
        const double lo = low - p + margin;
        const double hi = high - p - margin;
        if (d == 0) {
            if (lo >= 0 || hi <= 0) return false;
            continue;
        }
        const double s = lo / d;
        const double t = hi / d;
        from = std::max(from, std::min(s, t));
        to = std::min(to, std::max(s, t));
    }
    return to - from > 0x1p-20;
}

}  // namespace

void LeafAnchors::build(LeafWork& work, LeafWindings& windings) {
    work_ = &work;
    windings_ = &windings;
    ids_.clear();
    vertex_of_id_.clear();
    vertices_.clear();
    known_count_ = 0;
    first_.assign(work.items.size(), no_edge);
    for (LeafIndex i = 0; i < work.item_count(); ++i) {
        // Only what nothing touches makes others hang together; the rest is looked at on demand.
        if (!work.contacts(i).empty()) continue;
        const std::size_t n = corner_count(i);
        for (std::size_t k = 0; k < n; ++k) join_item(i, vertex_of(i, k));
        const LeafItem& item = work.item(i);
        if (item.contained || !is_facet(item)) continue;
        for (int k = 0; k < 3; ++k) join_item(i, edge_of(i, k));
    }
}

void LeafAnchors::join_item(LeafIndex item, LeafIndex vertex) {
    if (vertex < 0) return;
    LeafIndex& first = first_[as_index(item)];
    if (first < 0) {
        first = vertex;
    } else {
        join(first, vertex);
    }
}

std::size_t LeafAnchors::corner_count(LeafIndex item) {
    return is_facet(work_->item(item)) ? 3 : work_->shape(item).points.size();
}

bool LeafAnchors::is_in_cell(LeafIndex i, std::size_t corner) {
    const LeafItem& item = work_->item(i);
    const Cell& cell = work_->problem->cell;
    if (item.contained) return true;
    if (is_facet(item))
        return cell.contains(
            Box::of(item.ref.source->corner(item.ref.facet, static_cast<int>(corner))));
    const PointId p = work_->shape(i).points[corner];
    if (work_->bench.is_corner(p)) return cell.contains(Box::of(work_->bench.lattice(p)));
    // A vertex very near to a splitting plane does not count.
    const Approximation& a = work_->bench.approximation(p);
    for (std::size_t k = 0; k < 3; ++k) {
        const double slack = 1.001 * a.error + 0x1p-45 * std::fabs(a.c[k]);
        const auto scale = static_cast<double>(splitting_scale);
        if ((a.c[k] - slack) * scale <= static_cast<double>(cell.lo[k]) ||
            (a.c[k] + slack) * scale >= static_cast<double>(cell.hi[k]))
            return false;
    }
    return true;
}

LeafIndex LeafAnchors::vertex_of(LeafIndex i, std::size_t corner) {
    const LeafItem& item = work_->item(i);
    // Corners of the source by name, so that facets need no shape; other points by the bench's.
    Key128 key{static_cast<std::uint64_t>(item.surface), 0};
    if (is_facet(item)) {
        key.b = item.ref.source->corner_index(item.ref.facet, static_cast<int>(corner));
    } else {
        const PointId p = work_->shape(i).points[corner];
        if (work_->bench.is_corner(p) && work_->bench.corner_name(p).first == item.ref.source) {
            key.b = work_->bench.corner_name(p).second;
        } else {
            key = {(std::uint64_t{1} << 40) | static_cast<std::uint64_t>(item.operand),
                   static_cast<std::uint64_t>(p)};
        }
    }
    const auto [id, inserted] = ids_.insert(key, static_cast<std::int32_t>(vertex_of_id_.size()));
    if (inserted) {
        vertex_of_id_.push_back(outside_cell);
        if (is_in_cell(i, corner)) {
            const auto v = static_cast<LeafIndex>(vertices_.size());
            vertex_of_id_.back() = v;
            Vertex vertex;
            vertex.item = i;
            vertex.corner = static_cast<std::int32_t>(corner);
            vertex.parent = v;
            vertices_.push_back(vertex);
        }
    }
    return vertex_of_id_[as_index(id)];
}

// An edge of a source with both ends outside the cell, if it surely runs through the cell.
LeafIndex LeafAnchors::edge_of(LeafIndex i, int edge) {
    const LeafItem& item = work_->item(i);
    const Source& source = *item.ref.source;
    const LatticePoint& a = source.corner(item.ref.facet, edge);
    const LatticePoint& b = source.corner(item.ref.facet, (edge + 1) % 3);
    const Cell& cell = work_->problem->cell;
    if (cell.contains(Box::of(a)) || cell.contains(Box::of(b))) return no_edge;
    if (!runs_through(cell, a, b)) return no_edge;
    const std::uint64_t v = source.corner_index(item.ref.facet, edge);
    const std::uint64_t w = source.corner_index(item.ref.facet, (edge + 1) % 3);
    const Key128 key{(std::uint64_t{1} << 41) | static_cast<std::uint64_t>(item.surface),
                     (std::min(v, w) << 32) | std::max(v, w)};
    const auto [id, inserted] = ids_.insert(key, static_cast<std::int32_t>(vertex_of_id_.size()));
    if (inserted) {
        const auto at = static_cast<LeafIndex>(vertices_.size());
        vertex_of_id_.push_back(at);
        Vertex vertex;
        vertex.item = i;
        vertex.corner = -1;
        vertex.parent = at;
        vertices_.push_back(vertex);
    }
    return vertex_of_id_[as_index(id)];
}

LeafIndex LeafAnchors::root(LeafIndex v) {
    while (vertices_[as_index(v)].parent != v) {
        LeafIndex& parent = vertices_[as_index(v)].parent;
        v = parent = vertices_[as_index(parent)].parent;
    }
    return v;
}

void LeafAnchors::join(LeafIndex a, LeafIndex b) {
    a = root(a);
    b = root(b);
    if (a == b) return;
    // A tree's root is a vertex if there is one.
    if (vertices_[as_index(a)].corner < 0) std::swap(a, b);
    vertices_[as_index(b)].parent = a;
    if (vertices_[as_index(b)].corner >= 0) vertices_[as_index(a)].example = b;
}

bool LeafAnchors::trace_to(const Vertex& v, std::vector<int>& w) {
    const LeafItem& item = work_->item(v.item);
    if (is_facet(item) && item.ref.source->is_whole()) {
        const LatticePoint& c = item.ref.source->corner(item.ref.facet, v.corner);
        const TraceTarget target(
            FinePoint{{fine_position(c.x), fine_position(c.y), fine_position(c.z)}});
        return windings_->at_point(target, item.operand, w);
    }
    const PointId p = work_->shape(v.item).points[static_cast<std::size_t>(v.corner)];
    const TraceTarget target(work_->bench, {p, p, p}, {1, 0, 0});
    return windings_->at_point(target, item.operand, w);
}

// One trace, to another vertex when the first is degenerate. On a grid where vertices lie on other
// surfaces all the time, more attempts cost more than the traces that they might spare.
void LeafAnchors::find_windings(LeafIndex r) {
    vertices_[as_index(r)].state = State::Useless;
    if (known_count_ == known_.size()) known_.emplace_back();
    if (vertices_[as_index(r)].corner < 0) return;  // edges only: see remember()
    for (int attempt = 0; attempt < 2; ++attempt) {
        const LeafIndex example = vertices_[as_index(r)].example;
        const LeafIndex at = attempt == 0 ? r : example;
        if (at < 0 || vertices_[as_index(at)].corner < 0 ||
            !trace_to(vertices_[as_index(at)], known_[known_count_]))
            continue;
        vertices_[as_index(r)].state = State::Known;
        vertices_[as_index(r)].windings = static_cast<LeafIndex>(known_count_++);
        return;
    }
}

void LeafAnchors::remember(LeafIndex item, const std::vector<int>& windings) {
    if (!work_->contacts(item).empty() || first_[as_index(item)] < 0) return;
    Vertex& r = vertices_[as_index(root(first_[as_index(item)]))];
    if (r.state == State::Known) return;
    if (known_count_ == known_.size()) known_.emplace_back();
    known_[known_count_] = windings;
    r.windings = static_cast<LeafIndex>(known_count_++);
    r.state = State::Known;
}

LeafAnchor LeafAnchors::anchor_of(LeafIndex item) {
    if (work_->contacts(item).empty()) {
        // All its vertices hang together; which one it is does not matter.
        const LeafIndex first = first_[as_index(item)];
        if (first < 0) return {};
        const LeafIndex r = root(first);
        if (vertices_[as_index(r)].state == State::Unknown) find_windings(r);
        return {vertices_[as_index(r)].windings, 0};
    }
    const std::size_t n = corner_count(item);
    // First a vertex of which the windings are known.
    for (const bool ask : {false, true}) {
        for (std::size_t k = 0; k < n; ++k) {
            const LeafIndex v = vertex_of(item, k);
            if (v < 0) continue;
            const LeafIndex r = root(v);
            if (ask && vertices_[as_index(r)].state == State::Unknown) find_windings(r);
            const Vertex& at = vertices_[as_index(r)];
            if (at.state == State::Known) return {at.windings, k};
        }
    }
    return {};
}

}  // namespace trisect::detail

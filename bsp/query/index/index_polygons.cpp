// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/query/index/index_polygons.h>

#include <algorithm>

#include <trisect/kernel/contract.h>

namespace trisect::detail {

namespace {

// The corners of a convex polygon given by its edges in any order: the points where two edges meet
// that lie on no wrong side. Only for the rare facets that are cut by a cell; sorted around by the
// chain of shared edges.
std::vector<Plane> edges_in_order(const Plane& support, const std::vector<Plane>& edges) {
    struct Corner {
        std::size_t a, b;
        Point point;
    };
    std::vector<Corner> corners;
    for (std::size_t a = 0; a < edges.size(); ++a)
        for (std::size_t b = a + 1; b < edges.size(); ++b) {
            if (!meet_in_a_point(support, edges[a], edges[b])) continue;
            Point p(support, edges[a], edges[b]);
            const bool kept = std::all_of(edges.begin(), edges.end(), [&](const Plane& e) {
                return trisect::side_of(p, e) != Side::Above;
            });
            const bool known = std::any_of(corners.begin(), corners.end(),
                                           [&](const Corner& c) { return c.point == p; });
            if (kept && !known) corners.push_back({a, b, std::move(p)});
        }
    if (corners.size() < 3) return {};
    // Walk: from a corner along one of its edges to the other corner on that edge.
    std::vector<Plane> out;
    std::vector<bool> used(edges.size());
    std::size_t at = 0;
    for (std::size_t step = 0; step < corners.size(); ++step) {
        std::size_t next = corners.size();
        for (std::size_t e = 0; e < edges.size() && next == corners.size(); ++e) {
            if (used[e] || trisect::side_of(corners[at].point, edges[e]) != Side::On) continue;
            for (std::size_t c = 0; c < corners.size(); ++c)
                if (c != at && trisect::side_of(corners[c].point, edges[e]) == Side::On) {
                    used[e] = true;
                    out.push_back(edges[e]);
                    next = c;
                    break;
                }
        }
        if (next == corners.size()) break;
        at = next;
    }
    // Counter-clockwise seen from above: the triple (support, edge, next edge) turns like the
    // outward normals of a corner do.
    if (out.size() >= 3 && sign_of_det(support, out[0], out[1]) < 0)
        std::reverse(out.begin(), out.end());
    return out;
}

}  // namespace

IndexPolygons::IndexPolygons(const Source& source)
    : only_(&source), whole_(source.is_whole()), size_(source.facet_count()) {
    TRISECT_EXPECTS(!source.is_half_space(), "a half-space has no facets to number");
}

std::uint32_t IndexPolygons::slot_of(const Source* source) {
    if (last_slot_ < sources_.size() && sources_[last_slot_] == source) return last_slot_;
    const auto [it, is_new] =
        slots_.try_emplace(source, static_cast<std::uint32_t>(sources_.size()));
    if (is_new) {
        sources_.push_back(source);
        facets_.emplace_back(std::size_t{2} * source->facet_count());
    }
    return last_slot_ = it->second;
}

IndexPolygons::Facet& IndexPolygons::facet_at(std::uint32_t slot, std::uint32_t facet,
                                              bool flipped) {
    return facets_[slot][std::size_t{2} * facet + (flipped ? 1 : 0)];
}

IndexPolygons::Id IndexPolygons::add_convex(const PolygonRef& ref, bool flipped, std::uint32_t slot,
                                            std::span<const Plane> edges, const Box& box) {
    Record r;
    r.source = slot;
    r.facet = ref.facet;
    r.first = static_cast<std::uint32_t>(planes_.size());
    r.box = static_cast<std::uint32_t>(boxes_.size());
    r.edges = static_cast<std::uint16_t>(edges.size());
    r.kind = Kind::Convex;
    r.flipped = flipped;
    planes_.push_back(ref.source->support(ref.facet));
    planes_.insert(planes_.end(), edges.begin(), edges.end());
    boxes_.push_back(box);
    records_.push_back(r);
    return size_++;
}

void IndexPolygons::note(const PolygonRef& ref, bool turned, const Cell& cell, bool incomplete) {
    Facet& f = facet_at(slot_of(ref.source), ref.facet, ref.flipped != turned);
    whole_ = whole_ && ref.source->is_whole();
    if (ref.fragment != nullptr)
        for (const EdgeName& e : ref.fragment->edges())
            if (const Source* s = e.plane.source()) whole_ = whole_ && s->is_whole();
    if (incomplete || ref.touched || ref.fragment != nullptr) {
        f.cut = true;
    } else if (ref.source->is_half_space() ||
               cell.contains(Box::of(ref.source->corner(ref.facet, 0)))) {
        f.owned = true;
    }
}

IndexPolygons::Id IndexPolygons::add(const PolygonRef& ref, bool turned, const Cell& cell) {
    TRISECT_EXPECTS(size_ + 1 < none, "too many polygons for an index");
    const bool flipped = ref.flipped != turned;
    const std::uint32_t slot = slot_of(ref.source);
    if (ref.fragment != nullptr) {
        std::vector<Plane> edges;
        for (const EdgeName& e : ref.fragment->edges()) {
            const Plane p = e.plane.plane();
            edges.push_back(e.above ? p.flipped() : p);
        }
        return add_convex(ref, flipped, slot, edges, ref.fragment->box());
    }
    Facet& f = facet_at(slot, ref.facet, flipped);
    const bool is_split = f.cut && !(cell.contains(ref.box()) && !ref.source->is_half_space());
    if (is_split) return add_clipped(ref, flipped, slot, cell);
    if (!f.cut && !f.owned) return none;
    if (f.id != none) return f.id;
    if (ref.source->is_half_space())
        return f.id = add_convex(ref, flipped, slot, {}, ref.source->box());
    Record r;
    r.source = slot;
    r.facet = ref.facet;
    r.flipped = flipped;
    records_.push_back(r);
    return f.id = size_++;
}

// What is of a facet in a cell.
IndexPolygons::Id IndexPolygons::add_clipped(const PolygonRef& ref, bool flipped,
                                             std::uint32_t slot, const Cell& cell) {
    const Plane support = ref.source->support(ref.facet);
    const Box box = ref.box();
    std::vector<Plane> edges;
    if (!ref.source->is_half_space())
        for (int i = 0; i < 3; ++i) edges.push_back(ref.source->edge_plane(ref.facet, i, support));
    for (int k = 0; k < 3; ++k) {
        const auto kk = static_cast<std::size_t>(k);
        if (box.lo[kk] <= lattice_below(cell.lo[kk]))
            edges.push_back(Plane::axis_aligned(k, splitting_scale, cell.lo[kk]).flipped());
        if (box.hi[kk] > lattice_below(cell.hi[kk]))
            edges.push_back(Plane::axis_aligned(k, splitting_scale, cell.hi[kk]));
    }
    edges = edges_in_order(support, edges);
    if (edges.size() < 3) return none;
    return add_convex(ref, flipped, slot, edges, box);
}

void IndexPolygons::finish() {
    facets_ = {};
    slots_ = {};
    records_.shrink_to_fit();
    planes_.shrink_to_fit();
    boxes_.shrink_to_fit();
}

std::span<const Plane> IndexPolygons::edges(Id id, std::array<Plane, 3>& storage) const {
    if (!is_triangle(id)) return edges(id);
    const Source& s = source(id);
    const Plane plane = s.support(facet(id));
    for (int i = 0; i < 3; ++i)
        storage[static_cast<std::size_t>(i)] = s.edge_plane(facet(id), i, plane);
    return storage;
}

std::vector<Point> IndexPolygons::corners(Id id) const {
    std::vector<Point> out;
    if (is_triangle(id)) {
        for (int i = 0; i < 3; ++i) out.emplace_back(corner(id, i));
        return out;
    }
    const auto planes = edges(id);
    TRISECT_EXPECTS(planes.size() >= 3, "corners of an unbounded facet");
    const Plane plane = support(id);
    for (std::size_t i = 0; i < planes.size(); ++i)
        out.emplace_back(plane, planes[i == 0 ? planes.size() - 1 : i - 1], planes[i]);
    return out;
}

// Boxes of whole coordinates end at lattice planes.
DoubleBox IndexPolygons::bounds(const Box& box) const {
    constexpr double rounding = 0x1p-40;  // of the two reaches and of small sums
    DoubleBox out;
    for (std::size_t k = 0; k < 3; ++k) {
        out.lo[k] = static_cast<double>(box.lo[k]);
        out.hi[k] = static_cast<double>(box.hi[k]);
        if (whole_) continue;
        out.lo[k] -= reach_below + rounding;
        out.hi[k] += reach_above + rounding;
    }
    return out;
}

FaceSource IndexPolygons::face_source(Id id) const { return source(id).name_of(facet(id)); }

std::size_t IndexPolygons::bytes() const {
    return sizeof(*this) + records_.capacity() * sizeof(Record) +
           planes_.capacity() * sizeof(Plane) + boxes_.capacity() * sizeof(Box) +
           sources_.capacity() * sizeof(void*);
}

}  // namespace trisect::detail

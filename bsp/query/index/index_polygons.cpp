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

IndexPolygons::IndexPolygons(const PolygonList& list, const Cell& cell) : cell_(cell) {
    if (const Source* source = list.whole_source(); source != nullptr && list.has_all_facets() &&
                                                    !list.flipped() && !source->is_half_space() &&
                                                    cell.contains(source->box())) {
        only_ = source;
        whole_ = source->is_whole();
        size_ = source->facet_count();
        return;
    }
    TRISECT_EXPECTS(list.size() < none, "too many polygons for an index");
    records_.reserve(list.size());
    for (const PolygonRef r : list) add(r);
    size_ = static_cast<std::uint32_t>(records_.size());
}

void IndexPolygons::add(const PolygonRef& ref) {
    const Box box = ref.box();
    if (!cell_.meets(box)) return;
    Record r;
    r.source = ref.source;
    r.facet = ref.facet;
    r.flipped = ref.flipped ? 1 : 0;
    r.reaches_out = cell_.contains(box) ? 0 : 1;
    whole_ = whole_ && ref.source->is_whole();
    if (ref.fragment != nullptr || ref.source->is_half_space()) {
        r.convex = static_cast<std::uint32_t>(convex_.size()) & triangle;
        add_planes(ref, box);
    }
    records_.push_back(r);
}

void IndexPolygons::add_planes(const PolygonRef& ref, const Box& box) {
    Convex c;
    c.box = box;
    c.first = static_cast<std::uint32_t>(planes_.size());
    planes_.push_back(ref.source->support(ref.facet));
    if (ref.fragment != nullptr)
        for (const EdgeName& e : ref.fragment->edges()) {
            if (const Source* s = e.plane.source()) whole_ = whole_ && s->is_whole();
            const Plane p = e.plane.plane();
            planes_.push_back(e.above ? p.flipped() : p);
        }
    c.edges = static_cast<std::uint32_t>(planes_.size() - c.first - 1);
    convex_.push_back(c);
}

PolygonPart IndexPolygons::part(Id id) const {
    std::array<Plane, 3> storage;
    const auto own = edges(id, storage);
    PolygonPart out{support(id), {own.begin(), own.end()}};
    if (!reaches_out(id)) return out;
    const Box box = is_triangle(id) ? source(id).facet_box(facet(id)) : convex(id).box;
    const bool everywhere = is_unbounded(id);
    for (int k = 0; k < 3; ++k) {
        const auto kk = static_cast<std::size_t>(k);
        if (everywhere || box.lo[kk] <= lattice_below(cell_.lo[kk]))
            out.edges.push_back(Plane::axis_aligned(k, splitting_scale, cell_.lo[kk]).flipped());
        if (everywhere || box.hi[kk] > lattice_below(cell_.hi[kk]))
            out.edges.push_back(Plane::axis_aligned(k, splitting_scale, cell_.hi[kk]));
    }
    out.edges = edges_in_order(out.support, out.edges);
    return out;
}

bool IndexPolygons::enters(Id id) const {
    if (!reaches_out(id)) return true;
    if (is_triangle(id))
        for (int i = 0; i < 3; ++i)
            if (cell_.contains(Box::of(corner(id, i)))) return true;
    return !part(id).is_empty();
}

std::vector<Point> PolygonPart::corners() const {
    std::vector<Point> out;
    for (std::size_t i = 0; i < edges.size(); ++i)
        out.emplace_back(support, edges[i == 0 ? edges.size() - 1 : i - 1], edges[i]);
    return out;
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
           convex_.capacity() * sizeof(Convex) + planes_.capacity() * sizeof(Plane);
}

}  // namespace trisect::detail

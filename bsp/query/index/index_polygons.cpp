// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/query/index/index_polygons.h>

#include <algorithm>

#include <trisect/kernel/contract.h>

namespace trisect::detail {

namespace {

Plane wall(int axis, std::int64_t position) {
    return Plane::axis_aligned(axis, splitting_scale, position);
}

// What of a plane is in the universe, as far as walls across its dominant axis say.
ConvexPolygon universe_on(const Plane& plane) {
    const int axis = plane.dominant_axis();
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    std::vector<Plane> edges{wall(v, -universe_limit).flipped(), wall(u, universe_limit),
                             wall(v, universe_limit), wall(u, -universe_limit).flipped()};
    // Counter-clockwise where the normal points up.
    if (plane.normal(axis).sign() < 0) std::reverse(edges.begin(), edges.end());
    return {plane, std::move(edges)};
}

}  // namespace

IndexPolygons::IndexPolygons(const PolygonList& list, const Cell& cell) : cell_(cell) {
    if (const Source* source = list.whole_source(); source != nullptr && list.has_all_facets() &&
                                                    !list.flipped() && !source->is_half_space() &&
                                                    cell.contains(source->box())) {
        only_ = source;
        whole_ = source->is_whole();
        size_ = source->facet_count();
        box_ = source->box();
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
        r.fragment = static_cast<std::uint32_t>(fragments_.size()) & triangle;
        fragments_.push_back(ref.fragment);
        if (ref.fragment != nullptr)
            for (const EdgeName& e : ref.fragment->edges())
                if (const Source* s = e.plane.source()) whole_ = whole_ && s->is_whole();
    }
    records_.push_back(r);
    box_.add(r.fragment != triangle && ref.fragment == nullptr ? cell_.lattice_box() : box);
}

ConvexPolygon IndexPolygons::part(Id id) const {
    ConvexPolygon out;
    if (is_triangle(id)) {
        out = ConvexPolygon::from_triangle(corner(id, 0), corner(id, 1), corner(id, 2));
    } else if (is_unbounded(id)) {
        out = universe_on(support(id));
    } else {
        out = ConvexPolygon(support(id), edges(id));
    }
    if (!reaches_out(id)) return out;
    const Box box = box_of(id);
    for (int k = 0; k < 3 && !out.is_empty(); ++k) {
        const auto kk = static_cast<std::size_t>(k);
        if (box.lo[kk] <= lattice_below(cell_.lo[kk])) out = out.clip_above(wall(k, cell_.lo[kk]));
        if (box.hi[kk] > lattice_below(cell_.hi[kk])) out = out.clip_below(wall(k, cell_.hi[kk]));
    }
    return out;
}

bool IndexPolygons::enters(Id id) const {
    if (!reaches_out(id)) return true;
    if (is_triangle(id))
        for (int i = 0; i < 3; ++i)
            if (cell_.contains(Box::of(corner(id, i)))) return true;
    return !part(id).is_empty();
}

std::vector<Plane> IndexPolygons::edges(Id id) const {
    std::vector<Plane> out;
    if (is_triangle(id)) {
        const Source& s = source(id);
        const Plane plane = s.support(facet(id));
        for (int i = 0; i < 3; ++i) out.push_back(s.edge_plane(facet(id), i, plane));
    } else if (const Fragment* const cut = fragment(id)) {
        for (const EdgeName& e : cut->edges()) {
            const Plane p = e.plane.plane();
            out.push_back(e.above ? p.flipped() : p);
        }
    }
    return out;
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
           fragments_.capacity() * sizeof(fragments_[0]);
}

}  // namespace trisect::detail

// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/cells/polygon_in_cell.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace trisect::detail {

namespace {

Box outward_box(const Workbench& bench, const WorkPolygon& polygon) {
    Box b;
    for (const PointId p : polygon.points) {
        const Approximation& a = bench.approximation(p);
        for (std::size_t k = 0; k < 3; ++k) {
            b.lo[k] = std::min(b.lo[k], static_cast<std::int64_t>(std::floor(a.c[k] - a.error)));
            b.hi[k] = std::max(b.hi[k], static_cast<std::int64_t>(std::ceil(a.c[k] + a.error)));
        }
    }
    return b;
}

// Whether a fragment certainly lies in a cell: by its box, or where it ends at a splitting plane by
// name.
bool lies_in(const Fragment& fragment, const Cell& cell) {
    Box box = fragment.box();
    for (const EdgeName& e : fragment.edges()) {
        if (!e.plane.is_splitter()) continue;
        const std::size_t k = e.plane.facet;
        if (e.above && e.plane.position() == cell.lo[k]) box.lo[k] = lattice_below(cell.lo[k]) + 1;
        if (!e.above && e.plane.position() == cell.hi[k]) box.hi[k] = lattice_below(cell.hi[k]);
    }
    return cell.contains(box);
}

}  // namespace

PolygonRef make_fragment(const Workbench& bench, const PolygonRef& ref,
                         const WorkPolygon& polygon) {
    std::vector<EdgeName> edges;
    std::vector<Approximation> vertices;
    edges.reserve(polygon.edges.size());
    vertices.reserve(polygon.edges.size());
    for (const WorkEdge& e : polygon.edges) edges.push_back({bench.name(e.plane), e.above});
    for (const PointId p : polygon.points) vertices.push_back(bench.approximation(p));
    PolygonRef out = ref;
    out.fragment = Fragment::make(edges, vertices, outward_box(bench, polygon));
    return out;
}

std::optional<PolygonRef> clip_to_cell(Workbench& bench, const PolygonRef& ref, const Cell& cell) {
    if (ref.fragment != nullptr ? lies_in(*ref.fragment, cell) : cell.contains(ref.box()))
        return ref;
    WorkPolygon whole = bench.polygon(ref);
    bench.with_edges(whole, ref);
    const WorkPolygon part = bench.clipped(whole, ref.box(), cell);
    if (part.is_empty()) return std::nullopt;
    if (part.points == whole.points) return ref;
    return make_fragment(bench, ref, part);
}

bool meets_cell(Workbench& bench, const PolygonRef& ref, const Cell& cell) {
    if (cell.contains(ref.box())) return true;
    if (ref.fragment == nullptr && !ref.source->is_half_space()) {
        for (int i = 0; i < 3; ++i) {
            Box corner;
            corner.add(ref.source->corner(ref.facet, i));
            if (cell.contains(corner)) return true;
        }
    }
    bench.clear();
    WorkPolygon whole = bench.polygon(ref);
    bench.with_edges(whole, ref);
    return !bench.clipped(whole, ref.box(), cell).is_empty();
}

bool ends_at_splitters(const Fragment& fragment, const Cell& cell) {
    const auto ends_at = [&](std::size_t axis, std::int64_t splitter, bool above) {
        const EdgeName e{PlaneName::splitter(static_cast<int>(axis), splitter), above};
        return std::ranges::find(fragment.edges(), e) != fragment.edges().end();
    };
    for (std::size_t k = 0; k < 3; ++k) {
        if (fragment.box().lo[k] <= lattice_below(cell.lo[k]) && !ends_at(k, cell.lo[k], true))
            return false;
        if (fragment.box().hi[k] > lattice_below(cell.hi[k]) && !ends_at(k, cell.hi[k], false))
            return false;
    }
    return true;
}

}  // namespace trisect::detail

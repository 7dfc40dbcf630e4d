// SPDX-License-Identifier: Apache-2.0
//
// An exact boundary as an operand.
//
// Imported solids are triangles with lattice corners. The corners of a result are not on the
// lattice, but its planes are as good as those of an import: that is all that cutting needs. So
// such a boundary becomes one leaf, as an import does, which lists convex fragments of planes, as
// results do. An edge is named by the plane of the face on its other side; faces that are not
// convex are divided along such planes (msp_soup.cpp), so no new plane is made and no coefficient
// grows.

#include <trisect/bsp/solid.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include <trisect/brep/import/weld_points.h>
#include <trisect/brep/measure.h>
#include <trisect/brep/triangulate.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/evaluate/named_boundary.h>
#include <trisect/bsp/msp/msp_soup.h>
#include <trisect/bsp/solid/inside_out.h>
#include <trisect/kernel/error.h>

namespace trisect {

namespace {

using detail::Box;
using detail::CellNode;
using detail::EdgeName;
using detail::FinePoint;
using detail::PlaneName;
using detail::PolygonList;
using detail::PolygonRef;
using detail::Source;
namespace msp = detail::msp;

bool is_on_the_lattice(const Brep& brep) {
    for (const Point& p : brep.points())
        if (!p.is_lattice()) return false;
    return true;
}

// Where solids touch in a vertex or an edge a B-rep has one for each of them. A source has one
// point for equal corners, so that facets that are cut there and facets that are not stay
// neighbours.
LatticeMesh triangles_of(const Brep& brep) {
    LatticeMesh mesh;
    mesh.lattice = brep.lattice();
    for (const Point& p : brep.points()) mesh.points.push_back(p.lattice());
    const auto id = detail::weld_in_place(mesh.points, mesh.points.size());
    const auto welded = [&](std::uint32_t v) { return id.empty() ? v : id[v]; };
    for (const FaceId f : brep.faces())
        for (const IndexTriangle& t : triangulate(brep, f)) {
            mesh.triangles.push_back({welded(t[0]), welded(t[1]), welded(t[2])});
            mesh.face_of_triangle.push_back(f.index);
        }
    return mesh;
}

void add_outward(Box& box, const Approximation& p) {
    for (std::size_t k = 0; k < 3; ++k) {
        box.lo[k] = std::min(box.lo[k], static_cast<std::int64_t>(std::floor(p.c[k] - p.error)));
        box.hi[k] = std::max(box.hi[k], static_cast<std::int64_t>(std::ceil(p.c[k] + p.error)));
    }
}

msp::MspSoup convex_parts_of(const Brep& brep) {
    try {
        return msp::soup_of(brep);
    } catch (const UnsupportedError&) {
        throw UnsupportedError(
            "a face borders on one in its own plane along an edge through which no other plane is "
            "known: join faces of one plane first");
    }
}

class FragmentMaker {
public:
    explicit FragmentMaker(const Brep& brep) : soup_(convex_parts_of(brep)) {
        for (const Point& p : brep.points()) add_outward(box_, p.approximation());
        source_ = Source::planes(soup_.geometry.planes(), brep.lattice(), box_);
    }

    [[nodiscard]] const std::shared_ptr<const Source>& source() const { return source_; }
    [[nodiscard]] const Box& box() const { return box_; }
    [[nodiscard]] PolygonList polygons() {
        std::vector<PolygonRef> refs;
        refs.reserve(soup_.fragments.size());
        for (const msp::Fragment& f : soup_.fragments) {
            PolygonRef r;
            r.source = source_.get();
            r.facet = f.support;
            r.fragment = fragment(f);
            refs.push_back(r);
        }
        return PolygonList(std::move(refs));
    }

private:
    const detail::Fragment* fragment(const msp::Fragment& f) {
        const std::vector<msp::Corner> corners = without_straight_ones(f);
        const std::size_t n = corners.size();
        std::vector<EdgeName> edges;
        std::vector<Approximation> vertices;
        Box box;
        for (std::size_t i = 0; i < n; ++i) {
            const msp::Corner& c = corners[i];
            vertices.push_back(geometry().approximation(c.point));
            add_outward(box, vertices.back());
            // The third corner from here is off the edge's line, on the polygon's side.
            const Side side = geometry().side(corners[(i + 2) % n].point, c.edge_plane);
            edges.push_back({PlaneName::support(source_.get(), c.edge_plane), side == Side::Above});
        }
        return detail::Fragment::make(edges, vertices, box);
    }
    // Consecutive edges of a fragment are on different lines.
    std::vector<msp::Corner> without_straight_ones(const msp::Fragment& f) {
        const auto all = geometry().corners(f);
        const std::size_t n = all.size();
        std::vector<msp::Corner> r;
        for (std::size_t i = 0; i < n; ++i) {
            const msp::Corner& before = all[(i + n - 1) % n];
            const msp::Corner& after = all[(i + 1) % n];
            if (geometry().side(after.point, before.edge_plane) != Side::On) r.push_back(all[i]);
        }
        return r;
    }
    [[nodiscard]] msp::MspGeometry& geometry() { return soup_.geometry; }

    msp::MspSoup soup_;
    Box box_;
    std::shared_ptr<const Source> source_;
};

using SourcePtr = std::shared_ptr<const Source>;

Solid solid_from(const SourcePtr& source, PolygonList polygons, const Box& box, bool mixed,
                 bool embedded) {
    auto state = std::make_shared<detail::SolidState>();
    state->lattice = source->lattice();
    state->form = detail::CellTree{
        {CellNode::leaf(std::move(polygons), detail::point_beyond(box), 0, mixed), false},
        {},
        nullptr,
        true};
    state->embedded = embedded;
    state->whole = source->is_half_space() || source->is_whole();
    state->source = source->serial();
    return detail::solid_of(std::move(state));
}

}  // namespace

Solid Solid::from_brep(const Brep& brep, Embedding embedding, InsideOut inside_out) {
    if (brep.is_empty()) return {};
    const bool accepts_all = embedding != Embedding::Assume && inside_out == InsideOut::Accept;
    if (!accepts_all && sign_of_volume(brep) <= 0) detail::require_accepted(embedding, inside_out);
    if (is_on_the_lattice(brep)) return from_lattice_mesh(triangles_of(brep), embedding);
    FragmentMaker maker(brep);
    return solid_from(maker.source(), maker.polygons(), maker.box(), true,
                      embedding == Embedding::Assume);
}

Solid detail::named_solid(const Brep& brep) {
    std::vector<FaceSource> names;
    for (const FaceId f : brep.faces()) names.push_back(brep.source(f));
    if (is_on_the_lattice(brep)) {
        const SourcePtr source = Source::named(Source::make(triangles_of(brep)), std::move(names));
        return solid_from(source, PolygonList::all_facets(*source), source->box(), false, true);
    }
    FragmentMaker maker(brep);
    // Planes after those of the faces only bound parts of faces.
    names.resize(maker.source()->facet_count());
    const SourcePtr source = Source::named(maker.source(), std::move(names));
    return solid_from(source, maker.polygons(), maker.box(), true, true);
}

}  // namespace trisect

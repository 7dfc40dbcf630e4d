// SPDX-License-Identifier: Apache-2.0

#include "dissolve.h"

#include <algorithm>
#include <vector>

#include <trisect/brep/brep_builder.h>
#include <trisect/brep/planar_loops.h>
#include <trisect/kernel/point.h>

#include "disjoint_sets.h"

namespace manifold {

namespace {

using trisect::Brep;
using trisect::FaceId;
using trisect::HalfedgeId;
using trisect::VertexId;

class Dissolver {
public:
    explicit Dissolver(const Brep& brep)
        : brep_(brep), sets_(brep.faces().size()), outgoing_(brep.vertices().size(), 0) {}

    Brep run() {
        bool changed = false;
        for (const HalfedgeId h : brep_.halfedges()) {
            const FaceId f = brep_.face(h);
            const FaceId g = brep_.face(brep_.twin(h));
            if (g < f || f == g || !are_one(f, g)) continue;
            sets_.join(f.index, g.index);
            changed = true;
        }
        for (const HalfedgeId h : brep_.halfedges())
            if (is_border(h)) ++outgoing_[brep_.origin(h).index];
        // Where no face has a corner at which nothing turns, all is as it was.
        for (const FaceId f : brep_.faces()) {
            const trisect::PlaneProjection plane(brep_.plane(f), brep_.points());
            for (const HalfedgeId h : brep_.halfedges(f))
                changed = changed || is_straight(plane, h, brep_.next(h));
        }
        return changed ? rebuilt() : brep_;
    }

private:
    bool are_one(FaceId f, FaceId g) const {
        if (brep_.source(f) != brep_.source(g)) return false;
        const trisect::Plane& plane = brep_.plane(f);
        double turn = 0;
        for (int i = 0; i < 3; ++i)
            turn += plane.approx_normal(i) * brep_.plane(g).approx_normal(i);
        return turn > 0 && std::ranges::all_of(corners_of(g), [&](VertexId v) {
                   return trisect::side_of(brep_.point(v), plane) == trisect::Side::On;
               });
    }

    std::vector<VertexId> corners_of(FaceId f) const {
        std::vector<VertexId> corners;
        for (const HalfedgeId h : brep_.halfedges(f)) corners.push_back(brep_.origin(h));
        return corners;
    }

    std::uint32_t region(HalfedgeId h) { return sets_.root(brep_.face(h).index); }
    bool is_border(HalfedgeId h) { return region(h) != region(brep_.twin(h)); }
    // The next one along the border of the region.
    HalfedgeId next_border(HalfedgeId h) {
        HalfedgeId n = brep_.next(h);
        while (!is_border(n)) n = brep_.next(brep_.twin(n));
        return n;
    }
    // Copies at a contact are one vertex of the builder, which takes them apart again.
    VertexId place(VertexId v) const {
        const auto copies = brep_.copies(v);
        return copies.empty() ? v : *std::ranges::min_element(copies);
    }

    Brep rebuilt() {
        std::vector<std::vector<trisect::IndexLoop>> loops(brep_.faces().size());
        std::vector<bool> done(brep_.halfedges().size());
        for (const HalfedgeId first : brep_.halfedges()) {
            if (done[first.index] || !is_border(first)) continue;
            const std::uint32_t r = region(first);
            const trisect::PlaneProjection plane(brep_.plane(FaceId(r)), brep_.points());
            trisect::IndexLoop loop;
            HalfedgeId before = first;
            do {
                done[before.index] = true;
                const HalfedgeId h = next_border(before);
                if (!is_straight(plane, before, h)) loop.push_back(brep_.origin(h).index);
                before = h;
            } while (before != first);
            loops[r].push_back(std::move(loop));
        }
        return built(loops);
    }

    bool is_straight(const trisect::PlaneProjection& plane, HalfedgeId before, HalfedgeId h) {
        const VertexId v = brep_.origin(h);
        return outgoing_[v.index] == 2 &&
               plane.orientation(brep_.origin(before).index, v.index, brep_.target(h).index) == 0;
    }

    Brep built(const std::vector<std::vector<trisect::IndexLoop>>& loops) const {
        trisect::BrepBuilder builder(brep_.lattice());
        std::vector<std::uint32_t> number(brep_.vertices().size(), VertexId::none);
        const auto vertex = [&](std::uint32_t v) {
            const VertexId at = place(VertexId(v));
            if (number[at.index] == VertexId::none)
                number[at.index] = builder.add_vertex(brep_.point(at));
            return number[at.index];
        };
        for (const FaceId f : brep_.faces()) {
            if (loops[f.index].empty()) continue;
            for (std::vector<trisect::IndexLoop>& piece :
                 trisect::connected_regions(brep_.plane(f), brep_.points(), loops[f.index])) {
                for (trisect::IndexLoop& loop : piece)
                    for (std::uint32_t& v : loop) v = vertex(v);
                builder.add_face(brep_.plane(f), piece, brep_.source(f));
            }
        }
        return std::move(builder).build();
    }

    const Brep& brep_;
    DisjointSets sets_;
    std::vector<int> outgoing_;  // by vertex: edges that stay
};

}  // namespace

Brep dissolved(const Brep& brep) { return Dissolver(brep).run(); }

}  // namespace manifold

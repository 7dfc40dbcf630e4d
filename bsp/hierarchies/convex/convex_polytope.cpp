// SPDX-License-Identifier: Apache-2.0
//
// A walk over features needs, from each of them, the next larger ones: from a vertex its edges,
// from an edge its two faces. Whether a larger feature comes nearer to a point is decided by one
// vertex of it off the smaller one (`Spoke::vertex`, `Edge::across`); so these are kept with the
// adjacency, and no edge direction or normal is ever stored, which a pose would have to turn.

#include <trisect/bsp/hierarchies/convex/convex_polytope.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <trisect/kernel/contract.h>
#include <trisect/kernel/number/flat_corner.h>
#include <trisect/kernel/predicates.h>

namespace trisect::hierarchies {

namespace {

using Loop = std::vector<std::uint32_t>;

// Three corners a third of the way round from each other: not collinear, as no three are.
std::array<std::uint32_t, 3> far_apart(std::span<const std::uint32_t> loop) {
    const std::size_t n = loop.size();
    return {loop[0], loop[(n + 1) / 3], loop[(2 * n + 1) / 3]};
}

}  // namespace

ConvexPolytope::ConvexPolytope(Lattice lattice, int dimension,
                               std::span<const LatticePoint> vertices,
                               std::span<const std::vector<std::uint32_t>> loops)
    : lattice_(lattice), dimension_(dimension) {
    std::vector<std::uint32_t> order(vertices.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    std::sort(order.begin(), order.end(),
              [&](std::uint32_t a, std::uint32_t b) { return vertices[a] < vertices[b]; });
    std::vector<std::uint32_t> name(order.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) {
        name[order[i]] = i;
        vertices_.push_back(vertices[order[i]]);
    }
    std::vector<Loop> faces;
    for (const Loop& given : loops) {
        Loop loop;
        for (const std::uint32_t v : given) loop.push_back(name[v]);
        std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
        faces.push_back(std::move(loop));
    }
    std::sort(faces.begin(), faces.end());
    for (const Loop& loop : faces) {
        corners_.insert(corners_.end(), loop.begin(), loop.end());
        first_corner_.push_back(static_cast<std::uint32_t>(corners_.size()));
        const auto s = far_apart(loop);
        spans_.push_back(s);
        planes_.push_back(Plane::through(vertices_[s[0]], vertices_[s[1]], vertices_[s[2]]));
    }
    make_edges();
    make_spokes();
    note_sizes();
}

ConvexPolytope::ConvexPolytope(Lattice lattice, std::span<const LatticePoint> ends)
    : lattice_(lattice),
      dimension_(static_cast<int>(ends.size()) - 1),
      vertices_(ends.begin(), ends.end()) {
    TRISECT_EXPECTS(dimension_ == 0 || dimension_ == 1, "a segment has two ends");
    std::sort(vertices_.begin(), vertices_.end());
    if (dimension_ == 1) {
        edges_.emplace_back();
        edges_.back().vertex = {0, 1};
    }
    make_spokes();
    note_sizes();
}

void ConvexPolytope::make_edges() {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> number;
    for (std::size_t f = 0; f < face_count(); ++f) {
        const auto loop = corners(f);
        for (std::size_t i = 0; i < loop.size(); ++i)
            number.emplace(std::minmax(loop[i], loop[(i + 1) % loop.size()]), 0);
    }
    for (auto& [ends, n] : number) {
        n = static_cast<std::uint32_t>(edges_.size());
        edges_.emplace_back();
        edges_.back().vertex = {ends.first, ends.second};
    }
    sides_.resize(corners_.size());
    for (std::size_t f = 0; f < face_count(); ++f) {
        const auto loop = corners(f);
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const std::uint32_t from = loop[i];
            const std::uint32_t to = loop[(i + 1) % loop.size()];
            const std::uint32_t e = number.at(std::minmax(from, to));
            sides_[first_corner_[f] + i] = e;
            Edge& edge = edges_[e];
            const std::size_t side = from < to ? 0 : 1;
            TRISECT_EXPECTS(edge.face[side] == none, "faces of a polytope overlap");
            edge.face[side] = static_cast<std::uint32_t>(f);
            // Neither end of the side: between 2 and n - 1 corners on.
            edge.across[side] = loop[(i + 1 + loop.size() / 2) % loop.size()];
        }
    }
    for (const Edge& e : edges_)
        TRISECT_EXPECTS(e.face[0] != none && e.face[1] != none, "a polytope is open");
}

void ConvexPolytope::make_spokes() {
    std::vector<std::vector<Spoke>> at(vertices_.size());
    for (std::uint32_t e = 0; e < edges_.size(); ++e) {
        const auto [a, b] = edges_[e].vertex;
        at[a].push_back({e, b});
        at[b].push_back({e, a});
    }
    for (const auto& spokes : at) {
        spokes_.insert(spokes_.end(), spokes.begin(), spokes.end());
        first_spoke_.push_back(static_cast<std::uint32_t>(spokes_.size()));
    }
}

void ConvexPolytope::note_sizes() {
    for (const LatticePoint& p : vertices_) {
        for (int k = 0; k < 3; ++k) largest_ = std::max(largest_, std::fabs(p[k].to_double()));
        whole_ = whole_ && p.is_whole();
    }
}

std::size_t ConvexPolytope::bytes() const {
    return sizeof *this + vertices_.size() * sizeof(LatticePoint) + edges_.size() * sizeof(Edge) +
           planes_.size() * (sizeof(Plane) + sizeof(spans_[0]) + 4) + corners_.size() * 8 +
           spokes_.size() * sizeof(Spoke) + first_spoke_.size() * 4;
}

bool ConvexPolytope::contains(const LatticePoint& p) const {
    for (std::size_t f = 0; f < face_count(); ++f) {
        if (side_of(p, planes_[f]) == Side::Above) return false;
        if (dimension_ > 2) continue;
        // In the plane: not beyond a side, seen along the largest component of the normal.
        const auto loop = corners(f);
        const int axis = planes_[f].dominant_axis();
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const LatticePoint& a = vertices_[loop[i]];
            const LatticePoint& b = vertices_[loop[(i + 1) % loop.size()]];
            const int j = (axis + 1) % 3;
            const int k = (axis + 2) % 3;
            const auto flat = [&](const LatticePoint& c) { return detail::flat_corner(c, j, k); };
            const int side = detail::turn(flat(a), flat(b), flat(p));
            if (planes_[f].normal(axis) > 0 ? side < 0 : side > 0) return false;
        }
    }
    return !is_empty();
}

}  // namespace trisect::hierarchies

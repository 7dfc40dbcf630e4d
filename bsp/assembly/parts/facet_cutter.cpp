// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/assembly/parts/facet_cutter.h>

#include <algorithm>
#include <array>
#include <cmath>

#include <trisect/brep/face/small_polygon.h>
#include <trisect/kernel/contract.h>
#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/support/as_index.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

namespace {

constexpr std::uint32_t not_listed = static_cast<std::uint32_t>(-1);

// In a loop of one region all passages of a vertex have one name.
bool is_simple(std::span<const PointId> loop) {
    for (std::size_t i = 0; i < loop.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (loop[i] == loop[j]) return false;
    return true;
}

// A plane that is looked at along these axes. Of the support no more is needed, which takes longer
// to make.
Plane plane_seen_along(PlaneProjection::Axes axes) {
    const int across = 3 - axes.u - axes.v;
    const Plane plane = PlaneName::splitter(across, 0).plane();
    return axes.u == (across + 1) % 3 ? plane : plane.flipped();
}

}  // namespace

void FacetCutter::cut(std::span<const BoundaryEdge> edges, CutFacets& out) {
    const BoundaryFacet& f = parts_.facets[as_index(edges[0].facet)];
    const std::size_t table = parts_.table_of(f.source);
    out.facets.push_back({table, f.facet, f.flipped, out.corners.size()});
    loops_.set_region(f.support, f.flipped, edges);
    if (loops_.loop_count() == 1 && is_all_of(f, loops_.loop(0))) {
        add_all_of(f, loops_.loop(0), out.corners);
    } else if (loops_.has_holes()) {
        cut_large(0, loops_.loop_count(), out.corners);
    } else {
        for (std::size_t l = 0; l < loops_.loop_count(); ++l) cut_loop(l, out.corners);
    }
}

// A facet may have been touched in vain; then the result must not differ from that of one that was
// not.
bool FacetCutter::is_all_of(const BoundaryFacet& f, std::span<const PointId> loop) const {
    return loop.size() == 3 && std::ranges::all_of(loop, [&](PointId p) {
               if (!bench_.is_corner(p)) return false;
               const auto [source, v] = bench_.corner_name(p);
               if (source != f.source) return false;
               const auto& corners = source->mesh().triangles[f.facet];
               return std::ranges::find(corners, v) != corners.end();
           });
}

// In the order that the facet has.
void FacetCutter::add_all_of(const BoundaryFacet& f, std::span<const PointId> loop,
                             PoolVector<PointId>& out) const {
    const std::uint32_t first = f.source->mesh().triangles[f.facet][0];
    std::size_t i = 0;
    while (bench_.corner_name(loop[i]).second != first) ++i;
    for (std::size_t k = 0; k < 3; ++k) out.push_back(loop[(i + k) % 3]);
}

void FacetCutter::cut_loop(std::size_t l, PoolVector<PointId>& out) {
    const auto loop = loops_.loop(l);
    if (loop.size() > small_polygon_limit || !(loops_.are_simple() || is_simple(loop))) {
        cut_large(l, l + 1, out);
    } else {
        cut_small(l, out);
    }
}

// Vertices are rounded correctly, and all corners of a loop are used; so turns are those of rounded
// corners, and few are left for integers.
void FacetCutter::cut_small(std::size_t l, PoolVector<PointId>& out) {
    const auto loop = loops_.loop(l);
    const PlaneProjection::Axes axes = loops_.axes();
    rounded_.clear();
    exact_.clear();
    exact_of_.assign(loop.size(), -1);
    for (const PointId p : loop) add_rounded(p, axes);
    const auto orientation = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        const int s = rounded_.turn(a, b, c);
        return s != 0 ? s : doubtful_turn(l, {a, b, c});
    };
    // A loop starts at its smallest vertex.
    const auto first_corner = [] { return std::uint32_t{0}; };
    const bool done = cut_small_polygon(loop.size(), orientation, first_corner,
                                        [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
                                            out.insert(out.end(), {loop[a], loop[b], loop[c]});
                                        });
    TRISECT_EXPECTS(done, "a face with a simple outline has an ear");
}

// Whether the edges between them on one way around the loop are on one line, by name.
bool FacetCutter::are_in_row(std::size_t l, const std::array<std::uint32_t, 3>& corners) const {
    std::array<std::uint32_t, 3> c = corners;
    std::ranges::sort(c);
    const auto n = static_cast<std::uint32_t>(loops_.loop(l).size());
    const auto is_line = [&](std::uint32_t from, std::uint32_t to) {
        const PlaneId line = loops_.line_from(l, from);
        for (std::uint32_t i = from; i != to; i = i + 1 == n ? 0 : i + 1)
            if (loops_.line_from(l, i) != line) return false;
        return true;
    };
    return is_line(c[0], c[2]) || is_line(c[1], c[0]) || is_line(c[2], c[1]);
}

// In units of the lattice. Multiples of at least 2^-330 of these units do not underflow in those of
// the mesh, which differ by a power of two, unless that is extreme.
void FacetCutter::add_rounded(PointId p, PlaneProjection::Axes axes) {
    const auto u = static_cast<std::size_t>(axes.u);
    const auto v = static_cast<std::size_t>(axes.v);
    if (made_.unit < 0x1p-600 || bench_.is_lattice(p)) {
        const Approximation& at = bench_.approximation(p);
        return rounded_.add(at.c[u], at.c[v], at.error);
    }
    const Point3d& at = made_.coordinates[made_.number_of[as_index(p)]];
    const double inverse_unit = 1 / made_.unit;
    rounded_.add_nearest(at[u] * inverse_unit, at[v] * inverse_unit);
}

// Each corner is computed once: triangles that nearly lie in one plane make rows of corners that
// nearly lie on one line, where many turns are exact.
// One call for what is rare, so that the turns of rounded corners are compiled where they are
// taken.
int FacetCutter::doubtful_turn(std::size_t l, const std::array<std::uint32_t, 3>& corners) {
    return are_in_row(l, corners) ? 0 : exact_turn(loops_.loop(l), corners, loops_.axes());
}

int FacetCutter::exact_turn(std::span<const PointId> loop,
                            const std::array<std::uint32_t, 3>& corners,
                            PlaneProjection::Axes axes) {
    for (const std::uint32_t c : corners) {
        if (exact_of_[c] >= 0) continue;
        exact_of_[c] = static_cast<int>(exact_.size());
        exact_.push_back(bench_.homogeneous(loop[c]));
    }
    const auto at = [&](std::size_t i) -> const HomogeneousPoint& {
        return exact_[as_index(exact_of_[corners[i]])];
    };
    return PlaneProjection::exact_orientation(at(0), at(1), at(2), axes);
}

// In units of the lattice, as above. Correctly rounded coordinates are off by half a unit in the
// last place of the largest one.
Approximation FacetCutter::nearest(PointId p) const {
    if (bench_.is_lattice(p)) return bench_.approximation(p);
    std::array<double, 3> at{};
    if (made_.unit < 0x1p-600) {
        at = bench_.nearest(p);
    } else {
        at = made_.coordinates[made_.number_of[as_index(p)]];
        for (double& c : at) c *= 1 / made_.unit;
    }
    const double largest = std::max(std::fabs(at[0]), std::max(std::fabs(at[1]), std::fabs(at[2])));
    return {at, largest * unit_roundoff};
}

// Loops [first, end) as one region.
void FacetCutter::cut_large(std::size_t first, std::size_t end, PoolVector<PointId>& out) {
    corners_.clear();
    outline_.clear();
    local_.resize(bench_.point_count(), not_listed);
    for (std::size_t l = first; l < end; ++l) {
        auto& loop = outline_.emplace_back();
        for (const PointId p : loops_.loop(l)) {
            if (local_[as_index(p)] == not_listed) {
                local_[as_index(p)] = static_cast<std::uint32_t>(corners_.size());
                corners_.add(p, nearest(p));
            }
            loop.push_back(local_[as_index(p)]);
        }
    }
    for (const PointId p : corners_.points()) local_[as_index(p)] = not_listed;
    const PlaneProjection projection(plane_seen_along(loops_.axes()), corners_);
    for (const IndexTriangle& t : triangulate(projection, outline_))
        for (const std::uint32_t i : t) out.push_back(corners_.point(i));
}

}  // namespace trisect::detail

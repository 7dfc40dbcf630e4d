// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/measure/boundary_bounds.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>

#include <trisect/bsp/assembly/assembly_parts.h>
#include <trisect/bsp/assembly/joining/join_facets.h>
#include <trisect/kernel/stop_scope.h>
#include <trisect/kernel/support/as_index.h>
#include <trisect/kernel/support/pool_allocator.h>

namespace trisect::detail {

namespace {

// The ends of the boundary along the axes, in lattice units. A vertex that is a quotient is rounded
// only where it may be an end.
class Ends {
public:
    void add(const LatticePoint& p) { add(p.doubles()); }
    void add(const std::array<double, 3>& c) {
        for (std::size_t k = 0; k < 3; ++k) {
            lo_[k] = std::min(lo_[k], c[k]);
            hi_[k] = std::max(hi_[k], c[k]);
        }
    }
    /// What is beyond this in any case.
    void add(const Approximation& a) {
        for (std::size_t k = 0; k < 3; ++k) {
            lo_[k] = std::min(lo_[k], a.c[k] + error_along(a, k));
            hi_[k] = std::max(hi_[k], a.c[k] - error_along(a, k));
        }
    }
    [[nodiscard]] bool may_be_beyond(const Approximation& a) const {
        for (std::size_t k = 0; k < 3; ++k)
            if (a.c[k] - error_along(a, k) <= lo_[k] || a.c[k] + error_along(a, k) >= hi_[k])
                return true;
        return false;
    }
    [[nodiscard]] bool contain(const std::array<double, 3>& c) const {
        for (std::size_t k = 0; k < 3; ++k)
            if (c[k] < lo_[k] || c[k] > hi_[k]) return false;
        return true;
    }
    [[nodiscard]] bool is_empty() const { return lo_[0] > hi_[0]; }
    [[nodiscard]] Bounds in_units_of(Lattice lattice) const {
        Bounds out;
        for (std::size_t k = 0; k < 3; ++k) {
            out.lo[k] = lattice.to_double(lo_[k]);
            out.hi[k] = lattice.to_double(hi_[k]);
        }
        return out;
    }

private:
    // With what sums of a coordinate and this are rounded.
    static double error_along(const Approximation& a, std::size_t axis) {
        return a.error + 0x1p-50 * (std::fabs(a.c[axis]) + a.error);
    }
    static constexpr double infinity = std::numeric_limits<double>::infinity();
    std::array<double, 3> lo_{infinity, infinity, infinity};
    std::array<double, 3> hi_{-infinity, -infinity, -infinity};
};

// Those of the facets that pass through.
Ends ends_of_whole_facets(const BoundaryParts& parts) {
    Ends ends;
    for (const FacetMarks& marks : parts.sources) {
        const LatticeMesh& mesh = marks.source()->mesh();
        marks.for_each_whole([&](std::uint32_t facet, bool) {
            for (const std::uint32_t v : mesh.triangles[facet]) ends.add(mesh.points[v]);
        });
        check_stop();
    }
    return ends;
}

// Those and the vertices of edges, rounded.
Ends with_edges(Ends ends, const Workbench& bench, std::span<const BoundaryEdge> edges) {
    for (const BoundaryEdge& e : edges)
        if (bench.is_lattice(e.from)) ends.add(bench.lattice(e.from));
    Ends surely_within = ends;
    PoolVector<PointId> made;
    for (const BoundaryEdge& e : edges) {
        const Approximation& a = bench.approximation(e.from);
        if (bench.is_lattice(e.from) || !ends.may_be_beyond(a)) continue;
        made.push_back(e.from);
        surely_within.add(a);
    }
    for (const PointId p : made)
        if (surely_within.may_be_beyond(bench.approximation(p))) ends.add(bench.nearest(p));
    return ends;
}

// Where facets are in special position, outlines without a width may reach beyond the boundary;
// joined, they vanish. Mostly what others have says that none does.
std::optional<Ends> without_special_facets(const BoundaryParts& parts, const Ends& whole) {
    BoundaryEdges others;
    PoolVector<std::uint8_t> has_others(parts.bench.point_count());
    const auto is_special = [&](const BoundaryEdge& e) {
        return parts.facets[as_index(e.facet)].is_special;
    };
    for (const BoundaryEdge& e : parts.edges) {
        if (is_special(e)) continue;
        others.push_back(e);
        has_others[as_index(e.from)] = 1;
    }
    const Ends ends = with_edges(whole, parts.bench, others);
    const auto is_within = [&](const BoundaryEdge& e) {
        if (!is_special(e) || has_others[as_index(e.from)] != 0) return true;
        return !ends.may_be_beyond(parts.bench.approximation(e.from)) ||
               ends.contain(parts.bench.nearest(e.from));
    };
    if (ends.is_empty() || !std::ranges::all_of(parts.edges, is_within)) return std::nullopt;
    return ends;
}

}  // namespace

std::optional<Bounds> boundary_bounds(const SolidState& solid) {
    BoundaryParts parts;
    gather_parts(solid, parts, true);
    const Ends whole = ends_of_whole_facets(parts);
    std::optional<Ends> ends;
    if (parts.are_joined || std::ranges::none_of(parts.facets, &BoundaryFacet::is_special)) {
        ends = with_edges(whole, parts.bench, parts.edges);
    } else {
        ends = without_special_facets(parts, whole);
    }
    if (!ends) {
        BoundaryEdges edges = std::move(parts.edges);
        join_facets(parts, edges);
        ends = with_edges(whole, parts.bench, edges);
    }
    if (ends->is_empty()) return std::nullopt;
    return ends->in_units_of(solid.lattice);
}

}  // namespace trisect::detail

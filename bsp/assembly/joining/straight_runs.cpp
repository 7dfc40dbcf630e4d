// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/assembly/joining/straight_runs.h>

#include <algorithm>
#include <array>
#include <atomic>

#include <trisect/brep/planar_loops.h>
#include <trisect/bsp/assembly/parts/coplanar_facets.h>
#include <trisect/bsp/assembly/parts/vertex_turn.h>
#include <trisect/kernel/contract.h>
#include <trisect/kernel/support/as_index.h>
#include <trisect/kernel/support/radix_sort.h>

namespace trisect::detail {

namespace {

// Those of one point stay in the order of the edges.
void sort_ends(PoolVector<std::pair<PointId, std::size_t>>& ends) {
    constexpr std::size_t few = 256;
    if (ends.size() < few) return std::sort(ends.begin(), ends.end());
    radix_sort(ends, [](const auto& end) { return static_cast<std::uint64_t>(end.first); });
}

bool are_one_by_corners(const PlaneName& p, const PlaneName& q) {
    const auto is_of_facet = [](const PlaneName& n) {
        return n.kind == PlaneName::Support && !n.source()->is_half_space();
    };
    if (!is_of_facet(p) || !is_of_facet(q)) return false;
    const FacetPoints facet = facet_points(*p.source(), p.facet);
    return std::ranges::all_of(facet_points(*q.source(), q.facet), [&](const Vector3& corner) {
        return side_of_facet(facet, corner) == 0;
    });
}

}  // namespace

void StraightRuns::look_at(std::size_t first, std::size_t end, EdgeChains& chains) {
    constexpr std::size_t ahead = 16;
    for (std::size_t i = first; i < end;) {
        std::size_t j = i;
        for (; j < end && edges_[j].facet == edges_[i].facet; ++j)
            if (j + ahead < end)  // names of points lie anywhere in memory
                __builtin_prefetch(&bench_.planes_of(edges_[j + ahead].from));
        look_at_facet(i, j, chains);
        i = j;
    }
}

void StraightRuns::compute(std::span<std::size_t> next) {
    for (const Passage& d : uncertain_) {
        const PointId p = edges_[d.out].from;
        if (is_kept(p)) continue;
        if (runs_straight(edges_[d.in], edges_[d.out])) {
            next[d.in] = d.out;
        } else {
            keep(p);
        }
    }
}

bool StraightRuns::is_kept(PointId p) const {
    return std::atomic_ref(keep_[as_index(p)]).load(std::memory_order_relaxed) != 0;
}
void StraightRuns::keep(PointId p) {
    std::atomic_ref(keep_[as_index(p)]).store(1, std::memory_order_relaxed);
}

void StraightRuns::look_at_facet(std::size_t first, std::size_t end, EdgeChains& chains) {
    const auto region = std::span(edges_).subspan(first, end - first);
    if (!chains.are_simple(region)) return look_at_any(first, end);
    const PlaneId support = parts_.facets[as_index(region[0].facet)].support;
    for_each_turn(region, [&](std::size_t in, std::size_t out) {
        const PointId p = region[out].from;
        if (is_kept(p)) return;
        if ((keep_corners_ && bench_.is_corner(p)) ||
            name_tells_turn(bench_, p, support, region[in].line, region[out].line)) {
            keep(p);
        } else {
            add_passage(first + in, first + out);
        }
    });
}

void StraightRuns::look_at_any(std::size_t first, std::size_t end) {
    by_from_.clear();
    by_to_.clear();
    for (std::size_t i = first; i < end; ++i) {
        by_from_.emplace_back(edges_[i].from, i);
        by_to_.emplace_back(edges_[i].to, i);
    }
    sort_ends(by_from_);
    sort_ends(by_to_);
    const std::size_t n = by_from_.size();
    for (std::size_t k = 0; k < n; ++k) {
        const auto [p, out] = by_from_[k];
        const auto [q, in] = by_to_[k];
        TRISECT_EXPECTS(p == q, "boundary of a face is not closed");
        const bool single =
            (k == 0 || by_from_[k - 1].first != p) && (k + 1 == n || by_from_[k + 1].first != p);
        if (is_kept(p)) continue;
        if (keep_corners_ && bench_.is_corner(p)) {
            keep(p);
        } else if (single) {
            add_passage(in, out);
        } else if (k + 1 == n || by_from_[k + 1].first != p) {
            add_passages_of_slit(k);
        }
    }
}

void StraightRuns::add_passage(std::size_t in, std::size_t out) {
    if (edges_[in].from == edges_[out].to) {
        keep(edges_[out].from);  // the tip of a slit
    } else {
        uncertain_.push_back({in, out});
    }
}

// A vertex that several edges leave, the last of them at place k. Where these are two, and two
// others come from where they go to, it may lie inside a line along which the region is slit.
void StraightRuns::add_passages_of_slit(std::size_t k) {
    const PointId p = by_from_[k].first;
    const bool two = by_from_[k - 1].first == p && (k < 2 || by_from_[k - 2].first != p);
    std::array<std::size_t, 2> in{by_to_[k - 1].second, by_to_[k].second};
    const std::array<std::size_t, 2> out{by_from_[k - 1].second, by_from_[k].second};
    if (edges_[in[0]].from == edges_[out[0]].to) std::swap(in[0], in[1]);
    if (!two || edges_[in[0]].from != edges_[out[1]].to ||
        edges_[in[1]].from != edges_[out[0]].to) {
        keep(p);
        return;
    }
    for (std::size_t i = 0; i < 2; ++i) add_passage(in[i], out[i]);
}

// By the corners of the facets whose supports they are. Long runs have the same two.
bool StraightRuns::are_one_plane(PlaneId p, PlaneId q) {
    if (p == q) return true;
    if (std::exchange(last_planes_, {p, q}) != std::pair(p, q))
        last_are_one_ = are_one_by_corners(bench_.name(p), bench_.name(q));
    return last_are_one_;
}
// Mostly doubles decide, and then no planes are made.
bool StraightRuns::runs_straight(const BoundaryEdge& in, const BoundaryEdge& out) {
    const BoundaryFacet& f = parts_.facets[as_index(in.facet)];
    if (are_one_plane(in.line.plane, out.line.plane)) return true;
    const int k = bench_.facing(f.support).axis;
    const PlaneProjection::Axes axes{(k + 1) % 3, (k + 2) % 3};
    if (PlaneProjection::filtered_orientation(bench_.approximation(in.from),
                                              bench_.approximation(out.from),
                                              bench_.approximation(out.to), axes) != 0)
        return false;
    return turn_at_vertex(bench_, f.support, f.flipped, in.line, out.line) == 0;
}

}  // namespace trisect::detail

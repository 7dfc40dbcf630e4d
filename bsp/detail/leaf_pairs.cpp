// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/detail/leaf_pairs.h>

#include <algorithm>
#include <utility>

#include <trisect/bsp/detail/leaf_pieces.h>
#include <trisect/bsp/detail/work_budget.h>

namespace trisect::detail {

namespace {

// Corners of sources that two whole facets have in common.
int shared_corners(const LeafItem& a, const LeafItem& b) {
    if (a.ref.source != b.ref.source || a.ref.fragment != nullptr || b.ref.fragment != nullptr)
        return 0;
    int n = 0;
    for (const PointId p : a.shape.points)
        n += static_cast<int>(std::count(b.shape.points.begin(), b.shape.points.end(), p));
    return n;
}

}  // namespace

void LeafPairs::relate_all() {
    const auto n = static_cast<LeafIndex>(work_.items.size());
    for (LeafIndex i = 0; i < n; ++i) {
        check_budget(*work_.problem->options, *work_.stats);
        for (LeafIndex j = i + 1; j < n; ++j) {
            const LeafItem& a = work_.item(i);
            const LeafItem& b = work_.item(j);
            if (a.operand == b.operand && work_.operand_of(a).embedded) continue;
            if (!a.box.overlaps(b.box)) continue;
            ++work_.stats->pairs_boxes;
            relate(i, j);
        }
    }
}

void LeafPairs::relate(LeafIndex s, LeafIndex t) {
    LeafItem& a = work_.item(s);
    LeafItem& b = work_.item(t);
    const auto range = [&](const WorkPolygon& w, PlaneId plane) {
        int lo = 2;
        int hi = -2;
        for (const PointId p : w.points) {
            const int x = work_.bench.side(p, plane);
            lo = std::min(lo, x);
            hi = std::max(hi, x);
        }
        return std::pair{lo, hi};
    };
    const auto [b_lo, b_hi] = range(b.shape, a.shape.support);
    if (b_lo > 0 || b_hi < 0) return;
    if (b_lo == 0 && b_hi == 0) {
        work_.bench.declare_same(a.shape.support, b.shape.support);
        relate_coplanar(s, t);
        return;
    }
    const auto [a_lo, a_hi] = range(a.shape, b.shape.support);
    if (a_lo > 0 || a_hi < 0) return;
    const int shared = a.operand == b.operand ? shared_corners(a, b) : 0;
    // Two facets in different planes with a common edge meet nowhere else; with one common corner
    // and the rest of one of them strictly on one side they meet in that corner only.
    if (shared >= 2) return;
    if (shared == 1 && (b_lo == 0 || b_hi == 0) &&
        std::count_if(b.shape.points.begin(), b.shape.points.end(),
                      [&](PointId p) { return work_.bench.side(p, a.shape.support) == 0; }) == 1)
        return;
    if (shared == 1 && (a_lo == 0 || a_hi == 0) &&
        std::count_if(a.shape.points.begin(), a.shape.points.end(),
                      [&](PointId p) { return work_.bench.side(p, b.shape.support) == 0; }) == 1)
        return;
    a.touched = true;
    b.touched = true;
    bool cutting = false;
    if (a_lo < 0 && a_hi > 0 && cuts(work_.bench, work_.with_edges(s), work_.with_edges(t))) {
        a.cutters.push_back(t);
        cutting = true;
    }
    if (b_lo < 0 && b_hi > 0 && cuts(work_.bench, work_.with_edges(t), work_.with_edges(s))) {
        b.cutters.push_back(s);
        cutting = true;
    }
    if (cutting) ++work_.stats->pairs_cutting;
}

bool LeafPairs::separated_by_edges_of(LeafIndex s, LeafIndex t) {
    const WorkPolygon& a = work_.with_edges(s);
    const WorkPolygon& b = work_.item(t).shape;
    return std::any_of(a.edges.begin(), a.edges.end(), [&](const WorkEdge& e) {
        const int outside = e.above ? -1 : 1;
        return std::all_of(b.points.begin(), b.points.end(),
                           [&](PointId p) { return work_.bench.side(p, e.plane) * outside >= 0; });
    });
}

void LeafPairs::relate_coplanar(LeafIndex s, LeafIndex t) {
    LeafItem& a = work_.item(s);
    LeafItem& b = work_.item(t);
    const bool same_surface = a.operand == b.operand && shared_corners(a, b) == 2;
    if (separated_by_edges_of(s, t) || separated_by_edges_of(t, s)) {
        if (!same_surface) {
            a.touched = true;
            b.touched = true;
        }
        return;
    }
    a.touched = true;
    b.touched = true;
    a.covers.push_back(t);
    b.covers.push_back(s);
}

}  // namespace trisect::detail

// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/detail/leaf_coincidence.h>

#include <algorithm>
#include <tuple>
#include <utility>

namespace trisect::detail {

namespace {

bool covered_by(LeafWork& work, const WorkPolygon& piece, LeafIndex t) {
    const WorkPolygon& cover = work.with_edges(t);
    return std::all_of(cover.edges.begin(), cover.edges.end(), [&](const WorkEdge& e) {
        const int outside = e.above ? -1 : 1;
        return std::all_of(piece.points.begin(), piece.points.end(),
                           [&](PointId p) { return work.bench.side(p, e.plane) * outside <= 0; });
    });
}

bool speaks_before(const LeafWork& work, const LeafItem& a, const LeafItem& b) {
    const auto key = [&](const LeafItem& i) {
        return std::tuple(work.operand_of(i).slot, i.ref.source->serial(), i.ref.facet);
    };
    if (key(a) != key(b)) return key(a) < key(b);
    return &a < &b;
}

}  // namespace

void resolve_coincidence(LeafWork& work, std::size_t first) {
    for (std::size_t i = first; i < work.pieces.size(); ++i) {
        LeafPiece& piece = work.pieces[i];
        const LeafItem& item = work.item(piece.item);
        std::vector<int> step = work.step_of(piece.item);
        for (const LeafIndex t : item.covers) {
            if (!covered_by(work, piece.shape, t)) continue;
            const LeafItem& other = work.item(t);
            if (speaks_before(work, other, item)) {
                piece.dropped = true;
                if (!work.problem->cell.contains(item.ref.box()))
                    work.incomplete.push_back({item.ref.source->serial(), item.ref.facet});
                break;
            }
            // Orientation of the cover relative to this item's support.
            const bool same = same_orientation(work.bench.plane_at(item.shape.support),
                                               work.bench.plane_at(other.shape.support));
            step[LeafWork::u(other.operand)] += same ? other.orientation : -other.orientation;
        }
        piece.step = static_cast<int>(work.steps.size());
        work.steps.push_back(std::move(step));
    }
}

}  // namespace trisect::detail

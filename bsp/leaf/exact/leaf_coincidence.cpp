// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/leaf/exact/leaf_coincidence.h>

#include <algorithm>
#include <tuple>
#include <utility>
#include <vector>

#include <trisect/kernel/support/as_index.h>

namespace trisect::detail {

bool is_within(const Workbench& bench, const WorkPolygon& piece, const WorkPolygon& other) {
    return std::all_of(other.edges.begin(), other.edges.end(), [&](const WorkEdge& e) {
        const int outside = e.above ? -1 : 1;
        return std::all_of(piece.points.begin(), piece.points.end(),
                           [&](PointId p) { return bench.side(p, e.plane) * outside <= 0; });
    });
}

bool represents_before(const LeafWork& work, LeafIndex a, LeafIndex b) {
    const auto key = [&](LeafIndex i) {
        const LeafItem& item = work.item(i);
        return std::tuple(work.operand_of(item).slot, item.ref.source->serial(), item.ref.facet, i);
    };
    return key(a) < key(b);
}

void resolve_coincidence(LeafWork& work, std::size_t first) {
    std::vector<int> step(work.problem->operands.size());
    for (std::size_t k = first; k < work.pieces.size(); ++k) {
        LeafPiece& piece = work.pieces[k];
        const LeafItem& item = work.item(piece.item);
        std::fill(step.begin(), step.end(), 0);
        step[as_index(item.operand)] += item.orientation;
        bool alone = true;
        for (const LeafContact& c : work.contacts(piece.item)) {
            if (!c.overlaps || !is_within(work.bench, piece.shape, work.with_edges(c.other)))
                continue;
            alone = false;
            if (represents_before(work, c.other, piece.item)) {
                piece.dropped = true;
                if (!item.contained)
                    work.incomplete.push_back({item.ref.source->serial(), item.ref.facet});
                break;
            }
            // Orientation of the coincident polygon relative to this item's support.
            const LeafItem& other = work.item(c.other);
            const bool same = same_orientation(work.bench.plane_at(item.shape.support),
                                               work.bench.plane_at(other.shape.support));
            step[as_index(other.operand)] += same ? other.orientation : -other.orientation;
        }
        if (alone || piece.dropped) continue;
        piece.step = static_cast<LeafIndex>(work.steps.size());
        work.steps.push_back(step);
    }
}

}  // namespace trisect::detail

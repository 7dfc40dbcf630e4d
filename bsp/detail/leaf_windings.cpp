// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/detail/leaf_windings.h>

#include <algorithm>

#include <trisect/bsp/detail/trace_winding.h>
#include <trisect/bsp/detail/work_budget.h>
#include <trisect/kernel/contract.h>

namespace trisect::detail {

namespace {

// A triangle of three well-separated vertices of a convex polygon.
std::array<PointId, 3> spread_vertices(const WorkPolygon& w) {
    const std::size_t n = w.points.size();
    return {w.points[0], w.points[n / 3], w.points[2 * n / 3]};
}

// Weights of successive attempts: the barycentre first, then points away from it that no simple
// symmetry of the input can hit again.
std::array<std::int64_t, 3> weights_of_attempt(int attempt) {
    if (attempt == 0) return {1, 1, 1};
    const auto a = static_cast<std::int64_t>(mix64(static_cast<std::uint64_t>(attempt)) % 97);
    const auto b =
        static_cast<std::int64_t>(mix64(static_cast<std::uint64_t>(attempt) + 1000) % 89);
    return {17 + a, 23 + b, 59};
}

constexpr int max_attempts = 60;

}  // namespace

LeafWindings::LeafWindings(LeafWork& work, SlotValues& values)
    : work_(work),
      values_(values),
      reference_(work.problem->reference),
      reference_approximation_(approximate(reference_)) {
    for (const LeafOperand& o : work.problem->operands) reference_windings_.push_back(o.winding);
}

bool LeafWindings::formula_at(const std::vector<int>& windings) {
    for (std::size_t o = 0; o < windings.size(); ++o) {
        const LeafOperand& operand = work_.problem->operands[o];
        values_[LeafWork::u(operand.slot)] =
            is_inside(windings[o], work_.problem->options->winding) ? 1 : 0;
    }
    return value_of(*work_.problem->formula, values_);
}

// Winding numbers of the operands at the target, leaving out polygons in the plane of the target
// and those of the target's own operand when the caller knows its winding numbers (-1: none).
bool LeafWindings::trace(const TraceTarget& target, PlaneId own_class, LeafIndex own_operand,
                         std::vector<int>& w) {
    w = reference_windings_;
    const Box segment = box_of_segment(reference_approximation_, target.approximation());
    for (LeafItem& item : work_.items) {
        if (item.operand == own_operand || !item.ref.box().overlaps(segment)) continue;
        const Plane& support = work_.bench.plane_at(item.shape.support);
        if (own_class >= 0 && work_.bench.plane_class(item.shape.support) == own_class) continue;
        if (item.side_of_reference == 2)
            item.side_of_reference = side(reference_, reference_approximation_, support);
        const int at_start = item.side_of_reference;
        const int at_end = side(target, support);
        if (at_start == at_end && at_start != 0) continue;
        work_.bench.with_edges(item.shape, item.ref);
        if (at_start == 0 || at_end == 0) {
            const auto from_outside = [&](const WorkEdge& e) {
                return side(reference_, reference_approximation_, work_.bench.plane_at(e.plane)) *
                           (e.above ? -1 : 1) >
                       0;
            };
            const auto to_outside = [&](const WorkEdge& e) {
                return side(target, work_.bench.plane_at(e.plane)) * (e.above ? -1 : 1) > 0;
            };
            if (avoids_in_plane(at_start, at_end, item.shape.edges, from_outside, to_outside))
                continue;
            return false;
        }
        const SupportCrossing crossing(reference_, reference_approximation_, target,
                                       work_.bench.plane_at(item.shape.support));
        int worst = -1;
        for (const WorkEdge& e : item.shape.edges) {
            const int s = crossing.side_of(work_.bench.plane_at(e.plane));
            worst = std::max(worst, e.above ? -s : s);
            if (worst > 0) break;
        }
        if (worst == 0) return false;
        if (worst > 0) continue;
        w[LeafWork::u(item.operand)] += at_start > 0 ? item.orientation : -item.orientation;
    }
    return true;
}

LeafSides LeafWindings::sides_of(LeafIndex item, const WorkPolygon& part,
                                 const std::vector<int>& step) {
    check_budget(*work_.problem->options, *work_.stats);
    const PlaneId support = work_.item(item).shape.support;
    const std::array<PointId, 3> corners = spread_vertices(part);
    // An embedded operand has 0 outside its own facets and 1 inside.
    const LeafIndex own = work_.item(item).operand;
    const LeafIndex known = work_.problem->operands[LeafWork::u(own)].embedded ? own : -1;
    std::vector<int> w;
    for (int attempt = 0; attempt < max_attempts; ++attempt) {
        if (attempt > 0) ++work_.stats->traces_retried;
        if (attempt % 6 == 5) next_reference();
        const int at_reference =
            side(reference_, reference_approximation_, work_.bench.plane_at(support));
        if (at_reference == 0) {
            next_reference();
            continue;
        }
        ++work_.stats->traces;
        const TraceTarget target(work_.bench, corners, weights_of_attempt(attempt));
        if (!trace(target, work_.bench.plane_class(support), known, w)) continue;
        if (known >= 0) {
            const bool outside_is_near = (work_.item(item).orientation > 0) == (at_reference > 0);
            w[LeafWork::u(known)] = outside_is_near ? 0 : 1;
        }
        // w holds on the side of the reference; crossing to the other side takes the step.
        LeafSides sides;
        const bool near = formula_at(w);
        for (std::size_t o = 0; o < w.size(); ++o) w[o] += at_reference * step[o];
        const bool far = formula_at(w);
        sides.above = at_reference > 0 ? near : far;
        sides.below = at_reference > 0 ? far : near;
        return sides;
    }
    TRISECT_EXPECTS(false, "no segment to a polygon of a leaf is free of degeneracies");
    return {};
}

// Another reference in the cell: some point between the old one and a pseudo-random corner of the
// polygons' box, at even positions so that it lies on no wall.
void LeafWindings::next_reference() {
    Box around;
    for (const LeafItem& item : work_.items) around.add(item.box);
    for (int k = 0; k < 200; ++k) {
        FinePoint p;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::int64_t lo =
                std::max(work_.problem->cell.lo[axis] + 1, (around.lo[axis] - 1) * wall_scale);
            const std::int64_t hi =
                std::min(work_.problem->cell.hi[axis] - 1, (around.hi[axis] + 1) * wall_scale);
            const auto seed = static_cast<std::uint64_t>(++reference_attempt_) * 3 + axis;
            const auto range = static_cast<std::uint64_t>(std::max<std::int64_t>(hi - lo, 1));
            const auto c = lo + static_cast<std::int64_t>(mix64(seed) % range);
            p.c[axis] = (c & 1) != 0 ? c + 1 : c;
        }
        if (!work_.problem->cell.contains(p) || p == reference_) continue;
        std::vector<int> w;
        if (!trace(TraceTarget(p), -1, -1, w)) continue;
        reference_ = p;
        reference_approximation_ = approximate(p);
        reference_windings_ = w;
        for (LeafItem& item : work_.items) item.side_of_reference = 2;
        return;
    }
}

}  // namespace trisect::detail

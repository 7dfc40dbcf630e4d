// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/leaf/exact/leaf_windings.h>

#include <algorithm>

#include <trisect/bsp/cells/trace/trace_winding.h>
#include <trisect/bsp/cells/work_budget.h>
#include <trisect/kernel/contract.h>
#include <trisect/kernel/support/as_index.h>

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

void LeafWindings::start(LeafWork& work) {
    work_ = &work;
    reference_ = work.problem->reference;
    reference_approximation_ = approximate(reference_);
    reference_windings_.clear();
    for (const LeafOperand& o : work.problem->operands) reference_windings_.push_back(o.winding);
    reference_attempt_ = 0;
}

// Winding numbers of the operands at the target, leaving out polygons in the plane of the target
// (own_class, -1: none) and operands whose winding numbers are known.
bool LeafWindings::trace(const TraceTarget& target, PlaneId own_class,
                         const std::vector<char>& known, std::vector<int>& w) {
    w = reference_windings_;
    const Box segment = box_of_segment(reference_approximation_, target.approximation());
    for (LeafIndex i = 0; i < work_->item_count(); ++i) {
        LeafItem& item = work_->item(i);
        if (known[as_index(item.operand)] != 0 || !item.box.overlaps(segment)) continue;
        const PlaneId support_id = work_->shape(i).support;
        const Plane& support = work_->bench.plane_at(support_id);
        if (own_class >= 0 && work_->bench.plane_class(support_id) == own_class) continue;
        if (item.side_of_reference == 2)
            item.side_of_reference =
                static_cast<std::int8_t>(side(reference_, reference_approximation_, support));
        const int at_start = item.side_of_reference;
        const int at_end = side(target, support);
        if (at_start == at_end && at_start != 0) continue;
        (void)work_->with_edges(i);
        if (at_start == 0 || at_end == 0) {
            const auto from_outside = [&](const WorkEdge& e) {
                return side(reference_, reference_approximation_, work_->bench.plane_at(e.plane)) *
                           (e.above ? -1 : 1) >
                       0;
            };
            const auto to_outside = [&](const WorkEdge& e) {
                return side(target, work_->bench.plane_at(e.plane)) * (e.above ? -1 : 1) > 0;
            };
            if (avoids_in_plane(at_start, at_end, item.shape.edges, from_outside, to_outside))
                continue;
            return false;
        }
        const SupportCrossing crossing(reference_, reference_approximation_, target,
                                       work_->bench.plane_at(item.shape.support));
        int worst = -1;
        for (const WorkEdge& e : item.shape.edges) {
            const int s = crossing.side_of(work_->bench.plane_at(e.plane));
            worst = std::max(worst, e.above ? -s : s);
            if (worst > 0) break;
        }
        if (worst == 0) return false;
        if (worst > 0) continue;
        w[as_index(item.operand)] += at_start > 0 ? item.orientation : -item.orientation;
    }
    return true;
}

Approximation LeafWindings::windings_above(LeafIndex item, const WorkPolygon& part,
                                           const std::vector<int>& step,
                                           const std::vector<char>& known,
                                           std::vector<int>& windings) {
    check_budget(*work_->problem->options, *work_->stats);
    const PlaneId support = work_->item(item).shape.support;
    const std::array<PointId, 3> corners = spread_vertices(part);
    for (int attempt = 0; attempt < max_attempts; ++attempt) {
        if (attempt > 0) ++work_->stats->traces_retried;
        if (attempt % 6 == 5) next_reference();
        const int at_reference =
            side(reference_, reference_approximation_, work_->bench.plane_at(support));
        if (at_reference == 0) {
            next_reference();
            continue;
        }
        ++work_->stats->traces;
        const TraceTarget target(work_->bench, corners, weights_of_attempt(attempt));
        if (!trace(target, work_->bench.plane_class(support), known, traced_)) continue;
        // What was traced holds on the side of the reference.
        for (std::size_t o = 0; o < windings.size(); ++o)
            if (known[o] == 0) windings[o] = traced_[o] - (at_reference < 0 ? step[o] : 0);
        return target.approximation();
    }
    TRISECT_EXPECTS(false, "no segment to a polygon of a leaf is free of degeneracies");
    return {};
}

bool LeafWindings::at_point(const TraceTarget& target, LeafIndex own, std::vector<int>& w) {
    check_budget(*work_->problem->options, *work_->stats);
    own_.assign(work_->problem->operands.size(), 0);
    own_[as_index(own)] = 1;
    ++work_->stats->traces;
    if (trace(target, -1, own_, w)) return true;
    ++work_->stats->traces_retried;
    return false;
}

TraceTarget middle_of(const Workbench& bench, const WorkPolygon& part) {
    return {bench, spread_vertices(part), weights_of_attempt(0)};
}

// Another reference in the cell: some point between the old one and a pseudo-random corner of the
// polygons' box, at even positions so that it lies on no splitting plane.
void LeafWindings::next_reference() {
    Box around;
    for (const LeafItem& item : work_->items) around.add(item.box);
    for (int k = 0; k < 200; ++k) {
        FinePoint p;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::int64_t lo = std::max(work_->problem->cell.lo[axis] + 1,
                                             (around.lo[axis] - 1) * splitting_scale);
            const std::int64_t hi = std::min(work_->problem->cell.hi[axis] - 1,
                                             (around.hi[axis] + 1) * splitting_scale);
            const auto seed = static_cast<std::uint64_t>(++reference_attempt_) * 3 + axis;
            const auto range = static_cast<std::uint64_t>(std::max<std::int64_t>(hi - lo, 1));
            const auto c = lo + static_cast<std::int64_t>(mix64(seed) % range);
            p.c[axis] = reference_position(c, 1);
        }
        if (!work_->problem->cell.contains(p) || p == reference_) continue;
        const std::vector<char> known(work_->problem->operands.size(), 0);
        std::vector<int> w;
        if (!trace(TraceTarget(p), -1, known, w)) continue;
        reference_ = p;
        reference_approximation_ = approximate(p);
        reference_windings_ = w;
        for (LeafItem& item : work_->items) item.side_of_reference = 2;
        return;
    }
}

}  // namespace trisect::detail

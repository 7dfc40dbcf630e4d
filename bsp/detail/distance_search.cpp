// SPDX-License-Identifier: Apache-2.0
//
// Best first: the pair of boxes with the least lower bound is opened next, so that no pair is ever
// opened whose bound is above the distance. A pair of triangles at the front gives bounds above and
// below (triangle_distance.cpp); the search ends when the front is beyond the least upper bound.
// What remains are the pairs whose lower bound is not above it: nearly always one, or the few
// around a common edge or vertex. The exact distance is the least of theirs.
//
// Distances are those of the user's space, boxes are in A's lattice. A difference d there is L d in
// the world, L the matrix of A's pose times the unit; |L d| >= σ |d| with σ² at least the least
// eigenvalue of L^T L, which a row's diagonal entry minus the others bounds (Gershgorin); for a
// rotation that is 1 up to rounding. For a matrix far from that σ >= |det| / |L|² serves.
//
// Triangles are compared in the world's directions about a corner r of A's: L (p - r) and L (m q +
// t - r). With row sums of |L| at most R, entries known within 2^-50 of themselves, differences at
// most g, and δ the error of a difference: errors are below R (δ + u g) + R g (2^-50 + 3 u) < R
// (1.01 δ + 2^-49 g).

#include <trisect/bsp/detail/distance_search.h>

#include <algorithm>
#include <cmath>

#include <trisect/bsp/detail/obb_fit.h>
#include <trisect/bsp/detail/triangle_filter.h>
#include <trisect/kernel/error.h>

namespace trisect::detail {

namespace {

struct ByBound {
    template <class Entry>
    bool operator()(const Entry& a, const Entry& b) const {
        return a.bound > b.bound;
    }
};

// A lower bound of |L d| / |d|.
double least_stretch(const std::array<Double3, 3>& l) {
    double least = std::numeric_limits<double>::infinity();
    double most = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        double diagonal = 0;
        double rest = 0;
        for (std::size_t j = 0; j < 3; ++j) {
            double g = 0;
            for (std::size_t k = 0; k < 3; ++k) g += l[k][i] * l[k][j];
            (i == j ? diagonal : rest) += std::abs(g);
        }
        least = std::min(least, diagonal - rest);
        most = std::max(most, diagonal + rest);
    }
    const double det = std::abs(dot(l[0], cross(l[1], l[2])));
    const double by_det = most > 0 ? (det - 0x1p-45 * most * std::sqrt(most)) / most : 0;
    return std::max(
        {0.0, least > 0 ? std::sqrt(least) * (1 - 0x1p-40) : 0.0, by_det * (1 - 0x1p-40)});
}

}  // namespace

DistanceSearch::DistanceSearch(const InterferenceModelData& a, const Pose& pose_a,
                               const InterferenceModelData& b, const Pose& pose_b)
    : a_(&a), b_(&b), map_(approximate_map(pose_a, a.brep.lattice(), pose_b, b.brep.lattice())) {
    if (!map_.is_usable()) {
        const RelativePose exact =
            relative_pose(pose_a, a.brep.lattice(), pose_b, b.brep.lattice());
        if (exact.has_doubles()) map_ = approximate_map(exact);
        if (!map_.is_usable()) throw LimitError("distances need poses within the range of doubles");
    }
    pose_.emplace(a.boxes, b.boxes, map_);
    const auto m = pose_a.approximate();
    for (std::size_t i = 0; i < 3; ++i) {
        double row = 0;
        for (std::size_t j = 0; j < 3; ++j) {
            stretch_[i][j] = std::ldexp(m[4 * i + j], a.brep.lattice().exponent);
            row += std::abs(stretch_[i][j]);
        }
        row_ = std::max(row_, row * (1 + 0x1p-48));
    }
    error_ = a.position_error + map_.error_below(b.largest, b.position_error);
    unit_ = a.boxes.unit * least_stretch(stretch_) * (1 - 0x1p-20);
}

DistanceSearch::Candidate DistanceSearch::compare(std::uint32_t i, std::uint32_t j) const {
    TriangleCorners p;
    TriangleCorners q;
    for (std::size_t k = 0; k < 3; ++k) {
        p[k] = a_->position(a_->triangles[i].vertex[k]);
        q[k] = map_(b_->position(b_->triangles[j].vertex[k]));
    }
    const Double3 r = p[0];
    double g = 0;
    const auto placed = [&](const Double3& x) {
        const Double3 d = minus(x, r);
        for (const double c : d) g = std::max(g, std::abs(c));
        return Double3{dot(stretch_[0], d), dot(stretch_[1], d), dot(stretch_[2], d)};
    };
    TriangleCorners in_world_p;
    TriangleCorners in_world_q;
    for (std::size_t k = 0; k < 3; ++k) {
        in_world_p[k] = placed(p[k]);
        in_world_q[k] = placed(q[k]);
    }
    const double error = row_ * (1.01 * error_ + 0x1p-49 * g);
    Candidate c;
    c.a = i;
    c.b = j;
    const double nearest = std::min(upper_, limit_);
    if (are_certainly_farther(in_world_p, in_world_q, nearest, error)) {
        c.bounds = {nearest * (1 + 0x1p-50), std::numeric_limits<double>::infinity()};
        return c;
    }
    c.closest = closest_points(in_world_p, in_world_q);
    c.bounds = certify(in_world_p, in_world_q, c.closest, error);
    if (c.bounds.lower <= 0 && compare_triangles(p, q, error_) == PairVerdict::Crossing) {
        c.crossing = true;
        c.bounds = {0, 0};
    }
    return c;
}

void DistanceSearch::note(const Candidate& c) {
    if (!(c.bounds.lower <= upper_) || !(c.bounds.lower < limit_)) return;
    upper_ = std::min(upper_, c.bounds.upper);
    candidates_.push_back(c);
}

void DistanceSearch::push(float bound, ObbId a, ObbId b) {
    heap_.push_back({bound, a, b});
    std::push_heap(heap_.begin(), heap_.end(), ByBound{});
}

void DistanceSearch::expand(const Entry& e) {
    const ObbTree& ta = a_->boxes;
    const ObbTree& tb = b_->boxes;
    const ObbChild ca = ta.child(e.a);
    const ObbChild cb = tb.child(e.b);
    if (ca.is_leaf() && cb.is_leaf()) {
        for (std::uint32_t j = 0; j < cb.count(); ++j)
            for (std::uint32_t i = 0; i < ca.count(); ++i) {
                ++counters_.triangle_pairs;
                note(compare(ta.order[ca.first() + i], tb.order[cb.first() + j]));
            }
        return;
    }
    const auto size = [](const ObbTree& t, ObbId id) {
        const ObbNode& n = t.nodes[id.node()];
        return n.half[0][id.lane()] + n.half[1][id.lane()] + n.half[2][id.lane()];
    };
    const bool open_b =
        ca.is_leaf() || (!cb.is_leaf() && pose_->scale() * size(tb, e.b) > size(ta, e.a));
    ++counters_.node_tests;
    const Float4 gaps = open_b ? pose_->all_gaps(ta.box(e.a), tb.nodes[cb.node()])
                               : pose_->all_gaps(ta.nodes[ca.node()], tb.box(e.b));
    const ObbNode& opened = open_b ? tb.nodes[cb.node()] : ta.nodes[ca.node()];
    for (std::uint32_t k = 0; k < 4; ++k) {
        if (!(opened.half[0][k] >= 0)) continue;
        // The parents' bound holds as well.
        const float bound = std::max(e.bound, gaps[k]);
        const double least = unit_ * static_cast<double>(bound);
        if (least > upper_ || least >= limit_) continue;
        push(bound, open_b ? e.a : ObbId::of(ca.node(), k), open_b ? ObbId::of(cb.node(), k) : e.b);
    }
}

void DistanceSearch::run(double limit, bool stop,
                         std::optional<std::array<std::uint32_t, 2>> start) {
    heap_.clear();
    candidates_.clear();
    limit_ = limit;
    upper_ = std::numeric_limits<double>::infinity();
    if (start) {
        // For its upper bound only: the walk comes to it by itself.
        ++counters_.triangle_pairs;
        const Candidate c = compare((*start)[0], (*start)[1]);
        if (c.crossing) note(c);
        upper_ = c.bounds.upper;
    }
    push(0, ObbId{}, ObbId{});
    while (!heap_.empty()) {
        if (upper_ <= 0 || (stop && upper_ < limit_)) break;
        const Entry e = heap_.front();
        if (unit_ * static_cast<double>(e.bound) > upper_) break;
        std::pop_heap(heap_.begin(), heap_.end(), ByBound{});
        heap_.pop_back();
        expand(e);
    }
    finish();
}

void DistanceSearch::finish() {
    std::erase_if(candidates_, [this](const Candidate& c) { return c.bounds.lower > upper_; });
    std::sort(candidates_.begin(), candidates_.end(), [](const Candidate& c, const Candidate& d) {
        return c.bounds.upper < d.bounds.upper;
    });
    lower_ = std::numeric_limits<double>::infinity();
    for (const Candidate& c : candidates_) lower_ = std::min(lower_, c.bounds.lower);
}

}  // namespace trisect::detail

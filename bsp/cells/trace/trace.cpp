// SPDX-License-Identifier: Apache-2.0
//
// Widths of the exact stage. Reference points have 62 bits over 2^8. Targets have xyz < 2^1056 and
// w < 2^1000, planes n < 2^109 and d < 2^163; with fractions 2^3040, 2^2984, 2^328 and 2^381. Then
//   r = n·R + 2^8 d            < 2^175   or 2^392
//   g = n·G + w d              < 2^1168  or 2^3370
//   crossing X = R g - G r     < 2^1233  or 2^3434    W = 2^8 g - w r < 2^1178 or 2^3380
//   n·X + d W                  < 2^1345  or 2^3765                            -> 22 or 59 limbs.

#include <trisect/bsp/cells/trace/trace.h>

#include <algorithm>
#include <cmath>

#include <trisect/bsp/cells/trace/interpolation.h>
#include <trisect/kernel/counters.h>
#include <trisect/kernel/number/error_bounds.h>
#include <trisect/kernel/plane_value.h>

namespace trisect::detail {

namespace {

BoundedInt plane_value_at(const std::array<BoundedInt, 3>& x, const BoundedInt& w,
                          const Plane& plane) {
    BoundedInt sum = w * plane.offset();
    for (int k = 0; k < 3; ++k) sum += x[static_cast<std::size_t>(k)] * plane.normal(k);
    return sum;
}

BoundedInt plane_value_at(const FinePoint& p, const Plane& plane) {
    return plane_value_at({p.c[0], p.c[1], p.c[2]}, splitting_scale, plane);
}

BoundedInt plane_value_at(const TraceTarget::Exact& t, const Plane& plane) {
    return plane_value_at(t.xyz, t.w, plane);
}

}  // namespace

// The crossing in doubles: R + λ (G - R), λ = r / (r - g) with r and g of different signs.
std::optional<Approximation> approximate_crossing(const Approximation& from,
                                                  const Approximation& to, const Plane& plane) {
    const Ball r = value_at_point(plane, from.c, from.error);
    const Ball g = value_at_point(plane, to.c, to.error);
    if (r.value * g.value >= 0) return std::nullopt;
    Approximation x;
    if (!interpolate(from, r.value, to, g.value, r.error + g.error, x)) return std::nullopt;
    return x;
}

TraceTarget::TraceTarget(const FinePoint& p) : approximation_(detail::approximate(p)), fine_(p) {}

TraceTarget::TraceTarget(const Workbench& bench, const std::array<PointId, 3>& points,
                         const std::array<std::int64_t, 3>& weights)
    : bench_(&bench), points_(points), weights_(weights) {
    const double total = static_cast<double>(weights[0] + weights[1] + weights[2]);
    double largest = 0;
    double error = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const Approximation& a = bench.approximation(points[i]);
        error = std::max(error, a.error);
        for (std::size_t k = 0; k < 3; ++k) {
            approximation_.c[k] += static_cast<double>(weights[i]) * a.c[k] / total;
            largest = std::max(largest, std::fabs(a.c[k]));
        }
    }
    approximation_.error = error_slack * error + largest * 0x1p-49;
}

const TraceTarget::Exact& TraceTarget::exact() const {
    if (exact_) return *exact_;
    Exact e;
    if (bench_ == nullptr) {
        for (std::size_t k = 0; k < 3; ++k) e.xyz[k] = fine_.c[k];
        e.w = splitting_scale;
        exact_ = e;
        return *exact_;
    }
    std::array<HomogeneousPoint, 3> h;
    for (std::size_t i = 0; i < 3; ++i) h[i] = bench_->homogeneous(points_[i]);
    for (std::size_t i = 0; i < 3; ++i) {
        const BoundedInt others =
            BoundedInt(h[(i + 1) % 3].w) * h[(i + 2) % 3].w * BoundedInt(weights_[i]);
        for (std::size_t k = 0; k < 3; ++k) e.xyz[k] += others * h[i].xyz[k];
    }
    e.w = BoundedInt(h[0].w) * h[1].w * h[2].w * (weights_[0] + weights_[1] + weights_[2]);
    exact_ = e;
    return *exact_;
}

Approximation approximate(const FinePoint& p) {
    Approximation a;
    for (std::size_t k = 0; k < 3; ++k) {
        a.c[k] = rounded_position(p.c[k]);
        a.error = std::max(a.error, std::fabs(a.c[k]) * last_place);
    }
    return a;
}

int side(const FinePoint& p, const Approximation& approximation, const Plane& plane) {
    if (const auto s = filtered_side(approximation, plane)) {
        ++detail::counters_of_thread<PredicateCounters>.filtered;
        return sign_of(*s);
    }
    ++detail::counters_of_thread<PredicateCounters>.exact_wide;
    return plane_value_at(p, plane).sign();
}

int side(const TraceTarget& target, const Plane& plane) {
    if (const auto s = filtered_side(target.approximation(), plane)) {
        ++detail::counters_of_thread<PredicateCounters>.filtered;
        return sign_of(*s);
    }
    ++detail::counters_of_thread<PredicateCounters>.exact_wide;
    return plane_value_at(target.exact(), plane).sign();
}

SupportCrossing::SupportCrossing(const FinePoint& reference, const Approximation& approximation,
                                 const TraceTarget& target, const Plane& support)
    : reference_(reference),
      target_(target),
      support_(support),
      approximation_(approximate_crossing(approximation, target.approximation(), support)) {}

int SupportCrossing::side_of(const Plane& edge) const {
    if (approximation_) {
        if (const auto s = filtered_side(*approximation_, edge)) {
            ++detail::counters_of_thread<PredicateCounters>.filtered;
            return sign_of(*s);
        }
    }
    ++detail::counters_of_thread<PredicateCounters>.exact_wide;
    const TraceTarget::Exact& t = target_.exact();
    const BoundedInt r = plane_value_at(reference_, support_);
    const BoundedInt g = plane_value_at(t, support_);
    std::array<BoundedInt, 3> x;
    for (std::size_t k = 0; k < 3; ++k) x[k] = g * reference_.c[k] - t.xyz[k] * r;
    const BoundedInt w = g * splitting_scale - t.w * r;
    const int s = plane_value_at(x, w, edge).sign();
    return w.sign() < 0 ? -s : s;
}

}  // namespace trisect::detail

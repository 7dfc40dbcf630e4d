// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/measure/split_vertices.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include <trisect/kernel/number/double_pair.h>

namespace trisect::detail {

namespace {

// Numbers to 129 bits and their quotient are off by 2^-98 of it (double_pair.h).
RefinedPoint quotients(const HomogeneousPoint& p) {
    const ScaledPair w = to_scaled_pair(p.w);
    RefinedPoint out;
    for (std::size_t k = 0; k < 3; ++k) {
        const ScaledPair x = to_scaled_pair(p.xyz[k]);
        const double factor = std::ldexp(1, 64 * (x.shift - w.shift));
        const DoublePair q = divide(x.value, w.value);
        out.high[k] = q.high * factor;
        out.low[k] = q.low * factor;
        out.error = std::max(out.error, 0x1p-97 * std::fabs(out.high[k]));
    }
    return out;
}

}  // namespace

SplitUnits units_of(const BoundaryParts& parts) {
    double reach = 1;
    std::array<double, 3> lo{};
    std::array<double, 3> hi{};
    bool is_first = true;
    for (const FacetMarks& marks : parts.sources) {
        const Box& box = marks.source()->box();
        for (std::size_t k = 0; k < 3; ++k) {
            const auto low = static_cast<double>(box.lo[k]);
            const auto high = static_cast<double>(box.hi[k]);
            reach = std::max({reach, std::fabs(low), std::fabs(high)});
            if (marks.source()->is_unbounded()) continue;
            lo[k] = is_first ? low : std::min(lo[k], low);
            hi[k] = is_first ? high : std::max(hi[k], high);
        }
        is_first = is_first && marks.source()->is_unbounded();
    }
    return {reach, {lo[0] / 2 + hi[0] / 2, lo[1] / 2 + hi[1] / 2, lo[2] / 2 + hi[2] / 2}};
}

void SplitVertices::make(std::span<const BoundaryEdge> edges) {
    points_.resize(bench_.point_count());
    is_made_.resize(bench_.point_count());
    for (const BoundaryEdge& e : edges) {
        make(e.from);
        make(e.to);
    }
}

void SplitVertices::make(PointId p) {
    if (is_made_[as_index(p)] != 0) return;
    is_made_[as_index(p)] = 1;
    if (bench_.is_lattice(p)) {
        points_[as_index(p)] = units_.split(bench_.lattice(p));
        return;
    }
    std::optional<RefinedPoint> refined = bench_.refined(p);
    constexpr double fine = 0x1p-30;  // one vertex that is known badly spoils the sum
    if (!refined || refined->error * units_.scale() > fine)
        refined = quotients(bench_.homogeneous(p));
    points_[as_index(p)] = units_.split(*refined);
    constexpr double rounding = 0x1p-50;  // of the sum of two rests
    error_ = std::max(error_, refined->error * units_.scale() + rounding);
}

int axis_across(const BoundaryFacet& facet) {
    if (facet.source->is_half_space()) {
        const Plane plane = facet.source->support(facet.facet);
        for (int k = 0; k < 3; ++k)
            if (plane.normal((k + 1) % 3).is_zero() && plane.normal((k + 2) % 3).is_zero())
                return k;
        return -1;
    }
    const LatticePoint& a = facet.source->corner(facet.facet, 0);
    const LatticePoint& b = facet.source->corner(facet.facet, 1);
    const LatticePoint& c = facet.source->corner(facet.facet, 2);
    for (int k = 0; k < 3; ++k)
        if (a[k] == b[k] && b[k] == c[k]) return k;
    return -1;
}

}  // namespace trisect::detail

// SPDX-License-Identifier: Apache-2.0
//
// Built from the top: a part is divided across its longest principal axis at the mean of its
// triangles' centres, twice, which makes the four boxes of a node. Directions come from the
// principal axes of the area (obb_fit.cpp).
//
// Why four: a walk tests one box against the four children of another, and four of them fit into
// one register, so that fifteen axes cost for four boxes what they cost for one. Why oriented
// boxes: where surfaces come close over an area, thin boxes along the surface separate them after
// O(n^1/2) pairs, axis-parallel ones after O(n) (Gottschalk, Lin and Manocha 1996).
//
// Certified containment. In units of the tree a point is known within e = 2^-50 + error / unit: the
// difference to the origin is rounded once (it is at most 2 in units), dividing by a power of two
// is exact. For a float axis u, |u| < 1.01, the product u · p of three terms below 2 is off by at
// most 6·3·2^-53 and by 2 e from the point. So each half is enlarged by 2^-48 + 2 e. Now the slabs
// hold all contents.
//
// The other set, centre + Σ s_i axis_i, contains the slabs if halves are enlarged again: with U the
// matrix of axes and U U^T = I + E, x - centre = U^-1 y = U^T (I + E)^-1 y. Rounding to floats
// moves components by at most 2^-25, so |E_ij| <= 3·2·2^-25 + 2^-48 < 2^-22.4, and |((I + E)^-1 -
// I) y| <= 2^-22 Σ half. Finally halves grow by the factor 1 + 2^-20, of which 2^-21 pay for all
// roundings of sums of halves in box tests (obb_pose.h), the rest for the roundings here.

#include <trisect/bsp/interference/boxes/obb_parts.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <trisect/kernel/contract.h>
#include <trisect/kernel/number/error_bounds.h>

namespace trisect::detail {

ObbParts::ObbParts(std::span<const std::array<double, 3>> positions, double error,
                   std::vector<std::array<std::uint32_t, 3>> triangles)
    : corners_(std::move(triangles)) {
    set_unit(positions);
    slack_ = slack_of(error, unit_);
    points_.reserve(positions.size());
    for (const Vector3& p : positions) {
        Vector3 q = minus(p, origin_);
        for (double& c : q) c /= unit_;
        points_.push_back(q);
        radius_ = std::max(radius_, bound_slack * std::sqrt(dot(q, q)) + slack_);
    }
    set_items();
}

void ObbParts::set_items() {
    items_.resize(corners_.empty() ? points_.size() / 3 : corners_.size());
    for (std::uint32_t t = 0; t < items_.size(); ++t) {
        items_[t].triangle = t;
        for (std::size_t k = 0; k < 3; ++k)
            items_[t].center[k] =
                static_cast<float>(corner(t, 0)[k] + corner(t, 1)[k] + corner(t, 2)[k]);
    }
}

void ObbParts::set_unit(std::span<const Vector3> positions) {
    Vector3 lo = positions.front();
    Vector3 hi = lo;
    for (const Vector3& p : positions)
        for (std::size_t k = 0; k < 3; ++k) {
            lo[k] = std::min(lo[k], p[k]);
            hi[k] = std::max(hi[k], p[k]);
        }
    double extent = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        origin_[k] = lo[k] + 0.5 * (hi[k] - lo[k]);
        extent = std::max(extent, hi[k] - lo[k]);
    }
    // Half the extent and a little is at most one unit.
    unit_ = extent > 0 ? std::ldexp(1.0, std::ilogb(extent)) : 1.0;
}

ObbParts::Part ObbParts::part(std::uint32_t begin, std::uint32_t end) const {
    Part part{begin, end, {}};
    if (end - begin == 1) {
        const std::uint32_t t = items_[begin].triangle;
        part.frame = triangle_frame(corner(t, 0), corner(t, 1), corner(t, 2));
        return part;
    }
    AreaMoments m;
    const std::uint32_t step = 1 + (end - begin - 1) / samples_;
    for (std::uint32_t i = begin; i < end; i += step) {
        const std::uint32_t t = items_[i].triangle;
        m.add(corner(t, 0), corner(t, 1), corner(t, 2));
    }
    part.frame = principal_frame(m);
    return part;
}

// Across the axis along which the centres reach farthest, at their mean; at the median where the
// mean leaves hardly anything on one side.
std::array<ObbParts::Part, 2> ObbParts::halves(const Part& whole) {
    // All axes at once: along one, each sum waits for the one before.
    std::array<std::array<float, 3>, 3> axes{};
    std::array<float, 3> lo{};
    std::array<float, 3> hi{};
    std::array<double, 3> sum{};
    lo.fill(std::numeric_limits<float>::infinity());
    hi.fill(-std::numeric_limits<float>::infinity());
    for (std::size_t j = 0; j < 3; ++j)
        for (std::size_t k = 0; k < 3; ++k) axes[j][k] = static_cast<float>(whole.frame.axis[j][k]);
    for (std::uint32_t i = whole.begin; i < whole.end; ++i)
        for (std::size_t j = 0; j < 3; ++j) {
            const float c = along(axes[j], items_[i]);
            lo[j] = std::min(lo[j], c);
            hi[j] = std::max(hi[j], c);
            sum[j] += static_cast<double>(c);
        }
    std::size_t longest = 0;
    for (std::size_t j = 1; j < 3; ++j)
        if (hi[j] - lo[j] > hi[longest] - lo[longest]) longest = j;
    const std::array<float, 3>& axis = axes[longest];
    const double mean = sum[longest] / static_cast<double>(whole.size());
    const auto first = items_.begin() + static_cast<std::ptrdiff_t>(whole.begin);
    const auto last = items_.begin() + static_cast<std::ptrdiff_t>(whole.end);
    const auto split = std::partition(
        first, last, [&](const Item& i) { return static_cast<double>(along(axis, i)) < mean; });
    auto middle = static_cast<std::uint32_t>(split - items_.begin());
    if (std::min(middle - whole.begin, whole.end - middle) < 1 + whole.size() / 16) {
        middle = whole.begin + whole.size() / 2;
        std::nth_element(
            first, items_.begin() + static_cast<std::ptrdiff_t>(middle), last,
            [&axis](const Item& i, const Item& j) { return along(axis, i) < along(axis, j); });
    }
    if (has_rough_frames())
        return {Part{whole.begin, middle, whole.frame}, Part{middle, whole.end, whole.frame}};
    return {part(whole.begin, middle), part(middle, whole.end)};
}

std::size_t ObbParts::divide(const Part& whole, std::uint32_t leaf, std::array<Part, 4>& parts) {
    std::size_t count = 1;
    parts[0] = whole;
    while (count < 4) {
        std::size_t largest = 0;
        for (std::size_t i = 1; i < count; ++i)
            if (parts[i].size() > parts[largest].size()) largest = i;
        if (parts[largest].size() <= leaf) break;
        const auto [one, other] = halves(parts[largest]);
        parts[largest] = one;
        parts[count++] = other;
    }
    // Parts that are divided further at once have had the frame of the whole.
    if (has_rough_frames())
        for (std::size_t i = 0; i < count; ++i) parts[i] = part(parts[i].begin, parts[i].end);
    return count;
}

double ObbParts::put(const Part& part, ObbNode& node, std::uint32_t lane) const {
    std::array<Vector3, 3> u{};  // the floats' values
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k)
            u[i][k] = static_cast<double>(static_cast<float>(part.frame.axis[i][k]));
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            TRISECT_EXPECTS(std::abs(dot(u[i], u[j]) - (i == j ? 1 : 0)) < 0x1.6p-23,
                            "box axes that are orthonormal up to rounding");
    Vector3 lo{};
    Vector3 hi{};
    lo.fill(std::numeric_limits<double>::infinity());
    hi.fill(-std::numeric_limits<double>::infinity());
    for (std::uint32_t i = part.begin; i < part.end; ++i)
        for (std::size_t j = 0; j < 3; ++j) {
            const Vector3& p = corner(items_[i].triangle, j);
            for (std::size_t k = 0; k < 3; ++k) {
                const double c = dot(u[k], p);
                lo[k] = std::min(lo[k], c);
                hi[k] = std::max(hi[k], c);
            }
        }
    Vector3 center{};
    for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t i = 0; i < 3; ++i) center[k] += 0.5 * (lo[i] + hi[i]) * u[i][k];
    for (double& c : center) c = static_cast<double>(static_cast<float>(c));
    Vector3 half{};
    for (std::size_t k = 0; k < 3; ++k) {
        const double c = dot(u[k], center);
        half[k] = std::max(hi[k] - c, c - lo[k]) + slack_;
    }
    const double sum = half[0] + half[1] + half[2];
    double far = std::sqrt(dot(center, center));
    for (std::size_t k = 0; k < 3; ++k) {
        const double wanted = (half[k] + 0x1p-22 * sum) * (1 + 0x1p-20);
        float h = static_cast<float>(wanted);
        if (static_cast<double>(h) < wanted)
            h = std::nextafter(h, std::numeric_limits<float>::infinity());
        node.half[k][lane] = h;
        node.center[k][lane] = static_cast<float>(center[k]);
        for (std::size_t j = 0; j < 3; ++j)
            node.axis[k][j][lane] = static_cast<float>(part.frame.axis[k][j]);
        half[k] = static_cast<double>(h);
    }
    far += std::sqrt(dot(half, half));
    return bound_slack * far;
}

}  // namespace trisect::detail

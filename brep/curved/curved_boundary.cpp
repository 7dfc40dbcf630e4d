// SPDX-License-Identifier: Apache-2.0

#include <trisect/brep/curved/curved_boundary.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include <trisect/kernel/error.h>

namespace trisect {

namespace detail {

SideCurve SideCurve::reversed() const {
    SideCurve r = *this;
    std::reverse(r.points.begin(), r.points.end());
    std::reverse(r.weights.begin(), r.weights.end());
    return r;
}

bool SideCurve::is_point() const {
    return std::all_of(points.begin(), points.end(),
                       [&](const Point3d& p) { return p == points.front(); });
}

SideCurve side_curve(const BezierPatch& patch, std::uint32_t number) {
    SideCurve r;
    const bool along_u = number == 0 || number == 2;
    const std::size_t degree = along_u ? patch.degree_u() : patch.degree_v();
    for (std::size_t k = 0; k <= degree; ++k) {
        const std::size_t back = degree - k;
        const std::size_t i =
            along_u ? (number == 0 ? k : back) : (number == 1 ? patch.degree_u() : 0);
        const std::size_t j =
            along_u ? (number == 0 ? 0 : patch.degree_v()) : (number == 1 ? k : back);
        r.points.push_back(patch.point(i, j));
        r.weights.push_back(patch.weight(i, j));
        // -0.0 and 0.0 are the same coordinate.
        for (double& c : r.points.back()) c += 0.0;
    }
    int exponent = 0;
    (void)std::frexp(*std::max_element(r.weights.begin(), r.weights.end()), &exponent);
    for (double& w : r.weights) w = std::ldexp(w, -exponent);
    return r;
}

}  // namespace detail

namespace {

std::string name_of(CurvedBoundary::Side s) {
    static constexpr std::array<const char*, 4> sides{"v = 0", "u = 1", "v = 1", "u = 0"};
    return "side " + std::string(sides[s.number]) + " of patch " + std::to_string(s.patch);
}

}  // namespace

CurvedBoundary::CurvedBoundary(std::vector<BezierPatch> patches) : patches_(std::move(patches)) {
    partners_.resize(patches_.size());
    std::map<detail::SideCurve, Side> waiting;
    for (std::uint32_t p = 0; p < patches_.size(); ++p)
        for (std::uint32_t k = 0; k < 4; ++k) {
            const Side side{p, k};
            partners_[p][k] = side;
            detail::SideCurve curve = detail::side_curve(patches_[p], k);
            if (curve.is_point()) continue;
            detail::SideCurve back = curve.reversed();
            if (curve == back)
                throw UsageError(name_of(side) + " is a curve that comes back the way it went");
            const auto found = waiting.find(back);
            if (found != waiting.end()) {
                partners_[p][k] = found->second;
                partners_[found->second.patch][found->second.number] = side;
                waiting.erase(found);
                continue;
            }
            const auto [it, is_new] = waiting.emplace(std::move(curve), side);
            if (!is_new)
                throw UsageError(name_of(side) + " and " + name_of(it->second) +
                                 " run through one curve in the same direction");
        }
    if (!waiting.empty())
        throw UsageError("the patches do not close: " + name_of(waiting.begin()->second) +
                         " has no partner (" + std::to_string(waiting.size()) + " such sides)");
}

bool CurvedBoundary::is_point(Side side) const {
    return partners_[side.patch][side.number] == side;
}
CurvedBoundary::Side CurvedBoundary::partner(Side side) const {
    return partners_[side.patch][side.number];
}

}  // namespace trisect

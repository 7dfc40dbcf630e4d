// SPDX-License-Identifier: Apache-2.0
//
// Rays, distances and winding numbers.

#include <algorithm>
#include <cmath>
#include <limits>

#include <manifold/manifold.h>
#include <trisect/brep/exact_point.h>
#include <trisect/bsp/brep_index.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/interference/solid_interference.h>

#include "node.h"

namespace manifold {

namespace {

trisect::Point3d array(const vec3& v) { return {v.x, v.y, v.z}; }

// The triangle of the mesh that is nearest to a point of the boundary.
std::size_t triangle_at(const TriMesh& mesh, const vec3& p) {
    std::size_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t t = 0; t < mesh.corners.size(); ++t) {
        const vec3 up = mesh.normal(t);
        const double size = la::length2(up);
        if (!(size > 0)) continue;
        const double height = std::abs(la::dot(up, p - mesh.corner(t, 0))) / std::sqrt(size);
        double outside = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const vec3 side = mesh.corner(t, (k + 1) % 3) - mesh.corner(t, k);
            const double area = la::dot(la::cross(side, p - mesh.corner(t, k)), up);
            outside = std::max(outside, -area / std::sqrt(size * la::length2(side)));
        }
        if (height + outside < least) {
            least = height + outside;
            best = t;
        }
    }
    return best;
}

}  // namespace

// Where the segment enters or leaves. Where it touches the boundary, or runs along it, without
// that, there is no hit.
std::vector<RayHit> Manifold::RayCast(vec3 origin, vec3 endpoint) const {
    std::vector<RayHit> hits;
    if (IsEmpty() || origin == endpoint) return hits;
    const trisect::BrepIndex index(node_->solid().solid);
    const auto all = index.all_hits(trisect::Segment{array(origin), array(endpoint)});
    const auto at = [&](double t) { return la::lerp(origin, endpoint, t); };
    const auto is_inside = [&](double t) {
        return index.locate(array(at(t))).location == trisect::Location::Inside;
    };
    for (std::size_t i = 0; i < all.size();) {
        // What hangs together is one contact.
        std::size_t end = i + 1;
        while (end < all.size() && all[end].enter == all[end - 1].leave) ++end;
        const double enter = all[i].enter.nearest();
        const double leave = all[end - 1].leave.nearest();
        const double before = i == 0 ? 0 : all[i - 1].leave.nearest();
        const double after = end == all.size() ? 1 : all[end].enter.nearest();
        // An end of the segment on the boundary counts as a crossing of it.
        const bool was = enter > before && is_inside((before + enter) / 2);
        const bool will = after > leave && is_inside((leave + after) / 2);
        if (was != will || (enter == 0 && will) || (leave == 1 && was)) {
            RayHit hit;
            hit.distance = was ? enter : leave;
            hit.position = at(hit.distance);
            const std::size_t t = triangle_at(node_->mesh(), hit.position);
            hit.faceID = t;
            hit.normal = la::normalize(node_->mesh().normal(t));
            hits.push_back(hit);
        }
        i = end;
    }
    return hits;
}

double Manifold::MinGap(const Manifold& other, double searchLength) const {
    const trisect::Solid& a = node_->solid().solid;
    const trisect::Solid& b = other.node_->solid().solid;
    const auto squared = trisect::exact_squared_distance(a, {}, b, {});
    if (!squared) return searchLength;
    const double gap = std::sqrt(squared->to_double());
    if (gap == 0 || !trisect::evaluate(a & b).is_empty()) return 0;
    return std::min(gap, searchLength);
}

// 1 inside, and 0 on the boundary and outside: solids have no winding numbers besides.
std::vector<int> Manifold::WindingNumber(const std::vector<vec3>& points) const {
    std::vector<int> winding;
    const trisect::BrepIndex index(node_->solid().solid);
    for (const vec3& p : points)
        winding.push_back(index.locate(array(p)).location == trisect::Location::Inside ? 1 : 0);
    return winding;
}

}  // namespace manifold

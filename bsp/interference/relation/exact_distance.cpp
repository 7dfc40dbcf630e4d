// SPDX-License-Identifier: Apache-2.0
//
// The exact distance of two triangles apart: all pairs of sides, and corners above insides, in
// rationals. Slow, and only for the pairs that are left when the exact number is requested.
//
// The closest pairs of points of two triangles are a convex polytope in the space of pairs. At each
// of its corners one of the points is a corner of its triangle, or both are on sides that are not
// parallel; so the pairs tried here are all of its corners, and their features can be named.

#include <array>
#include <cstddef>
#include <optional>

#include <trisect/bsp/interference/relation/boundary_pairs.h>
#include <trisect/bsp/interference/relation/exact_place.h>
#include <trisect/bsp/interference/relation/pair_distance.h>
#include <trisect/kernel/number/vector3.h>

namespace trisect::detail {

namespace {

using RationalVector = std::array<ExactRational, 3>;

bool in_unit(const ExactRational& v) { return v.sign() >= 0 && v <= ExactRational(1); }

class Least {
public:
    void note(const ExactRational& v, Feature p, Feature q) {
        if (closest_ && closest_->squared < v) return;
        if (!closest_ || v < closest_->squared) closest_ = ExactClosest{v, {}};
        closest_->features.push_back({p, q});
    }
    [[nodiscard]] const ExactClosest& value() const { return *closest_; }

private:
    std::optional<ExactClosest> closest_;
};

// The feature at a parameter in [0, 1] of side i.
Feature on_side(std::size_t i, const ExactRational& t) {
    if (t.sign() == 0) return Feature::corner(i);
    return t == ExactRational(1) ? Feature::corner((i + 1) % 3) : Feature::side(i);
}

struct OfPoint {
    ExactRational squared;
    Feature feature;
};

// Of a point and side i of a triangle.
std::optional<OfPoint> point_and_side(const RationalVector& x, const WorldCorners& c,
                                      std::size_t i) {
    const RationalVector d = minus(c[(i + 1) % 3], c[i]);
    const RationalVector w = minus(x, c[i]);
    const ExactRational t = dot(d, w) / dot(d, d);
    if (!in_unit(t)) return std::nullopt;  // an end, which is a corner of another side's question
    return OfPoint{dot(w, w) - t * dot(d, w), on_side(i, t)};
}

// Of the lines of two sides, where that is between their ends.
void sides(const WorldCorners& p, std::size_t i, const WorldCorners& q, std::size_t j,
           Least& least) {
    const RationalVector u = minus(p[(i + 1) % 3], p[i]);
    const RationalVector v = minus(q[(j + 1) % 3], q[j]);
    const RationalVector r = minus(p[i], q[j]);
    const ExactRational uu = dot(u, u);
    const ExactRational vv = dot(v, v);
    const ExactRational uv = dot(u, v);
    const ExactRational det = uu * vv - uv * uv;
    if (det.sign() == 0) return;  // parallel: ends do it
    const ExactRational s = (uv * dot(v, r) - vv * dot(u, r)) / det;
    const ExactRational t = (uu * dot(v, r) - uv * dot(u, r)) / det;
    if (!in_unit(s) || !in_unit(t)) return;
    const RationalVector n = cross(u, v);
    const ExactRational height = dot(n, r);
    least.note(height * height / dot(n, n), on_side(i, s), on_side(j, t));
}

std::optional<OfPoint> point_and_inside(const RationalVector& x, const WorldCorners& t) {
    const RationalVector u = minus(t[1], t[0]);
    const RationalVector v = minus(t[2], t[0]);
    const RationalVector w = minus(x, t[0]);
    const RationalVector n = cross(u, v);
    const ExactRational nn = dot(n, n);
    const ExactRational beta = dot(cross(w, v), n) / nn;
    const ExactRational gamma = dot(cross(u, w), n) / nn;
    const ExactRational alpha = ExactRational(1) - beta - gamma;
    // Towards side i, which is across from the corner with this weight.
    const auto feature = feature_from_signs({gamma.sign(), alpha.sign(), beta.sign()});
    if (!feature) return std::nullopt;
    const ExactRational height = dot(n, w);
    return OfPoint{height * height / nn, *feature};
}

}  // namespace

WorldCorners world_corners(const PlacedTriangle& t) {
    WorldCorners r;
    for (std::size_t i = 0; i < 3; ++i)
        r[i] = in_world(exact_place(*t.triangle.corner[i]), t.lattice, t.pose);
    return r;
}

ExactClosest exact_closest(const InterferenceModelData& a, const Pose& pose_a,
                           std::uint32_t triangle_a, const InterferenceModelData& b,
                           const Pose& pose_b, std::uint32_t triangle_b) {
    ObbWalk::Stack stack;
    if (BoundaryPairs(a, pose_a, b, pose_b, stack).exact(triangle_a, triangle_b).meets()) return {};
    return exact_closest_apart({posed_triangle(a, triangle_a), a.lattice, pose_a},
                               {posed_triangle(b, triangle_b), b.lattice, pose_b});
}

ExactClosest exact_closest_apart(const PlacedTriangle& a, const PlacedTriangle& b) {
    const WorldCorners p = world_corners(a);
    const WorldCorners q = world_corners(b);
    Least least;
    for (std::size_t i = 0; i < 3; ++i) {
        const Feature corner = Feature::corner(i);
        for (std::size_t j = 0; j < 3; ++j) {
            const RationalVector w = minus(p[i], q[j]);
            least.note(dot(w, w), corner, Feature::corner(j));
            if (const auto f = point_and_side(p[i], q, j))
                least.note(f->squared, corner, f->feature);
            if (const auto f = point_and_side(q[i], p, j))
                least.note(f->squared, f->feature, corner);
            sides(p, i, q, j, least);
        }
        if (const auto f = point_and_inside(p[i], q)) least.note(f->squared, corner, f->feature);
        if (const auto f = point_and_inside(q[i], p)) least.note(f->squared, f->feature, corner);
    }
    return least.value();
}

ExactRational exact_squared_distance(const InterferenceModelData& a, const Pose& pose_a,
                                     std::uint32_t triangle_a, const InterferenceModelData& b,
                                     const Pose& pose_b, std::uint32_t triangle_b) {
    return exact_closest(a, pose_a, triangle_a, b, pose_b, triangle_b).squared;
}

}  // namespace trisect::detail

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

namespace trisect::detail {

namespace {

using Vector = std::array<ExactRational, 3>;
using Corners = std::array<Vector, 3>;

Vector subtracted(const Vector& a, const Vector& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
ExactRational dotted(const Vector& a, const Vector& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Vector crossed(const Vector& a, const Vector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
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
std::optional<OfPoint> point_and_side(const Vector& x, const Corners& c, std::size_t i) {
    const Vector d = subtracted(c[(i + 1) % 3], c[i]);
    const Vector w = subtracted(x, c[i]);
    const ExactRational t = dotted(d, w) / dotted(d, d);
    if (!in_unit(t)) return std::nullopt;  // an end, which is a corner of another side's question
    return OfPoint{dotted(w, w) - t * dotted(d, w), on_side(i, t)};
}

// Of the lines of two sides, where that is between their ends.
void sides(const Corners& p, std::size_t i, const Corners& q, std::size_t j, Least& least) {
    const Vector u = subtracted(p[(i + 1) % 3], p[i]);
    const Vector v = subtracted(q[(j + 1) % 3], q[j]);
    const Vector r = subtracted(p[i], q[j]);
    const ExactRational uu = dotted(u, u);
    const ExactRational vv = dotted(v, v);
    const ExactRational uv = dotted(u, v);
    const ExactRational det = uu * vv - uv * uv;
    if (det.sign() == 0) return;  // parallel: ends do it
    const ExactRational s = (uv * dotted(v, r) - vv * dotted(u, r)) / det;
    const ExactRational t = (uu * dotted(v, r) - uv * dotted(u, r)) / det;
    if (!in_unit(s) || !in_unit(t)) return;
    const Vector n = crossed(u, v);
    const ExactRational height = dotted(n, r);
    least.note(height * height / dotted(n, n), on_side(i, s), on_side(j, t));
}

std::optional<OfPoint> point_and_inside(const Vector& x, const Corners& t) {
    const Vector u = subtracted(t[1], t[0]);
    const Vector v = subtracted(t[2], t[0]);
    const Vector w = subtracted(x, t[0]);
    const Vector n = crossed(u, v);
    const ExactRational nn = dotted(n, n);
    const ExactRational beta = dotted(crossed(w, v), n) / nn;
    const ExactRational gamma = dotted(crossed(u, w), n) / nn;
    const ExactRational alpha = ExactRational(1) - beta - gamma;
    // Towards side i, which is across from the corner with this weight.
    const auto feature = feature_from_signs({gamma.sign(), alpha.sign(), beta.sign()});
    if (!feature) return std::nullopt;
    const ExactRational height = dotted(n, w);
    return OfPoint{height * height / nn, *feature};
}

Corners corners(const InterferenceModelData& m, const Pose& pose, std::uint32_t triangle) {
    Corners r;
    for (std::size_t i = 0; i < 3; ++i)
        r[i] = in_world(exact_place(m.brep.point(m.triangles[triangle].vertex[i])),
                        m.brep.lattice(), pose);
    return r;
}

}  // namespace

ExactClosest exact_closest(const InterferenceModelData& a, const Pose& pose_a,
                           std::uint32_t triangle_a, const InterferenceModelData& b,
                           const Pose& pose_b, std::uint32_t triangle_b) {
    ObbWalk::Stack stack;
    if (BoundaryPairs(a, pose_a, b, pose_b, stack).exact(triangle_a, triangle_b).meets()) return {};
    const Corners p = corners(a, pose_a, triangle_a);
    const Corners q = corners(b, pose_b, triangle_b);
    Least least;
    for (std::size_t i = 0; i < 3; ++i) {
        const Feature corner = Feature::corner(i);
        for (std::size_t j = 0; j < 3; ++j) {
            const Vector w = subtracted(p[i], q[j]);
            least.note(dotted(w, w), corner, Feature::corner(j));
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

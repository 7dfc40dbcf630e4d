// SPDX-License-Identifier: Apache-2.0
//
// Minkowski sums and differences.
//
// A point is in the sum of A and B where A meets the reflected B that is moved there. Either their
// boundaries meet, or one of them is inside the other: so the sum is that of the boundaries, with A
// moved by a point of B, and B by a point of A. The boundary of what is convex may be left out.

#include <manifold/manifold.h>
#include <trisect/brep/primitives/hull.h>
#include <trisect/bsp/expression.h>
#include <trisect/kernel/error.h>

#include "node.h"

namespace manifold {

namespace {

using trisect::Expression;
using trisect::Point3d;
using trisect::Solid;

// The hull of the sums of points; nothing where all are in one plane.
Solid hull_of_sums(const std::vector<vec3>& a, const std::vector<vec3>& b) {
    std::vector<Point3d> sums;
    for (const vec3& p : a)
        for (const vec3& q : b) sums.push_back({p.x + q.x, p.y + q.y, p.z + q.z});
    try {
        return Solid::from_mesh(trisect::make_hull(sums));
    } catch (const trisect::Error& error) {
        if (error.code() != trisect::ErrorCode::Usage) throw;
        return {};
    }
}

bool is_convex(const ManifoldNode& node) {
    const Solid hull = hull_of_sums(node.mesh().points, {vec3()});
    return trisect::evaluate(hull - node.solid().solid).is_empty();
}

std::vector<vec3> corners(const TriMesh& mesh, std::size_t t) {
    return {mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)};
}

// The boundary of a, each of whose triangles is swept with b.
std::vector<Solid> swept_boundary(const ManifoldNode& a, const TriMesh& b, bool b_is_convex) {
    std::vector<Solid> parts;
    for (std::size_t t = 0; t < a.mesh().corners.size(); ++t) {
        if (b_is_convex) {
            parts.push_back(hull_of_sums(corners(a.mesh(), t), b.points));
            continue;
        }
        for (std::size_t u = 0; u < b.corners.size(); ++u)
            parts.push_back(hull_of_sums(corners(a.mesh(), t), corners(b, u)));
    }
    return parts;
}

// Moved by the same additions of rounded corners as in the sums, so that both fit together.
Solid moved_by(const Manifold& m, const vec3& by) {
    const Manifold rounded(ManifoldNode::of_mesh(m.node()->mesh()));
    return rounded.Translate(by).node()->solid().solid;
}

Manifold made(const Expression& formula) {
    const Solid solid = trisect::evaluate(formula);
    NamedSolid named;
    named.runs.push_back({.original = static_cast<int>(Manifold::ReserveIDs(1))});
    named.solid = solid;
    return Manifold(ManifoldNode::of_solid(std::move(named)));
}

bool failed(const Manifold& a, const Manifold& b, Manifold& error) {
    for (const Manifold& m : {a, b})
        if (m.Status() != Manifold::Error::NoError) {
            error = m;
            return true;
        }
    return false;
}

}  // namespace

Manifold Manifold::MinkowskiSum(const Manifold& o) const {
    Manifold error;
    if (failed(*this, o, error)) return error;
    if (IsEmpty() || o.IsEmpty()) return {};
    const bool convex = is_convex(*node_);
    const bool other_convex = is_convex(*o.node_);
    if (convex && other_convex)
        return made(hull_of_sums(node_->mesh().points, o.node_->mesh().points));
    const bool swapped = convex;
    const Manifold& a = swapped ? o : *this;
    const Manifold& b = swapped ? *this : o;
    std::vector<Solid> parts =
        swept_boundary(*a.node_, b.node_->mesh(), swapped ? convex : other_convex);
    parts.push_back(moved_by(a, b.node_->mesh().points.front()));
    parts.push_back(moved_by(b, a.node_->mesh().points.front()));
    return made(Expression::any_of(parts));
}

// Where the other one may be moved without leaving this one.
Manifold Manifold::MinkowskiDifference(const Manifold& o) const {
    Manifold error;
    if (failed(*this, o, error)) return error;
    if (IsEmpty() || o.IsEmpty()) return *this;
    const Manifold reflected = o.Scale(vec3(-1.0));
    const std::vector<Solid> parts =
        swept_boundary(*node_, reflected.node_->mesh(), is_convex(*o.node_));
    return made(moved_by(*this, reflected.node_->mesh().points.front()) -
                Expression::any_of(parts));
}

}  // namespace manifold

// SPDX-License-Identifier: Apache-2.0
//
// Booleans, moves, and what is asked of a solid.

#include <algorithm>
#include <cmath>
#include <utility>

#include <manifold/manifold.h>
#include <trisect/brep/primitives/hull.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid_measure.h>
#include <trisect/bsp/solid_transform.h>
#include <trisect/bsp/split.h>
#include <trisect/kernel/error.h>

#include "node.h"
#include "settings.h"

namespace manifold {

namespace {

using trisect::Expression;
using trisect::Solid;
using Ptr = ManifoldNode::Ptr;
using Error = Manifold::Error;

// Two uses of one table must not be taken for one.
bool is_other(const FacePiece& a, const FacePiece& b) {
    return a.table != b.table || !(a.place == b.place) || a.flipped != b.flipped;
}

class Booleans {
public:
    void add(Ptr node, bool flipped) {
        if (clashes(node->solid(), flipped)) {
            node = renamed(*node);
            has_renamed_ = true;
        }
        const NamedSolid& s = node->solid();
        const auto first = static_cast<std::uint32_t>(result_.runs.size());
        for (Run run : s.runs) {
            run.backside ^= flipped;
            result_.runs.push_back(run);
        }
        for (const auto& [operand, piece] : s.pieces) {
            FacePiece p = piece;
            p.first_run += first;
            p.flipped ^= flipped;
            result_.pieces.try_emplace(operand, std::move(p));
        }
        result_.width = std::max(result_.width, s.width);
        tolerance_ = std::max(tolerance_, node->tolerance());
        solids_.push_back(s.solid);
    }

    Ptr evaluate(OpType op) {
        const std::span<const Solid> all(solids_);
        if (op == OpType::Add)
            result_.solid = trisect::evaluate(Expression::any_of(all));
        else if (op == OpType::Intersect)
            result_.solid = trisect::evaluate(Expression::all_of(all));
        else
            result_.solid = trisect::evaluate(solids_[0] - Expression::any_of(all.subspan(1)));
        return ManifoldNode::of_solid(std::move(result_), tolerance_);
    }

    /// Cut by half-spaces, whose faces have a run of their own.
    Ptr cut(const Solid& half) {
        add_run();
        return finish(trisect::evaluate(solids_[0] - half));
    }
    void add_run() {
        result_.runs.push_back({.original = static_cast<int>(Manifold::ReserveIDs(1))});
    }
    /// What was evaluated elsewhere.
    Ptr finish(Solid solid) {
        result_.solid = std::move(solid);
        return ManifoldNode::of_solid(std::move(result_), tolerance_);
    }
    /// Whether some solid got other names than it has.
    [[nodiscard]] bool has_renamed() const { return has_renamed_; }
    [[nodiscard]] const std::vector<Solid>& solids() const { return solids_; }

private:
    [[nodiscard]] bool clashes(const NamedSolid& s, bool flipped) const {
        return std::ranges::any_of(s.pieces, [&](const auto& named) {
            const auto found = result_.pieces.find(named.first);
            if (found == result_.pieces.end()) return false;
            FacePiece piece = named.second;
            piece.flipped ^= flipped;
            return is_other(found->second, piece);
        });
    }

    NamedSolid result_;
    std::vector<Solid> solids_;
    double tolerance_ = 0;
    bool has_renamed_ = false;
};

Ptr boolean(const std::vector<Manifold>& manifolds, OpType op) {
    for (const Manifold& m : manifolds)
        if (m.node()->status() != Error::NoError) return ManifoldNode::of_error(m.node()->status());
    if (manifolds.empty()) return ManifoldNode::of_mesh({});
    if (manifolds.size() == 1) return manifolds[0].node();
    Booleans b;
    for (std::size_t i = 0; i < manifolds.size(); ++i)
        b.add(manifolds[i].node(), op == OpType::Subtract && i > 0);
    return b.evaluate(op);
}

// What is on the side of a plane to which its normal does not point.
Solid below(vec3 normal, double offset) {
    const double length = la::length(normal);
    try {
        return Solid::half_space({normal.x, normal.y, normal.z, -offset * length});
    } catch (const trisect::Error& error) {
        if (error.code() != trisect::ErrorCode::Limit) throw;
    }
    // Coefficients of too many bits lose their last ones.
    constexpr double units = 1 << 30;
    const vec3 n = normal / la::maxelem(la::abs(normal));
    const auto whole = [](double x) { return std::round(x * units); };
    const double d = offset * length / la::maxelem(la::abs(normal));
    return Solid::half_space({whole(n.x), whole(n.y), whole(n.z), -whole(d)});
}

Ptr cut(const Manifold& m, const Solid& half) {
    if (m.node()->status() != Error::NoError || m.node()->is_empty()) return m.node();
    Booleans b;
    b.add(m.node(), false);
    return b.cut(half);
}

bool is_finite(const mat3x4& m) {
    for (int j = 0; j < 4; ++j)
        for (int i = 0; i < 3; ++i)
            if (!std::isfinite(m[j][i])) return false;
    return true;
}

trisect::AffineMap affine(const mat3x4& m) {
    trisect::AffineMap map;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 4; ++j)
            map.rows[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] = m[j][i];
    return map;
}

Ptr moved_node(const ManifoldNode& node, const mat3x4& m) {
    if (la::determinant(mat3(m)) == 0) return ManifoldNode::of_mesh({});
    if (node.is_mesh()) return ManifoldNode::of_mesh(moved(node.mesh(), m), -1, node.tolerance());
    NamedSolid s = node.solid();
    if (!s.solid.is_empty()) s.solid = trisect::transformed(s.solid, affine(m));
    for (auto& [operand, piece] : s.pieces) piece.place = compose(m, piece.place);
    for (Run& run : s.runs) run.transform = compose(m, run.transform);
    return ManifoldNode::of_solid(std::move(s), node.tolerance());
}

}  // namespace

Manifold Manifold::BatchBoolean(const std::vector<Manifold>& manifolds, OpType op) {
    return Manifold(boolean(manifolds, op));
}

Manifold Manifold::Boolean(const Manifold& second, OpType op) const {
    return BatchBoolean({*this, second}, op);
}

Manifold Manifold::Compose(const std::vector<Manifold>& manifolds) {
    return BatchBoolean(manifolds, OpType::Add);
}

// Where one solid is on both sides, the difference has it under other names: then there are two
// evaluations.
std::pair<Manifold, Manifold> Manifold::Split(const Manifold& cutter) const {
    if (Status() != Error::NoError || cutter.Status() != Error::NoError)
        return {*this ^ cutter, *this - cutter};
    Booleans common;
    Booleans rest;
    for (Booleans* b : {&common, &rest}) {
        b->add(node(), false);
        b->add(cutter.node(), b == &rest);
    }
    if (common.has_renamed() || rest.has_renamed()) return {*this ^ cutter, *this - cutter};
    trisect::SplitSolid parts = trisect::split(common.solids()[0], common.solids()[1]);
    return {Manifold(common.finish(std::move(parts.common))),
            Manifold(rest.finish(std::move(parts.rest)))};
}

std::pair<Manifold, Manifold> Manifold::SplitByPlane(vec3 normal, double originOffset) const {
    if (Status() != Error::NoError || node()->is_empty()) return {*this, *this};
    Booleans above;
    Booleans under;
    for (Booleans* b : {&above, &under}) {
        b->add(node(), false);
        b->add_run();
    }
    trisect::SplitSolid parts = trisect::split(above.solids()[0], below(normal, originOffset));
    return {Manifold(above.finish(std::move(parts.rest))),
            Manifold(under.finish(std::move(parts.common)))};
}

Manifold Manifold::TrimByPlane(vec3 normal, double originOffset) const {
    return Manifold(cut(*this, below(normal, originOffset)));
}

Manifold Manifold::Transform(const mat3x4& m) const {
    if (Status() != Error::NoError) return *this;
    if (!is_finite(m)) return Manifold(ManifoldNode::of_error(Error::NonFiniteVertex));
    return Manifold(moved_node(*node_, m));
}

Manifold Manifold::Translate(vec3 by) const {
    return Transform({vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, 0, 1), by});
}

Manifold Manifold::Scale(vec3 by) const {
    return Transform({vec3(by.x, 0, 0), vec3(0, by.y, 0), vec3(0, 0, by.z), vec3()});
}

Manifold Manifold::Rotate(double xDegrees, double yDegrees, double zDegrees) const {
    const auto turn = [](int axis, double angle) {
        mat3 m = la::identity;
        const int u = (axis + 1) % 3;
        const int v = (axis + 2) % 3;
        m[u][u] = cosd(angle);
        m[u][v] = sind(angle);
        m[v][u] = -sind(angle);
        m[v][v] = cosd(angle);
        return m;
    };
    return Transform({turn(2, zDegrees) * turn(1, yDegrees) * turn(0, xDegrees), vec3()});
}

Manifold Manifold::Mirror(vec3 normal) const {
    if (Status() != Error::NoError) return *this;
    const double length = la::length2(normal);
    if (!(length > 0)) return {};
    mat3 m = la::identity;
    for (int j = 0; j < 3; ++j) m[j] -= normal * (2 * normal[j] / length);
    return Transform({m, vec3()});
}

std::vector<Manifold> Manifold::Decompose() const {
    if (Status() != Error::NoError || IsEmpty()) return {*this};
    std::vector<Manifold> parts;
    if (node_->is_mesh()) {
        const auto triangles = parts_of(node_->mesh());
        if (triangles.size() == 1) return {*this};
        for (const auto& part : triangles)
            parts.emplace_back(
                ManifoldNode::of_mesh(part_of(node_->mesh(), part), -1, node_->tolerance()));
        return parts;
    }
    for (Solid& part : trisect::components(node_->solid().solid)) {
        NamedSolid s = node_->solid();
        s.solid = std::move(part);
        parts.emplace_back(ManifoldNode::of_solid(std::move(s), node_->tolerance()));
    }
    return parts;
}

namespace {

Manifold hull_of(const std::vector<trisect::Point3d>& points) {
    trisect::PolygonMesh hull;
    try {
        hull = trisect::make_hull(points);
    } catch (const trisect::Error& error) {
        if (error.code() != trisect::ErrorCode::Usage) throw;
        return {};
    }
    TriMesh mesh;
    std::vector<std::uint32_t> number(hull.points.size(), no_side);
    for (std::size_t f = 0; f < hull.face_count(); ++f) {
        Triple t{};
        for (std::size_t k = 0; k < 3; ++k) {
            std::uint32_t& n = number[hull.face(f)[k]];
            if (n == no_side) {
                n = static_cast<std::uint32_t>(mesh.points.size());
                mesh.points.emplace_back(hull.points[hull.face(f)[k]].data());
            }
            t[k] = n;
        }
        mesh.corners.push_back(t);
    }
    const int id = static_cast<int>(Manifold::ReserveIDs(1));
    mesh.run.assign(mesh.corners.size(), 0);
    mesh.runs.push_back({.original = id});
    mesh.face = flat_faces(mesh);
    return Manifold(ManifoldNode::of_mesh(std::move(mesh), id));
}

}  // namespace

Manifold Manifold::Hull(const std::vector<vec3>& points) {
    std::vector<trisect::Point3d> all;
    for (const vec3& p : points) {
        if (!std::isfinite(p.x + p.y + p.z))
            return Manifold(ManifoldNode::of_error(Error::NonFiniteVertex));
        all.push_back({p.x, p.y, p.z});
    }
    return hull_of(all);
}

Manifold Manifold::Hull(const std::vector<Manifold>& manifolds) {
    std::vector<vec3> points;
    for (const Manifold& m : manifolds) {
        if (m.Status() != Error::NoError) return m;
        points.insert(points.end(), m.node_->mesh().points.begin(), m.node_->mesh().points.end());
    }
    return Hull(points);
}

Manifold Manifold::Hull() const { return Hull(std::vector<Manifold>{*this}); }

double Manifold::Volume() const {
    return node_->is_mesh() ? volume_of(node_->mesh()) : trisect::volume(node_->solid().solid);
}

double Manifold::SurfaceArea() const {
    return node_->is_mesh() ? area_of(node_->mesh()) : trisect::area(node_->solid().solid).value;
}

Box Manifold::BoundingBox() const {
    if (node_->is_mesh()) return box_of(node_->mesh());
    const auto bounds = trisect::bounds(node_->solid().solid);
    if (!bounds) return {};
    return {vec3(bounds->lo.data()), vec3(bounds->hi.data())};
}

}  // namespace manifold

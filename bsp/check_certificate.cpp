// SPDX-License-Identifier: Apache-2.0
//
// The checker shares nothing with what decides: it has the vertices, loops and shells of the two
// boundaries, the numbers of the poses, and fractions. Points are located by the parity of a ray's
// crossings with faces (even-odd in the face's plane); a ray that meets an edge is given up for
// another one. That is slow and plain on purpose.

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <trisect/bsp/detail/certified_triangles.h>
#include <trisect/bsp/interference_certificate.h>

namespace trisect {

namespace {

using Vector = RationalPoint;

Vector minus(const Vector& u, const Vector& v) { return {u[0] - v[0], u[1] - v[1], u[2] - v[2]}; }
Vector cross(const Vector& u, const Vector& v) {
    return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}
ExactRational dot(const Vector& u, const Vector& v) {
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}
bool is_zero(const Vector& v) { return v[0].sign() == 0 && v[1].sign() == 0 && v[2].sign() == 0; }

enum class Where { Inside, Outside, Boundary, Unknown };

// A boundary in the world.
class PlacedBoundary {
public:
    PlacedBoundary(const Brep& brep, const Pose& pose)
        : brep_(&brep), points_(detail::corners_in_world(brep, pose)) {
        for (const FaceId f : brep.faces()) normals_.push_back(normal_of(f));
    }

    [[nodiscard]] const Brep& brep() const { return *brep_; }
    [[nodiscard]] const std::vector<Vector>& points() const { return points_; }
    [[nodiscard]] const Vector& at(VertexId v) const { return points_[v.index]; }

    [[nodiscard]] Where locate(const Vector& p) const {
        for (const FaceId f : brep_->faces())
            if (is_on_face(f, p)) return Where::Boundary;
        // Directions of no special meaning; one that meets no edge is found soon.
        std::int64_t seed = 1;
        const auto number = [&seed] {
            seed = (seed * 48271) % 2147483647;
            return ExactRational(seed % 2001 - 1000);
        };
        for (int attempt = 0; attempt < 50; ++attempt) {
            const Vector d{number(), number(), number()};
            if (const Where w = along_ray(p, d); w != Where::Unknown) return w;
        }
        return Where::Unknown;
    }

    // The segments of every face's loops, without direction: they tell the face, and all faces
    // together a bounded solid.
    [[nodiscard]] std::vector<std::set<std::pair<Vector, Vector>>> outlines() const {
        std::vector<std::set<std::pair<Vector, Vector>>> all;
        for (const FaceId f : brep_->faces()) {
            auto& outline = all.emplace_back();
            for (const HalfedgeId h : brep_->halfedges(f))
                outline.insert(std::minmax(at(brep_->origin(h)), at(brep_->target(h))));
        }
        std::ranges::sort(all);
        return all;
    }

    [[nodiscard]] bool is_on_face(FaceId f, const Vector& p) const {
        return f.index < brep_->faces().size() &&
               dot(normals_[f.index], minus(at(corner(f)), p)).sign() == 0 &&
               in_face(f, p) != Where::Outside;
    }

    // Whether triangles fill all faces: in each face their sides, cancelled, are its halfedges. Two
    // bounded chains in a plane with one boundary are the same.
    [[nodiscard]] bool is_filled_by(const std::vector<CertifiedTriangle>& triangles) const {
        std::map<std::uint32_t, std::map<std::pair<Vector, Vector>, int>> sides;
        const auto add = [&](std::uint32_t face, const Vector& p, const Vector& q, int sign) {
            if (p < q)
                sides[face][{p, q}] += sign;
            else
                sides[face][{q, p}] -= sign;
        };
        for (const CertifiedTriangle& t : triangles) {
            if (t.face.index >= brep_->faces().size()) return false;
            const Vector& n = normals_[t.face.index];
            for (std::size_t i = 0; i < 3; ++i) {
                if (t.vertex[i].index >= points_.size()) return false;
                if (dot(n, minus(at(t.vertex[i]), at(corner(t.face)))).sign() != 0) return false;
            }
            if (dot(n, cross(minus(at(t.vertex[1]), at(t.vertex[0])),
                             minus(at(t.vertex[2]), at(t.vertex[0]))))
                    .sign() <= 0)
                return false;
            for (std::size_t i = 0; i < 3; ++i)
                add(t.face.index, at(t.vertex[i]), at(t.vertex[(i + 1) % 3]), 1);
        }
        for (const FaceId f : brep_->faces())
            for (const HalfedgeId h : brep_->halfedges(f))
                add(f.index, at(brep_->origin(h)), at(brep_->target(h)), -1);
        return std::ranges::all_of(sides, [](const auto& face) {
            return std::ranges::all_of(face.second, [](const auto& s) { return s.second == 0; });
        });
    }

private:
    [[nodiscard]] VertexId corner(FaceId f) const {
        return brep_->origin(brep_->halfedges(brep_->outer_loop(f))[0]);
    }
    // Twice the vector area of the outer loop: counter-clockwise about it, mirrored or not.
    [[nodiscard]] Vector normal_of(FaceId f) const {
        Vector n;
        for (const HalfedgeId h : brep_->halfedges(brep_->outer_loop(f))) {
            const Vector c = cross(at(brep_->origin(h)), at(brep_->target(h)));
            for (std::size_t i = 0; i < 3; ++i) n[i] += c[i];
        }
        return n;
    }
    // Of a point in the face's plane.
    [[nodiscard]] Where in_face(FaceId f, const Vector& p) const {
        const Vector& n = normals_[f.index];
        std::size_t k = 0;
        while (n[k].sign() == 0) ++k;
        const std::size_t x = (k + 1) % 3;
        const std::size_t y = (k + 2) % 3;
        bool inside = false;
        for (const HalfedgeId h : brep_->halfedges(f)) {
            const Vector& u = at(brep_->origin(h));
            const Vector& v = at(brep_->target(h));
            const ExactRational turn =
                (v[x] - u[x]) * (p[y] - u[y]) - (v[y] - u[y]) * (p[x] - u[x]);
            const bool within = std::min(u[x], v[x]) <= p[x] && p[x] <= std::max(u[x], v[x]) &&
                                std::min(u[y], v[y]) <= p[y] && p[y] <= std::max(u[y], v[y]);
            if (turn.sign() == 0 && within) return Where::Boundary;
            if ((u[y] > p[y]) == (v[y] > p[y])) continue;
            if ((turn.sign() > 0) == (v[y] > u[y])) inside = !inside;
        }
        return inside ? Where::Inside : Where::Outside;
    }
    [[nodiscard]] Where along_ray(const Vector& p, const Vector& d) const {
        bool inside = false;
        for (const FaceId f : brep_->faces()) {
            const Vector& n = normals_[f.index];
            const ExactRational speed = dot(n, d);
            if (speed.sign() == 0) return Where::Unknown;
            const ExactRational t = dot(n, minus(at(corner(f)), p)) / speed;
            if (t.sign() <= 0) continue;
            const Vector hit{p[0] + t * d[0], p[1] + t * d[1], p[2] + t * d[2]};
            const Where w = in_face(f, hit);
            if (w == Where::Boundary) return Where::Unknown;
            if (w == Where::Inside) inside = !inside;
        }
        return inside ? Where::Inside : Where::Outside;
    }

    const Brep* brep_;
    std::vector<Vector> points_;
    std::vector<Vector> normals_;
};

// Of a point and a triangle.
ExactRational squared_distance(const Vector& p, const std::array<Vector, 3>& t) {
    const Vector n = cross(minus(t[1], t[0]), minus(t[2], t[0]));
    const ExactRational nn = dot(n, n);
    bool above = nn.sign() != 0;
    for (std::size_t i = 0; above && i < 3; ++i)
        above = dot(cross(n, minus(t[(i + 1) % 3], t[i])), minus(p, t[i])).sign() >= 0;
    if (above) {
        const ExactRational h = dot(n, minus(p, t[0]));
        return h * h / nn;
    }
    std::optional<ExactRational> least;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vector d = minus(t[(i + 1) % 3], t[i]);
        const Vector w = minus(p, t[i]);
        const ExactRational dd = dot(d, d);
        ExactRational part = dd.sign() == 0 ? ExactRational() : dot(w, d) / dd;
        part = std::clamp(part, ExactRational(), ExactRational(1));
        const Vector way{w[0] - part * d[0], w[1] - part * d[1], w[2] - part * d[2]};
        const ExactRational squared = dot(way, way);
        if (!least || squared < *least) least = squared;
    }
    return *least;
}

ExactRational value_at(const SeparatingPlane& plane, const Vector& p) {
    return dot(plane.normal, p) + plane.offset;
}

using Polygon = std::vector<Vector>;  // convex

class Checker {
public:
    Checker(const InterferenceCertificate& c, const Brep& a, const Pose& pose_a, const Brep& b,
            const Pose& pose_b)
        : c_(c), a_(a, pose_a), b_(b, pose_b) {}

    std::string run() {
        if (a_.brep().is_empty() || b_.brep().is_empty())
            return c_.relation == Relation::Disjoint ? "" : "an empty solid is disjoint";
        if (std::string wrong = wrong_points(); !wrong.empty()) return wrong;
        if (c_.plane && !separates(*c_.plane)) return "the plane does not separate the solids";
        if (!c_.apart.empty() || !c_.cells.empty())
            if (!a_.is_filled_by(c_.triangles_a) || !b_.is_filled_by(c_.triangles_b))
                return "the triangles do not fill the faces";
        if (!c_.apart.empty())
            if (std::string wrong = wrong_tree(); !wrong.empty()) return wrong;
        if (!c_.cells.empty())
            if (std::string wrong = wrong_cells(); !wrong.empty()) return wrong;
        if (std::string wrong = contradiction(); !wrong.empty()) return wrong;
        return c_.is_complete ? missing() : "";
    }

private:
    static bool is(const PlacedBoundary& boundary, const std::optional<Vector>& p, Where where) {
        return !p || boundary.locate(*p) == where;
    }
    std::string wrong_points() const {
        if (!is(a_, c_.in_both, Where::Inside) || !is(b_, c_.in_both, Where::Inside))
            return "a point is not inside both";
        if (!is(a_, c_.only_in_a, Where::Inside) || !is(b_, c_.only_in_a, Where::Outside))
            return "a point is not inside A alone";
        if (!is(a_, c_.only_in_b, Where::Outside) || !is(b_, c_.only_in_b, Where::Inside))
            return "a point is not inside B alone";
        if (!is(a_, c_.on_both, Where::Boundary) || !is(b_, c_.on_both, Where::Boundary))
            return "a point is not on both boundaries";
        return {};
    }
    bool separates(const SeparatingPlane& plane) const {
        return !is_zero(plane.normal) && std::ranges::all_of(a_.points(), [&](const Vector& p) {
            return value_at(plane, p).sign() <= 0;
        }) && std::ranges::all_of(b_.points(), [&](const Vector& p) {
            return value_at(plane, p).sign() >= 0;
        });
    }

    std::string wrong_tree() {
        struct Range {
            std::size_t node, a0, a1, b0, b1;
        };
        std::vector<Range> open{{0, 0, c_.triangles_a.size(), 0, c_.triangles_b.size()}};
        std::vector<bool> seen(c_.apart.size(), false);
        while (!open.empty()) {
            const Range r = open.back();
            open.pop_back();
            if (r.node >= c_.apart.size() || seen[r.node]) return "the tree is no tree";
            seen[r.node] = true;
            const ApartNode& n = c_.apart[r.node];
            if (n.kind == ApartNode::Kind::Separated) {
                if (!are_apart(r.a0, r.a1, r.b0, r.b1, n.plane))
                    return "a plane of the tree does not separate";
                continue;
            }
            const bool of_a = n.kind == ApartNode::Kind::SplitA;
            if ((of_a ? r.a1 - r.a0 : r.b1 - r.b0) < 2) return "the tree splits a single triangle";
            const std::size_t ma = (r.a0 + r.a1) / 2;
            const std::size_t mb = (r.b0 + r.b1) / 2;
            open.push_back({r.node + 1, r.a0, of_a ? ma : r.a1, r.b0, of_a ? r.b1 : mb});
            open.push_back({n.other, of_a ? ma : r.a0, r.a1, of_a ? r.b0 : mb, r.b1});
        }
        return {};
    }
    bool are_apart(std::size_t a0, std::size_t a1, std::size_t b0, std::size_t b1,
                   const SeparatingPlane& plane) const {
        const auto all = [&](const PlacedBoundary& boundary,
                             const std::vector<CertifiedTriangle>& triangles, std::size_t from,
                             std::size_t to, int sign) {
            return std::ranges::all_of(
                detail::corners_of_range(triangles, from, to), [&](std::uint32_t v) {
                    return value_at(plane, boundary.at(VertexId(v))).sign() == sign;
                });
        };
        return all(a_, c_.triangles_a, a0, a1, -1) && all(b_, c_.triangles_b, b0, b1, 1);
    }

    // The pieces of triangles in an open cell, and the planes that bound it: points of it have the
    // sign given with each.
    struct Cell {
        std::size_t node = 0;
        std::vector<Polygon> of_a;
        std::vector<Polygon> of_b;
        std::vector<std::pair<std::size_t, int>> bounds;
    };
    std::string wrong_cells() {
        std::vector<bool> seen(c_.cells.size(), false);
        std::vector<Cell> open{{0, polygons(a_, c_.triangles_a), polygons(b_, c_.triangles_b), {}}};
        while (!open.empty()) {
            Cell cell = std::move(open.back());
            open.pop_back();
            if (cell.node >= c_.cells.size() || seen[cell.node]) return "the cells are no tree";
            seen[cell.node] = true;
            const CertifiedCell& n = c_.cells[cell.node];
            if (n.kind != CertifiedCell::Kind::Split) {
                if (std::string wrong = wrong_leaf(cell, n); !wrong.empty()) return wrong;
                continue;
            }
            if (is_zero(n.plane.normal)) return "a plane of a cell has no normal";
            for (const int side : {1, -1}) {
                Cell half;
                half.node = side < 0 ? cell.node + 1 : n.other;
                half.of_a = beside(cell.of_a, n.plane, side);
                half.of_b = beside(cell.of_b, n.plane, side);
                half.bounds = cell.bounds;
                half.bounds.emplace_back(cell.node, side);
                open.push_back(std::move(half));
            }
        }
        return {};
    }
    // A cell that one boundary misses has to be on the side of that solid that says enough.
    std::string wrong_leaf(const Cell& cell, const CertifiedCell& leaf) const {
        for (const auto& [node, side] : cell.bounds)
            if (value_at(c_.cells[node].plane, leaf.point).sign() != side)
                return "the point of a cell is not in it";
        const bool is_of_a = leaf.kind == CertifiedCell::Kind::WithoutA;
        if (!(is_of_a ? cell.of_a : cell.of_b).empty()) return "a boundary reaches into a cell";
        const Relation within = is_of_a ? Relation::Contains : Relation::Inside;
        const Where where = (is_of_a ? a_ : b_).locate(leaf.point);
        const Where enough = c_.relation == within ? Where::Inside : Where::Outside;
        return where == enough ? "" : "a cell is on the wrong side";
    }
    static std::vector<Polygon> polygons(const PlacedBoundary& boundary,
                                         const std::vector<CertifiedTriangle>& triangles) {
        std::vector<Polygon> r;
        for (const CertifiedTriangle& t : triangles)
            r.push_back(
                {boundary.at(t.vertex[0]), boundary.at(t.vertex[1]), boundary.at(t.vertex[2])});
        return r;
    }
    // What of the polygons is strictly on a side of a plane; closed again.
    static std::vector<Polygon> beside(const std::vector<Polygon>& polygons,
                                       const SeparatingPlane& plane, int side) {
        std::vector<Polygon> r;
        for (const Polygon& p : polygons) {
            std::vector<ExactRational> values;
            for (const Vector& v : p) values.push_back(value_at(plane, v));
            if (std::ranges::none_of(values,
                                     [side](const ExactRational& v) { return v.sign() == side; }))
                continue;
            Polygon& q = r.emplace_back();
            for (std::size_t i = 0; i < p.size(); ++i) {
                const std::size_t j = (i + 1) % p.size();
                if (values[i].sign() != -side) q.push_back(p[i]);
                if (values[i].sign() * values[j].sign() >= 0) continue;
                const ExactRational t = values[i] / (values[i] - values[j]);
                const Vector d = minus(p[j], p[i]);
                q.push_back({p[i][0] + t * d[0], p[i][1] + t * d[1], p[i][2] + t * d[2]});
            }
        }
        return r;
    }

    // What the parts say together, against the relation claimed.
    std::string contradiction() const {
        const Relation r = c_.relation;
        const bool interiors_meet = r != Relation::Disjoint && r != Relation::Touching;
        if (c_.in_both && !interiors_meet) return "interiors meet";
        if (c_.plane && interiors_meet) return "a plane separates the solids";
        if (c_.only_in_a && (r == Relation::Inside || r == Relation::Equal))
            return "a point of A is outside B";
        if (c_.only_in_b && (r == Relation::Contains || r == Relation::Equal))
            return "a point of B is outside A";
        if (c_.on_both && r == Relation::Disjoint) return "the boundaries meet";
        if (!c_.apart.empty() && c_.on_both) return "the boundaries meet and are apart";
        if (!c_.cells.empty() && (r == Relation::Overlapping || r == Relation::Equal))
            return "cells say nothing about such solids";
        return {};
    }

    std::string missing() {
        switch (c_.relation) {
            case Relation::Touching:
                if (!c_.on_both) return "no common point";
                return c_.plane || !c_.cells.empty() ? "" : "no proof that interiors are apart";
            case Relation::Overlapping:
                return c_.in_both && c_.only_in_a && c_.only_in_b ? "" : "points are missing";
            case Relation::Equal:
                return a_.outlines() == b_.outlines() ? "" : "the boundaries are different";
            case Relation::Inside:
                if (c_.cells.empty()) return shells_say();
                return c_.only_in_b ? "" : "no point of B alone";
            case Relation::Contains:
                if (c_.cells.empty()) return shells_say();
                return c_.only_in_a ? "" : "no point of A alone";
            default:
                return shells_say();
        }
    }
    // Boundaries that are apart: each shell is inside or outside as a whole.
    std::string shells_say() {
        if (c_.apart.empty()) return "no proof that the boundaries are apart";
        bool a_in = false;
        bool a_out = false;
        bool b_in = false;
        const auto look = [](const PlacedBoundary& these, const PlacedBoundary& other, bool& in,
                             bool& out) {
            const Brep& brep = these.brep();
            for (const ShellId s : brep.shells()) {
                const FaceId f = brep.faces(s).front();
                const Where w =
                    other.locate(these.at(brep.origin(brep.halfedges(brep.outer_loop(f))[0])));
                in = in || w == Where::Inside;
                out = out || w == Where::Outside;
                if (w == Where::Boundary || w == Where::Unknown) return false;
            }
            return true;
        };
        bool b_out = false;
        if (!look(a_, b_, a_in, a_out) || !look(b_, a_, b_in, b_out))
            return "a shell that could not be located";
        Relation found = Relation::Overlapping;
        if (!a_in && !b_in)
            found = Relation::Disjoint;
        else if (!a_out && !b_in)
            found = Relation::Inside;
        else if (!b_out && !a_in)
            found = Relation::Contains;
        return found == c_.relation ? "" : "the shells lie otherwise";
    }

    const InterferenceCertificate& c_;
    PlacedBoundary a_;
    PlacedBoundary b_;
};

}  // namespace

std::vector<RationalPoint> detail::corners_in_world(const Brep& brep, const Pose& pose) {
    std::vector<RationalPoint> r;
    for (const Point& p : brep.points()) {
        const HomogeneousPoint h = p.homogeneous();
        Vector x;
        for (std::size_t i = 0; i < 3; ++i)
            x[i] = (ExactRational(h.xyz[i]) / ExactRational(h.w)).scaled(brep.lattice().exponent);
        Vector y;
        for (std::size_t i = 0; i < 3; ++i) {
            y[i] = ExactRational(pose.translation(i));
            for (std::size_t j = 0; j < 3; ++j) y[i] += ExactRational(pose.matrix(i, j)) * x[j];
            y[i] /= ExactRational(pose.denominator());
        }
        r.push_back(std::move(y));
    }
    return r;
}

bool detail::is_on_face(const RationalPoint& point, FaceId face, const Brep& brep,
                        const Pose& pose) {
    return PlacedBoundary(brep, pose).is_on_face(face, point);
}

bool detail::is_deep_inside(const RationalPoint& point, const ExactRational& radius,
                            const std::vector<CertifiedTriangle>& triangles, const Brep& brep,
                            const Pose& pose) {
    const PlacedBoundary boundary(brep, pose);
    for (const CertifiedTriangle& t : triangles) {
        std::array<Vector, 3> c;
        for (std::size_t i = 0; i < 3; ++i) {
            if (t.vertex[i].index >= boundary.points().size()) return false;
            c[i] = boundary.at(t.vertex[i]);
        }
        // Far off along an axis.
        bool far = false;
        for (std::size_t k = 0; k < 3 && !far; ++k)
            far =
                std::ranges::all_of(c, [&](const Vector& v) { return v[k] - point[k] > radius; }) ||
                std::ranges::all_of(c, [&](const Vector& v) { return point[k] - v[k] > radius; });
        if (!far && squared_distance(point, c) <= radius * radius) return false;
    }
    return boundary.locate(point) == Where::Inside;
}

std::vector<std::uint32_t> detail::corners_of_range(const std::vector<CertifiedTriangle>& triangles,
                                                    std::size_t from, std::size_t to) {
    std::vector<std::uint32_t> r;
    for (std::size_t i = from; i < to; ++i)
        for (const VertexId v : triangles[i].vertex) r.push_back(v.index);
    std::ranges::sort(r);
    r.erase(std::unique(r.begin(), r.end()), r.end());
    return r;
}

bool detail::triangles_fill_faces(const std::vector<CertifiedTriangle>& triangles,
                                  const Brep& brep) {
    return PlacedBoundary(brep, Pose()).is_filled_by(triangles);
}

std::string check_certificate(const InterferenceCertificate& certificate, const Brep& a,
                              const Pose& pose_a, const Brep& b, const Pose& pose_b) {
    return Checker(certificate, a, pose_a, b, pose_b).run();
}

}  // namespace trisect

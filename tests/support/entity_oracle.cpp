// SPDX-License-Identifier: Apache-2.0

#include "entity_oracle.h"

#include <cstddef>
#include <optional>

#include "reference/vector.h"
#include "support/lattice_arithmetic.h"

namespace trisect::test {

namespace {

using reference::cross;
using reference::dot;
using reference::Integer;
using reference::Point3;
using reference::Rational;
using reference::sign;
using reference::subtracted;
using Leaf = MspTree::Leaf;
using Ref = MspTree::Ref;

template <int N>
Integer integer(const WideInt<N>& v) {
    const WideInt<N> a = v.abs();
    Integer r = 0;
    for (int i = N - 1; i >= 0; --i) {
        r <<= 64;
        r += Integer(static_cast<unsigned long>(a.limb(i)));
    }
    return v.is_negative() ? Integer(-r) : r;
}

// Whether p is strictly between the ends.
bool is_between(const Point3& from, const Point3& to, const Point3& p) {
    const Point3 d = subtracted(to, from);
    const Point3 e = subtracted(p, from);
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t l = (k + 1) % 3;
        if (d[k] * e[l] != d[l] * e[k]) return false;
    }
    const Rational along = dot(d, e);
    return along > 0 && along < dot(d, d);
}

}  // namespace

Point3 rational(const Point& p) {
    const HomogeneousPoint h = p.homogeneous();
    Point3 out;
    for (std::size_t k = 0; k < 3; ++k)
        out[k] = reference::fraction(integer(h.xyz[k]), integer(h.w));
    return out;
}

Point3 rational(const LatticePoint& p) {
    return reference::to_point({p.x.to_integer(), p.y.to_integer(), p.z.to_integer()});
}

EntityOracle::EntityOracle(const Brep& brep) {
    for (const VertexId v : brep.vertices()) vertices_.push_back(rational(brep.point(v)));
    const auto side = [&](HalfedgeId h) {
        return Side{vertices_[brep.origin(h).index], vertices_[brep.target(h).index]};
    };
    for (const EdgeId e : brep.edges()) edges_.push_back(side(brep.halfedge(e)));
    for (const FaceId f : brep.faces()) {
        const Plane& plane = brep.plane(f);
        Face face;
        for (int k = 0; k < 3; ++k)
            face.normal[static_cast<std::size_t>(k)] =
                Rational(integer(WideInt<2>(plane.normal(k))));
        face.offset = Rational(integer(plane.offset()));
        std::size_t dropped = 0;
        while (face.normal[dropped] == 0) ++dropped;
        face.u = (dropped + 1) % 3;
        face.v = (dropped + 2) % 3;
        for (const HalfedgeId h : brep.halfedges(f)) face.sides.push_back(side(h));
        faces_.push_back(std::move(face));
    }
    Rational volume = 0;
    for (const Face& f : faces_)
        for (const Side& s : f.sides) volume += dot(f.sides.front().from, cross(s.from, s.to));
    is_complement_ = volume < 0;
}

// Even or odd, in the projection; half-open, so that corners count once. \pre p is on the plane and
// on no side.
bool EntityOracle::covers(const Face& f, const Point3& p) {
    bool inside = false;
    for (const Side& s : f.sides) {
        const bool above_from = s.from[f.v] > p[f.v];
        const bool above_to = s.to[f.v] > p[f.v];
        if (above_from == above_to) continue;
        const Rational t = (p[f.v] - s.from[f.v]) / (s.to[f.v] - s.from[f.v]);
        if (s.from[f.u] + t * (s.to[f.u] - s.from[f.u]) > p[f.u]) inside = !inside;
    }
    return inside;
}

Ref EntityOracle::locate(const Point3& p) const {
    for (std::size_t v = 0; v < vertices_.size(); ++v)
        if (vertices_[v] == p) return Ref::leaf(Leaf::OnVertex, static_cast<std::uint32_t>(v));
    for (std::size_t e = 0; e < edges_.size(); ++e)
        if (is_between(edges_[e].from, edges_[e].to, p))
            return Ref::leaf(Leaf::OnEdge, static_cast<std::uint32_t>(e));
    for (std::size_t f = 0; f < faces_.size(); ++f)
        if (dot(faces_[f].normal, p) + faces_[f].offset == 0 && covers(faces_[f], p))
            return Ref::leaf(Leaf::OnFace, static_cast<std::uint32_t>(f));
    for (long attempt = 1;; ++attempt) {
        const Point3 way{Rational(1009 + 7 * attempt), Rational(31 * attempt, 7) + 101,
                         Rational(-17 * attempt, 11) + 57};
        bool inside = is_complement_;
        bool is_generic = true;
        for (const Face& f : faces_) {
            const Rational slope = dot(f.normal, way);
            const Rational height = dot(f.normal, p) + f.offset;
            if (slope == 0) {
                is_generic = is_generic && height != 0;
                continue;
            }
            const Rational t = -height / slope;
            if (t <= 0) continue;
            const Point3 hit{p[0] + t * way[0], p[1] + t * way[1], p[2] + t * way[2]};
            for (const Side& s : f.sides)
                is_generic = is_generic && hit != s.from && !is_between(s.from, s.to, hit);
            if (!is_generic) break;
            if (covers(f, hit)) inside = !inside;
        }
        if (is_generic) return Ref::leaf(inside ? Leaf::In : Leaf::Out);
    }
}

}  // namespace trisect::test

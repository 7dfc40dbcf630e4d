// SPDX-License-Identifier: Apache-2.0
//
// The oracle moves vertices by the poses' own numbers, in GMP's fractions, and shares no formula
// with the walk. Distances are compared in doubles first, with a margin that is a million times
// their error on small grids, then exactly.

#include "convex_oracle.h"
#include "support/lattice_arithmetic.h"

#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <cmath>

#include <trisect/brep/number/gmp_conversion.h>
#include <trisect/bsp/hierarchies/convex/convex_hull.h>

namespace convex_oracle {

namespace {

using trisect::LatticePoint;
using trisect::hierarchies::PolytopeFeature;
using Kind = PolytopeFeature::Kind;

template <class N>
using V3 = std::array<N, 3>;

template <class N>
V3<N> sub(const V3<N>& a, const V3<N>& b) {
    return {N(a[0] - b[0]), N(a[1] - b[1]), N(a[2] - b[2])};
}
template <class N>
V3<N> add(const V3<N>& a, const N& s, const V3<N>& b) {
    return {N(a[0] + s * b[0]), N(a[1] + s * b[1]), N(a[2] + s * b[2])};
}
template <class N>
N dot(const V3<N>& a, const V3<N>& b) {
    return N(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
}
template <class N>
V3<N> cross(const V3<N>& a, const V3<N>& b) {
    return {N(a[1] * b[2] - a[2] * b[1]), N(a[2] * b[0] - a[0] * b[2]),
            N(a[0] * b[1] - a[1] * b[0])};
}

// Corners of a feature, in order.
template <class N>
using Corners = std::vector<V3<N>>;

template <class N>
struct Closest {
    N squared;
    V3<N> p;
    V3<N> q;
};

template <class N>
void keep_least(std::optional<Closest<N>>& best, const V3<N>& p, const V3<N>& q) {
    const V3<N> r = sub(p, q);
    N d = dot(r, r);
    if (!best || d < best->squared) best = Closest<N>{std::move(d), p, q};
}

template <class N>
V3<N> on_segment(const V3<N>& p, const V3<N>& a, const V3<N>& b) {
    const V3<N> d = sub(b, a);
    N t = dot(sub(p, a), d) / dot(d, d);
    if (t < 0) t = 0;
    if (t > 1) t = 1;
    return add(a, t, d);
}

template <class N>
V3<N> normal_of(const Corners<N>& c) {
    // The largest of the corner's, which is not 0.
    V3<N> best{N(0), N(0), N(0)};
    for (std::size_t i = 2; i < c.size(); ++i) {
        const V3<N> n = cross(sub(c[i - 1], c[0]), sub(c[i], c[0]));
        if (dot(n, n) > dot(best, best)) best = n;
    }
    return best;
}

template <class N>
std::optional<V3<N>> inside_foot(const V3<N>& p, const Corners<N>& face) {
    const V3<N> n = normal_of(face);
    for (std::size_t i = 0; i < face.size(); ++i) {
        const V3<N>& a = face[i];
        const V3<N>& b = face[(i + 1) % face.size()];
        if (dot(n, cross(sub(b, a), sub(p, a))) < 0) return std::nullopt;
    }
    const N h = dot(n, sub(p, face[0])) / dot(n, n);
    return add(p, N(-h), n);
}

// Of two features of at most two corners, or one of one corner and a face, without crossings.
template <class N>
void closest_of(const Corners<N>& x, const Corners<N>& y, std::optional<Closest<N>>& best) {
    for (const V3<N>& p : x)
        for (std::size_t j = 0; j < y.size(); ++j) {
            keep_least(best, p, y[j]);
            if (y.size() > 1) keep_least(best, p, on_segment(p, y[j], y[(j + 1) % y.size()]));
        }
    for (const V3<N>& q : y)
        for (std::size_t i = 0; i < x.size(); ++i)
            if (x.size() > 1) keep_least(best, on_segment(q, x[i], x[(i + 1) % x.size()]), q);
    if (x.size() == 2 && y.size() == 2) {
        const V3<N> u = sub(x[1], x[0]);
        const V3<N> v = sub(y[1], y[0]);
        const V3<N> r = sub(y[0], x[0]);
        const N uu = dot(u, u);
        const N vv = dot(v, v);
        const N uv = dot(u, v);
        const N det = uu * vv - uv * uv;
        if (det > 0) {
            const N s = (dot(u, r) * vv - dot(v, r) * uv) / det;
            const N t = (dot(u, r) * uv - dot(v, r) * uu) / det;
            if (s >= 0 && s <= 1 && t >= 0 && t <= 1)
                keep_least(best, add(x[0], s, u), add(y[0], t, v));
        }
    }
    if (x.size() == 1 && y.size() > 2)
        if (const auto q = inside_foot(x[0], y)) keep_least(best, x[0], *q);
    if (y.size() == 1 && x.size() > 2)
        if (const auto p = inside_foot(y[0], x)) keep_least(best, *p, y[0]);
}

}  // namespace

struct Scene::Data {
    struct Body {
        const ConvexPolytope* polytope;
        Corners<mpq_class> exact;
        Corners<double> about;

        template <class N>
        [[nodiscard]] const Corners<N>& points() const {
            if constexpr (std::is_same_v<N, double>)
                return about;
            else
                return exact;
        }
        template <class N>
        [[nodiscard]] Corners<N> corners(const PolytopeFeature& f) const {
            if (f.kind == Kind::Vertex) return {points<N>()[f.index]};
            Corners<N> r;
            if (f.kind == Kind::Edge)
                for (const auto v : polytope->edges()[f.index].vertex) r.push_back(points<N>()[v]);
            else
                for (const auto v : polytope->corners(f.index)) r.push_back(points<N>()[v]);
            return r;
        }
        [[nodiscard]] std::vector<PolytopeFeature> features() const {
            std::vector<PolytopeFeature> r;
            for (std::size_t i = 0; i < polytope->vertices().size(); ++i)
                r.push_back(PolytopeFeature::vertex(i));
            for (std::size_t i = 0; i < polytope->edges().size(); ++i)
                r.push_back(PolytopeFeature::edge(i));
            for (std::size_t i = 0; i < polytope->face_count(); ++i)
                r.push_back(PolytopeFeature::face(i));
            return r;
        }
    };
    Body a;
    Body b;
};

Scene::Scene(const ConvexPolytope& a, const Pose& pose_a, const ConvexPolytope& b,
             const Pose& pose_b)
    : data_(std::make_unique<Data>()) {
    const auto place = [](Data::Body& body, const ConvexPolytope& p, const Pose& pose) {
        body.polytope = &p;
        const mpz_class s = trisect::detail::to_gmp(pose.denominator());
        mpq_class unit = 1;
        const int e = p.lattice().exponent;
        for (int i = 0; i < std::abs(e); ++i) unit *= e < 0 ? mpq_class(1, 2) : mpq_class(2);
        for (const LatticePoint& v : p.vertices()) {
            V3<mpq_class> r;
            V3<double> f{};
            for (std::size_t i = 0; i < 3; ++i) {
                r[i] = trisect::detail::to_gmp(pose.translation(i));
                for (int k = 0; k < 3; ++k)
                    r[i] += trisect::detail::to_gmp(pose.matrix(i, static_cast<std::size_t>(k))) *
                            unit * mpq_class(v[k].to_double());
                r[i] /= s;
                f[i] = r[i].get_d();
            }
            body.exact.push_back(r);
            body.about.push_back(f);
        }
    };
    place(data_->a, a, pose_a);
    place(data_->b, b, pose_b);
}
Scene::~Scene() = default;

Scene::Least Scene::least() const {
    const auto fa = data_->a.features();
    const auto fb = data_->b.features();
    struct Entry {
        double squared;
        PolytopeFeature a;
        PolytopeFeature b;
    };
    std::vector<Entry> entries;
    double best = HUGE_VAL;
    std::vector<Corners<double>> corners_b;
    for (const auto& g : fb) corners_b.push_back(data_->b.corners<double>(g));
    for (const auto& f : fa) {
        const Corners<double> x = data_->a.corners<double>(f);
        for (std::size_t j = 0; j < fb.size(); ++j) {
            // Two faces, or a face and an edge, are as close as smaller features of theirs.
            if (x.size() + corners_b[j].size() > 4 && x.size() != 1 && corners_b[j].size() != 1)
                continue;
            std::optional<Closest<double>> c;
            closest_of(x, corners_b[j], c);
            entries.push_back({c->squared, f, fb[j]});
            best = std::min(best, c->squared);
        }
    }
    std::optional<mpq_class> least;
    Least r;
    for (const Entry& e : entries) {
        if (e.squared > best * (1 + 1e-7) + 1e-9) continue;
        std::optional<Closest<mpq_class>> c;
        closest_of(data_->a.corners<mpq_class>(e.a), data_->b.corners<mpq_class>(e.b), c);
        const FeaturePair pair{e.a, e.b};
        if (!least || c->squared < *least || (c->squared == *least && pair < r.pair)) {
            least = c->squared;
            r.pair = pair;
        }
    }
    r.squared = trisect::detail::from_gmp(*least);
    return r;
}

bool Scene::proves_least(const FeaturePair& pair, const ExactRational& squared,
                         bool* parallel) const {
    std::optional<Closest<mpq_class>> c;
    closest_of(data_->a.corners<mpq_class>(pair.a), data_->b.corners<mpq_class>(pair.b), c);
    if (c->squared != trisect::detail::to_gmp(squared) || c->squared <= 0) return false;
    const auto w = sub(c->q, c->p);
    const mpq_class at_p = dot(w, c->p);
    const mpq_class at_q = dot(w, c->q);
    int on_a = 0;
    int on_b = 0;
    for (const auto& v : data_->a.exact) {
        const int s = cmp(dot(w, v), at_p);
        if (s > 0) return false;
        if (s == 0) ++on_a;
    }
    for (const auto& v : data_->b.exact) {
        const int s = cmp(dot(w, v), at_q);
        if (s < 0) return false;
        if (s == 0) ++on_b;
    }
    if (parallel != nullptr) *parallel = on_a > 1 && on_b > 1;
    return true;
}

namespace {

bool passes_through(const Corners<mpq_class>& e, const Corners<mpq_class>& f) {
    const auto n = normal_of(f);
    const mpq_class d0 = dot(n, sub(e[0], f[0]));
    const mpq_class d1 = dot(n, sub(e[1], f[0]));
    if (d0 * d1 > 0 || d0 == d1) return false;
    return inside_foot(add(e[0], mpq_class(d0 / (d0 - d1)), sub(e[1], e[0])), f).has_value();
}

}  // namespace

bool Scene::proves_meeting(const FeaturePair& pair) const {
    const auto x = data_->a.corners<mpq_class>(pair.a);
    const auto y = data_->b.corners<mpq_class>(pair.b);
    if (x.size() == 2 && y.size() > 2 && passes_through(x, y)) return true;
    if (y.size() == 2 && x.size() > 2 && passes_through(y, x)) return true;
    std::optional<Closest<mpq_class>> c;
    closest_of(x, y, c);
    if (c->squared == 0) return true;
    // A vertex inside: on the same side of all faces as the centre of the body.
    const auto is_inside = [](const V3<mpq_class>& p, const Data::Body& body) {
        V3<mpq_class> centre{0, 0, 0};
        const mpq_class weight(1, static_cast<unsigned long>(body.exact.size()));
        for (const auto& v : body.exact) centre = add(centre, weight, v);
        for (std::size_t f = 0; f < body.polytope->face_count(); ++f) {
            const auto corners = body.corners<mpq_class>(PolytopeFeature::face(f));
            const auto n = normal_of(corners);
            if (dot(n, sub(p, corners[0])) * dot(n, sub(centre, corners[0])) < 0) return false;
        }
        return body.polytope->dimension() == 3;
    };
    return (pair.a.kind == Kind::Vertex && is_inside(x[0], data_->b)) ||
           (pair.b.kind == Kind::Vertex && is_inside(y[0], data_->a));
}

ConvexPolytope random_polytope(Engine& engine, int reach) {
    const auto between = [&](int lo, int hi) {
        return std::uniform_int_distribution<int>(lo, hi)(engine);
    };
    std::vector<LatticePoint> points;
    const auto any = [&] {
        return LatticePoint{between(-reach, reach), between(-reach, reach), between(-reach, reach)};
    };
    switch (between(0, 9)) {
        case 0: {  // a box
            const LatticePoint lo = any();
            const int x = between(1, reach);
            const int y = between(1, reach);
            const int z = between(1, reach);
            for (unsigned i = 0; i < 8; ++i)
                points.push_back(lo + LatticePoint{(i & 1U) != 0 ? x : 0, (i & 2U) != 0 ? y : 0,
                                                   (i & 4U) != 0 ? z : 0});
            break;
        }
        case 1: {  // a prism along an axis
            const int axis = between(0, 2);
            const int height = between(1, reach);
            for (int i = between(3, 8); i > 0; --i) {
                LatticePoint p = any();
                (axis == 0 ? p.x : axis == 1 ? p.y : p.z) = 0;
                LatticePoint q = p;
                (axis == 0 ? q.x : axis == 1 ? q.y : q.z) = height;
                points.push_back(p);
                points.push_back(q);
            }
            break;
        }
        case 2: {  // anything flat, or less
            const int axis = between(0, 2);
            for (int i = between(1, 6); i > 0; --i) {
                LatticePoint p = any();
                (axis == 0 ? p.x : axis == 1 ? p.y : p.z) = between(0, 5) == 0 ? 1 : 0;
                points.push_back(p);
            }
            break;
        }
        default:
            for (int i = between(4, 24); i > 0; --i) points.push_back(any());
    }
    return trisect::hierarchies::convex_hull(points, {});
}

Pose random_pose(Engine& engine, int reach) {
    const auto between = [&](int lo, int hi) {
        return std::uniform_int_distribution<int>(lo, hi)(engine);
    };
    const auto step = [&] { return 0.5 * static_cast<double>(between(-2 * reach, 2 * reach)); };
    const std::array<double, 3> t{step(), step(), step()};
    switch (between(0, 9)) {
        case 0:
        case 1:
        case 2:
            return Pose::from_translation(t);
        case 3:
        case 4:
        case 5:
            return Pose::from_quaternion({1, between(-1, 1), between(-1, 1), between(-1, 1)}, t);
        case 6:
            return Pose::from_doubles({1, 0, 0, t[0], 0, -1, 0, t[1], 0, 0, 1, t[2]});
        case 7:
            return Pose::from_doubles({1, 0.5, 0, t[0], 0, 1, 0.25, t[1], 0, 0, 2, t[2]});
        default:
            return Pose::from_quaternion(
                {between(1, 9), between(-9, 9), between(-9, 9), between(-9, 9)}, t);
    }
}

}  // namespace convex_oracle

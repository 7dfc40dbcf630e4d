// SPDX-License-Identifier: Apache-2.0
//
// A state is a pair of features, of A and of B, whose closest points p and q lie in the relative
// interiors of both. p - q is known up to a factor from the vertices of the features alone, so that
// coordinates never grow along a walk. The question of each step is the one of Lin and Canny: is q
// in the Voronoi region of p's feature, and p in that of q's? With w = q - p it is
//   p a vertex         w·(c - p) <= 0 for the other end c of each edge at p;
//   p inside an edge   w·(c - p) <= 0 for a corner c off the edge of each of its two faces (w is
//                      orthogonal to the edge, so any of them stands for the face);
//   p inside a face    q is on the outer side of the face's plane.
// Where that fails, the larger feature that c stands for, an edge or a face, has points nearer to
// q, and the closest points of that feature and q's feature are the next state, reduced to the
// features in whose relative interiors they lie. In the third case q is behind the face: it is
// inside of A, or outside of some faces. The way from p to q then leaves A through one of these, at
// a point that is nearer to q than p; so the nearest of these faces is nearer than p.
//
// Why it cannot cycle. Each step makes the distance of the pair's closures strictly smaller, by an
// exact comparison of fractions, and there are finitely many pairs. No tie is ever stepped across:
// moving along parallel faces and edges would not be a decrease, so the walk just ends there.
//
// Why it ends at the distance of the polytopes. The edges at a vertex generate the cone of
// directions into a polytope, a face's plane the one at an edge, and so on; so when no condition
// fails, w·(x - p) <= 0 for all x of A and w·(y - q) >= 0 for all y of B. Hence
// (y - x)·w >= w·w for all x and y: nothing is nearer. If the polytopes have a common point the
// distance is 0 and the walk ends at 0 by the same argument: with an edge through a face, features
// that touch, or a vertex inside. So penetration needs no internal Voronoi regions and no case of
// its own; every answer is certified by its last state.
//
// The states with an edge against a face, and two faces, are never needed: the distance of these is
// attained at a vertex or at two edges as well, unless they cross. Ties are broken afterwards, in
// smallest_pair(), by names.
//
// Which of several failing conditions is followed is free; we take the steepest edge in doubles. A
// next state is chosen by its distance in doubles too, but it must be less than the present one
// exactly; where rounding misleads, all candidates are compared exactly.

#include <trisect/bsp/hierarchies/convex/feature_walk.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <trisect/brep/number/gmp_conversion.h>
#include <trisect/bsp/hierarchies/convex/exact_frame.h>
#include <trisect/kernel/contract.h>
#include <trisect/kernel/number/error_bounds.h>

namespace trisect::hierarchies {

using detail::Ball;
using detail::cross;
using detail::dot;
using detail::minus;
using detail::scaled;
using detail::VectorOf;
using Kind = PolytopeFeature::Kind;

struct FeatureWalk::Doubles {
    using Number = Ball;
    const FeatureWalk* walk;
    static Number one() { return {1, 0}; }
    VectorOf<Number> operator()(const Place& p) const {
        return walk->frame_->approximate(p.body, walk->polytope(p.body).vertices()[p.vertex]);
    }
};

struct FeatureWalk::Integers {
    using Number = mpz_class;
    const FeatureWalk* walk;
    static Number one() { return 1; }
    VectorOf<Number> operator()(const Place& p) const {
        return walk->exact_frame().place(p.body, walk->polytope(p.body).vertices()[p.vertex]);
    }
};

namespace {

template <class N>
VectorOf<N> negated(const VectorOf<N>& v) {
    return {N(-v[0]), N(-v[1]), N(-v[2])};
}
template <class N>
VectorOf<N> turned(const VectorOf<N>& v, int sense) {
    return sense < 0 ? negated(v) : v;
}

// A number as numerator and denominator.
template <class N>
struct Fraction {
    N numerator;
    N denominator;
};

double about(const Fraction<Ball>& f) { return f.numerator.value / f.denominator.value; }

}  // namespace

FeatureWalk::FeatureWalk(const ConvexPolytope& a, const ConvexPolytope& b, const CommonFrame& frame,
                         WalkCounts* counts)
    : a_(&a), b_(&b), frame_(&frame), counts_(counts) {
    TRISECT_EXPECTS(!a.is_empty() && !b.is_empty(), "an empty polytope has no features");
}

std::array<FeatureWalk::Place, 2> FeatureWalk::ends(const Part& edge) const {
    const auto& e = polytope(edge.body).edges()[edge.feature.index];
    return {Place{edge.body, e.vertex[0]}, Place{edge.body, e.vertex[1]}};
}

// The sign of a formula over any numbers: in doubles if they can decide.
template <class F>
int FeatureWalk::sign(const F& f) const {
    if (counts_ != nullptr) ++counts_->signs;
    if (const int s = f(Doubles{this}).sign(); s != 0) return s;
    if (counts_ != nullptr) ++counts_->exact_signs;
    return sgn(f(Integers{this}));
}

// The same where the doubles are there already.
template <class F>
int FeatureWalk::decide(const Ball& d, const F& f) const {
    if (counts_ != nullptr) ++counts_->signs;
    if (const int s = d.sign(); s != 0) return s;
    if (counts_ != nullptr) ++counts_->exact_signs;
    return sgn(f(Integers{this}));
}

// Of the face in the frame: outward if the frame does not mirror the body.
template <class At>
auto FeatureWalk::normal_of(const Part& face, const At& at) const {
    const auto& s = polytope(face.body).span_of(face.feature.index);
    const auto o = at(Place{face.body, s[0]});
    return cross(minus(at(Place{face.body, s[1]}), o), minus(at(Place{face.body, s[2]}), o));
}

// A positive multiple of q - p.
template <class At>
auto FeatureWalk::way(const State& s, const At& at) const {
    const Part x{Body::A, s.a};
    const Part y{Body::B, s.b};
    // From a vertex to the foot of its perpendicular on an edge.
    const auto to_foot = [&](const Place& p, const Part& edge) {
        const auto [e0, e1] = ends(edge);
        const auto r = minus(at(e0), at(p));
        const auto d = minus(at(e1), at(e0));
        return minus(scaled(r, dot(d, d)), scaled(d, dot(r, d)));
    };
    if (s.a.kind == Kind::Face) return turned(normal_of(x, at), s.sense);
    if (s.b.kind == Kind::Face) return turned(normal_of(y, at), -s.sense);
    if (s.a.kind == Kind::Vertex) {
        const Place p{Body::A, s.a.index};
        if (s.b.kind == Kind::Vertex) return minus(at(Place{Body::B, s.b.index}), at(p));
        return to_foot(p, y);
    }
    if (s.b.kind == Kind::Vertex) return negated(to_foot(Place{Body::B, s.b.index}, x));
    const auto [e0, e1] = ends(x);
    const auto [f0, f1] = ends(y);
    return turned(cross(minus(at(e1), at(e0)), minus(at(f1), at(f0))), s.sense);
}

// The squared distance as a fraction.
template <class At>
auto FeatureWalk::squared(const State& s, const At& at) const {
    using N = typename At::Number;
    const Part x{Body::A, s.a};
    const Part y{Body::B, s.b};
    const auto across = [&](const VectorOf<N>& n, const VectorOf<N>& r) {
        const N h = dot(n, r);
        return Fraction<N>{N(h * h), dot(n, n)};
    };
    const auto from_line = [&](const Place& p, const Part& edge) {
        const auto [e0, e1] = ends(edge);
        const auto d = minus(at(e1), at(e0));
        const auto c = cross(minus(at(p), at(e0)), d);
        return Fraction<N>{dot(c, c), dot(d, d)};
    };
    const auto from_plane = [&](const Place& p, const Part& face) {
        const auto& c = polytope(face.body).span_of(face.feature.index);
        return across(normal_of(face, at), minus(at(p), at(Place{face.body, c[0]})));
    };
    const Place p{Body::A, s.a.index};
    const Place q{Body::B, s.b.index};
    if (s.a.kind == Kind::Face) return from_plane(q, x);
    if (s.b.kind == Kind::Face) return from_plane(p, y);
    if (s.a.kind == Kind::Vertex && s.b.kind == Kind::Vertex) {
        const auto r = minus(at(q), at(p));
        return Fraction<N>{dot(r, r), At::one()};
    }
    if (s.a.kind == Kind::Vertex) return from_line(p, y);
    if (s.b.kind == Kind::Vertex) return from_line(q, x);
    const auto [e0, e1] = ends(x);
    const auto [f0, f1] = ends(y);
    return across(cross(minus(at(e1), at(e0)), minus(at(f1), at(f0))), minus(at(f0), at(e0)));
}

void FeatureWalk::push(Part x, Part y, int sense, bool crossing) {
    if (x.body == Body::B) std::swap(x, y);
    found_.push_back({x.feature, y.feature, sense, crossing});
}

// Puts the states at which two closed features are closest into found_, among others perhaps that
// are not nearer.
void FeatureWalk::closest_points(const Part& x, const Part& y) {
    const auto place = [](const Part& p) { return Place{p.body, p.feature.index}; };
    if (x.feature.kind > y.feature.kind) return closest_points(y, x);
    switch (y.feature.kind) {
        case Kind::Vertex:
            return of_vertices(place(x), place(y));
        case Kind::Edge:
            return x.feature.kind == Kind::Vertex ? of_vertex_and_edge(place(x), y)
                                                  : of_edges(x, y);
        case Kind::Face:
            break;
    }
    if (x.feature.kind == Kind::Vertex) return of_vertex_and_face(place(x), y);
    if (x.feature.kind == Kind::Edge) return of_edge_and_face(x, y);
    for (const std::uint32_t e : polytope(x.body).sides(x.feature.index))
        of_edge_and_face({x.body, PolytopeFeature::edge(e)}, y);
    for (const std::uint32_t e : polytope(y.body).sides(y.feature.index))
        of_edge_and_face({y.body, PolytopeFeature::edge(e)}, x);
}

void FeatureWalk::of_vertices(const Place& p, const Place& q) {
    push({p.body, PolytopeFeature::vertex(p.vertex)}, {q.body, PolytopeFeature::vertex(q.vertex)});
}

void FeatureWalk::of_vertex_and_edge(const Place& p, const Part& edge) {
    const auto [e0, e1] = ends(edge);
    // Whether the perpendicular falls beyond an end.
    const auto beyond = [&](const Place& end, const Place& other) {
        return sign([&](const auto& at) {
                   const auto o = at(end);
                   return dot(minus(at(p), o), minus(at(other), o));
               }) <= 0;
    };
    if (beyond(e0, e1)) return of_vertices(p, e0);
    if (beyond(e1, e0)) return of_vertices(p, e1);
    push({p.body, PolytopeFeature::vertex(p.vertex)}, edge);
}

// Where two lines are closest.
template <class N>
struct FeatureWalk::LinePair {
    // With u, v along the edges, r = q - p and n = u × v, it is p + u (s / nn), q + v (t / nn).
    N s;
    N t;
    N nn;
    N height;  // n·r
};

template <class At>
auto FeatureWalk::lines(const Part& e, const Part& f, const At& at) const {
    using N = typename At::Number;
    const auto [p, p1] = ends(e);
    const auto [q, q1] = ends(f);
    const VectorOf<N> o = at(p);
    const VectorOf<N> o2 = at(q);
    const VectorOf<N> u = minus(at(p1), o);
    const VectorOf<N> v = minus(at(q1), o2);
    const VectorOf<N> r = minus(o2, o);
    const VectorOf<N> n = cross(u, v);
    return LinePair<N>{dot(cross(r, v), n), dot(cross(r, u), n), dot(n, n), dot(n, r)};
}

void FeatureWalk::of_edges(const Part& e, const Part& f) {
    const auto d = lines(e, f, Doubles{this});
    const auto positive = [&](const Ball& about, const auto& exact) {
        return decide(about, [&](const Integers& at) { return exact(lines(e, f, at)); }) > 0;
    };
    // Parallel edges have n = 0 and are within nothing.
    if (positive(d.s, [](const auto& x) { return x.s; }) &&
        positive(d.nn - d.s, [](const auto& x) { return mpz_class(x.nn - x.s); }) &&
        positive(d.t, [](const auto& x) { return x.t; }) &&
        positive(d.nn - d.t, [](const auto& x) { return mpz_class(x.nn - x.t); })) {
        // From A's point to B's along A's edge × B's: n and r both turn over when the edges are
        // exchanged.
        return push(e, f,
                    decide(d.height, [&](const Integers& at) { return lines(e, f, at).height; }));
    }
    // The distance of the lines' points is convex over the square of both edges; with its least
    // value not inside it is least on the square's sides.
    const auto [p, p1] = ends(e);
    const auto [q, q1] = ends(f);
    of_vertex_and_edge(p, f);
    of_vertex_and_edge(p1, f);
    of_vertex_and_edge(q, e);
    of_vertex_and_edge(q1, e);
}

void FeatureWalk::of_vertex_and_face(const Place& p, const Part& given) {
    const ConvexPolytope& body = polytope(given.body);
    Part face = given;
    const auto loop = body.corners(face.feature.index);
    const auto sides = body.sides(face.feature.index);
    const Doubles at{this};
    const VectorOf<Ball> n = normal_of(face, at);
    const VectorOf<Ball> x = at(p);
    bool inside = true;
    VectorOf<Ball> from = at(Place{face.body, loop[0]});
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const Place c{face.body, loop[i]};
        const Place d{face.body, loop[(i + 1) % loop.size()]};
        const VectorOf<Ball> to = at(d);
        const int s =
            decide(dot(n, cross(minus(to, from), minus(x, from))), [&](const Integers& exact) {
                return dot(normal_of(face, exact),
                           cross(minus(exact(d), exact(c)), minus(exact(p), exact(c))));
            });
        from = to;
        if (s > 0) continue;
        inside = false;
        of_vertex_and_edge(p, {face.body, PolytopeFeature::edge(sides[i])});
    }
    if (!inside) return;
    int s = side_of_face(p, face);
    // A polygon has a face on either side.
    if (body.dimension() == 2 && s == -outward(face.body)) {
        face.feature.index = 1 - face.feature.index;
        s = -s;
    }
    push({p.body, PolytopeFeature::vertex(p.vertex)}, face, s);
}

// 1 on the side to which the normal that the formulas make points.
int FeatureWalk::side_of_face(const Place& p, const Part& face) const {
    const Place c{face.body, polytope(face.body).span_of(face.feature.index)[0]};
    return sign([&](const auto& at) { return dot(normal_of(face, at), minus(at(p), at(c))); });
}

// Whether an edge with ends on both sides of a face's plane passes through the face.
bool FeatureWalk::passes_through(const std::array<Place, 2>& e, const Part& face) const {
    const auto loop = polytope(face.body).corners(face.feature.index);
    int left = 0;
    int right = 0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const Place from{face.body, loop[i]};
        const Place to{face.body, loop[(i + 1) % loop.size()]};
        const int s = sign([&](const auto& at) {
            const auto o = at(e[0]);
            return dot(minus(at(e[1]), o), cross(minus(at(from), o), minus(at(to), o)));
        });
        if (s > 0) ++left;
        if (s < 0) ++right;
        if (left != 0 && right != 0) return false;
    }
    return true;
}

void FeatureWalk::of_edge_and_face(const Part& edge, const Part& face) {
    const auto e = ends(edge);
    if (side_of_face(e[0], face) * side_of_face(e[1], face) < 0 && passes_through(e, face))
        return push(edge, face, 0, true);
    for (const Place& p : e) of_vertex_and_face(p, face);
    for (const std::uint32_t s : polytope(face.body).sides(face.feature.index))
        of_edges(edge, {face.body, PolytopeFeature::edge(s)});
}

bool FeatureWalk::meets(const State& s) const {
    if (s.crossing) return true;
    const bool by_sense = s.a.kind == Kind::Face || s.b.kind == Kind::Face ||
                          (s.a.kind == Kind::Edge && s.b.kind == Kind::Edge);
    if (by_sense) return s.sense == 0;
    return sign([&](const auto& at) { return squared(s, at).numerator; }) == 0;
}

bool FeatureWalk::is_less(const State& s, const State& t) const {
    if (s.crossing) return !meets(t);
    return sign([&](const auto& at) {
               const auto f = squared(s, at);
               const auto g = squared(t, at);
               using N = std::decay_t<decltype(f.numerator)>;
               return N(N(f.numerator * g.denominator) - N(g.numerator * f.denominator));
           }) < 0;
}

// The one with the least distance in doubles.
FeatureWalk::State FeatureWalk::nearest_found() const {
    const State* best = &found_.front();
    double least = std::numeric_limits<double>::infinity();
    for (const State& s : found_) {
        if (s.crossing) return s;
        const double d = about(squared(s, Doubles{this}));
        if (d < least) {
            least = d;
            best = &s;
        }
    }
    return *best;
}

FeatureWalk::State FeatureWalk::nearest_below(const State& limit) const {
    State s = nearest_found();
    if (is_less(s, limit)) return s;
    for (const State& t : found_)
        if (is_less(t, s)) s = t;
    TRISECT_EXPECTS(is_less(s, limit), "a step between features does not come nearer");
    return s;
}

// The sign of w·(to - from), w the way from the body's point to the other's.
int FeatureWalk::towards(Body body, const Place& from, const Place& to) const {
    const int s =
        sign([&](const auto& at) { return dot(way(state_, at), minus(at(to), at(from))); });
    return body == Body::A ? s : -s;
}

FeatureWalk::Rise FeatureWalk::rise(Body body) {
    const Part x{body, body == Body::A ? state_.a : state_.b};
    switch (x.feature.kind) {
        case Kind::Vertex:
            return rise_from_vertex(x);
        case Kind::Edge:
            return rise_from_edge(x);
        case Kind::Face:
            break;
    }
    return rise_from_face(x);
}

FeatureWalk::Rise FeatureWalk::rise_from_vertex(const Part& x) {
    const Doubles at{this};
    const Place p{x.body, x.feature.index};
    const Part y{x.body == Body::A ? Body::B : Body::A, x.body == Body::A ? state_.b : state_.a};
    const VectorOf<Ball> w = turned(way(state_, at), x.body == Body::A ? 1 : -1);
    const VectorOf<Ball> o = at(p);
    const auto spokes = polytope(x.body).spokes(p.vertex);
    std::uint32_t best = ConvexPolytope::none;
    double steepest = 0;
    bool unsure = false;
    for (const auto& spoke : spokes) {
        const VectorOf<Ball> d = minus(at(Place{x.body, spoke.vertex}), o);
        const Ball rise = dot(w, d);
        const int s = rise.sign();
        if (counts_ != nullptr && s != 0) ++counts_->signs;
        unsure = unsure || s == 0;
        if (s <= 0) continue;
        const double slope = rise.value * rise.value / dot(d, d).value;
        if (best == ConvexPolytope::none || slope > steepest) {
            best = spoke.edge;
            steepest = slope;
        }
    }
    if (best == ConvexPolytope::none && unsure)
        for (const auto& spoke : spokes)
            if (towards(x.body, p, {x.body, spoke.vertex}) > 0) {
                best = spoke.edge;
                break;
            }
    if (best == ConvexPolytope::none) return Rise::None;
    found_.clear();
    closest_points({x.body, PolytopeFeature::edge(best)}, y);
    return Rise::Found;
}

FeatureWalk::Rise FeatureWalk::rise_from_edge(const Part& x) {
    const auto& edge = polytope(x.body).edges()[x.feature.index];
    const Part y{x.body == Body::A ? Body::B : Body::A, x.body == Body::A ? state_.b : state_.a};
    for (std::size_t i = 0; i < 2; ++i) {
        if (edge.face[i] == ConvexPolytope::none) continue;
        if (towards(x.body, {x.body, edge.vertex[0]}, {x.body, edge.across[i]}) <= 0) continue;
        found_.clear();
        closest_points({x.body, PolytopeFeature::face(edge.face[i])}, y);
        return Rise::Found;
    }
    return Rise::None;
}

FeatureWalk::Rise FeatureWalk::rise_from_face(const Part& x) {
    const int out = outward(x.body);
    if (state_.sense == out) return Rise::None;
    // Behind the face: beyond another one, or inside.
    const Place q{x.body == Body::A ? Body::B : Body::A,
                  (x.body == Body::A ? state_.b : state_.a).index};
    const ConvexPolytope& body = polytope(x.body);
    found_.clear();
    bool inside = true;
    for (std::uint32_t f = 0; f < body.face_count(); ++f) {
        const Part face{x.body, PolytopeFeature::face(f)};
        if (side_of_face(q, face) != out) continue;
        inside = false;
        of_vertex_and_face(q, face);
    }
    return inside ? Rise::Inside : Rise::Found;
}

const WalkEnd& FeatureWalk::run(const FeaturePair& start) {
    if (counts_ != nullptr) ++counts_->walks;
    found_.clear();
    closest_points({Body::A, start.a}, {Body::B, start.b});
    state_ = nearest_found();
    closest_ = {};
    for (;;) {
        closest_.pair = {state_.a, state_.b};
        closest_.meet = meets(state_);
        if (closest_.meet) break;
        Rise r = rise(Body::A);
        if (r == Rise::None) r = rise(Body::B);
        if (r == Rise::None) break;
        if (r == Rise::Inside) {
            closest_.meet = closest_.inside = true;
            break;
        }
        state_ = nearest_below(state_);
        ++closest_.steps;
    }
    if (counts_ != nullptr) counts_->steps += closest_.steps;
    return closest_;
}

FeatureWalk::Bounds FeatureWalk::bounds() const {
    if (closest_.meet) return {};
    const auto f = squared(state_, Doubles{this});
    const double low =
        (f.numerator.value - f.numerator.error) / (f.denominator.value + f.denominator.error);
    const double high =
        (f.numerator.value + f.numerator.error) / (f.denominator.value - f.denominator.error);
    Bounds r{0, std::numeric_limits<double>::infinity()};
    // Differences, quotients and roots are rounded: below 2^-50 of them together.
    if (low > 0) r.lower = std::sqrt(low) * detail::slightly_less * frame_->unit();
    if (high >= 0 && f.denominator.value > f.denominator.error)
        r.upper = std::sqrt(high) * detail::slightly_more * frame_->unit();
    return r;
}

ExactRational FeatureWalk::squared_distance() const {
    if (closest_.meet) return {};
    const auto f = squared(state_, Integers{this});
    mpq_class v(f.numerator, f.denominator);
    v.canonicalize();
    const mpq_class& scale = exact_frame().scale;
    return trisect::detail::from_gmp(v / (scale * scale));
}

// The features of the face of the polytope that is farthest towards the other one: all that may be
// closest. In ascending order.
std::vector<PolytopeFeature> FeatureWalk::support(Body body) const {
    const ConvexPolytope& x = polytope(body);
    const PolytopeFeature at = body == Body::A ? state_.a : state_.b;
    std::vector<std::uint32_t> vertices;
    if (at.kind == Kind::Vertex) vertices = {at.index};
    if (at.kind == Kind::Edge) vertices = {x.edges()[at.index].vertex[0]};
    if (at.kind == Kind::Face) vertices = {x.corners(at.index)[0]};
    const auto has = [&](std::uint32_t v) {
        return std::find(vertices.begin(), vertices.end(), v) != vertices.end();
    };
    for (std::size_t i = 0; i < vertices.size(); ++i)
        for (const auto& spoke : x.spokes(vertices[i]))
            if (!has(spoke.vertex) && towards(body, {body, vertices[i]}, {body, spoke.vertex}) == 0)
                vertices.push_back(spoke.vertex);
    std::vector<PolytopeFeature> r;
    for (const std::uint32_t v : vertices) {
        r.push_back(PolytopeFeature::vertex(v));
        for (const auto& spoke : x.spokes(v)) {
            if (spoke.vertex < v || !has(spoke.vertex)) continue;
            r.push_back(PolytopeFeature::edge(spoke.edge));
            for (const std::uint32_t f : x.edges()[spoke.edge].face) {
                if (f == ConvexPolytope::none) continue;
                const auto loop = x.corners(f);
                if (std::all_of(loop.begin(), loop.end(), has))
                    r.push_back(PolytopeFeature::face(f));
            }
        }
    }
    std::sort(r.begin(), r.end());
    r.erase(std::unique(r.begin(), r.end()), r.end());
    return r;
}

FeaturePair FeatureWalk::smallest_pair() {
    if (closest_.meet) return closest_.pair;
    const auto of_a = support(Body::A);
    const auto of_b = support(Body::B);
    for (const PolytopeFeature& f : of_a)
        for (const PolytopeFeature& g : of_b) {
            if (of_a.size() == 1 && of_b.size() == 1) return {f, g};
            found_.clear();
            closest_points({Body::A, f}, {Body::B, g});
            for (const State& s : found_)
                if (!is_less(state_, s)) return {f, g};
        }
    return closest_.pair;
}

}  // namespace trisect::hierarchies

// SPDX-License-Identifier: Apache-2.0
//
// Up to the contact no plane has a margin. Planes through features of the triangles, a face, an
// edge, a corner, or one along two edges, have heights that are polynomials with a root at the time
// of contact and no root before.

#include <trisect/bsp/interference/certificate/find/contact_planes.h>

#include <algorithm>
#include <cmath>

#include <trisect/bsp/interference/boxes/triangle_distance.h>

namespace trisect::detail {

namespace {

using proof::Approximate;

GmpVector exact_fractions(const Approximate& v) {
    return {mpq_class(v[0]), mpq_class(v[1]), mpq_class(v[2])};
}

std::array<GmpVector, 3> corners_of(const ProofBody& body, std::size_t t) {
    std::array<GmpVector, 3> r;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k)
            r[i][k] = to_gmp(body.points[body.triangles[t].vertex[i].index][k]);
    return r;
}

}  // namespace

// Positive from a time on, with the contact for the first root and nothing else.
bool ContactPlanes::is_positive(const IntegerPolynomial& p, double from) {
    if (p.is_zero() || p.sign_at(mpq_class(from)) <= 0) return false;
    auto roots = isolate_roots(p, mpq_class(from), mpq_class(contact_.upper));
    if (roots.empty()) return true;
    return roots.size() == 1 && roots[0].compare(contact_.time) == 0;
}

std::optional<MovingSeparator> ContactPlanes::plane(std::size_t i, std::size_t j, double from) {
    const Corners p = corners_of(a_, i);
    const Corners q = corners_of(b_, j);
    for (const auto kind : {MovingSeparator::Kind::OfA, MovingSeparator::Kind::OfB})
        if (auto s = plane_of_one(kind, p, q, from)) return s;
    return plane_along_edges(i, j, p, q, from);
}

// The plane is carried along with one of the triangles, `resting`, and supports it.
std::optional<MovingSeparator> ContactPlanes::plane_of_one(MovingSeparator::Kind kind,
                                                           const Corners& p, const Corners& q,
                                                           double from) {
    const bool is_of_a = kind == MovingSeparator::Kind::OfA;
    const auto& resting = is_of_a ? p : q;
    const auto& moving = is_of_a ? q : p;
    const MotionPiece& map = is_of_a ? to_a_ : to_b_;
    std::vector<MovingPoint> paths;
    for (const GmpVector& x : moving) paths.emplace_back(map, x);
    // Away from the resting triangle, towards the other one.
    for (const GmpVector& n : candidates(resting, paths, from)) {
        mpq_class highest = dot(n, resting[0]);
        for (const GmpVector& x : resting) highest = std::max(highest, dot(n, x));
        if (!std::ranges::all_of(paths, [&](const MovingPoint& x) {
                return is_positive(height(n, -highest, x), from);
            }))
            continue;
        MovingSeparator s;
        s.kind = kind;
        const GmpVector m = is_of_a ? n : opposite(n);
        s.plane = {rational(m), from_gmp(is_of_a ? mpq_class(-highest) : highest)};
        return s;
    }
    return std::nullopt;
}

// Normals: of the triangle, the way to the other one, and that way turned square to each edge.
std::vector<GmpVector> ContactPlanes::candidates(const Corners& resting,
                                                 const std::vector<MovingPoint>& paths,
                                                 double from) {
    const GmpVector n = cross(minus(resting[1], resting[0]), minus(resting[2], resting[0]));
    std::vector<GmpVector> r{n, opposite(n)};
    TriangleCorners p;
    TriangleCorners q;
    const mpq_class at(from);
    for (std::size_t i = 0; i < 3; ++i) {
        const mpq_class w = paths[i].w.value_at(at);
        for (std::size_t k = 0; k < 3; ++k) {
            p[i][k] = resting[i][k].get_d();
            q[i][k] = mpq_class(paths[i].x[k].value_at(at) / w).get_d();
        }
    }
    std::vector<Approximate> ways;
    add_proof_directions(p, q, ways);
    // The other one's normals and the way between the middles, too.
    ways.push_back({});
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k) ways.back()[k] += q[i][k] - p[i][k];
    const std::size_t count = ways.size();
    for (std::size_t i = 1; i < count; ++i) {  // between two of them
        const double a = length(ways[0]);
        const double b = length(ways[i]);
        if (!(a > 0) || !(b > 0)) continue;
        Approximate sum{};
        for (std::size_t k = 0; k < 3; ++k) sum[k] = ways[0][k] / a + ways[i][k] / b;
        ways.push_back(sum);
    }
    for (const Approximate& way : ways) {
        const double size = length(way);
        if (!(size > 0) || !std::isfinite(size)) continue;
        // Short numbers.
        Approximate d{};
        for (std::size_t k = 0; k < 3; ++k) d[k] = std::round(way[k] / size * 0x1p20);
        const GmpVector e = exact_fractions(d);
        if (is_zero(e)) continue;
        r.push_back(e);
        for (std::size_t i = 0; i < 3; ++i) {
            const GmpVector u = minus(resting[(i + 1) % 3], resting[i]);
            const mpq_class uu = dot(u, u);
            const mpq_class eu = dot(e, u);
            GmpVector square;
            for (std::size_t k = 0; k < 3; ++k) square[k] = uu * e[k] - eu * u[k];
            if (!is_zero(square)) r.push_back(square);
        }
    }
    return r;
}

std::optional<MovingSeparator> ContactPlanes::plane_along_edges(std::size_t first,
                                                                std::size_t second,
                                                                const Corners& p, const Corners& q,
                                                                double from) {
    std::vector<MovingPoint> paths;
    for (const GmpVector& x : q) paths.emplace_back(to_a_, x);
    const CertifiedTriangle& ta = a_.triangles[first];
    const CertifiedTriangle& tb = b_.triangles[second];
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) {
            const std::size_t i1 = (i + 1) % 3;
            const std::size_t j1 = (j + 1) % 3;
            PolynomialVector n =
                cross(constant(minus(p[i1], p[i])), moving_direction(to_a_, minus(q[j1], q[j])));
            for (const bool flipped : {false, true}) {
                if (flipped) n = PolynomialVector{} - n;
                IntegerPolynomial below = -dot(n, constant(minus(p[(i + 2) % 3], p[i])));
                if (!below.is_zero() && !is_positive(below, from)) continue;
                if (!std::ranges::all_of(paths, [&](const MovingPoint& x) {
                        return is_positive(dot(n, way_from(p[i], x)), from);
                    }))
                    continue;
                MovingSeparator s;
                s.kind = MovingSeparator::Kind::Edges;
                s.edge_a = {ta.vertex[i], ta.vertex[i1]};
                s.edge_b = {tb.vertex[j], tb.vertex[j1]};
                s.flipped = flipped;
                return s;
            }
        }
    return std::nullopt;
}

std::optional<CommonPoint> ContactPlanes::common_point(std::size_t first, std::size_t second) {
    const auto p = corners_of(a_, first);
    const auto q = corners_of(b_, second);
    CommonPoint c;
    c.triangle_a = a_.triangles[first];
    c.triangle_b = b_.triangles[second];
    for (std::size_t i = 0; i < 3; ++i) {
        if (is_on({to_a_, q[i]}, p)) {
            c.kind = CommonPoint::Kind::VertexOfB;
            c.vertex_b = c.triangle_b.vertex[i];
            return c;
        }
        if (is_on({to_b_, p[i]}, q)) {
            c.kind = CommonPoint::Kind::VertexOfA;
            c.vertex_a = c.triangle_a.vertex[i];
            return c;
        }
    }
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) {
            if (!cross_each_other(p[i], p[(i + 1) % 3], q[j], q[(j + 1) % 3])) continue;
            c.kind = CommonPoint::Kind::Edges;
            c.edge_a = {c.triangle_a.vertex[i], c.triangle_a.vertex[(i + 1) % 3]};
            c.edge_b = {c.triangle_b.vertex[j], c.triangle_b.vertex[(j + 1) % 3]};
            return c;
        }
    return std::nullopt;
}

bool ContactPlanes::is_on(const MovingPoint& x, const Corners& t) {
    const GmpVector n = cross(minus(t[1], t[0]), minus(t[2], t[0]));
    if (sign_of(height(n, -dot(n, t[0]), x)) != 0) return false;
    for (std::size_t i = 0; i < 3; ++i) {
        const GmpVector inward = cross(n, minus(t[(i + 1) % 3], t[i]));
        if (sign_of(height(inward, -dot(inward, t[i]), x)) < 0) return false;
    }
    return true;
}

bool ContactPlanes::cross_each_other(const GmpVector& a0, const GmpVector& a1, const GmpVector& b0,
                                     const GmpVector& b1) {
    const PolynomialVector u = constant(minus(a1, a0));
    const PolynomialVector v = moving_direction(to_a_, minus(b1, b0));
    const PolynomialVector n = cross(u, v);
    const MovingPoint x0(to_a_, b0);
    const MovingPoint x1(to_a_, b1);
    const PolynomialVector way = way_from(a0, x0);
    if (sign_of(dot(n, way)) != 0 || sign_of(dot(n, n)) != 1) return false;
    const PolynomialVector across_u = cross(n, u);
    const PolynomialVector across_v = cross(n, v);
    return sign_of(dot(across_u, way)) * sign_of(dot(across_u, way_from(a0, x1))) <= 0 &&
           sign_of(dot(across_v, way)) * sign_of(dot(across_v, way_from(a1, x0))) <= 0;
}

}  // namespace trisect::detail

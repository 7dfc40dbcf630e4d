// SPDX-License-Identifier: Apache-2.0
//
// The solid lies below its faces. So from a point in the inside of a face the way against the
// normal is inside until it meets a triangle of the boundary, its edges included. Triangles
// parallel to the way need no look: where one begins, an edge of another one that is not parallel
// is met.
#include <trisect/brep/measure/interior_point.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include <trisect/brep/measure/exact_values.h>
#include <trisect/brep/triangulate.h>
#include <trisect/kernel/contract.h>
#include <trisect/kernel/number/gmp.h>

namespace trisect::detail {

namespace {

using ExactVector = std::array<mpq_class, 3>;

ExactVector vector_of(const Point& p) {
    const Corner c = corner_at(p);
    return {fraction(c.x[0], c.w), fraction(c.x[1], c.w), fraction(c.x[2], c.w)};
}

std::array<mpz_class, 3> normal_of(const Plane& p) {
    return {to_integer(p.normal(0)), to_integer(p.normal(1)), to_integer(p.normal(2))};
}

mpz_class largest(const std::array<mpz_class, 3>& v) {
    return std::max({mpz_class(abs(v[0])), mpz_class(abs(v[1])), mpz_class(abs(v[2]))});
}

int turn(const ExactVector& a, const ExactVector& b, const ExactVector& p, std::size_t u,
         std::size_t v) {
    return sgn(mpq_class((b[u] - a[u]) * (p[v] - a[v]) - (b[v] - a[v]) * (p[u] - a[u])));
}

}  // namespace

struct InteriorPoints::Data {
    struct Triangle {
        IndexTriangle corner{};
        FaceId face;
    };

    const Brep& brep;
    std::vector<ExactVector> point;
    std::vector<Triangle> triangles;

    /// How far to the first triangle, in lengths of `direction`.
    [[nodiscard]] mpq_class way(const ExactVector& from,
                                const std::array<mpz_class, 3>& direction) const;
    [[nodiscard]] bool contains(const Triangle& t, const ExactVector& p) const;
};

InteriorPoints::InteriorPoints(const Brep& brep) {
    auto data = std::make_unique<Data>(Data{brep, {}, {}});
    for (const VertexId v : brep.vertices()) data->point.push_back(vector_of(brep.point(v)));
    for (const FaceId f : brep.faces())
        for (const IndexTriangle& t : triangulate(brep, f)) data->triangles.push_back({t, f});
    data_ = std::move(data);
}

InteriorPoints::~InteriorPoints() = default;

bool InteriorPoints::Data::contains(const Triangle& t, const ExactVector& p) const {
    const auto axis = static_cast<std::size_t>(brep.plane(t.face).dominant_axis());
    const std::size_t u = (axis + 1) % 3;
    const std::size_t v = (axis + 2) % 3;
    const ExactVector& a = point[t.corner[0]];
    const ExactVector& b = point[t.corner[1]];
    const ExactVector& c = point[t.corner[2]];
    const int ab = turn(a, b, p, u, v);
    const int bc = turn(b, c, p, u, v);
    const int ca = turn(c, a, p, u, v);
    return (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
}

mpq_class InteriorPoints::Data::way(const ExactVector& from,
                                    const std::array<mpz_class, 3>& direction) const {
    mpq_class best = -1;
    FaceId face;
    mpq_class at;  // on the plane of `face`
    for (const Triangle& t : triangles) {
        if (t.face != face) {
            face = t.face;
            const auto n = normal_of(brep.plane(face));
            const mpz_class slope = n[0] * direction[0] + n[1] * direction[1] + n[2] * direction[2];
            at = -1;
            if (slope != 0) {
                at = -(n[0] * from[0] + n[1] * from[1] + n[2] * from[2] +
                       to_integer(brep.plane(face).offset())) /
                     slope;
            }
        }
        if (at <= 0 || (best > 0 && at >= best)) continue;
        ExactVector hit;
        for (std::size_t k = 0; k < 3; ++k) hit[k] = from[k] + at * direction[k];
        if (contains(t, hit)) best = at;
    }
    TRISECT_EXPECTS(best > 0, "a boundary that does not close");
    return best;
}

ExactPoint InteriorPoints::near(VertexId v, unsigned shrink) const {
    const FaceId face = data_->brep.face(data_->brep.outgoing(v));
    const auto found = std::find_if(
        data_->triangles.begin(), data_->triangles.end(), [&](const Data::Triangle& t) {
            return t.face == face &&
                   (t.corner[0] == v.index || t.corner[1] == v.index || t.corner[2] == v.index);
        });
    TRISECT_EXPECTS(found != data_->triangles.end(), "a vertex without a triangle");
    const ExactVector& corner = data_->point[v.index];
    const mpq_class part(1, mpz_class(1) << shrink);
    ExactVector from;
    mpq_class reach = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const mpq_class middle =
            (data_->point[found->corner[0]][k] + data_->point[found->corner[1]][k] +
             data_->point[found->corner[2]][k]) /
            3;
        const mpq_class step = (middle - corner[k]) * part;
        from[k] = corner[k] + step;
        reach = std::max(reach, mpq_class(abs(step)));
    }
    auto direction = normal_of(data_->brep.plane(face));
    for (mpz_class& d : direction) d = -d;
    mpq_class way = data_->way(from, direction) / 2;
    way = std::min(way, mpq_class(reach / largest(direction)));
    ExactPoint out;
    for (std::size_t k = 0; k < 3; ++k) {
        const mpq_class value = from[k] + way * direction[k];
        out[k] =
            to_rational(value.get_num(), value.get_den()).scaled(data_->brep.lattice().exponent);
    }
    return out;
}

}  // namespace trisect::detail

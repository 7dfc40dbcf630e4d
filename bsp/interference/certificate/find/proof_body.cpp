// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/interference/certificate/find/proof_body.h>

#include <algorithm>
#include <limits>
#include <utility>

#include <trisect/bsp/interference/certificate/find/proof_vector.h>
#include <trisect/bsp/interference/relation/exact_place.h>

namespace trisect::detail {

namespace {

std::vector<CertifiedTriangle> triangles_of(const InterferenceModelData& model) {
    std::vector<CertifiedTriangle> r;
    r.reserve(model.triangles.size());
    for (const auto& t : model.triangles) r.push_back({t.face, t.vertex});
    return r;
}

}  // namespace

ProofBody::ProofBody(const InterferenceModelData& model) : triangles(triangles_of(model)) {
    for (const Point& p : model.brep.points()) {
        ExactPoint x = exact_place(p).c;
        for (ExactRational& c : x) c = c.scaled(model.brep.lattice().exponent);
        add(std::move(x));
    }
    order(0, triangles.size());
}

ProofBody::ProofBody(const InterferenceModelData& model, const Pose& pose)
    : triangles(triangles_of(model)) {
    for (const Point& p : model.brep.points())
        add(in_world(exact_place(p), model.brep.lattice(), pose));
    order(0, triangles.size());
}

void ProofBody::add(ExactPoint point) {
    near.push_back({point[0].to_double(), point[1].to_double(), point[2].to_double()});
    points.push_back(std::move(point));
}

std::vector<std::uint32_t> ProofBody::corners(std::size_t from, std::size_t to) const {
    std::vector<std::uint32_t> r;
    for (std::size_t i = from; i < to; ++i)
        for (const VertexId v : triangles[i].vertex) r.push_back(v.index);
    std::ranges::sort(r);
    r.erase(std::unique(r.begin(), r.end()), r.end());
    return r;
}

std::array<double, 3> ProofBody::middle(std::span<const std::uint32_t> vertices) const {
    std::array<double, 3> sum{};
    for (const std::uint32_t v : vertices)
        for (std::size_t k = 0; k < 3; ++k) sum[k] += near[v][k];
    for (double& c : sum) c /= static_cast<double>(vertices.size());
    return sum;
}

double ProofBody::squared_size(std::span<const std::uint32_t> vertices) const {
    const std::array<double, 3> m = middle(vertices);
    double square = 0;
    for (const std::uint32_t v : vertices) {
        const std::array<double, 3> d = minus(near[v], m);
        square = std::max(square, dot(d, d));
    }
    return square;
}

double ProofBody::centre(const CertifiedTriangle& t, std::size_t axis) const {
    return near[t.vertex[0].index][axis] + near[t.vertex[1].index][axis] +
           near[t.vertex[2].index][axis];
}

void ProofBody::order(std::size_t from, std::size_t to) {
    if (to - from < 2) return;
    std::size_t axis = 0;
    double longest = -1;
    for (std::size_t k = 0; k < 3; ++k) {
        double lo = std::numeric_limits<double>::infinity();
        double hi = -lo;
        for (std::size_t i = from; i < to; ++i) {
            lo = std::min(lo, centre(triangles[i], k));
            hi = std::max(hi, centre(triangles[i], k));
        }
        if (hi - lo > longest) {
            longest = hi - lo;
            axis = k;
        }
    }
    const auto at = [this](std::size_t i) {
        return triangles.begin() + static_cast<std::ptrdiff_t>(i);
    };
    const std::size_t middle = (from + to) / 2;
    std::nth_element(at(from), at(middle), at(to),
                     [&](const CertifiedTriangle& s, const CertifiedTriangle& t) {
                         return centre(s, axis) < centre(t, axis);
                     });
    order(from, middle);
    order(middle, to);
}

ExactRational lowest_along(const ExactPoint& direction, std::span<const std::uint32_t> vertices,
                           const ProofBody& body) {
    ExactRational lowest = dot(direction, body.points[vertices.front()]);
    for (const std::uint32_t v : vertices.subspan(1))
        if (ExactRational x = dot(direction, body.points[v]); x < lowest) lowest = std::move(x);
    return lowest;
}

ExactRational highest_along(const ExactPoint& direction, std::span<const std::uint32_t> vertices,
                            const ProofBody& body) {
    return -lowest_along(proof::opposite(direction), vertices, body);
}

std::vector<std::array<double, 3>> proof_directions(const std::array<double, 3>& way) {
    return {way, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
}

void add_proof_directions(const TriangleCorners& p, const TriangleCorners& q,
                          std::vector<std::array<double, 3>>& directions) {
    const ClosestPoints closest = closest_points(p, q);
    std::array<double, 3> way{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k)
            way[k] += closest.on_q[i] * q[i][k] - closest.on_p[i] * p[i][k];
    directions.insert(directions.begin(), way);
    for (const TriangleCorners& t : {p, q}) {
        const std::array<double, 3> n = cross(minus(t[1], t[0]), minus(t[2], t[0]));
        directions.push_back(n);
        directions.push_back({-n[0], -n[1], -n[2]});
    }
}

}  // namespace trisect::detail

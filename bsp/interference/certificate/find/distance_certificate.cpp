// SPDX-License-Identifier: Apache-2.0
//
// Finding certificates of distances. What is found need not be right: the checker says.
//
// The slab square to the way between the closest points is as thick as the distance, and for convex
// boundaries nothing else is needed. So that direction is tried first, for all ranges. In doubles
// slabs are taken that are thick enough by far more than rounding; where the thickness is next to
// the distance, which is so for all pairs that are equally close, fractions decide. Two triangles
// at the distance have a slab square to a side, to two sides, to a face, or along the way between
// two corners: the closest points of triangles are of these kinds.

#include <trisect/bsp/interference/distance_certificate.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include <trisect/bsp/interference/certificate/find/proof_body.h>
#include <trisect/bsp/interference/certificate/find/proof_tree.h>
#include <trisect/bsp/interference/certificate/find/proof_vector.h>
#include <trisect/bsp/interference/relation/distance_search.h>
#include <trisect/bsp/interference/relation/exact_place.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>
#include <trisect/bsp/interference/relation/meeting_pairs.h>

namespace trisect {

namespace {

using detail::cross;
using detail::dot;
using detail::Feature;
using detail::InterferenceModelData;
using detail::minus;
using detail::ProofBody;
using detail::proof::Approximate;
using detail::proof::exact;
using detail::proof::opposite;
using RationalCorners = std::array<ExactPoint, 3>;

// Of size about 1, in multiples of 2^-52, which keeps products short. Zero stays zero.
Approximate scaled(const Approximate& v) {
    const double size = std::sqrt(dot(v, v));
    if (!(size > 0) || !std::isfinite(size)) return {};
    Approximate r{};
    for (std::size_t k = 0; k < 3; ++k) r[k] = std::round(v[k] / size * 0x1p52) * 0x1p-52;
    return r;
}
// A fraction's size may be beyond doubles.
Approximate scaled(const ExactPoint& v) {
    ExactRational largest;
    for (const ExactRational& x : v) largest = std::max(largest, x.sign() < 0 ? -x : x);
    if (largest.sign() == 0) return {};
    return scaled(Approximate{(v[0] / largest).to_double(), (v[1] / largest).to_double(),
                              (v[2] / largest).to_double()});
}

// ---------------------------------------------------------------- closest points

struct PointsOfPair {
    std::array<ExactRational, 3> on_p;
    std::array<ExactRational, 3> on_q;
};

std::array<ExactRational, 3> on_side(std::size_t i, const ExactRational& t) {
    std::array<ExactRational, 3> r;
    r[i] = ExactRational(1) - t;
    r[(i + 1) % 3] = t;
    return r;
}

// The weights of the point in a triangle's plane that is nearest to x, or 0 where it is x.
std::array<ExactRational, 3> weights_of(const ExactPoint& x, const RationalCorners& t) {
    const ExactPoint u = minus(t[1], t[0]);
    const ExactPoint v = minus(t[2], t[0]);
    const ExactPoint w = minus(x, t[0]);
    const ExactPoint n = cross(u, v);
    const ExactRational nn = dot(n, n);
    std::array<ExactRational, 3> r;
    r[1] = dot(cross(w, v), n) / nn;
    r[2] = dot(cross(u, w), n) / nn;
    r[0] = ExactRational(1) - r[1] - r[2];
    return r;
}

ExactRational part_along(const ExactPoint& x, const ExactPoint& from, const ExactPoint& to) {
    const ExactPoint d = minus(to, from);
    return dot(minus(x, from), d) / dot(d, d);
}

// Of the point of a feature that is closest to x.
std::array<ExactRational, 3> nearest(const ExactPoint& x, const RationalCorners& t, Feature f) {
    if (f.is_interior()) return weights_of(x, t);
    if (f.is_side()) return on_side(f.index(), part_along(x, t[f.index()], t[(f.index() + 1) % 3]));
    return on_side(f.index(), ExactRational());
}

// The closest points of two triangles by the features that they are on: a corner, or two sides that
// are not parallel.
PointsOfPair points_of(const RationalCorners& p, Feature on_p, const RationalCorners& q,
                       Feature on_q) {
    if (on_p.is_corner()) return {on_side(on_p.index(), {}), nearest(p[on_p.index()], q, on_q)};
    if (on_q.is_corner()) return {nearest(q[on_q.index()], p, on_p), on_side(on_q.index(), {})};
    const std::size_t i = on_p.index();
    const std::size_t j = on_q.index();
    const ExactPoint u = minus(p[(i + 1) % 3], p[i]);
    const ExactPoint v = minus(q[(j + 1) % 3], q[j]);
    const ExactPoint r = minus(p[i], q[j]);
    const ExactRational uu = dot(u, u);
    const ExactRational vv = dot(v, v);
    const ExactRational uv = dot(u, v);
    const ExactRational det = uu * vv - uv * uv;
    return {on_side(i, (uv * dot(v, r) - vv * dot(u, r)) / det),
            on_side(j, (uu * dot(v, r) - uv * dot(u, r)) / det)};
}

RationalCorners corners_of(const InterferenceModelData& m, const Pose& pose,
                           std::uint32_t triangle) {
    RationalCorners r;
    for (std::size_t i = 0; i < 3; ++i)
        r[i] = in_world(detail::exact_place(m.brep.point(m.triangles[triangle].vertex[i])),
                        m.brep.lattice(), pose);
    return r;
}

ExactPoint weighted(const std::array<ExactRational, 3>& weights, const RationalCorners& c) {
    ExactPoint r;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k) r[k] += weights[i] * c[i][k];
    return r;
}

struct Closest {
    PointOnFace on_a;
    PointOnFace on_b;
};

std::optional<Closest> common_point(const InterferenceModelData& a, const Pose& pose_a,
                                    const InterferenceModelData& b, const Pose& pose_b) {
    const detail::PosedModels models{
        a, b, detail::PosedPair(pose_a, a.brep.lattice(), pose_b, b.brep.lattice())};
    detail::BoundaryFlags flags;
    for (const detail::MeetingPair& pair : meeting_pairs(models, true, flags))
        for (const detail::MeetingPoint& m : pair.contact.corners()) {
            if (m.a.is_interior() && m.b.is_interior()) continue;
            const ExactPoint x = in_world(place_of(models, pair, m), a.brep.lattice(), pose_a);
            return Closest{{a.triangles[pair.a].face, x}, {b.triangles[pair.b].face, x}};
        }
    return std::nullopt;
}

std::optional<Closest> closest_points(const InterferenceModelData& a, const Pose& pose_a,
                                      const InterferenceModelData& b, const Pose& pose_b) {
    detail::DistanceSearch search(a, pose_a, b, pose_b);
    search.run();
    const detail::DistanceCandidate* best = nullptr;
    detail::ExactClosest least;
    for (const detail::DistanceCandidate& c : search.candidates()) {
        if (c.crossing) return common_point(a, pose_a, b, pose_b);
        detail::ExactClosest e = exact_closest(a, pose_a, c.a, b, pose_b, c.b);
        if (best != nullptr && !(e.squared < least.squared)) continue;
        best = &c;
        least = std::move(e);
    }
    if (best == nullptr || least.features.empty()) return common_point(a, pose_a, b, pose_b);
    const RationalCorners p = corners_of(a, pose_a, best->a);
    const RationalCorners q = corners_of(b, pose_b, best->b);
    const PointsOfPair points = points_of(p, least.features[0].a, q, least.features[0].b);
    return Closest{{a.triangles[best->a].face, weighted(points.on_p, p)},
                   {b.triangles[best->b].face, weighted(points.on_q, q)}};
}

// ---------------------------------------------------------------- slabs

class SlabBuilder {
public:
    SlabBuilder(const ProofBody& a, const ProofBody& b, const Closest& closest, std::size_t limit)
        : a_(a),
          b_(b),
          way_(minus(closest.on_b.point, closest.on_a.point)),
          squared_(dot(way_, way_)),
          limit_(limit) {
        near_way_ = scaled(way_);
        distance_ = std::sqrt(squared_.to_double());
    }

    std::optional<std::vector<SlabNode>> build() {
        return detail::ProofTree<SlabNode, detail::NoTime, SlabBuilder>(*this, {limit_})
            .build({0, a_.triangles.size(), 0, b_.triangles.size(), {}, {}});
    }
    bool separate(const detail::ProofRange<>& r, SlabNode& node) const {
        const auto of_a = a_.corners(r.a0, r.a1);
        const auto of_b = b_.corners(r.b0, r.b1);
        auto slab = slab_of_ranges(of_a, of_b);
        if (!slab && r.is_single()) slab = slab_of_triangles(r.a0, r.b0, of_a, of_b);
        if (slab) node.slab = std::move(*slab);
        return slab.has_value();
    }

private:
    using Indices = std::span<const std::uint32_t>;

    // What doubles say of a direction.
    struct Extent {
        double highest = -std::numeric_limits<double>::infinity();
        double lowest = std::numeric_limits<double>::infinity();
        double error = 0;
        double goal = 0;  // what the thickness must be
    };
    [[nodiscard]] Extent extent(const Approximate& d, Indices of_a, Indices of_b) const {
        Extent r;
        double size = 0;
        const auto height = [&](const Approximate& p) {
            for (std::size_t k = 0; k < 3; ++k) size = std::max(size, std::abs(d[k] * p[k]));
            return dot(d, p);
        };
        for (const std::uint32_t v : of_a) r.highest = std::max(r.highest, height(a_.near[v]));
        for (const std::uint32_t v : of_b) r.lowest = std::min(r.lowest, height(b_.near[v]));
        r.goal = distance_ * std::sqrt(dot(d, d));
        r.error = 0x1p-46 * (size + r.goal) + 0x1p-1000;
        return r;
    }
    [[nodiscard]] std::optional<Slab> quick_slab(const Approximate& d, const Extent& e) const {
        if (!(e.lowest - e.highest > e.goal + 8 * e.error)) return std::nullopt;
        return Slab{exact(d), ExactRational::from_double(e.highest + e.error),
                    ExactRational::from_double(e.lowest - e.error)};
    }
    [[nodiscard]] static bool is_hopeless(const Extent& e) {
        return e.lowest - e.highest < e.goal - 8 * e.error - 0x1p-20 * e.goal;
    }
    // In fractions.
    [[nodiscard]] std::optional<Slab> slab_along(const ExactPoint& d, Indices of_a,
                                                 Indices of_b) const {
        ExactRational highest = highest_along(d, of_a, a_);
        ExactRational lowest = lowest_along(d, of_b, b_);
        const ExactRational thick = lowest - highest;
        if (thick.sign() <= 0 || thick * thick < squared_ * dot(d, d)) return std::nullopt;
        return Slab{d, std::move(highest), std::move(lowest)};
    }

    [[nodiscard]] std::optional<Slab> slab_of_ranges(Indices of_a, Indices of_b) const {
        const Extent along = extent(near_way_, of_a, of_b);
        if (auto s = quick_slab(near_way_, along)) return s;
        if (!is_hopeless(along))
            if (auto s = slab_along(way_, of_a, of_b)) return s;
        for (const Approximate& d :
             detail::proof_directions(scaled(minus(b_.middle(of_b), a_.middle(of_a))))) {
            const Extent e = extent(d, of_a, of_b);
            if (auto s = quick_slab(d, e)) return s;
            if (!is_hopeless(e))
                if (auto s = slab_along(exact(d), of_a, of_b)) return s;
        }
        return std::nullopt;
    }
    [[nodiscard]] std::optional<Slab> slab_of_triangles(std::size_t i, std::size_t j, Indices of_a,
                                                        Indices of_b) const {
        RationalCorners p;
        RationalCorners q;
        for (std::size_t k = 0; k < 3; ++k) {
            p[k] = a_.points[a_.triangles[i].vertex[k].index];
            q[k] = b_.points[b_.triangles[j].vertex[k].index];
        }
        std::optional<Slab> slab;
        const auto works = [&](const ExactPoint& d) {
            const Approximate near = scaled(d);
            if (near == Approximate{}) return false;
            const Extent e = extent(near, of_a, of_b);
            slab = quick_slab(near, e);
            if (!slab && !is_hopeless(e)) slab = slab_along(d, of_a, of_b);
            return slab.has_value();
        };
        for (std::size_t k = 0; k < 3; ++k)
            for (std::size_t l = 0; l < 3; ++l)
                if (works(minus(q[l], p[k]))) return slab;
        const auto both_ways = [&](const ExactPoint& d) { return works(d) || works(opposite(d)); };
        if (both_ways(cross(minus(p[1], p[0]), minus(p[2], p[0])))) return slab;
        if (both_ways(cross(minus(q[1], q[0]), minus(q[2], q[0])))) return slab;
        for (std::size_t k = 0; k < 3; ++k)
            for (std::size_t l = 0; l < 3; ++l) {
                const ExactPoint u = minus(p[(k + 1) % 3], p[k]);
                const ExactPoint v = minus(q[(l + 1) % 3], q[l]);
                if (both_ways(cross(u, v))) return slab;
                const ExactPoint w = minus(q[l], p[k]);
                if (works(square_to(w, u)) || works(square_to(w, v))) return slab;
                // The other way round: a corner of A and a side of B that does not begin there.
                if (works(square_to(minus(q[l], p[(k + 1) % 3]), v))) return slab;
                if (works(square_to(minus(q[(l + 1) % 3], p[k]), u))) return slab;
            }
        return std::nullopt;
    }
    // What of w is square to u, times a positive number.
    static ExactPoint square_to(const ExactPoint& w, const ExactPoint& u) {
        const ExactRational uu = dot(u, u);
        const ExactRational wu = dot(w, u);
        ExactPoint r;
        for (std::size_t k = 0; k < 3; ++k) r[k] = uu * w[k] - wu * u[k];
        return r;
    }

    const ProofBody& a_;
    const ProofBody& b_;
    ExactPoint way_;
    ExactRational squared_;
    Approximate near_way_{};
    double distance_ = 0;
    std::size_t limit_;
};

}  // namespace

DistanceCertificate certify_distance(const InterferenceModel& a, const Pose& pose_a,
                                     const InterferenceModel& b, const Pose& pose_b,
                                     std::size_t max_nodes) {
    DistanceCertificate c;
    if (a.is_empty() || b.is_empty()) return c;
    auto closest = closest_points(detail::data_of(a), pose_a, detail::data_of(b), pose_b);
    if (!closest) return c;
    const ExactPoint way = minus(closest->on_b.point, closest->on_a.point);
    c.squared = dot(way, way);
    c.on_a = closest->on_a;
    c.on_b = closest->on_b;
    c.is_complete = true;
    if (c.squared.sign() == 0) return c;
    ProofBody body_a(detail::data_of(a), pose_a);
    ProofBody body_b(detail::data_of(b), pose_b);
    auto slabs = SlabBuilder(body_a, body_b, *closest, max_nodes).build();
    if (!slabs) {
        c.is_complete = false;
        return c;
    }
    c.slabs = std::move(*slabs);
    c.triangles_a = std::move(body_a.triangles);
    c.triangles_b = std::move(body_b.triangles);
    return c;
}

}  // namespace trisect

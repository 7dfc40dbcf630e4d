// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/interference/boundary_distance.h>

#include <cmath>

#include <trisect/bsp/interference/relation/distance_search.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>
#include <trisect/bsp/interference/relation/meeting_pairs.h>
#include <trisect/kernel/error.h>

namespace trisect {

namespace {

using detail::DistanceSearch;
using detail::Feature;
using detail::InterferenceModelData;

// The smallest part of a triangle that carries a point with these weights.
Feature feature_of(const std::array<double, 3>& weights) {
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t next = (i + 1) % 3;
        if (weights[(i + 2) % 3] > 0) continue;
        if (!(weights[next] > 0)) return Feature::corner(i);
        if (weights[i] > 0) return Feature::side(i);
    }
    return Feature::interior();
}

std::array<double, 3> point_of(const InterferenceModelData& m, const Pose& pose,
                               std::uint32_t triangle, const std::array<double, 3>& weights) {
    std::array<double, 3> p{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k)
            p[k] += weights[i] * m.position(m.triangles[triangle].vertex[i])[k];
    for (double& c : p) c = std::ldexp(c, m.brep.lattice().exponent);
    const auto f = pose.approximate();
    std::array<double, 3> r{};
    for (std::size_t i = 0; i < 3; ++i)
        r[i] = f[4 * i] * p[0] + f[4 * i + 1] * p[1] + f[4 * i + 2] * p[2] + f[4 * i + 3];
    return r;
}

}  // namespace

std::optional<BoundaryDistance> boundary_distance(const InterferenceModel& a, const Pose& pose_a,
                                                  const InterferenceModel& b, const Pose& pose_b) {
    if (a.is_empty() || b.is_empty()) return std::nullopt;
    DistanceSearch search(detail::data_of(a), pose_a, detail::data_of(b), pose_b);
    search.run_for_bounds();
    const DistanceSearch::Candidate& best = search.candidates().front();
    BoundaryDistance r;
    r.lower = search.lower();
    r.upper = search.upper();
    r.a = entity_of(detail::data_of(a), best.a, feature_of(best.closest.on_p));
    r.b = entity_of(detail::data_of(b), best.b, feature_of(best.closest.on_q));
    r.on_a = point_of(detail::data_of(a), pose_a, best.a, best.closest.on_p);
    r.on_b = point_of(detail::data_of(b), pose_b, best.b, best.closest.on_q);
    return r;
}

std::optional<ExactRational> exact_squared_distance(const InterferenceModel& a, const Pose& pose_a,
                                                    const InterferenceModel& b,
                                                    const Pose& pose_b) {
    if (a.is_empty() || b.is_empty()) return std::nullopt;
    DistanceSearch search(detail::data_of(a), pose_a, detail::data_of(b), pose_b);
    search.run();
    std::optional<ExactRational> least;
    for (const DistanceSearch::Candidate& c : search.candidates()) {
        if (c.crossing) return ExactRational();
        const ExactRational d = detail::exact_squared_distance(detail::data_of(a), pose_a, c.a,
                                                               detail::data_of(b), pose_b, c.b);
        if (!least || d < *least) least = d;
        if (least->sign() == 0) break;
    }
    return least;
}

bool are_nearer_than(const InterferenceModel& a, const Pose& pose_a, const InterferenceModel& b,
                     const Pose& pose_b, double distance) {
    if (!std::isfinite(distance) || distance < 0)
        throw UsageError("a distance must be finite and not negative");
    if (a.is_empty() || b.is_empty() || distance == 0) return false;
    DistanceSearch search(detail::data_of(a), pose_a, detail::data_of(b), pose_b);
    search.run(distance, true);
    if (search.upper() < distance) return true;
    const ExactRational limit = ExactRational::from_double(distance);
    for (const DistanceSearch::Candidate& c : search.candidates())
        if (c.bounds.lower < distance &&
            detail::exact_squared_distance(detail::data_of(a), pose_a, c.a, detail::data_of(b),
                                           pose_b, c.b) < limit * limit)
            return true;
    return false;
}

}  // namespace trisect

// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <cmath>

#include <trisect/bsp/interference/relation/distance_search.h>
#include <trisect/bsp/interference/relation/pair_distance.h>
#include <trisect/bsp/interference/solid_interference.h>
#include <trisect/bsp/interference/tree/exact_triangles.h>
#include <trisect/bsp/interference/tree/solid_boundary.h>
#include <trisect/bsp/interference/tree/solid_places.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/pose/relative_pose.h>

namespace trisect {

namespace {

using detail::DistanceSearch;
using detail::in_world;
using detail::SolidBoundary;

// The exact square of the distance of two polygons.
class ExactDistances {
public:
    ExactDistances(const SolidBoundary& a, const Pose& pose_a, const SolidBoundary& b,
                   const Pose& pose_b)
        : a_(a),
          b_(b),
          pose_a_(pose_a),
          pose_b_(pose_b),
          poses_(pose_a, a.lattice, pose_b, b.lattice),
          test_(poses_) {}

    [[nodiscard]] ExactRational squared(std::uint32_t i, std::uint32_t j) {
        const auto of_a = exact_a_.triangles_of(exact_a_.number_of(a_.origin(i).polygon()));
        const auto of_b = exact_b_.triangles_of(exact_b_.number_of(b_.origin(j).polygon()));
        std::optional<ExactRational> least;
        for (std::uint32_t p = of_a.begin; p < of_a.end; ++p)
            for (std::uint32_t q = of_b.begin; q < of_b.end; ++q) {
                const ExactRational d = squared_of(exact_a_[p].posed(), exact_b_[q].posed());
                if (!least || d < *least) least = d;
            }
        return *least;
    }

private:
    [[nodiscard]] ExactRational squared_of(const detail::PosedTriangle& p,
                                           const detail::PosedTriangle& q) {
        if (test_(p, q).meets()) return {};
        return detail::exact_closest_apart({p, a_.lattice, pose_a_}, {q, b_.lattice, pose_b_})
            .squared;
    }

    const SolidBoundary& a_;
    const SolidBoundary& b_;
    const Pose& pose_a_;
    const Pose& pose_b_;
    detail::PosedPair poses_;
    detail::TrianglePairTest test_;
    detail::ExactTriangles exact_a_;
    detail::ExactTriangles exact_b_;
};

}  // namespace

std::optional<NamedDistance> boundary_distance(const Solid& a, const Pose& pose_a, const Solid& b,
                                               const Pose& pose_b) {
    const SolidBoundary boundary_a(a);
    const SolidBoundary boundary_b(b);
    if (boundary_a.is_empty() || boundary_b.is_empty()) return std::nullopt;
    DistanceSearch search(boundary_a, pose_a, boundary_b, pose_b);
    search.run_for_bounds();
    const DistanceSearch::Candidate& best = search.candidates().front();
    const auto on_a = point_on(boundary_a, best.a, best.closest.on_p);
    const auto on_b = point_on(boundary_b, best.b, best.closest.on_q);
    NamedDistance out;
    out.lower = search.lower();
    out.upper = search.upper();
    out.a = name_near(boundary_a, best.a, on_a);
    out.b = name_near(boundary_b, best.b, on_b);
    out.on_a = in_world(on_a, boundary_a.lattice, pose_a);
    out.on_b = in_world(on_b, boundary_b.lattice, pose_b);
    return out;
}

std::optional<ExactRational> exact_squared_distance(const Solid& a, const Pose& pose_a,
                                                    const Solid& b, const Pose& pose_b) {
    const SolidBoundary boundary_a(a);
    const SolidBoundary boundary_b(b);
    if (boundary_a.is_empty() || boundary_b.is_empty()) return std::nullopt;
    DistanceSearch search(boundary_a, pose_a, boundary_b, pose_b);
    search.run();
    ExactDistances exact(boundary_a, pose_a, boundary_b, pose_b);
    std::optional<ExactRational> least;
    for (const DistanceSearch::Candidate& c : search.candidates()) {
        if (c.crossing) return ExactRational();
        const ExactRational d = exact.squared(c.a, c.b);
        if (!least || d < *least) least = d;
        if (least->sign() == 0) break;
    }
    return least;
}

bool are_nearer_than(const Solid& a, const Pose& pose_a, const Solid& b, const Pose& pose_b,
                     double distance) {
    if (!std::isfinite(distance) || distance < 0)
        throw UsageError("a distance must be finite and not negative");
    const SolidBoundary boundary_a(a);
    const SolidBoundary boundary_b(b);
    if (boundary_a.is_empty() || boundary_b.is_empty() || distance == 0) return false;
    DistanceSearch search(boundary_a, pose_a, boundary_b, pose_b);
    search.run(distance, true);
    if (search.upper() < distance) return true;
    ExactDistances exact(boundary_a, pose_a, boundary_b, pose_b);
    const ExactRational limit = ExactRational::from_double(distance);
    return std::ranges::any_of(search.candidates(), [&](const DistanceSearch::Candidate& c) {
        return c.bounds.lower < distance && exact.squared(c.a, c.b) < limit * limit;
    });
}

}  // namespace trisect

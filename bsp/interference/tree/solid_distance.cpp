// SPDX-License-Identifier: Apache-2.0

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include <trisect/bsp/interference/relation/distance_search.h>
#include <trisect/bsp/interference/relation/pair_distance.h>
#include <trisect/bsp/interference/solid_interference.h>
#include <trisect/bsp/interference/tree/exact_triangles.h>
#include <trisect/bsp/interference/tree/solid_boundary.h>
#include <trisect/bsp/interference/tree/solid_places.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/number/vector3.h>
#include <trisect/kernel/pose/relative_pose.h>

namespace trisect {

namespace {

using detail::DistanceSearch;
using detail::in_world;
using detail::SolidBoundary;

using detail::ExactTriangles;
using detail::WorldCorners;
using RationalVector = WorldCorners::value_type;

// The exact triangles of one solid, with their corners in the world.
class WorldTriangles {
public:
    WorldTriangles(const SolidBoundary& boundary, const Pose& pose)
        : boundary_(boundary), pose_(pose) {}

    [[nodiscard]] ExactTriangles::Range of(std::uint32_t triangle) {
        return exact_.triangles_of(exact_.number_of(boundary_.origin(triangle).polygon()));
    }
    [[nodiscard]] detail::PlacedTriangle placed(std::uint32_t number) const {
        return {exact_[number].posed(), boundary_.lattice, pose_};
    }
    [[nodiscard]] const WorldCorners& corners(std::uint32_t number) {
        const auto found = corners_.find(number);
        if (found != corners_.end()) return found->second;
        return corners_.emplace(number, world_corners(placed(number))).first->second;
    }

private:
    const SolidBoundary& boundary_;
    const Pose& pose_;
    ExactTriangles exact_;
    std::unordered_map<std::uint32_t, WorldCorners> corners_;
};

// Extents of triangles along one direction. Where many pairs are equally near, as of parallel
// faces, those along a normal show that most are no nearer than the first: once for each triangle
// instead of once for each pair.
class Slab {
public:
    explicit Slab(const RationalVector& n) : n_(n), square_(detail::dot(n, n)) {}

    [[nodiscard]] bool is_usable() const { return square_.sign() > 0; }
    // Whether the square of their distance is certainly `least` or more.
    [[nodiscard]] bool are_as_far(std::uint32_t p, const WorldCorners& at_p, std::uint32_t q,
                                  const WorldCorners& at_q, const ExactRational& least) {
        const Extent& a = extent(of_a_, p, at_p);
        const Extent& b = extent(of_b_, q, at_q);
        const ExactRational gap = std::max(b.lo - a.hi, a.lo - b.hi);
        return gap.sign() > 0 && gap * gap >= least * square_;
    }

private:
    struct Extent {
        ExactRational lo;
        ExactRational hi;
    };
    using Extents = std::unordered_map<std::uint32_t, Extent>;
    const Extent& extent(Extents& known, std::uint32_t number, const WorldCorners& corners) const {
        const auto found = known.find(number);
        if (found != known.end()) return found->second;
        Extent e{detail::dot(n_, corners[0]), detail::dot(n_, corners[0])};
        for (std::size_t i = 1; i < 3; ++i) {
            const ExactRational d = detail::dot(n_, corners[i]);
            e.lo = std::min(e.lo, d);
            e.hi = std::max(e.hi, d);
        }
        return known.emplace(number, e).first->second;
    }

    RationalVector n_;
    ExactRational square_;
    Extents of_a_;
    Extents of_b_;
};

// The exact square of the least distance of pairs of polygons, or what it was begun with.
class ExactDistances {
public:
    ExactDistances(const SolidBoundary& a, const Pose& pose_a, const SolidBoundary& b,
                   const Pose& pose_b)
        : a_(a, pose_a),
          b_(b, pose_b),
          poses_(pose_a, a.lattice, pose_b, b.lattice),
          test_(poses_) {}

    void set_least(const ExactRational& least) { least_ = least; }
    [[nodiscard]] const std::optional<ExactRational>& least() const { return least_; }

    void add(std::uint32_t i, std::uint32_t j) {
        const ExactTriangles::Range of_a = a_.of(i);
        const ExactTriangles::Range of_b = b_.of(j);
        for (std::uint32_t p = of_a.begin; p < of_a.end; ++p)
            for (std::uint32_t q = of_b.begin; q < of_b.end; ++q)
                if (!are_as_far(p, q)) compare(p, q);
    }

private:
    [[nodiscard]] bool are_as_far(std::uint32_t p, std::uint32_t q) {
        return least_ && std::ranges::any_of(slabs_, [&](Slab& s) {
                   return s.are_as_far(p, a_.corners(p), q, b_.corners(q), *least_);
               });
    }
    void compare(std::uint32_t p, std::uint32_t q) {
        constexpr std::size_t most_slabs = 4;
        const ExactRational d = squared_of(p, q);
        const bool is_less = !least_ || d < *least_;
        if (is_less) {
            least_ = d;
            slabs_.clear();
        }
        if (slabs_.size() >= most_slabs) return;
        for (const WorldCorners* c : {&a_.corners(p), &b_.corners(q)}) {
            Slab slab(
                detail::cross(detail::minus((*c)[1], (*c)[0]), detail::minus((*c)[2], (*c)[0])));
            if (slab.is_usable()) slabs_.push_back(std::move(slab));
        }
    }
    [[nodiscard]] ExactRational squared_of(std::uint32_t p, std::uint32_t q) {
        const detail::PlacedTriangle at_p = a_.placed(p);
        const detail::PlacedTriangle at_q = b_.placed(q);
        if (test_(at_p.triangle, at_q.triangle).meets()) return {};
        return detail::exact_closest_apart(at_p, at_q).squared;
    }

    WorldTriangles a_;
    WorldTriangles b_;
    detail::PosedPair poses_;
    detail::TrianglePairTest test_;
    std::optional<ExactRational> least_;
    std::vector<Slab> slabs_;
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
    for (const DistanceSearch::Candidate& c : search.candidates()) {
        if (c.crossing) return ExactRational();
        exact.add(c.a, c.b);
        if (exact.least()->sign() == 0) break;
    }
    return exact.least();
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
    const ExactRational square = limit * limit;
    exact.set_least(square);
    return std::ranges::any_of(search.candidates(), [&](const DistanceSearch::Candidate& c) {
        if (c.bounds.lower < distance) exact.add(c.a, c.b);
        return *exact.least() < square;
    });
}

}  // namespace trisect

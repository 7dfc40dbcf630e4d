// SPDX-License-Identifier: Apache-2.0
//
// PairDistance: distance of two triangles of posed models.
// It is bounded with certificates, and exact on demand.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <trisect/brep/exact_rational.h>
#include <trisect/bsp/interference/boxes/approximate_map.h>
#include <trisect/bsp/interference/boxes/moved_triangle_pair.h>
#include <trisect/bsp/interference/boxes/triangle_distance.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>
#include <trisect/kernel/pose.h>

namespace trisect::detail {

/// A pair of triangles that may be the closest. Distances are in the user's units.
struct DistanceCandidate {
    std::uint32_t a = 0;
    std::uint32_t b = 0;
    DistanceBounds bounds;
    ClosestPoints closest;
    bool crossing = false;  ///< certainly: the distance is 0
};

/// Compares triangles of posed boundaries in doubles. Boundaries must outlive it. Pairs beside each
/// other are mostly apart along the same direction, so the last one is tried first.
class PairDistance {
public:
    /// \throw LimitError when the poses are beyond the range of doubles.
    PairDistance(const Boundary& a, const Pose& pose_a, const Boundary& b, const Pose& pose_b);

    /// What is certainly farther than `nearest` gets an infinite upper bound and no closest points.
    [[nodiscard]] DistanceCandidate compare(std::uint32_t a, std::uint32_t b, double nearest);
    /// From B's lattice into A's.
    [[nodiscard]] const ApproximateMap& map() const { return map_; }
    /// A distance in A's lattice is in the world at least this many times as long.
    [[nodiscard]] double least_stretch() const { return least_; }

private:
    [[nodiscard]] DistanceCandidate compare_in_lattice(const TriangleCorners& p,
                                                       const TriangleCorners& q, double nearest);
    [[nodiscard]] DistanceCandidate compare_in_world(const TriangleCorners& p,
                                                     const TriangleCorners& q, double nearest);

    const Boundary* a_;
    const Boundary* b_;
    ApproximateMap map_;
    std::array<std::array<double, 3>, 3> stretch_{};  // differences in A's lattice to the world
    std::array<double, 3> way_{};  // the last one: in A's lattice, or in the world
    double row_ = 0;               // largest sum of a row's magnitudes
    double error_ = 0;             // of a position of A and one of moved B
    double least_ = 0;  // a distance in A's lattice is in the world at least so many times as long,
    double most_ = 0;   // and at most, where this is not infinite: of a similarity
};

/// The exact squared distance of two triangles of posed models, in the user's units.
[[nodiscard]] ExactRational exact_squared_distance(const InterferenceModelData& a,
                                                   const Pose& pose_a, std::uint32_t triangle_a,
                                                   const InterferenceModelData& b,
                                                   const Pose& pose_b, std::uint32_t triangle_b);

/// The same with the features of the closest points: of each pair of points that is a corner of the
/// convex set of all closest pairs, the smallest features that the points are on; some twice.
/// Without features where the triangles meet.
struct ExactClosest {
    ExactRational squared;
    std::vector<MeetingPoint> features;
};
[[nodiscard]] ExactClosest exact_closest(const InterferenceModelData& a, const Pose& pose_a,
                                         std::uint32_t triangle_a, const InterferenceModelData& b,
                                         const Pose& pose_b, std::uint32_t triangle_b);

/// A triangle of a posed solid.
struct PlacedTriangle {
    PosedTriangle triangle;
    Lattice lattice;
    const Pose& pose;
};
using WorldCorners = std::array<std::array<ExactRational, 3>, 3>;
/// Its corners in the world.
[[nodiscard]] WorldCorners world_corners(const PlacedTriangle& triangle);

/// The same of triangles that have no common point.
[[nodiscard]] ExactClosest exact_closest_apart(const PlacedTriangle& a, const PlacedTriangle& b);

}  // namespace trisect::detail

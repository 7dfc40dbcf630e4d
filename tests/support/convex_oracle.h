// SPDX-License-Identifier: Apache-2.0
//
// Closest features of convex polytopes without walking: all pairs of features, and a check that
// proves a given pair right.
#pragma once

#include <cstdint>
#include <memory>
#include <random>
#include <vector>

#include <trisect/brep/exact_rational.h>
#include <trisect/bsp/hierarchies/convex/convex_polytope.h>
#include <trisect/bsp/hierarchies/convex/feature_walk.h>
#include <trisect/kernel/pose.h>

namespace convex_oracle {

using trisect::ExactRational;
using trisect::Pose;
using trisect::hierarchies::ConvexPolytope;
using trisect::hierarchies::FeaturePair;

/// A placed pair of polytopes in integers.
class Scene {
public:
    Scene(const ConvexPolytope& a, const Pose& pose_a, const ConvexPolytope& b, const Pose& pose_b);
    ~Scene();
    Scene(const Scene&) = delete;
    Scene& operator=(const Scene&) = delete;

    struct Least {
        FeaturePair pair;  ///< the smallest of those at this distance
        ExactRational squared;
    };
    /// Of all pairs of vertices, edges and faces. \pre they do not meet.
    [[nodiscard]] Least least() const;

    /// Whether no point of A is nearer to B than this pair's closest points, and whether these
    /// points are in the features: a proof, by the planes through both points across their line.
    /// `parallel`: whether more than one vertex of each body is on these planes, so that closest
    /// edges or faces are parallel.
    [[nodiscard]] bool proves_least(const FeaturePair& pair, const ExactRational& squared,
                                    bool* parallel = nullptr) const;
    /// Whether the features have a common point, or a vertex of the pair is inside the other body:
    /// a proof that the sets meet.
    [[nodiscard]] bool proves_meeting(const FeaturePair& pair) const;

private:
    struct Data;
    std::unique_ptr<Data> data_;
};

using Engine = std::mt19937_64;

/// Hulls of random points of a small grid: of any dimension, boxes, prisms; many right angles.
[[nodiscard]] ConvexPolytope random_polytope(Engine& engine, int reach);
/// A translation, mostly after a turn by quarters, or by a small quaternion, or none; now and then
/// a mirror or a shear.
[[nodiscard]] Pose random_pose(Engine& engine, int reach);

}  // namespace convex_oracle

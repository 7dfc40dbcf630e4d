// SPDX-License-Identifier: Apache-2.0
//
// Certificates of exact distances between boundaries.
// Another program can check them with nothing but fractions.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <trisect/brep/brep.h>
#include <trisect/brep/exact_rational.h>
#include <trisect/bsp/interference/interference_certificate.h>
#include <trisect/bsp/interference/interference_model.h>
#include <trisect/bsp/interference/refusal.h>
#include <trisect/kernel/pose.h>

namespace trisect {

/// normal·x is `below` at most for one set of points and `above` at least for another: they are
/// (above - below) / |normal| apart.
struct Slab {
    ExactPoint normal;
    ExactRational below;
    ExactRational above;
};

/// A tree over ranges of triangles: a node has a slab between all its triangles of A and those of
/// B, or halves one of its ranges; children are the next node and `other`.
struct SlabNode {
    enum class Kind : std::uint8_t { Separated, SplitA, SplitB };
    Kind kind = Kind::Separated;
    std::uint32_t other = 0;  ///< the second child
    Slab slab;
};

/// A point of the world on a face.
struct PointOnFace {
    FaceId face;
    ExactPoint point;
};

/// That the square of the distance of two boundaries is `squared`: two points that are as near as
/// that, and slabs at least as thick between all others; none where boundaries have a point in
/// common.
struct DistanceCertificate {
    bool is_complete = false;
    ExactRational squared;
    PointOnFace on_a;
    PointOnFace on_b;
    /// In the order of the tree's ranges; they fill all faces.
    std::vector<CertifiedTriangle> triangles_a;
    std::vector<CertifiedTriangle> triangles_b;
    std::vector<SlabNode> slabs;
};

/// Decides the distance, exactly, and looks for a certificate. Incomplete when a model is empty,
/// and after `max_nodes`. Costs two to some hundred times the answer: nodes are pairs of parts for
/// which no common slab is thick enough. \throw LimitError when the poses are too wide for each
/// other.
[[nodiscard]] DistanceCertificate certify_distance(const InterferenceModel& a, const Pose& pose_a,
                                                   const InterferenceModel& b, const Pose& pose_b,
                                                   std::size_t max_nodes = 1000000);

/// Why a certificate does not hold for these boundaries in these poses; nothing when it does. Uses
/// the boundaries and fractions alone. An incomplete certificate holds when all it contains does.
/// O(vertices) for each node.
[[nodiscard]] std::optional<Refusal> check(const DistanceCertificate& certificate, const Brep& a,
                                           const Pose& pose_a, const Brep& b, const Pose& pose_b);

}  // namespace trisect

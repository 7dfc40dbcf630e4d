// SPDX-License-Identifier: Apache-2.0
//
// Certificates of the relation of two placed solids.
// Another program can check them with nothing but fractions.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <trisect/brep/brep.h>
#include <trisect/brep/exact_point.h>
#include <trisect/brep/exact_rational.h>
#include <trisect/bsp/interference/interference.h>
#include <trisect/bsp/interference/interference_model.h>
#include <trisect/bsp/interference/refusal.h>
#include <trisect/kernel/pose.h>

namespace trisect {

/// normal·x + offset is negative or 0 for one set of points, positive or 0 for another.
struct SeparatingPlane {
    ExactPoint normal;
    ExactRational offset;
};

/// A triangle of a face, by its vertices.
struct CertifiedTriangle {
    FaceId face;
    std::array<VertexId, 3> vertex;
};

/// A proof that no triangle of A meets one of B: a tree over ranges of both. A node either has a
/// plane with all corners of its triangles of A strictly below and those of B strictly above, or
/// halves one of its ranges: children are the next node and `other`.
struct ApartNode {
    enum class Kind : std::uint8_t { Separated, SplitA, SplitB };
    Kind kind = Kind::Separated;
    std::uint32_t other = 0;  ///< the second child
    SeparatingPlane plane;
};

/// A cell of space, bounded by planes: divided by another one, or without a piece of one of the
/// boundaries in its interior; then all of the cell is inside of that solid or all of it outside,
/// and `point`, strictly within the cell, says which.
struct CertifiedCell {
    enum class Kind : std::uint8_t { Split, WithoutA, WithoutB };
    Kind kind = Kind::Split;
    std::uint32_t other = 0;  ///< of Split: the child above the plane; the one below is next
    SeparatingPlane plane;    ///< of Split
    ExactPoint point;         ///< of the others
};

/// What proves a relation:
///   Disjoint     `apart`, with every shell outside the other solid
///   Touching     `on_both`, and that the interiors do not meet: `plane`, which has A on one side
///                and B on the other, or where no plane separates them `cells`, each of them
///                outside of A or outside of B
///   Overlapping  `in_both`, `only_in_a` and `only_in_b`, strictly inside and outside
///   Inside       `apart`, with the shells inside and outside as they must be; where the boundaries
///                meet `cells`, each of them outside of A or inside of B, and `only_in_b`
///   Contains     the same with A and B exchanged
///   Equal        nothing: the boundaries are the same, loop by loop
/// Cells are a binary partition of space, the whole space first. What is shown of the open cells
/// holds for the interiors of the solids.
struct InterferenceCertificate {
    Relation relation = Relation::Disjoint;
    bool is_complete = false;
    std::optional<ExactPoint> in_both;
    std::optional<ExactPoint> only_in_a;
    std::optional<ExactPoint> only_in_b;
    std::optional<ExactPoint> on_both;
    std::optional<SeparatingPlane> plane;
    /// In the order of the tree's ranges; they fill all faces.
    std::vector<CertifiedTriangle> triangles_a;
    std::vector<CertifiedTriangle> triangles_b;
    std::vector<ApartNode> apart;
    std::vector<CertifiedCell> cells;
};

/// Decides the relation and looks for a certificate. It is complete unless cells were too many
/// (20,000: large boundaries that touch all over). Costs some milliseconds; cells, all in
/// fractions, some 0.1 ms each.
[[nodiscard]] InterferenceCertificate certify_relation(const InterferenceModel& a,
                                                       const Pose& pose_a,
                                                       const InterferenceModel& b,
                                                       const Pose& pose_b);

/// Why a certificate does not hold for these boundaries in these poses; nothing when it does. Uses
/// the boundaries and fractions alone, no tree, no predicate and no index of the library: rays
/// against all faces, planes against all vertices. An incomplete certificate holds when all it
/// contains does. O(faces) for each point, O(vertices) for each node of `apart`; each cell clips
/// the triangles that reach into it.
[[nodiscard]] std::optional<Refusal> check(const InterferenceCertificate& certificate,
                                           const Brep& a, const Pose& pose_a, const Brep& b,
                                           const Pose& pose_b);

}  // namespace trisect

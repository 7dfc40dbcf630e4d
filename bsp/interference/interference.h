// SPDX-License-Identifier: Apache-2.0
//
// Exact relation of two placed solids, and contacts of their boundaries.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <vector>

#include <trisect/brep/brep.h>
#include <trisect/brep/exact_point.h>
#include <trisect/brep/exact_rational.h>
#include <trisect/bsp/interference/interference_model.h>
#include <trisect/kernel/point3d.h>
#include <trisect/kernel/pose.h>

namespace trisect {

/// Solids are closed sets here: one that lies in a face of the other from inside is Inside.
enum class Relation : std::uint8_t {
    Disjoint,     ///< no point in common
    Touching,     ///< points of the boundaries in common, no interior points
    Overlapping,  ///< interiors meet, neither contains the other
    Inside,       ///< A is a proper subset of B
    Contains,     ///< B is a proper subset of A
    Equal         ///< the same set
};

/// Whether the intersection of two solids in this relation has a volume.
[[nodiscard]] constexpr bool interiors_meet(Relation r) {
    return r != Relation::Disjoint && r != Relation::Touching;
}

/// "disjoint", "touching", "overlapping", "inside", "contains", "equal".
[[nodiscard]] const char* to_string(Relation relation);

/// A vertex, edge or face of a B-rep, without the smaller ones that bound it. Where entities
/// coincide (Brep::copies) the one with the smallest id. Ordered by kind, then id.
class BoundaryEntity {
public:
    enum class Kind : std::uint8_t { Vertex, Edge, Face };

    constexpr BoundaryEntity() = default;
    constexpr BoundaryEntity(VertexId v) : kind_(Kind::Vertex), index_(v.index) {}  // NOLINT
    constexpr BoundaryEntity(EdgeId e) : kind_(Kind::Edge), index_(e.index) {}      // NOLINT
    constexpr BoundaryEntity(FaceId f) : kind_(Kind::Face), index_(f.index) {}      // NOLINT

    [[nodiscard]] constexpr Kind kind() const { return kind_; }
    [[nodiscard]] constexpr std::uint32_t index() const { return index_; }
    [[nodiscard]] constexpr bool is_vertex() const { return kind_ == Kind::Vertex; }
    [[nodiscard]] constexpr bool is_edge() const { return kind_ == Kind::Edge; }
    [[nodiscard]] constexpr bool is_face() const { return kind_ == Kind::Face; }
    /// Invalid when the entity is of another kind.
    [[nodiscard]] constexpr VertexId vertex() const {
        return is_vertex() ? VertexId(index_) : VertexId();
    }
    [[nodiscard]] constexpr EdgeId edge() const { return is_edge() ? EdgeId(index_) : EdgeId(); }
    [[nodiscard]] constexpr FaceId face() const { return is_face() ? FaceId(index_) : FaceId(); }
    friend constexpr auto operator<=>(const BoundaryEntity&, const BoundaryEntity&) = default;

private:
    Kind kind_ = Kind::Vertex;
    std::uint32_t index_ = EntityId<void>::none;
};

/// An entity of A and an entity of B that have a point in common, and the dimension of what they
/// have in common: 0 (points), 1 (segments) or 2 (area).
///
/// The list of contacts is a property of the two sets and their maximal faces: every pair of
/// entities that meet, whether solids touch there or pass through each other.
struct Contact {
    BoundaryEntity a;
    BoundaryEntity b;
    std::uint8_t dimension = 0;
    /// Of area: the outward normals point in opposite directions, so the solids are on both sides.
    bool opposite = false;
    friend constexpr auto operator<=>(const Contact&, const Contact&) = default;
};

/// A point of a contact region, in the world and in the user's units.
struct ContactPoint {
    ExactPoint exact;
    /// The doubles nearest to the exact coordinates.
    Point3d nearest{};
};

/// A part of the common points of two boundaries, as large as it can be within a pair of entities:
///   dimension 2  the area that a face of each share; `a` and `b` are the faces. Loops have the
///                area to their left, seen from where A's outward normal points (from the other
///                side when A is mirrored); holes run the other way round. A pair of faces may
///                share several areas. Corners are where the outline turns.
///   dimension 1  a segment of an edge of one on an edge or face of the other, or where two faces
///                pass through each other, that is not part of an area's outline: one loop of two
///                points.
///   dimension 0  a point that is on no segment or area: one loop of one point.
struct ContactRegion {
    std::uint8_t dimension = 0;
    BoundaryEntity a;
    BoundaryEntity b;
    /// Of areas: the outward normals point in opposite directions.
    bool opposite = false;
    std::vector<std::vector<ContactPoint>> loops;
};

struct InterferenceOptions {
    /// All contacts. Without them the walk may stop as soon as the relation is known.
    bool contacts = false;
    /// All contact regions. Exact coordinates are rationals of any size and take their time: some
    /// microseconds a point.
    bool regions = false;
};

struct InterferenceResult {
    Relation relation = Relation::Disjoint;
    /// In ascending order, if requested.
    std::vector<Contact> contacts;
    /// By falling dimension, then by entities, if requested.
    std::vector<ContactRegion> regions;
};

/// Relation of A under its pose to B under its pose, and what `options` request.
///
/// Exact for the poses as given. The empty set is Disjoint from everything. Deterministic. Cost:
/// the pairs of triangles whose boxes meet; where solids touch, a few microseconds for each vertex
/// of the contact; where a shell of one meets nothing of the other, one point location in the
/// other's index, which is built when it is first needed. \throw LimitError when the poses are too
/// wide for each other (kernel/pose.h).
[[nodiscard]] InterferenceResult interfere(const InterferenceModel& a, const Pose& pose_a,
                                           const InterferenceModel& b, const Pose& pose_b,
                                           const InterferenceOptions& options = {});

}  // namespace trisect

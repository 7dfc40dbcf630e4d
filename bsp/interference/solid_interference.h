// SPDX-License-Identifier: Apache-2.0
//
// Exact relation, contacts and distance of two placed solids.
//
// By their own trees; no model is made before. Oriented boxes of triangles are kept in the leaves
// of the solids' cell trees, when a question first enters them, and shared by all solids that share
// these leaves. So a solid that was just cut is as good as any other one.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <optional>
#include <vector>

#include <trisect/brep/brep.h>
#include <trisect/brep/exact_rational.h>
#include <trisect/bsp/brep_index.h>
#include <trisect/bsp/interference/interference.h>
#include <trisect/bsp/solid.h>
#include <trisect/kernel/point3d.h>
#include <trisect/kernel/pose.h>

namespace trisect {

/// A face, edge or vertex of a solid's boundary, by faces of operands: what Place has, without
/// handles of a B-rep. The kind is a property of the set (Location): where all polygons at a point
/// lie in one plane it is on a face.
struct EntityName {
    enum class Kind : std::uint8_t { Vertex, Edge, Face };

    Kind kind = Kind::Face;
    /// 1, 2 or 3 for a face, edge or vertex: so many of `faces` are set, in ascending order.
    std::uint8_t face_count = 0;
    /// Of the faces of operands that meet there, the first ones in different planes.
    std::array<FaceSource, 3> faces{};
    /// Of a vertex that was a corner of an operand: its smallest name.
    CornerSource corner;

    friend constexpr auto operator<=>(const EntityName&, const EntityName&) = default;
};

/// An entity of A and an entity of B that have a point in common, and the dimension of what they
/// have in common: 0 (points), 1 (segments) or 2 (area).
struct NamedContact {
    EntityName a;
    EntityName b;
    std::uint8_t dimension = 0;
    /// Of area: the outward normals point in opposite directions.
    bool opposite = false;
    friend constexpr auto operator<=>(const NamedContact&, const NamedContact&) = default;
};

struct SolidInterferenceOptions {
    /// All contacts. Without them the walk may stop as soon as the relation is known.
    bool contacts = false;
};

struct SolidInterference {
    Relation relation = Relation::Disjoint;
    /// In ascending order, each once, if requested.
    std::vector<NamedContact> contacts;
};

/// Relation of A under its pose to B under its pose, and what `options` request. Exact for the
/// poses as given. Deterministic; the same as that of InterferenceModels of the solids.
///
/// Cost: the pairs of triangles whose boxes meet. Of a solid that no question came to, bounds of
/// its leaves; of a leaf that no question came to, about a microsecond a triangle; so of a result
/// of evaluate() what is new in it and near the other solid. A solid imported under
/// Embedding::Resolve is resolved each time: better evaluate() it once.
///
/// \throw UnsupportedError when a solid is unbounded; LimitError when the poses are too wide for
/// each other (kernel/pose.h); what evaluate() throws.
[[nodiscard]] SolidInterference interfere(const Solid& a, const Pose& pose_a, const Solid& b,
                                          const Pose& pose_b,
                                          const SolidInterferenceOptions& options = {});

/// The distance of two boundaries, in the user's units: lower <= distance <= upper, exactly, as
/// BoundaryDistance. The entities are those of a pair of points that is nearly as close, as far as
/// doubles say; other pairs may be equally close.
struct NamedDistance {
    double lower = 0;
    double upper = 0;
    EntityName a;
    EntityName b;
    Point3d on_a{};  ///< near to the closest points, in the world
    Point3d on_b{};
};

/// The distance of the boundaries; nothing when one of the solids is empty. \throw as interfere
[[nodiscard]] std::optional<NamedDistance> boundary_distance(const Solid& a, const Pose& pose_a,
                                                             const Solid& b, const Pose& pose_b);

/// The square of the distance, exactly. \throw as interfere
[[nodiscard]] std::optional<ExactRational> exact_squared_distance(const Solid& a,
                                                                  const Pose& pose_a,
                                                                  const Solid& b,
                                                                  const Pose& pose_b);

/// Whether the distance of the boundaries is less than `distance`, exactly; false when one is
/// empty. \throw UsageError for a distance that is not finite or negative, and as interfere
[[nodiscard]] bool are_nearer_than(const Solid& a, const Pose& pose_a, const Solid& b,
                                   const Pose& pose_b, double distance);

}  // namespace trisect

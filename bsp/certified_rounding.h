// SPDX-License-Identifier: Apache-2.0
//
// Certified rounding of exact boundaries to doubles or floats.
// The resulting mesh provably bounds a solid. It is repaired where plain rounding lets faces
// meet.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <trisect/brep/brep.h>
#include <trisect/brep/certificate.h>
#include <trisect/brep/polygon_mesh.h>
#include <trisect/bsp/expression.h>

namespace trisect {

struct RoundingOptions {
    Precision precision = Precision::Double;
    /// How often intersections may be resolved and rounded again.
    std::size_t max_rounds = 12;
    /// Limits and threads of each resolution.
    EvaluateOptions evaluate = {};
};

/// What it took. Nothing is moved in silence: `radius` bounds what the set lost and gained.
struct CertifiedRounding {
    enum class Outcome : std::uint8_t {
        Plain,     ///< correctly rounded coordinates, as to_polygon_mesh gives them, are certified
        Gridded,   ///< all coordinates rounded to multiples of one unit are
        Repaired,  ///< mended_rounding(), or intersections resolved and snapped
        Failed     ///< nothing is proved about `mesh` but `radius`
    };

    Outcome outcome = Outcome::Failed;
    PolygonMesh mesh;
    /// Of the mesh; its moves are those of the last rounding.
    Certificate certificate;
    /// Every point that is farther than this from the exact boundary is inside the mesh if it is
    /// inside the exact solid, and only then (winding numbers above 0). In the maximum norm.
    double radius = 0;
    /// The unit of the coordinates, a power of two; 0 for Plain.
    double unit = 0;
    std::size_t rounds = 0;            ///< resolutions
    std::size_t snapped_vertices = 0;  ///< moved to a coarser grid, in all rounds
    /// Pairs of faces that met before the first resolution.
    std::size_t first_pairs = 0;
};

/// Plain rounding first, then mended_rounding(). Where the check cannot decide (coordinates
/// that span more bits than the exact check has) or finds something, coordinates are rounded to
/// multiples of one unit, 2^-38 of the largest one or finer: on that grid the check is exact, and
/// an import changes nothing. What still meets is resolved as a boundary that may intersect itself,
/// rounded again, and the vertices of the faces that met are snapped to a grid that is four times
/// as coarse in each round; all others stay where they are.
///
/// There is no proof that this ends (Valque and Lazard, Removing self-intersections in 3D meshes
/// while preserving floating-point coordinates, SGP 2025, have none for theirs either), so rounds
/// are bounded and the outcome says so. Costs a validation, and an evaluation and a validation for
/// each round. \throw what evaluate throws.
[[nodiscard]] CertifiedRounding certified_rounding(const Brep& brep,
                                                   const RoundingOptions& options = {});

/// A rounded mesh whose triangles met, and do so no more.
struct MendedRounding {
    PolygonMesh mesh;
    std::vector<std::uint32_t> parents;  ///< of each triangle: the one that it is a part of
    Certificate certificate;             ///< holds
    double radius = 0;                   ///< as in CertifiedRounding; rounding included
    bool gave_thin_up = false;           ///< triangles thinner than the rounding
    std::size_t divided = 0;             ///< triangles more, since edges lie in faces
};

/// Where an edge of the exact solid lies inside a face of it (a roof that stands on its ridge), the
/// triangles of the face run across the edge. Here they are divided, and share it: no vertex is
/// moved, and the new corners are vertices, or lie where edges cross, within 4 `max_move`s or the
/// precision of doubles. Nothing where that does not lead to a certified mesh, or more than 4,096
/// pairs of faces meet. Costs a validation or two a pass, and some passes.
/// \pre all faces are triangles, and `certificate` is theirs at this precision.
[[nodiscard]] std::optional<MendedRounding> divided_at_contacts(
    const PolygonMesh& mesh, const Certificate& certificate,
    Precision precision = Precision::Double);

/// The first of these that leads to a certified mesh: triangles thinner than 4, or else 16, units
/// in the last place of the largest coordinate are given up (their corners become one, or they are
/// joined with neighbours), as rounding turns them over; divided_at_contacts(); both. Nothing where
/// none does, or where it is not known whether the mesh meets itself. Costs up to three validations
/// and what divided_at_contacts() does.
/// \pre as there
[[nodiscard]] std::optional<MendedRounding> mended_rounding(
    const PolygonMesh& mesh, const Certificate& certificate,
    Precision precision = Precision::Double);

}  // namespace trisect

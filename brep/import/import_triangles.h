// SPDX-License-Identifier: Apache-2.0
//
// Import of triangle meshes, and of general meshes, behind import_mesh.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include <trisect/brep/import_mesh.h>
#include <trisect/brep/polygon_mesh.h>

namespace trisect::detail {

/// The fast path: for meshes of triangles whose sides cancel by name. It gives the result and the
/// report of import_polygons, or nothing where that must decide. Repeated points, points of no
/// triangle, triangles without area, and coordinates that the lattice rounds are all right. Fewer
/// points or triangles than `least_part` are not worth a part of their own for another thread.
/// \throw LimitError as import_mesh.
[[nodiscard]] std::optional<ImportedMesh> import_triangles(const PolygonMesh& mesh,
                                                           const ImportOptions& options,
                                                           Fractions fractions = Fractions::Kept,
                                                           std::size_t least_part = 16384);
/// The same for triangles in memory of a caller.
[[nodiscard]] std::optional<ImportedMesh> import_triangles(const TriangleView& mesh,
                                                           const ImportOptions& options,
                                                           Fractions fractions = Fractions::Kept,
                                                           std::size_t least_part = 16384);

/// The general path: for every mesh.
/// \throw as import_mesh.
[[nodiscard]] ImportedMesh import_polygons(const PolygonMesh& mesh, const ImportOptions& options,
                                           Fractions fractions = Fractions::Kept);

/// The one of them that applies; `fractions` says what becomes of bits behind the point where the
/// options name no lattice.
[[nodiscard]] ImportedMesh import_mesh(const PolygonMesh& mesh, const ImportOptions& options,
                                       Fractions fractions);

/// How many meshes of the calling thread went which way: tests hold this against what should be,
/// because a fast path that is never taken changes nothing but the time.
struct ImportCounters {
    std::uint64_t triangles = 0;
    std::uint64_t polygons = 0;
};
[[nodiscard]] ImportCounters& import_counters() noexcept;

}  // namespace trisect::detail

// SPDX-License-Identifier: Apache-2.0

#include <trisect/brep/validate/validate.h>

#include <algorithm>
#include <utility>

#include <trisect/brep/brep.h>
#include <trisect/brep/import/own_lattice.h>
#include <trisect/brep/import/weld_points.h>
#include <trisect/brep/validate/checked_mesh.h>
#include <trisect/kernel/stop_scope.h>

namespace trisect {

namespace {

using detail::CheckedMesh;
using detail::PreparedMesh;

// The input's points that repeat others or are not used, by their index in the input.
void find_odd_points(CheckedMesh& m, std::size_t point_count,
                     std::span<const std::uint32_t> corners,
                     std::span<const LatticePoint> lattice_points) {
    std::vector<bool> used(point_count, false);
    for (const std::uint32_t c : corners) used[c] = true;
    const detail::WeldedPoints welded = detail::weld_points(lattice_points);
    for (std::uint32_t i = 0; i < point_count; ++i) {
        if (!used[i]) m.unused.push_back({i, welded.id[i]});
        if (welded.first[welded.id[i]] != i) m.repeated.push_back({i, welded.id[i]});
    }
}

ValidationReport run_checks(const CheckedMesh& m, const ValidateOptions& options) {
    ValidationReport report(options.list_limit);
    report.set_lattice(m.mesh.report);
    for (const auto check : {detail::check_open_edges, detail::check_non_manifold_edges,
                             detail::check_non_manifold_vertices, detail::check_repeated_corners,
                             detail::check_degenerate_faces, detail::check_non_planar_faces,
                             detail::check_non_simple_faces, detail::check_duplicate_faces}) {
        detail::check_stop(m.mesh.triangles.size());
        check(m, report);
        if (options.until_first && !report.empty()) return report;
    }
    detail::check_self_intersections(m, options, report);
    if (options.until_first && !report.empty()) return report;
    for (const auto check : {detail::check_duplicate_points, detail::check_unused_points,
                             detail::check_shells, detail::check_emptiness}) {
        detail::check_stop();
        detail::end_step();
        check(m, report);
    }
    report.sort();
    return report;
}

ValidationReport validate_on_lattice(const PolygonMesh& mesh, const LatticeReport& lattice,
                                     std::span<const LatticePoint> points,
                                     const ValidateOptions& options) {
    detail::end_step();
    PreparedMesh prepared = detail::weld_mesh(mesh, points);
    prepared.report = lattice;
    detail::end_step();
    detail::triangulate_faces(prepared);
    CheckedMesh checked(std::move(prepared));
    detail::end_step();
    find_odd_points(checked, points.size(), mesh.corners, points);
    return run_checks(checked, options);
}

}  // namespace

ValidationReport detail::validate_as_written(const PolygonMesh& mesh,
                                             const ValidateOptions& options, Fractions fractions) {
    check_stop(mesh.face_count());
    check_indices(mesh);
    LatticeReport lattice;
    const auto points = points_on_lattice(mesh.points, options.lattice, fractions, lattice);
    return validate_on_lattice(mesh, lattice, points, options);
}

// As import does: what only rounding closes is rounded.
ValidationReport validate(const PolygonMesh& mesh, const ValidateOptions& options) {
    if (options.lattice) return detail::validate_as_written(mesh, options, Fractions::Rounded);
    ValidationReport kept = detail::validate_as_written(mesh, options, Fractions::Kept);
    if (kept.count(DefectKind::OpenEdge) == 0) return kept;
    ValidationReport rounded = detail::validate_as_written(mesh, options, Fractions::Rounded);
    return rounded.count(DefectKind::OpenEdge) == 0 ? rounded : kept;
}

ValidationReport validate(const LatticeMesh& mesh, const ValidateOptions& options) {
    PolygonMesh indices;  // connectivity only; the points are on their lattice already
    indices.points.resize(mesh.points.size());
    indices.corners.reserve(3 * mesh.triangles.size());
    indices.face_begin.reserve(mesh.triangles.size() + 1);
    for (const auto& t : mesh.triangles) indices.add_face(t);
    detail::check_indices(indices);
    LatticeReport lattice;
    lattice.lattice = mesh.lattice;
    return validate_on_lattice(indices, lattice, mesh.points, options);
}

ValidationReport validate(const Brep& brep, const ValidateOptions& options) {
    ValidationReport report(options.list_limit);
    LatticeReport lattice;
    lattice.lattice = brep.lattice();
    report.set_lattice(lattice);
    detail::check_holes(brep, report);
    return report;
}

}  // namespace trisect

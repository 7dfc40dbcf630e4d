// SPDX-License-Identifier: Apache-2.0

#include <trisect/brep/mend/mend.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include <trisect/brep/import/own_lattice.h>
#include <trisect/brep/import/prepared_mesh.h>
#include <trisect/brep/mend/divide_edges.h>
#include <trisect/brep/mend/duplicates.h>
#include <trisect/brep/mend/exact_distance.h>
#include <trisect/brep/mend/fill_holes.h>
#include <trisect/brep/mend/join_vertices.h>
#include <trisect/brep/mend/mending_mesh.h>
#include <trisect/brep/mend/open_edges.h>
#include <trisect/brep/mend/orient_faces.h>
#include <trisect/brep/mend/orient_shells.h>
#include <trisect/brep/validate/defect.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/stop_scope.h>

namespace trisect {

std::string_view name_of(ShellTrouble trouble) {
    switch (trouble) {
        case ShellTrouble::Open:
            return "open";
        case ShellTrouble::NoVolume:
            return "no_volume";
        case ShellTrouble::MeetsOthers:
            return "meets_others";
        case ShellTrouble::WithinMeeting:
            return "within_meeting";
    }
    return "";
}

namespace {

using detail::MendingMesh;

MendingMesh welded(const PolygonMesh& mesh, const MendOptions& options, Fractions fractions,
                   LatticeReport& lattice) {
    const auto points = detail::points_on_lattice(mesh.points, options.lattice, fractions, lattice);
    detail::PreparedMesh prepared = detail::weld_mesh(mesh, points);
    MendingMesh out;
    out.points = std::move(prepared.points);
    out.source_point = std::move(prepared.source_point);
    out.loop_begin = std::move(prepared.loop_begin);
    out.corners = std::move(prepared.corners);
    out.face_source.resize(mesh.face_count());
    for (std::uint32_t f = 0; f < mesh.face_count(); ++f) out.face_source[f] = f;
    return out;
}

bool is_open(const MendingMesh& mesh, Lattice lattice) {
    MendReport found;
    detail::report_open(mesh, lattice, found);
    return !found.open.empty();
}

// As import does: what only rounding closes is rounded.
MendingMesh welded(const PolygonMesh& mesh, const MendOptions& options, LatticeReport& lattice) {
    MendingMesh kept = welded(mesh, options, Fractions::Kept, lattice);
    if (options.lattice || !is_open(kept, lattice.lattice)) return kept;
    LatticeReport rounded_lattice;
    MendingMesh rounded = welded(mesh, options, Fractions::Rounded, rounded_lattice);
    if (rounded.points.size() == kept.points.size() || is_open(rounded, rounded_lattice.lattice))
        return kept;
    lattice = rounded_lattice;
    return rounded;
}

// Vertices of different coordinates that are one on the lattice. \pre corners are as they were
void note_welded(const PolygonMesh& given, const MendingMesh& mesh, MendReport& report) {
    for (std::size_t i = 0; i < given.corners.size(); ++i) {
        const std::uint32_t vertex = given.corners[i];
        const std::uint32_t into = mesh.source_point[mesh.corners[i]];
        const Point3d& a = given.points[vertex];
        const Point3d& b = given.points[into];
        if (a != b)
            report.joined.push_back(
                {vertex, into, std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2])});
    }
    const auto less = [](const JoinedVertex& a, const JoinedVertex& b) {
        return a.vertex < b.vertex;
    };
    std::ranges::sort(report.joined, less);
    report.joined.erase(std::unique(report.joined.begin(), report.joined.end()),
                        report.joined.end());
    for (const JoinedVertex& j : report.joined) report.max_move = std::max(report.max_move, j.move);
}

void close_seams(MendingMesh& mesh, double distance, Lattice lattice, MendReport& report) {
    const detail::DistanceBound bound(distance, lattice);
    detail::leave_out_degenerate(mesh, report);
    detail::divide_exactly(mesh, bound, lattice, report);
    if (distance > 0) {
        detail::end_step();
        detail::join_near_vertices(mesh, bound, lattice, report);
        detail::leave_out_degenerate(mesh, report);
        detail::divide_exactly(mesh, detail::DistanceBound(0, lattice), lattice, report);
        detail::end_step();
        detail::divide_near(mesh, bound, lattice, report);
    }
    const auto sort_names = [](std::vector<std::uint32_t>& names) {
        std::ranges::sort(names);
        names.erase(std::unique(names.begin(), names.end()), names.end());
    };
    sort_names(report.cut_faces);
    sort_names(report.degenerate_faces);
}

// The mesh that was given, with loops as they are in `mesh`.
void keep_points(const PolygonMesh& given, const std::vector<bool>& turned, MendedMesh& out) {
    out.mesh = given;
    for (std::size_t f = 0; f < given.face_count(); ++f)
        if (turned[f])
            std::reverse(out.mesh.corners.begin() + given.face_begin[f] + 1,
                         out.mesh.corners.begin() + given.face_begin[f + 1]);
    out.source_of_point.resize(given.points.size());
    for (std::uint32_t i = 0; i < given.points.size(); ++i) out.source_of_point[i] = i;
}

// Points of faces, in the order of the mesh that was given.
void make_points(const PolygonMesh& given, const MendingMesh& mesh, const MendOptions& options,
                 MendedMesh& out) {
    std::vector<std::uint32_t> number(mesh.points.size(), no_face);
    for (const std::uint32_t c : mesh.corners) number[c] = 0;
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
        if (number[i] == no_face) continue;
        number[i] = static_cast<std::uint32_t>(out.mesh.points.size());
        out.source_of_point.push_back(mesh.source_point[i]);
        out.mesh.points.push_back(options.lattice ? to_user(mesh.points[i], *options.lattice)
                                                  : given.points[mesh.source_point[i]]);
    }
    out.mesh.face_begin = mesh.loop_begin;
    out.mesh.corners.reserve(mesh.corners.size());
    for (const std::uint32_t c : mesh.corners) out.mesh.corners.push_back(number[c]);
}

void note_turned(const MendingMesh& mesh, const std::vector<bool>& turned, MendReport& report) {
    for (std::size_t f = 0; f < mesh.face_count(); ++f)
        if (turned[f] && mesh.face_source[f] != no_face)
            report.turned_faces.push_back(mesh.face_source[f]);
    std::ranges::sort(report.turned_faces);
    report.turned_faces.erase(std::unique(report.turned_faces.begin(), report.turned_faces.end()),
                              report.turned_faces.end());
}

}  // namespace

bool MendReport::changed() const {
    return !turned_faces.empty() || !joined.empty() || !divided.empty() ||
           !degenerate_faces.empty() || !duplicate_faces.empty() || filled_holes != 0 ||
           !lattice.lossless;
}

MendedMesh mended(const PolygonMesh& mesh, const MendOptions& options) {
    detail::check_indices(mesh);
    if (options.seams && !(std::isfinite(*options.seams) && *options.seams >= 0))
        throw UsageError("mend: the distance of seams must be finite and not negative");
    MendedMesh out;
    MendReport& report = out.report;
    MendingMesh work = welded(mesh, options, report.lattice);
    const Lattice lattice = report.lattice.lattice;
    const bool keeps = !options.seams && !options.drop_duplicates && !options.fill_planar_holes &&
                       !options.lattice;
    if (!keeps && !options.lattice) note_welded(mesh, work, report);
    detail::end_step();
    if (options.seams) close_seams(work, *options.seams, lattice, report);
    if (options.drop_duplicates) detail::drop_duplicates(work, report);
    if (options.fill_planar_holes) detail::fill_planar_holes(work, report);
    detail::end_step();
    std::vector<bool> turned(work.face_count(), false);
    if (options.orient_faces) detail::orient_faces(work, turned, report);
    if (options.orient_shells) detail::orient_shells(work, options.inner_shells, turned, report);
    note_turned(work, turned, report);
    detail::report_open(work, lattice, report);
    out.source_of_face = work.face_source;
    if (keeps) {
        keep_points(mesh, turned, out);
    } else {
        make_points(mesh, work, options, out);
    }
    return out;
}

}  // namespace trisect

// SPDX-License-Identifier: Apache-2.0
//
// Closedness is decided in two steps. Where every edge is traversed as often one way as the other,
// the boundary is closed; this covers nearly all meshes and is a linear pass. Faces without area
// take part in that pass although they are left out of the result: their own boundary adds up to
// nothing on their line, so it makes no difference to the sum, but it connects the names of the
// edges around them. Dropping them first would make a closed mesh look open, which is why so many
// programs refuse or "repair" such files. Only the edges that remain are added up as intervals of
// their lines (line_balance.h).
//
// Triangle meshes without such an edge take a way of their own (brep/import/import_triangles.h)
// that gives the same result several times faster. What follows is the way of all others.

#include <trisect/brep/import_mesh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <trisect/brep/import/import_findings.h>
#include <trisect/brep/import/import_triangles.h>
#include <trisect/brep/import/line_balance.h>
#include <trisect/brep/import/own_lattice.h>
#include <trisect/brep/import/prepared_mesh.h>
#include <trisect/brep/import/refit_faces.h>
#include <trisect/brep/import/volume_sign.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/stop_scope.h>

namespace trisect {

namespace {

using detail::PreparedMesh;

class Importer {
public:
    Importer(const PolygonMesh& mesh, const ImportOptions& options, Fractions fractions)
        : input_(mesh), options_(options), fractions_(fractions) {}

    ImportedMesh run() {
        detail::check_stop(input_.face_count());
        detail::check_indices(input_);
        prepare();
        apply_nonplanar_policy();
        report_faces();
        detail::check_stop();
        if (!out_.report.lattice.lossless) count_flipped_faces();
        check_closed();
        move_result();
        return std::move(out_);
    }

private:
    [[nodiscard]] Point3d user_point(std::uint32_t id) const {
        return to_user(mesh_.points[id], out_.report.lattice.lattice);
    }
    [[nodiscard]] Point3d place_of_face(std::uint32_t f) const {
        return mesh_.loop(f).empty() ? Point3d{} : user_point(mesh_.loop(f)[0]);
    }

    void prepare() {
        out_.report.lattice = {};
        lattice_points_ = detail::points_on_lattice(input_.points, options_.lattice, fractions_,
                                                    out_.report.lattice, options_.threads);
        weld_and_triangulate();
    }

    void weld_and_triangulate() {
        detail::check_stop(lattice_points_.size());
        mesh_ = detail::weld_mesh(input_, lattice_points_);
        detail::end_step();
        detail::triangulate_faces(mesh_);
        out_.report.welded_points = mesh_.welded_points;
        out_.report.nonplanar_faces = mesh_.nonplanar_faces.size();
        out_.report.degenerate_faces_dropped = mesh_.degenerate_faces.size();
    }

    void apply_nonplanar_policy() {
        if (mesh_.nonplanar_faces.empty()) return;
        if (options_.nonplanar == NonplanarPolicy::Refuse) {
            add_face_defects(DefectKind::NonPlanarFace, mesh_.nonplanar_faces,
                             "the corners do not lie in one plane");
            throw InvalidSolid(out_.report.defects, "faces that are not planar were to be refused");
        }
        if (options_.nonplanar == NonplanarPolicy::Refit) refit();
    }

    // Faces are made planar on whole coordinates.
    void refit() {
        if (fractions_ == Fractions::Kept) {
            fractions_ = Fractions::Rounded;
            prepare();
        }
        const Lattice lattice = out_.report.lattice.lattice;
        const double units = std::floor(std::ldexp(options_.refit_move, -lattice.exponent));
        if (!(units >= 0)) throw UsageError("the move allowed to Refit must not be negative");
        const auto max_move = static_cast<std::int64_t>(std::min(units, 0x1p52));
        const std::size_t faces = mesh_.nonplanar_faces.size();
        const std::int64_t moved = detail::refit_faces(input_, mesh_, max_move, lattice_points_);
        weld_and_triangulate();
        if (!mesh_.nonplanar_faces.empty())
            throw UnsupportedError("face " + std::to_string(mesh_.nonplanar_faces[0]) +
                                   " would not be planar after its neighbours were refitted");
        out_.report.refitted_faces = faces;
        out_.report.max_refit_move = lattice.to_double(static_cast<double>(moved));
    }

    void add_face_defects(DefectKind kind, std::span<const std::uint32_t> faces, const char* what) {
        detail::add_face_defects(out_.report.defects, kind, faces, what,
                                 [this](std::uint32_t f) { return place_of_face(f); });
    }

    void report_faces() {
        add_face_defects(DefectKind::DegenerateFace, mesh_.degenerate_faces,
                         detail::degenerate_face_text);
        add_face_defects(DefectKind::NonPlanarFace, mesh_.nonplanar_faces,
                         "the corners do not lie in one plane; cut into triangles");
        add_face_defects(DefectKind::NonSimpleFace, mesh_.nonsimple_faces,
                         "the loop crosses or folds onto itself");
    }

    void count_flipped_faces() {
        const auto before = [this](std::uint32_t c) { return input_.points[c]; };
        const auto after = [this](std::uint32_t c) {
            return lattice_points_[c].doubles();  // the unit does not matter
        };
        for (std::size_t f = 0; f < input_.face_count(); ++f)
            if (detail::is_flipped(input_.face(f), before, after))
                ++out_.report.lattice.flipped_faces;
    }

    void check_closed() {
        const auto edges =
            detail::find_net_edges(mesh_.points.size(), mesh_.loop_begin, mesh_.corners);
        detail::end_step();
        detail::check_stop(edges.size());
        const auto open = detail::find_uncancelled(mesh_.points, edges);
        for (std::size_t i = 0; i < edges.size(); ++i) {
            if (!open[i]) {
                ++out_.report.t_edges;
                continue;
            }
            out_.report.closed = false;
            out_.report.defects.add(DefectKind::OpenEdge, [&] { return open_edge(edges[i]); });
        }
        if (!out_.report.closed) {
            if (options_.require_closed) throw InvalidSolid(sorted(out_.report.defects));
            return;
        }
        if (!mesh_.degenerate_faces.empty())
            out_.report.t_edges = detail::count_net_edges(mesh_.points.size(), mesh_.triangles);
        out_.report.inside_out = detail::volume_sign(mesh_.points, mesh_.triangles) < 0;
    }

    static ValidationReport sorted(ValidationReport report) {
        report.sort();
        return report;
    }

    [[nodiscard]] Defect open_edge(const detail::NetEdge& e) const {
        const Point3d a = user_point(e.from);
        const Point3d b = user_point(e.to);
        const std::uint32_t from = mesh_.source_point[e.from];
        const std::uint32_t to = mesh_.source_point[e.to];
        return Defect{DefectKind::OpenEdge,
                      {from, to},
                      {},
                      a,
                      "edge from vertex " + std::to_string(from) + " " + place_text(a) +
                          " to vertex " + std::to_string(to) + " " + place_text(b) +
                          " has no face on its other side"};
    }

    // Leaves out the points of no triangle.
    void move_result() {
        constexpr auto unused = std::numeric_limits<std::uint32_t>::max();
        std::vector<std::uint32_t> name(mesh_.points.size(), unused);
        for (const auto& t : mesh_.triangles)
            for (const std::uint32_t c : t) name[c] = 0;
        LatticeMesh& mesh = out_.mesh;
        mesh.lattice = out_.report.lattice.lattice;
        mesh.points = std::move(mesh_.points);
        std::uint32_t n = 0;
        for (std::size_t i = 0; i < name.size(); ++i) {
            if (name[i] == unused) continue;
            mesh.points[n] = mesh.points[i];
            name[i] = n++;
        }
        mesh.points.resize(n);
        mesh.triangles = std::move(mesh_.triangles);
        if (n != name.size())
            for (auto& t : mesh.triangles)
                for (std::uint32_t& c : t) c = name[c];
        const bool one_each = mesh.triangles.size() == input_.face_count() &&
                              (mesh.triangles.empty() || is_identity(mesh_.face_of_triangle));
        if (!one_each) mesh.face_of_triangle = std::move(mesh_.face_of_triangle);
        out_.report.defects.sort();
    }

    static bool is_identity(std::span<const std::uint32_t> v) {
        for (std::size_t i = 0; i < v.size(); ++i)
            if (v[i] != i) return false;
        return true;
    }

    const PolygonMesh& input_;
    const ImportOptions& options_;
    Fractions fractions_;
    std::vector<LatticePoint> lattice_points_;
    PreparedMesh mesh_;
    ImportedMesh out_;
};

// A copy, for the way of all other meshes.
PolygonMesh polygons_of(const TriangleView& mesh) {
    constexpr std::size_t limit = std::numeric_limits<std::uint32_t>::max();
    if (mesh.triangles.size() > limit / 3 || mesh.points.size() > limit)
        throw LimitError("a mesh of more than 2^32 - 1 corners or points");
    PolygonMesh copy;
    copy.points.assign(mesh.points.begin(), mesh.points.end());
    copy.corners.reserve(3 * mesh.triangles.size());
    copy.face_begin.reserve(mesh.triangles.size() + 1);
    for (const auto& t : mesh.triangles) copy.add_triangle(t[0], t[1], t[2]);
    return copy;
}

}  // namespace

namespace detail {

ImportCounters& import_counters() noexcept {
    thread_local ImportCounters counters;
    return counters;
}

ImportedMesh import_polygons(const PolygonMesh& mesh, const ImportOptions& options,
                             Fractions fractions) {
    return Importer(mesh, options, fractions).run();
}

ImportedMesh import_mesh(const PolygonMesh& mesh, const ImportOptions& options,
                         Fractions fractions) {
    if (auto imported = import_triangles(mesh, options, fractions)) {
        ++import_counters().triangles;
        return *std::move(imported);
    }
    ++import_counters().polygons;
    return import_polygons(mesh, options, fractions);
}

}  // namespace detail

ImportedMesh import_mesh(const TriangleView& mesh, const ImportOptions& options) {
    if (auto imported = detail::import_triangles(mesh, options)) {
        ++detail::import_counters().triangles;
        return *std::move(imported);
    }
    return import_mesh(polygons_of(mesh), options);
}

// What only rounding closes is rounded: files whose points repeat with noise in the last bits.
ImportedMesh import_mesh(const PolygonMesh& mesh, const ImportOptions& options) {
    ImportOptions open = options;
    open.require_closed = false;
    ImportedMesh kept = detail::import_mesh(mesh, open, Fractions::Kept);
    if (kept.report.closed) return kept;
    const auto is_whole = [](const LatticePoint& p) { return p.is_whole(); };
    if (!options.lattice && !std::ranges::all_of(kept.mesh.points, is_whole)) {
        ImportedMesh rounded = detail::import_mesh(mesh, open, Fractions::Rounded);
        if (rounded.report.closed) return rounded;
    }
    if (options.require_closed) throw InvalidSolid(std::move(kept.report.defects));
    return kept;
}

}  // namespace trisect

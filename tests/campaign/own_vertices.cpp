// SPDX-License-Identifier: Apache-2.0
//
// Own vertices: what import does to the coordinates of real files, and where a solid has them.
//
// Of each file: the bits that its coordinates span, whether the lattice keeps them all, and whether
// a mesh that is imported and written has the same doubles. Of each one that bounds a solid: where
// its own vertices are on the solid that it bounds. On a vertex, an edge or a face is right; inside
// or outside says that the solid is not the one of the file, unless the file's surface meets itself
// and covers its own vertices.
//
//     own_vertices [--details] PATH...
//
// A path is a mesh or a folder, searched with all below. Prints Markdown: a row a file with
// --details, and totals. Exits with 1 when a vertex of a lossless file that does not meet itself is
// not on the boundary.

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <trisect/brep/import_mesh.h>
#include <trisect/brep/io/read_mesh.h>
#include <trisect/brep/validate/embedding.h>
#include <trisect/bsp/brep_index.h>
#include <trisect/bsp/solid.h>
#include <trisect/kernel/lattice.h>

namespace {

using trisect::Location;
using trisect::Point3d;
using trisect::PolygonMesh;

struct FileReport {
    std::size_t vertices = 0;
    int span = 0;
    bool lossless = false;
    bool is_whole = false;  ///< no coordinate has bits behind the point
    bool same_doubles = false;
    bool is_solid = false;
    bool meets_itself = false;
    std::array<std::size_t, 5> located{};  // by Location

    [[nodiscard]] std::size_t at(Location l) const { return located[static_cast<std::size_t>(l)]; }
    [[nodiscard]] std::size_t on_boundary() const {
        return at(Location::OnVertex) + at(Location::OnEdge) + at(Location::OnFace);
    }
};

// Those that faces name, each once.
std::vector<Point3d> own_vertices(const PolygonMesh& mesh) {
    std::vector<bool> used(mesh.points.size(), false);
    for (const std::uint32_t c : mesh.corners) used[c] = true;
    std::vector<Point3d> out;
    for (std::size_t i = 0; i < used.size(); ++i)
        if (used[i]) out.push_back(mesh.points[i]);
    return out;
}

// Whether all of these doubles come out of the lattice as they went in. Zeros lose their sign.
bool keeps_doubles(const PolygonMesh& mesh, const trisect::LatticeMesh& imported) {
    std::set<Point3d> kept;
    for (const trisect::LatticePoint& p : imported.points)
        kept.insert(trisect::to_user(p, imported.lattice));
    const std::vector<Point3d> own = own_vertices(mesh);
    return std::ranges::all_of(own, [&](const Point3d& p) { return kept.contains(p); });
}

void locate_vertices(const PolygonMesh& mesh, const trisect::LatticeMesh& imported,
                     FileReport& out) {
    const auto solid = trisect::Solid::from_lattice_mesh(imported, trisect::Embedding::Resolve);
    const trisect::BrepIndex index(solid);
    for (const trisect::Place& place : index.locate(own_vertices(mesh)))
        ++out.located[static_cast<std::size_t>(place.location)];
    out.is_solid = true;
    out.meets_itself = !trisect::is_embedded(imported);
}

FileReport report_on(const std::filesystem::path& path) {
    const PolygonMesh mesh = trisect::read_mesh(path);
    FileReport out;
    const std::vector<Point3d> own = own_vertices(mesh);
    out.vertices = own.size();
    out.span = trisect::span_bits(own);
    trisect::ImportOptions options;
    options.require_closed = false;
    const trisect::ImportedMesh imported = trisect::import_mesh(mesh, options);
    out.lossless = imported.report.lattice.lossless;
    out.is_whole = std::ranges::all_of(imported.mesh.points,
                                       [](const trisect::LatticePoint& p) { return p.is_whole(); });
    out.same_doubles = keeps_doubles(mesh, imported.mesh);
    if (imported.report.closed && !imported.report.inside_out)
        locate_vertices(mesh, imported.mesh, out);
    return out;
}

bool is_mesh(const std::filesystem::path& path) {
    static const std::set<std::string> extensions{".off", ".obj", ".stl", ".ply"};
    return extensions.contains(path.extension().string());
}

std::vector<std::filesystem::path> files_of(const std::vector<std::string>& arguments) {
    std::vector<std::filesystem::path> out;
    for (const std::string& argument : arguments) {
        if (!std::filesystem::is_directory(argument)) {
            out.emplace_back(argument);
            continue;
        }
        for (const auto& entry : std::filesystem::recursive_directory_iterator(argument))
            if (entry.is_regular_file() && is_mesh(entry.path())) out.push_back(entry.path());
    }
    std::ranges::sort(out);
    return out;
}

struct Totals {
    std::size_t files = 0, lossless = 0, with_fractions = 0, same_doubles = 0, solids = 0,
                own_solids = 0, meeting_themselves = 0;
    std::size_t vertices = 0, on_vertex = 0, on_boundary = 0, lost = 0;
    std::map<int, std::size_t> spans;

    void add(const FileReport& r) {
        ++files;
        ++spans[r.span];
        lossless += r.lossless ? 1U : 0U;
        with_fractions += r.lossless && !r.is_whole ? 1U : 0U;
        same_doubles += r.same_doubles ? 1U : 0U;
        if (!r.is_solid) return;
        ++solids;
        own_solids += r.on_boundary() == r.vertices ? 1U : 0U;
        vertices += r.vertices;
        on_vertex += r.at(Location::OnVertex);
        on_boundary += r.on_boundary();
        meeting_themselves += r.meets_itself ? 1U : 0U;
        if (r.lossless && !r.meets_itself) lost += r.vertices - r.on_boundary();
    }
    [[nodiscard]] std::size_t spanning_at_most(int bits) const {
        std::size_t sum = 0;
        for (const auto& [span, count] : spans) sum += span <= bits ? count : 0;
        return sum;
    }
    void print() const {
        std::printf("\n| | |\n|---|---:|\n");
        std::printf("| files read | %zu |\n", files);
        std::printf("| coordinates kept by the lattice | %zu |\n", lossless);
        std::printf("| of these, with bits behind the point | %zu |\n", with_fractions);
        std::printf("| imported and written: the same doubles | %zu |\n", same_doubles);
        for (const int bits : {45, 53, 64, 80, 126})
            std::printf("| coordinates span at most %d bits | %zu |\n", bits,
                        spanning_at_most(bits));
        std::printf("| closed, not inside out | %zu |\n", solids);
        std::printf("| of these, all own vertices on the boundary | %zu |\n", own_solids);
        std::printf("| own vertices of closed files | %zu |\n", vertices);
        std::printf("| on the boundary | %zu |\n", on_boundary);
        std::printf("| as vertex | %zu |\n", on_vertex);
        std::printf("| closed files that meet themselves | %zu |\n", meeting_themselves);
        std::printf("| own vertices of lossless others, inside or outside | %zu |\n", lost);
    }
};

void print_row(const std::filesystem::path& path, const FileReport& r) {
    std::printf("| %s | %zu | %d | %s | %s |", path.filename().c_str(), r.vertices, r.span,
                r.lossless ? "yes" : "no", r.same_doubles ? "yes" : "no");
    if (r.is_solid)
        std::printf(" %zu | %zu | %zu | %zu |\n", r.at(Location::OnVertex), r.at(Location::OnEdge),
                    r.at(Location::OnFace), r.at(Location::Inside) + r.at(Location::Outside));
    else
        std::printf(" | | | |\n");
}

}  // namespace

int main(int argc, char** argv) {
    std::vector<std::string> arguments(argv + 1, argv + argc);
    const bool details = std::erase(arguments, "--details") != 0;
    if (arguments.empty()) {
        std::fprintf(stderr, "usage: own_vertices [--details] PATH...\n");
        return 2;
    }
    if (details)
        std::printf(
            "| file | vertices | bits | kept | same doubles | vertex | edge | face | "
            "inside or outside |\n|---|---:|---:|---|---|---:|---:|---:|---:|\n");
    Totals totals;
    for (const auto& path : files_of(arguments)) {
        try {
            const FileReport report = report_on(path);
            totals.add(report);
            if (details) print_row(path, report);
        } catch (const std::exception& e) {
            std::fprintf(stderr, "%s: %s\n", path.c_str(), e.what());
        }
        std::fflush(stdout);
    }
    totals.print();
    return totals.lost == 0 ? 0 : 1;
}

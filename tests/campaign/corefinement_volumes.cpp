// SPDX-License-Identifier: Apache-2.0
//
// Volumes of booleans against CGAL's corefinement with exact constructions, on the same doubles.
//
// Pairs of meshes of the folders given, or of spheres and tori: brought to about one size, turned
// and moved at random, each coordinate a double as it comes out of that. Nothing is put on a grid
// before either side gets it. The volume of the union, the intersection and the difference have to
// be the same fractions, those of the operands as well. What corefinement cannot write as a
// manifold is not compared, and neither are meshes that are open, inside out or meet themselves.
//
//     corefinement_volumes [--seed S] [--pairs N] [--most-triangles T] [PATH...]
//
// Exits with 1 when two volumes differ.

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <trisect/brep/import_mesh.h>
#include <trisect/brep/interop/cgal.h>
#include <trisect/brep/io/read_mesh.h>
#include <trisect/brep/measure.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/brep/primitives/torus.h>
#include <trisect/brep/transform.h>
#include <trisect/brep/validate/embedding.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid.h>
#include <trisect/bsp/solid_measure.h>

namespace {

using trisect::AffineMap;
using trisect::ExactRational;
using trisect::Point3d;
using trisect::PolygonMesh;
using trisect::Solid;

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
namespace pmp = CGAL::Polygon_mesh_processing;

ExactRational exact(const Kernel::FT& value) {
    std::ostringstream text;
    text << CGAL::exact(value);
    return ExactRational::from_string(text.str());
}

struct Counts {
    std::size_t pairs = 0, fractions = 0, volumes = 0, no_manifold = 0, different = 0;
};

// A mesh of triangles that bounds a solid and does not meet itself.
bool is_fit(const PolygonMesh& mesh, std::size_t most_triangles) {
    if (mesh.face_count() == 0 || mesh.face_count() > most_triangles) return false;
    for (std::size_t f = 0; f < mesh.face_count(); ++f)
        if (mesh.face(f).size() != 3) return false;
    trisect::ImportOptions options;
    options.require_closed = false;
    const trisect::ImportedMesh imported = trisect::import_mesh(mesh, options);
    if (!imported.report.closed || imported.report.inside_out ||
        imported.report.degenerate_faces_dropped != 0 || imported.report.t_edges != 0 ||
        imported.report.welded_points != 0)
        return false;
    return trisect::is_embedded(imported.mesh) &&
           CGAL::is_closed(trisect::to_cgal_surface_mesh<Kernel::Point_3>(mesh));
}

std::vector<PolygonMesh> meshes_of(const std::vector<std::string>& paths,
                                   std::size_t most_triangles) {
    if (paths.empty())
        return {trisect::make_icosphere(1, 2), trisect::make_uv_sphere(0.9, 24, 12),
                trisect::make_torus(1, 0.4, 24, 12), trisect::make_torus(0.8, 0.3, 32, 8)};
    std::vector<std::filesystem::path> files;
    for (const std::string& path : paths)
        for (const auto& entry : std::filesystem::recursive_directory_iterator(path))
            if (entry.is_regular_file()) files.push_back(entry.path());
    std::ranges::sort(files);
    std::vector<PolygonMesh> out;
    for (const auto& file : files) {
        if (!std::set<std::string>{".off", ".obj", ".stl", ".ply"}.contains(
                file.extension().string()))
            continue;
        try {
            PolygonMesh mesh = trisect::read_mesh(file);
            if (is_fit(mesh, most_triangles)) out.push_back(std::move(mesh));
        } catch (const std::exception&) {  // no mesh, or one that CGAL cannot hold
        }
    }
    return out;
}

class Pairs {
public:
    explicit Pairs(std::uint64_t seed) : random_(seed) {}

    [[nodiscard]] std::size_t below(std::size_t n) { return random_() % n; }

    // About one in size, turned about a random axis and moved.
    [[nodiscard]] PolygonMesh placed(const PolygonMesh& mesh) {
        Point3d lo = mesh.points[0];
        Point3d hi = lo;
        for (const Point3d& p : mesh.points)
            for (std::size_t k = 0; k < 3; ++k) {
                lo[k] = std::min(lo[k], p[k]);
                hi[k] = std::max(hi[k], p[k]);
            }
        const double size = std::max({hi[0] - lo[0], hi[1] - lo[1], hi[2] - lo[2]});
        const double scale = real(0.7, 1.4) / size;
        const Point3d to_middle{-0.5 * (lo[0] + hi[0]), -0.5 * (lo[1] + hi[1]),
                                -0.5 * (lo[2] + hi[2])};
        const AffineMap about = trisect::compose(
            AffineMap::rotation({real(-1, 1), real(-1, 1), real(0.1, 1)}, real(0, 360)),
            trisect::compose(AffineMap::scaling({scale, scale, scale}),
                             AffineMap::translation(to_middle)));
        return trisect::transformed(
            mesh, trisect::compose(
                      AffineMap::translation({real(-0.3, 0.3), real(-0.3, 0.3), real(-0.3, 0.3)}),
                      about));
    }

private:
    double real(double lo, double hi) {
        return std::uniform_real_distribution<double>(lo, hi)(random_);
    }
    std::mt19937_64 random_;
};

ExactRational volume(const trisect::Expression& e) { return exact_volume(evaluate(e)); }

void compare_operand(const PolygonMesh& mesh, const Solid& solid, Counts& counts) {
    ++counts.volumes;
    if (exact_volume(solid) !=
        exact(pmp::volume(trisect::to_cgal_surface_mesh<Kernel::Point_3>(mesh))))
        ++counts.different;
}

void compare(Pairs& pairs, const std::vector<PolygonMesh>& meshes, std::size_t index,
             Counts& counts) {
    const PolygonMesh a = pairs.placed(meshes[pairs.below(meshes.size())]);
    const PolygonMesh b = pairs.placed(meshes[pairs.below(meshes.size())]);
    // Rounding may have let one meet itself.
    if (!is_fit(a, a.face_count()) || !is_fit(b, b.face_count())) return;
    const trisect::ImportedMesh imported = trisect::import_mesh(a);
    const Solid x = Solid::from_mesh(a);
    const Solid y = Solid::from_mesh(b);
    ++counts.pairs;
    counts.fractions +=
        std::ranges::all_of(imported.mesh.points, [](const auto& p) { return p.is_whole(); }) ? 0U
                                                                                              : 1U;
    const std::size_t before = counts.different;
    compare_operand(a, x, counts);
    compare_operand(b, y, counts);
    const std::array<ExactRational, 3> ours{volume(x | y), volume(x & y), volume(x - y)};
    for (std::size_t op = 0; op < 3; ++op) {
        Mesh p = trisect::to_cgal_surface_mesh<Kernel::Point_3>(a);
        Mesh q = trisect::to_cgal_surface_mesh<Kernel::Point_3>(b);
        Mesh out;
        const bool done = op == 0   ? pmp::corefine_and_compute_union(p, q, out)
                          : op == 1 ? pmp::corefine_and_compute_intersection(p, q, out)
                                    : pmp::corefine_and_compute_difference(p, q, out);
        if (!done) {
            ++counts.no_manifold;
            continue;
        }
        ++counts.volumes;
        if (ours[op] != exact(pmp::volume(out))) ++counts.different;
    }
    if (counts.different != before) std::printf("DIFFERENT pair %zu\n", index);
}

}  // namespace

int main(int argc, char** argv) {
    std::uint64_t seed = 1;
    std::size_t count = 20;
    std::size_t most_triangles = 3000;
    std::vector<std::string> paths;
    for (int i = 1; i < argc; ++i) {
        const std::string name = argv[i];
        if (name.starts_with("--") && i + 1 < argc) {
            const auto value = std::strtoull(argv[++i], nullptr, 10);
            if (name == "--seed") seed = value;
            if (name == "--pairs") count = value;
            if (name == "--most-triangles") most_triangles = value;
        } else {
            paths.push_back(name);
        }
    }
    const std::vector<PolygonMesh> meshes = meshes_of(paths, most_triangles);
    Counts counts;
    for (std::size_t i = 0; counts.pairs < count && i < 4 * count && !meshes.empty(); ++i) {
        Pairs pairs(seed * 1'000'003 + i);
        compare(pairs, meshes, i, counts);
    }
    std::printf("| | |\n|---|---:|\n");
    std::printf("| meshes | %zu |\n", meshes.size());
    std::printf("| pairs | %zu |\n", counts.pairs);
    std::printf("| first operand with bits behind the point | %zu |\n", counts.fractions);
    std::printf("| volumes compared as fractions | %zu |\n", counts.volumes);
    std::printf("| results that corefinement cannot write as a manifold | %zu |\n",
                counts.no_manifold);
    std::printf("| different | %zu |\n", counts.different);
    return counts.different == 0 && counts.pairs != 0 ? 0 : 1;
}

// SPDX-License-Identifier: Apache-2.0
//
// Sphere trees of three constructions: how tightly the spheres of each level fit, and what is
// known about two solids after a number of tests.

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>

#include <trisect/brep/measure.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/brep/primitives/torus.h>
#include <trisect/bsp/hierarchies/volumes/sphere_trees.h>
#include <trisect/bsp/interference/boundary_distance.h>
#include <trisect/bsp/interference/interference.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>

#include "hierarchy_tables.h"

using namespace trisect;
using namespace trisect::hierarchies;

namespace {

struct Way {
    SphereConstruction construction;
    const char* name;
};
constexpr std::array ways{Way{SphereConstruction::Octree, "sphere-octree"},
                          Way{SphereConstruction::MedialAxis, "sphere-medial"},
                          Way{SphereConstruction::Vertices, "sphere-vertices"}};

void print_tightness(const char* name, const InterferenceModel& model) {
    const double of_solid = trisect::volume(model.brep());
    for (const Way& way : ways) {
        const SphereTree tree =
            build_sphere_tree(trisect::detail::data_of(model), way.construction);
        unsigned level = 0;
        for (const SphereLevel& l : tightness(model, tree, 1200))
            std::printf("| %s | %s | %u | %zu | %.2f | %.4f | %.4f |\n", name, way.name, level++,
                        l.spheres, l.volume / of_solid, l.largest_protrusion, l.mean_protrusion);
    }
}

void print_anytime(const char* name, const InterferenceModel& a, const InterferenceModel& b,
                   const Pose& pose) {
    const double unit = std::ldexp(1.0, a.lattice().exponent);
    const auto exact = boundary_distance(a, Pose(), b, pose);
    for (const Way& way : ways) {
        SphereTrees trees(a, b, way.construction);
        CostCounters counters;
        trees.place(Pose(), pose, counters);
        for (const std::uint64_t tests : {26U, 100U, 1000U, 10000U, 100000U}) {
            const AnytimeAnswer gap = trees.answer_within(tests, counters);
            const AnytimeDepth depth = trees.depth_within(tests, counters);
            std::printf("| %s, gap %.3f | %s | %llu | %.4f | %.4f | %.4f |\n", name, exact->lower,
                        way.name, static_cast<unsigned long long>(tests), gap.at_least * unit,
                        gap.at_most * unit, depth.at_most * unit);
        }
    }
}

}  // namespace

void print_spheres() {
    std::printf(
        "| solid | structure | level | spheres | volume of spheres / of solid | stands out by at "
        "most | on the average |\n|---|---|---:|---:|---:|---:|---:|\n");
    const InterferenceModel torus(Solid::from_mesh(make_torus(1, 0.3, 64, 32)));
    const InterferenceModel ball(Solid::from_mesh(make_icosphere(0.5, 3)));
    const InterferenceModel ring(Solid::from_mesh(make_torus(1, 0.05, 96, 12)));
    print_tightness("torus 1, 0.3", torus);
    print_tightness("ball 0.5", ball);
    print_tightness("ring 1, 0.05", ring);
    std::printf(
        "\n| solids | structure | tests | gap at least | at most | depth at most |\n"
        "|---|---|---:|---:|---:|---:|\n");
    // An egg in the hole of the torus, and in its tube.
    PolygonMesh mesh = make_icosphere(1, 3);
    for (auto& p : mesh.points) p = {0.5 * p[0], 0.2 * p[1], 0.15 * p[2]};
    const InterferenceModel egg(Solid::from_mesh(mesh));
    const auto turned = [](double x) { return Pose::from_quaternion({9, 1, 2, 1}, {x, 0.02, 0}); };
    print_anytime("egg in torus", torus, egg, turned(0.05));
    print_anytime("egg in torus", torus, egg, turned(0.35));
}

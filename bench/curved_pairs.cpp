// SPDX-License-Identifier: Apache-2.0
//
// curved_pairs
//
// Distances of curved surfaces that are known: sphere and sphere, sphere and plane, torus and
// sphere, each turned at random (seed 1), at gaps from 1 to 0 and through each other. What an
// interval of a given width costs, on a new tree and once more on the same; and what the
// tessellated solids cost whose distance is known to twice the deviation.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <functional>
#include <string>
#include <vector>

#include <trisect/brep/curved/curved_shapes.h>
#include <trisect/brep/curved/tessellate.h>
#include <trisect/bsp/hierarchies/curved/patch_distance.h>
#include <trisect/bsp/hierarchies/pairs/queries.h>
#include <trisect/bsp/hierarchies/structures.h>

#include "shapes.h"

namespace {

using namespace trisect;
using namespace trisect::hierarchies;

double processor_seconds() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

// Where B is put at a gap from A; it is turned about its own centre.
struct Pair {
    const char* name;
    std::vector<BezierPatch> a;
    std::vector<BezierPatch> b;
    std::function<Point3d(double gap)> place;
};

std::vector<BezierPatch> patches_of(const CurvedBoundary& boundary) {
    return {boundary.patches().begin(), boundary.patches().end()};
}

std::vector<Pair> pairs() {
    std::vector<Pair> r;
    r.push_back({"sphere, sphere", patches_of(make_curved_sphere(2)),
                 patches_of(make_curved_sphere(1)), [](double gap) {
                     // Along (2, 3, 6) / 7.
                     const double d = 3 + gap;
                     return Point3d{d * 2 / 7, d * 3 / 7, d * 6 / 7};
                 }});
    r.push_back({"plane, sphere",
                 {BezierPatch(1, 1, {{-8, -8, 0}, {-8, 8, 0}, {8, -8, 0}, {8, 8, 0}})},
                 patches_of(make_curved_sphere(1)),
                 [](double gap) {
                     return Point3d{0.3, -0.2, 1 + gap};
                 }});
    r.push_back({"torus, sphere", patches_of(make_curved_torus(5, 2)),
                 patches_of(make_curved_sphere(1)), [](double gap) {
                     // From the middle of the tube at (4, 3, 0), by (4/5, 3/5, 0) 3/5 + z 4/5.
                     const double d = 3 + gap;
                     return Point3d{4 + d * 12 / 25, 3 + d * 9 / 25, d * 4 / 5};
                 }});
    return r;
}

Pose random_pose(shapes::Random& random, const Point3d& by) {
    const auto number = [&random] {
        return static_cast<std::int64_t>(200 * random.uniform()) - 100;
    };
    return Pose::from_quaternion({101, number(), number(), number()}, by);
}

void compare_patches(const Pair& pair) {
    constexpr int turns = 10;
    for (const double gap : {1.0, 0.1, 1e-3, 1e-6, 0.0, -0.25})
        for (const double tolerance : {1e-3, 1e-6, 1e-9}) {
            shapes::Random random(1);
            const double known = std::max(gap, 0.0);
            int certified = 0;
            double tests = 0;
            double parts = 0;
            double seconds = 0;
            double again = 0;
            std::size_t apart = 0;
            for (int i = 0; i < turns; ++i) {
                PatchTree a(pair.a);
                PatchTree b(pair.b);
                const std::size_t before = a.part_count() + b.part_count();
                const Pose pose = random_pose(random, pair.place(gap));
                PatchDistanceOptions options;
                options.tolerance = tolerance;
                const double start = processor_seconds();
                const PatchDistance d = patch_distance(a, Pose(), b, pose, options);
                const double middle = processor_seconds();
                (void)patch_distance(a, Pose(), b, pose, options);
                again += processor_seconds() - middle;
                seconds += middle - start;
                tests += static_cast<double>(d.tests);
                parts += static_cast<double>(a.part_count() + b.part_count() - before) / 2;
                // Places are rounded to doubles.
                certified += d.reached && d.lower <= known + 1e-14 && d.upper >= known - 1e-14 &&
                                     d.upper - d.lower <= tolerance
                                 ? 1
                                 : 0;
                apart += patches_interfere(a, Pose(), b, pose, options) == PatchInterference::Apart
                             ? 1
                             : 0;
            }
            std::printf("| %s | %g | %g | %d of %d | %zu | %.0f | %.0f | %.0f | %.0f |\n",
                        pair.name, gap, tolerance, certified, turns, apart, tests / turns,
                        parts / turns, 1e6 * seconds / turns, 1e6 * again / turns);
            std::fflush(stdout);
        }
}

void compare_triangles(double deviation) {
    const auto model = [&](const CurvedBoundary& boundary) {
        return InterferenceModel(Solid::from_mesh(tessellate(boundary, deviation).mesh));
    };
    const double start = processor_seconds();
    const InterferenceModel torus = model(make_curved_torus(5, 2));
    const InterferenceModel ball = model(make_curved_sphere(1));
    const auto boxes = make_structure(StructureKind::ObbPacked, torus, ball);
    const double built = processor_seconds() - start;
    const Pair pair = pairs()[2];
    for (const double gap : {1.0, 0.1, 1e-3}) {
        shapes::Random random(1);
        double seconds = 0;
        double worst = 0;
        CostCounters counters;
        constexpr int turns = 10;
        for (int i = 0; i < turns; ++i) {
            const Pose pose = random_pose(random, pair.place(gap));
            const double begin = processor_seconds();
            boxes->place(Pose(), pose, counters);
            const DistanceInterval d = distance(*boxes, counters);
            seconds += processor_seconds() - begin;
            worst = std::max({worst, std::abs(d.upper - gap), std::abs(d.lower - gap)});
        }
        std::printf("| %g | %zu | %.1f | %g | %.2g | %.0f | %.0f | %.0f |\n", deviation,
                    torus.triangle_count() + ball.triangle_count(), 1e3 * built, gap, worst,
                    static_cast<double>(counters.volume_tests) / turns,
                    static_cast<double>(counters.primitive_tests) / turns, 1e6 * seconds / turns);
        std::fflush(stdout);
    }
}

}  // namespace

int main() {
    std::printf(
        "| pair | gap | width | certified | proved apart | pairs of hulls | halvings | us | again "
        "us "
        "|\n|---|---:|---:|---:|---:|---:|---:|---:|---:|\n");
    for (const Pair& pair : pairs()) compare_patches(pair);
    std::printf(
        "\nTorus and sphere as triangles:\n\n| deviation | triangles | build ms | gap | error | "
        "pairs of boxes | pairs of triangles | us |\n|---:|---:|---:|---:|---:|---:|---:|---:|\n");
    for (const double deviation : {1e-2, 1e-3, 1e-4}) compare_triangles(deviation);
}

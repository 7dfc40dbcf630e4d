// SPDX-License-Identifier: Apache-2.0
//
// compare_partitions relation [SCENE]...
// compare_partitions growth
//
// What is special about partitions of space. `relation`: the relation of two solids in every frame,
// where trees that know inside from outside may answer before triangles are compared (early
// accept). `growth`: the fly-through among more and more obstacles, by whatever finds the few that
// are near.

#include <cstdio>
#include <ctime>
#include <limits>
#include <string>
#include <vector>

#include <trisect/bsp/hierarchies/pairs/queries.h>
#include <trisect/bsp/hierarchies/structures.h>
#include <trisect/kernel/error.h>

#include "scenes/scenes.h"

namespace {

using namespace trisect;
using namespace trisect::hierarchies;

double processor_seconds() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

struct Run {
    BuildReport build;
    CostCounters counters;
    std::size_t frames = 0;
    std::size_t early = 0;  // of them, decided without a pair of triangles
    double seconds = std::numeric_limits<double>::infinity();
    bool agrees = true;

    [[nodiscard]] double per_frame(double v) const { return v / static_cast<double>(frames); }
    [[nodiscard]] double per_frame(std::uint64_t v) const {
        return per_frame(static_cast<double>(v));
    }
};

Run run(StructureKind kind, const InterferenceModel& a, const InterferenceModel& b,
        const std::vector<Pose>& poses, const std::vector<Relation>& expected) {
    const auto s = make_structure(kind, a, b);
    Run r;
    r.build = s->build_report();
    r.frames = poses.size();
    for (std::size_t f = 0; f < poses.size(); ++f) {
        CostCounters early;
        s->place(Pose(), poses[f], early);
        r.early += s->early_relation(early) ? 1 : 0;
        s->place(Pose(), poses[f], r.counters);
        r.agrees = r.agrees && relation(*s, r.counters) == expected[f];
    }
    const double begin = processor_seconds();
    for (double start = begin; start - begin < 0.5;) {
        CostCounters unused;
        for (const Pose& pose : poses) {
            s->place(Pose(), pose, unused);
            (void)relation(*s, unused);
        }
        const double end = processor_seconds();
        r.seconds = std::min(r.seconds, end - start);
        start = end;
    }
    return r;
}

bool print_rows(const std::string& label, const scenes::PairScene& scene,
                const std::vector<StructureKind>& kinds) {
    const InterferenceModel a(Solid::from_mesh(scene.a));
    const InterferenceModel b(Solid::from_mesh(scene.b));
    std::vector<Pose> poses;
    std::vector<Relation> expected;
    for (const scenes::Rows& r : scene.frames) {
        poses.push_back(scenes::pose_of(r));
        expected.push_back(interfere(a, Pose(), b, poses.back()).relation);
    }
    bool agree = true;
    for (const StructureKind kind : kinds) {
        const Run r = run(kind, a, b, poses, expected);
        std::printf("| %s | %s | %.1f | %zu | %u | %zu of %zu | %.1f | %.1f | %.1f | %.2f |\n",
                    label.c_str(), to_string(kind).data(), 1e3 * r.build.seconds, r.build.bytes,
                    r.build.depth, r.early, r.frames, r.per_frame(r.counters.updates),
                    r.per_frame(r.counters.volume_tests), r.per_frame(r.counters.primitive_tests),
                    1e6 * r.per_frame(r.seconds));
        std::fflush(stdout);
        if (!r.agrees) std::fprintf(stderr, "%s: relations differ\n", to_string(kind).data());
        agree = agree && r.agrees;
    }
    return agree;
}

void print_head(const char* label) {
    std::printf(
        "| %s | structure | build ms | bytes | depth | decided early | Nu | Nbv | Np | us |\n"
        "|---|---|---:|---:|---:|---:|---:|---:|---:|---:|\n",
        label);
}

bool compare_relations(std::vector<std::string> names) {
    if (names.empty()) names = {"tori-crossing", "falling", "parts", "screw", "fly-through"};
    print_head("scene");
    bool agree = true;
    for (const std::string& name : names) {
        const auto scene = scenes::make_pair_scene(name, scenes::Size::Full);
        if (!scene) continue;
        agree = print_rows(name, *scene,
                           {StructureKind::Kdop18, StructureKind::Obb, StructureKind::ObbPacked,
                            StructureKind::Octree, StructureKind::HashGrid, StructureKind::Bsp,
                            StructureKind::Msp}) &&
                agree;
    }
    return agree;
}

bool compare_growth() {
    print_head("obstacles");
    bool agree = true;
    // The way is as long as the field, the steps are the same.
    constexpr std::uint32_t frames_a_side = 50;
    for (const int side : {4, 6, 8, 10, 12})
        agree = print_rows(std::to_string(side * side * side),
                           scenes::make_fly_through(
                               side, frames_a_side * static_cast<std::uint32_t>(side)),
                           {StructureKind::FreeSpace, StructureKind::HashGrid,
                            StructureKind::Octree, StructureKind::Obb}) &&
                agree;
    return agree;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        const std::string what = argc > 1 ? argv[1] : "";
        if (what == "relation") return compare_relations({argv + 2, argv + argc}) ? 0 : 1;
        if (what == "growth") return compare_growth() ? 0 : 1;
        throw UsageError("compare_partitions relation [SCENE]... | growth");
    } catch (const std::exception& e) {
        std::fprintf(stderr, "compare_partitions: %s\n", e.what());
        return 2;
    }
}

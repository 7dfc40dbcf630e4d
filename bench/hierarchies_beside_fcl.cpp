// SPDX-License-Identifier: Apache-2.0
//
// hierarchies_beside_fcl [--scene NAME]... [--frames N] [--rounds N]
//
// Our boxes, k-DOPs and oriented boxes beside FCL's own with the same kind of volume, on the same
// meshes and poses in one run. Rounds alternate between the two, times are medians of rounds, in
// processor time. Asked is whether the boundaries meet, and for all pairs that do; FCL counts pairs
// of triangles in doubles, we name pairs of faces exactly.

#include <algorithm>
#include <array>
#include <cstdio>
#include <ctime>
#include <functional>
#include <string>
#include <vector>

#include <trisect/bsp/hierarchies/pairs/queries.h>
#include <trisect/bsp/hierarchies/structures.h>
#include <trisect/kernel/error.h>

#include "interference_peers.h"
#include "scenes/scenes.h"

namespace {

using namespace trisect;
using namespace trisect::hierarchies;

struct Options {
    std::vector<std::string> scenes;
    std::size_t frames = 40;
    std::size_t rounds = 5;
};

Options options_of(int argc, char** argv) {
    Options o;
    for (int i = 1; i + 1 < argc; i += 2) {
        const std::string option = argv[i];
        if (option == "--scene")
            o.scenes.emplace_back(argv[i + 1]);
        else if (option == "--frames")
            o.frames = std::stoul(argv[i + 1]);
        else if (option == "--rounds")
            o.rounds = std::stoul(argv[i + 1]);
        else
            throw UsageError("unknown option " + option);
    }
    if (o.scenes.empty()) o.scenes = scenes::pair_scene_names();
    return o;
}

double seconds(const std::function<void()>& work) {
    const auto now = [] {
        timespec t{};
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
        return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
    };
    const double start = now();
    work();
    return now() - start;
}

double median(std::vector<double> v) {
    std::ranges::sort(v);
    return v[v.size() / 2];
}

// What is compared with what.
struct Twin {
    StructureKind ours;
    const char* theirs;
};
constexpr Twin twins[] = {
    {StructureKind::Aabb, "FCL AABB"},     {StructureKind::Kdop6, "FCL AABB"},
    {StructureKind::Kdop14, "FCL KDOP16"}, {StructureKind::Kdop18, "FCL KDOP18"},
    {StructureKind::Kdop26, "FCL KDOP24"}, {StructureKind::Obb, "FCL OBB"},
    {StructureKind::ObbWide, "FCL OBB"},   {StructureKind::ObbPacked, "FCL OBB"}};

struct Times {
    double meet = 0;
    double all = 0;
};

bool run(const std::string& name, const Options& options) {
    const auto scene = scenes::make_pair_scene(name, scenes::Size::Full);
    if (!scene) {
        std::printf("%s: its models are not here\n\n", name.c_str());
        return true;
    }
    // Evenly from all frames.
    std::vector<interference_peers::Placement> placements;
    std::vector<Pose> poses;
    const std::size_t n = std::min(options.frames, scene->frames.size());
    for (std::size_t i = 0; i < n; ++i) {
        placements.push_back(scene->frames[i * scene->frames.size() / n]);
        poses.push_back(scenes::pose_of(placements.back()));
    }
    const InterferenceModel a(Solid::from_mesh(scene->a));
    const InterferenceModel b(Solid::from_mesh(scene->b));
    interference_peers::Peers peers;
    interference_peers::add_fcl_volumes(peers, scene->a, scene->b, placements);
    std::printf("## %s\n\n%zu and %zu triangles, %zu frames; microseconds a frame.\n\n",
                name.c_str(), a.triangle_count(), b.triangle_count(), n);
    std::printf(
        "| ours | FCL's | meet, ours | FCL | ratio | all pairs, ours | FCL | ratio |\n"
        "|---|---|---:|---:|---:|---:|---:|---:|\n");
    bool agree = true;
    for (const Twin& twin : twins) {
        const auto ours = make_structure(twin.ours, a, b);
        const auto theirs =
            std::ranges::find(peers, twin.theirs, [](const auto& p) { return p->name(); });
        if (theirs == peers.end()) continue;
        CostCounters counters;
        std::size_t met = 0;
        std::size_t met_by_peer = 0;
        const auto our_meet = [&] {
            met = 0;
            for (const Pose& p : poses) {
                ours->place(Pose(), p, counters);
                met += boundaries_meet(*ours, counters) ? 1 : 0;
            }
        };
        const auto our_all = [&] {
            for (const Pose& p : poses) {
                ours->place(Pose(), p, counters);
                (void)meeting_faces(*ours, counters);
            }
        };
        const auto their_meet = [&] {
            met_by_peer = 0;
            for (std::size_t i = 0; i < n; ++i) met_by_peer += (*theirs)->collide(i) ? 1 : 0;
        };
        const auto their_all = [&] {
            for (std::size_t i = 0; i < n; ++i) (void)(*theirs)->contacts(i);
        };
        std::array<std::vector<double>, 4> t;
        for (std::size_t r = 0; r < options.rounds; ++r) {
            t[0].push_back(seconds(our_meet));
            t[1].push_back(seconds(their_meet));
            t[2].push_back(seconds(our_all));
            t[3].push_back(seconds(their_all));
        }
        std::array<double, 4> m{};
        for (std::size_t i = 0; i < 4; ++i) m[i] = 1e6 * median(t[i]) / static_cast<double>(n);
        std::printf("| %s | %s | %.1f | %.1f | %.2f | %.1f | %.1f | %.2f |\n",
                    std::string(ours->name()).c_str(), twin.theirs, m[0], m[1], m[0] / m[1], m[2],
                    m[3], m[2] / m[3]);
        std::fflush(stdout);
        if (met != met_by_peer) {
            agree = false;
            std::fprintf(stderr, "%s: %zu frames meet by %s, %zu by %s\n", name.c_str(), met,
                         std::string(ours->name()).c_str(), met_by_peer, twin.theirs);
        }
    }
    std::printf("\n");
    return agree;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        const Options options = options_of(argc, argv);
        for (const std::string& name : options.scenes) (void)run(name, options);
        return 0;
    } catch (const std::exception& e) {
        std::fprintf(stderr, "hierarchies_beside_fcl: %s\n", e.what());
        return 2;
    }
}

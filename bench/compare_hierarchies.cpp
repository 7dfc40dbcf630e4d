// SPDX-License-Identifier: Apache-2.0
//
// compare_hierarchies [--scene NAME]... [--structure NAME]... [--small] [--seconds S]
//                     [--charts FOLDER] [--builders] [--changes] [--deformation] [--spheres]
//
// The tables of bench/results/hierarchies.md: every structure on every scene; with --builders, what
// the rules for dividing do to trees of two volumes; with --changes, how trees of boxes age under
// insertion, deletion and motion; with --deformation, what refitting a tree is worth; with
// --spheres, how tightly sphere trees fit and what they know after how many tests.

#include <cstdio>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

#include <trisect/bsp/hierarchies/volumes/volume_hierarchies.h>
#include <trisect/kernel/error.h>

#include "hierarchy_tables.h"
#include "scenes/comparison.h"
#include "scenes/scenes.h"

namespace {

using namespace trisect;
using namespace trisect::hierarchies;

struct Options {
    std::vector<std::string> scenes;
    scenes::ComparisonOptions comparison;
    scenes::Size size = scenes::Size::Full;
    std::string charts;
    bool builders = false;
    void (*table)() = nullptr;  ///< instead of scenes
};

Options options_of(int argc, char** argv) {
    Options o;
    for (int i = 1; i < argc; ++i) {
        const std::string option = argv[i];
        const auto value = [&]() -> std::string {
            if (i + 1 == argc) throw UsageError(option + " needs a value");
            return argv[++i];
        };
        if (option == "--scene") {
            o.scenes.push_back(value());
        } else if (option == "--structure") {
            const std::string name = value();
            const auto kind = structure_kind(name);
            if (!kind) throw UsageError("no structure has the name '" + name + "'");
            o.comparison.kinds.push_back(*kind);
        } else if (option == "--small") {
            o.size = scenes::Size::Small;
        } else if (option == "--builders") {
            o.builders = true;
        } else if (option == "--changes") {
            o.table = print_changes;
        } else if (option == "--deformation") {
            o.table = print_deformation;
        } else if (option == "--spheres") {
            o.table = print_spheres;
        } else if (option == "--seconds") {
            o.comparison.seconds_per_cell = std::stod(value());
        } else if (option == "--charts") {
            o.charts = value();
        } else {
            throw UsageError("unknown option " + option);
        }
    }
    if (o.scenes.empty()) o.scenes = scenes::pair_scene_names();
    return o;
}

bool run(const std::string& name, const Options& options) {
    const auto scene = scenes::make_pair_scene(name, options.size);
    if (!scene) {
        std::printf("## %s\n\nIts models are not here.\n\n", name.c_str());
        return true;
    }
    const InterferenceModel a(Solid::from_mesh(scene->a));
    const InterferenceModel b(Solid::from_mesh(scene->b));
    std::vector<Pose> poses;
    for (const scenes::Rows& r : scene->frames) poses.push_back(scenes::pose_of(r));
    const scenes::Comparison c = scenes::compare(a, b, poses, options.comparison);
    std::printf("## %s\n\n%s: %zu and %zu triangles, %zu frames.", name.c_str(),
                scene->about.c_str(), a.triangle_count(), b.triangle_count(), c.frames);
    for (const auto& [relation, n] : c.answers.relations)
        std::printf(" %s %zu.", relation.c_str(), n);
    std::printf(" Pairs of faces %zu.\n\n%s\n", c.answers.face_pairs, table_of(c).c_str());
    std::fflush(stdout);
    if (!options.charts.empty())
        std::ofstream(options.charts + "/hierarchies-" + name + ".svg")
            << chart_of(c, name + ": " + scene->about);
    if (!c.disagreement.empty())
        std::fprintf(stderr, "%s: %s\n", name.c_str(), c.disagreement.c_str());
    return c.disagreement.empty();
}

// Counts of one kind of tree by all rules.
template <class Make>
void print_builders(const char* volume, const std::vector<Pose>& poses, Make&& make) {
    struct Rule {
        const char* name;
        SplitRule rule;
    };
    for (const Rule& r : {Rule{"median", SplitRule::Median}, Rule{"mean", SplitRule::Mean},
                          Rule{"principal axis", SplitRule::Principal},
                          Rule{"surface area", SplitRule::SurfaceArea}})
        for (const unsigned arity : {2U, 4U}) {
            TreeOptions options;
            options.split = r.rule;
            options.arity = arity;
            const auto s = make(options);
            CostCounters n;
            for (const Pose& p : poses) {
                s->place(Pose(), p, n);
                (void)meeting_faces(*s, n);
            }
            const auto per_frame = [&](std::uint64_t v) {
                return static_cast<double>(v) / static_cast<double>(poses.size());
            };
            std::printf("| %s | %s | %u | %.2f | %u | %.1f | %.1f | %.1f |\n", volume, r.name,
                        arity, 1e3 * s->build_report().seconds, s->build_report().depth,
                        per_frame(n.updates), per_frame(n.volume_tests),
                        per_frame(n.primitive_tests));
        }
}

void run_builders(const std::string& name, const Options& options) {
    const auto scene = scenes::make_pair_scene(name, options.size);
    if (!scene) return;
    const InterferenceModel a(Solid::from_mesh(scene->a));
    const InterferenceModel b(Solid::from_mesh(scene->b));
    std::vector<Pose> poses;
    for (const scenes::Rows& r : scene->frames) poses.push_back(scenes::pose_of(r));
    std::printf(
        "## %s, rules\n\n| volume | rule | children | build ms | depth | Nu | Nbv | Np |\n"
        "|---|---|---:|---:|---:|---:|---:|---:|\n",
        name.c_str());
    print_builders("kdop18", poses,
                   [&](const TreeOptions& o) { return make_kdop18_tree(a, b, o); });
    print_builders("obb", poses, [&](const TreeOptions& o) { return make_obb_tree(a, b, o); });
    std::printf("\n");
}

}  // namespace

int main(int argc, char** argv) {
    try {
        const Options options = options_of(argc, argv);
        if (options.table != nullptr) {
            options.table();
            return 0;
        }
        if (options.builders) {
            for (const std::string& name : options.scenes) run_builders(name, options);
            return 0;
        }
        bool agree = true;
        for (const std::string& name : options.scenes) agree = run(name, options) && agree;
        return agree ? 0 : 1;
    } catch (const std::exception& e) {
        std::fprintf(stderr, "compare_hierarchies: %s\n", e.what());
        return 2;
    }
}

// SPDX-License-Identifier: Apache-2.0
//
// compare_hierarchies [--scene NAME]... [--structure NAME]... [--small] [--seconds S]
//                     [--charts FOLDER] [--builders] [--changes]
//
// The tables of bench/results/hierarchies.md: every structure on every scene; with --builders, what
// the rules for dividing do to trees of two volumes; with --changes, how trees of boxes age.

#include <cstdio>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

#include <trisect/bsp/hierarchies/dynamic_tree.h>
#include <trisect/bsp/hierarchies/volume_hierarchies.h>
#include <trisect/kernel/error.h>

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
    bool changes = false;
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
            o.changes = true;
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

// Triangles' boxes of a torus under the poses of a body that crawls along: moved, taken out and put
// in again, ten thousand times; against a tree built anew.
void run_changes() {
    std::printf(
        "| boxes | changes | kind | sum of areas, changed | rebuilt | ratio | tests a query, "
        "changed | rebuilt | Nu a change |\n|---:|---:|---|---:|---:|---:|---:|---:|---:|\n");
    for (const char* kind : {"small moves", "anywhere", "leave and enter"}) {
        constexpr std::uint32_t n = 2000;
        std::uint64_t state = 99;
        const auto uniform = [&state] {
            state = state * 6364136223846793005U + 1442695040888963407U;
            return static_cast<double>(state >> 11) * 0x1p-53;
        };
        const auto somewhere = [&uniform] {
            detail::BodyBox b;
            for (std::size_t k = 0; k < 3; ++k) {
                b.lo[k] = 100 * uniform();
                b.hi[k] = b.lo[k] + 1 + 3 * uniform();
            }
            return b;
        };
        DynamicTree tree;
        std::vector<detail::BodyBox> boxes;
        for (std::uint32_t i = 0; i < n; ++i) {
            boxes.push_back(somewhere());
            tree.insert(i, boxes[i]);
        }
        tree.rebuild();
        const std::uint64_t before = tree.updates();
        constexpr int changes = 10000;
        for (int c = 0; c < changes; ++c) {
            const auto i = static_cast<std::uint32_t>(n * uniform());
            if (kind[0] == 's')
                for (std::size_t k = 0; k < 3; ++k) {
                    const double by = 4 * uniform() - 2;
                    boxes[i].lo[k] += by;
                    boxes[i].hi[k] += by;
                }
            else
                boxes[i] = somewhere();
            if (kind[0] == 'l') {
                tree.remove(i);
                tree.insert(i, boxes[i]);
            } else {
                tree.update(i, boxes[i]);
            }
        }
        const double updates = static_cast<double>(tree.updates() - before) / changes;
        const auto tests = [&] {
            CostCounters count;
            for (const detail::BodyBox& b : boxes)
                tree.find(
                    b, [](std::uint32_t) {}, count);
            return static_cast<double>(count.volume_tests) / n;
        };
        const double changed = tree.quality();
        const double changed_tests = tests();
        tree.rebuild();
        std::printf("| %u | %d | %s | %.1f | %.1f | %.3f | %.1f | %.1f | %.1f |\n", n, changes,
                    kind, changed, tree.quality(), changed / tree.quality(), changed_tests, tests(),
                    updates);
    }
}

}  // namespace

int main(int argc, char** argv) {
    try {
        const Options options = options_of(argc, argv);
        if (options.changes) {
            run_changes();
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

// SPDX-License-Identifier: Apache-2.0
//
// compare_broad_phases [--scene NAME]... [--frames N] [--small] [--charts FOLDER]
//
// Swarms of apps/scenes through every broad phase: in each frame all bodies are moved and the pairs
// of boxes that meet are found. Boxes are the same for all and made before the clock starts; so are
// the pairs that must come out, by comparing all boxes with each other, and the exact relation of
// each. Boxes in space and time are asked for the whole motion at once.

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include <trisect/bsp/hierarchies/motion/space_time_boxes.h>
#include <trisect/bsp/interference/boxes/broad_phase.h>
#include <trisect/bsp/interference/interference.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>
#include <trisect/bsp/interference/scene/body_bounds.h>
#include <trisect/bsp/interference/scene/broad_phases.h>
#include <trisect/bsp/interference/scene/chain_boxes.h>
#include <trisect/bsp/interference/scene/dynamic_tree.h>
#include <trisect/kernel/error.h>

#include "scenes/bar_chart.h"
#include "scenes/scenes.h"

namespace {

using namespace trisect;
using detail::BodyBox;
using detail::BodyPair;
using detail::BroadPhase;

struct Options {
    std::vector<std::string> scenes;
    std::size_t frames = std::numeric_limits<std::size_t>::max();
    scenes::Size size = scenes::Size::Full;
    std::string charts;
};

Options options_of(int argc, char** argv) {
    Options o;
    for (int i = 1; i < argc; ++i) {
        const std::string option = argv[i];
        const auto value = [&]() -> std::string {
            if (i + 1 == argc) throw UsageError(option + " needs a value");
            return argv[++i];
        };
        if (option == "--scene")
            o.scenes.push_back(value());
        else if (option == "--frames")
            o.frames = std::max<std::size_t>(2, std::stoul(value()));
        else if (option == "--small")
            o.size = scenes::Size::Small;
        else if (option == "--charts")
            o.charts = value();
        else
            throw UsageError("unknown option " + option);
    }
    if (o.scenes.empty()) o.scenes = scenes::swarm_scene_names();
    return o;
}

double processor_seconds() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

struct Kind {
    const char* name;
    std::unique_ptr<BroadPhase> (*make)();
};

constexpr std::array kinds{Kind{"sweep", detail::make_sweep_and_prune},
                           Kind{"r-tree", detail::make_box_tree},
                           Kind{"hash-grid", hierarchies::make_hash_grid},
                           Kind{"hierarchical-grid", hierarchies::make_hierarchical_grid},
                           Kind{"octree", hierarchies::make_octree_phase},
                           Kind{"kd-tree", hierarchies::make_kd_tree_phase},
                           Kind{"dynamic-tree", hierarchies::make_dynamic_tree},
                           Kind{"chain-boxes", hierarchies::make_chain_boxes}};

// A scene as broad phases see it, and what they have to find.
struct Swarm {
    std::vector<InterferenceModel> bodies;
    std::vector<std::vector<Pose>> poses;      // frame by frame
    std::vector<std::vector<BodyBox>> boxes;   // the same
    std::vector<std::vector<BodyPair>> pairs;  // whose boxes meet
    std::vector<std::vector<BodyPair>> interfering;
    std::map<std::string, std::size_t> relations;  // of these pairs, in all frames
    std::size_t met = 0;                           // pairs of boxes in all frames
};

Swarm swarm_of(const scenes::SwarmScene& scene, std::size_t most_frames) {
    Swarm s;
    std::vector<InterferenceModel> models;
    std::vector<detail::BodyBounds> bounds;
    for (const PolygonMesh& m : scene.shapes) {
        models.emplace_back(Solid::from_mesh(m));
        bounds.emplace_back(trisect::detail::data_of(models.back()));
    }
    for (const std::size_t shape : scene.shape_of) s.bodies.push_back(models[shape]);
    for (std::size_t f = 0; f < std::min(most_frames, scene.frames.size()); ++f) {
        auto& poses = s.poses.emplace_back();
        auto& boxes = s.boxes.emplace_back();
        for (std::uint32_t i = 0; i < s.bodies.size(); ++i) {
            poses.push_back(scenes::pose_of(scene.frames[f][i]));
            boxes.push_back(bounds[scene.shape_of[i]].under(poses.back()));
        }
        auto& pairs = s.pairs.emplace_back();
        auto& interfering = s.interfering.emplace_back();
        for (std::uint32_t i = 0; i < boxes.size(); ++i)
            for (std::uint32_t j = i + 1; j < boxes.size(); ++j) {
                if (!boxes[i].meets(boxes[j])) continue;
                pairs.push_back({i, j});
                const Relation r = interfere(s.bodies[i], poses[i], s.bodies[j], poses[j]).relation;
                if (r == Relation::Disjoint) continue;
                interfering.push_back({i, j});
                ++s.relations[to_string(r)];
            }
        s.met += pairs.size();
    }
    return s;
}

struct Row {
    std::string name;
    double pairs = 0;  // a frame, like all that follow
    double tests = 0;
    double lookups = 0;
    double moves = 0;
    double entries = 0;
    std::size_t bytes = 0;
    double seconds = 0;
    bool agrees = true;
};

Row run(const Kind& kind, const Swarm& swarm) {
    Row row{kind.name};
    row.seconds = std::numeric_limits<double>::infinity();
    const auto frames = static_cast<double>(swarm.boxes.size());
    for (int round = 0; round < 3; ++round) {
        const auto phase = kind.make();
        for (std::uint32_t i = 0; i < swarm.bodies.size(); ++i) phase->insert(i, swarm.boxes[0][i]);
        std::vector<BodyPair> pairs;
        double seconds = 0;
        detail::BroadPhaseWork sum;
        for (std::size_t f = 0; f < swarm.boxes.size(); ++f) {
            const double start = processor_seconds();
            for (std::uint32_t i = 0; i < swarm.bodies.size(); ++i)
                phase->update(i, swarm.boxes[f][i]);
            phase->pairs(pairs);
            seconds += processor_seconds() - start;
            row.agrees = row.agrees && pairs == swarm.pairs[f];
            sum.box_tests += phase->work().box_tests;
            sum.lookups += phase->work().lookups;
            sum.moves += phase->work().moves;
            sum.cells += phase->work().cells;
        }
        row.seconds = std::min(row.seconds, seconds / frames);
        row.pairs = static_cast<double>(swarm.met) / frames;
        row.tests = static_cast<double>(sum.box_tests) / frames;
        row.lookups = static_cast<double>(sum.lookups) / frames;
        row.moves = static_cast<double>(sum.moves) / frames;
        row.entries = static_cast<double>(sum.cells) / frames;
        row.bytes = phase->bytes();
    }
    return row;
}

// Every point of a body goes straight from frame to frame. Pairs at the time of a frame.
Row run_space_time(const Swarm& swarm) {
    Row row{"space-time"};
    const std::size_t frames = swarm.poses.size();
    const double start = processor_seconds();
    hierarchies::SpaceTimeBoxes boxes;
    for (std::size_t i = 0; i < swarm.bodies.size(); ++i) {
        std::vector<Pose> way;
        for (const auto& poses : swarm.poses) way.push_back(poses[i]);
        boxes.add(swarm.bodies[i], Motion::through(way));
        row.entries += static_cast<double>(boxes.boxes(static_cast<std::uint32_t>(i)).size());
    }
    const auto found = boxes.pairs(0, static_cast<double>(frames - 1));
    row.seconds = (processor_seconds() - start) / static_cast<double>(frames);
    for (std::size_t f = 0; f < frames; ++f) {
        std::vector<BodyPair> now;
        for (const hierarchies::SpaceTimePair& p : found)
            if (p.from <= static_cast<double>(f) && static_cast<double>(f) <= p.to)
                now.push_back({p.first, p.second});
        std::ranges::sort(now);
        row.pairs += static_cast<double>(now.size()) / static_cast<double>(frames);
        row.agrees = row.agrees && std::ranges::includes(now, swarm.interfering[f]);
    }
    row.bytes = static_cast<std::size_t>(row.entries) * sizeof(hierarchies::SpaceTimeBox);
    row.entries /= static_cast<double>(frames);
    return row;
}

bool compare(const std::string& name, const Options& options) {
    const scenes::SwarmScene scene = scenes::make_swarm_scene(name, options.size);
    const Swarm swarm = swarm_of(scene, options.frames);
    std::printf("## %s\n\n%s: %zu bodies, %zu frames.", name.c_str(), scene.about.c_str(),
                swarm.bodies.size(), swarm.boxes.size());
    for (const auto& [relation, n] : swarm.relations) std::printf(" %s %zu.", relation.c_str(), n);
    std::printf(
        "\n\n| broad phase | pairs | tests | look-ups | moves | entries | bytes | us |\n"
        "|---|---:|---:|---:|---:|---:|---:|---:|\n");
    scenes::BarChart chart{
        name + ": " + scene.about, "us", "measured, microseconds a frame", "", {}};
    chart.panels.push_back({"pairs of boxes", {}});
    std::vector<Row> rows;
    for (const Kind& kind : kinds) rows.push_back(run(kind, swarm));
    rows.push_back(run_space_time(swarm));
    bool agree = true;
    for (const Row& r : rows) {
        std::printf("| %s | %.1f | %.0f | %.0f | %.0f | %.0f | %zu | %.1f |\n", r.name.c_str(),
                    r.pairs, r.tests, r.lookups, r.moves, r.entries, r.bytes, 1e6 * r.seconds);
        chart.panels[0].bars.push_back({r.name, 1e6 * r.seconds, 0});
        if (!r.agrees) std::fprintf(stderr, "%s: %s misses pairs\n", name.c_str(), r.name.c_str());
        agree = agree && r.agrees;
    }
    std::printf("\n");
    std::fflush(stdout);
    if (!options.charts.empty())
        std::ofstream(options.charts + "/broad-phases-" + name + ".svg") << svg_of(chart);
    return agree;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        const Options options = options_of(argc, argv);
        bool agree = true;
        for (const std::string& name : options.scenes) agree = compare(name, options) && agree;
        return agree ? 0 : 1;
    } catch (const std::exception& e) {
        std::fprintf(stderr, "compare_broad_phases: %s\n", e.what());
        return 2;
    }
}

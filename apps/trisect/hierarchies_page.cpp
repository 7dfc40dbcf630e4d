// SPDX-License-Identifier: Apache-2.0
#include "hierarchies_page.h"

#include <trisect/bsp/hierarchies/pairs/queries.h>
#include <trisect/bsp/hierarchies/structures.h>

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

namespace trisect::app {
namespace {

using hierarchies::VolumeOutline;

constexpr unsigned shown_levels = 5;
constexpr std::size_t most_frames = 41;

/// What the numbers of a volume are: a ball's centre and radius; a box's centre and half axes; or
/// both limits of each slab.
std::string_view kind_of(const VolumeOutline& v) {
    if (v.slabs.empty()) return "balls";
    return v.slabs.size() == 3 ? "boxes" : "slabs";
}

void add_numbers(const VolumeOutline& v, std::vector<float>& out) {
    const auto add = [&](double x) { out.push_back(static_cast<float>(x)); };
    if (v.slabs.empty()) {
        for (const double x : v.center) add(x);
        add(v.radius);
        return;
    }
    if (v.slabs.size() != 3) {
        for (const hierarchies::Slab& s : v.slabs) {
            add(s.lower);
            add(s.upper);
        }
        return;
    }
    Point3d center{};
    for (const hierarchies::Slab& s : v.slabs)
        for (std::size_t k = 0; k < 3; ++k) center[k] += s.direction[k] * (s.lower + s.upper) / 2;
    for (const double x : center) add(x);
    for (const hierarchies::Slab& s : v.slabs)
        for (std::size_t k = 0; k < 3; ++k) add(s.direction[k] * (s.upper - s.lower) / 2);
}

Json levels_json(const std::vector<VolumeOutline>& volumes) {
    Json out = Json::array();
    for (const VolumeOutline& v : volumes) out.push_back(2 * v.level + (v.is_leaf ? 1 : 0));
    return out;
}

Json directions_json(const VolumeOutline& v) {
    Json out = Json::array();
    for (const hierarchies::Slab& s : v.slabs) out.push_back(s.direction);
    return out;
}

/// What one structure has and does at each frame.
class StructureFilm {
public:
    StructureFilm(const scenes::StructureCost& cost, const std::array<PlacedBody, 2>& bodies)
        : structure_(hierarchies::make_structure(cost.kind, bodies[0].model, bodies[1].model)) {
        facts_["name"] = cost.name;
        facts_["bytes"] = cost.build.bytes;
        facts_["build_seconds"] = cost.build.seconds;
        for (const scenes::QuestionCost& q : cost.questions)
            if (q.question == scenes::Question::Faces) {
                facts_["predicted"] = q.predicted;
                facts_["measured"] = q.measured;
            }
        facts_["counts"] = Json::array();
    }

    void add_frame(const Pose& pose) {
        hierarchies::CostCounters counters;
        structure_->place(Pose(), pose, counters);
        (void)hierarchies::meeting_faces(*structure_, counters);
        facts_["counts"].push_back(
            {counters.updates, counters.volume_tests, counters.primitive_tests});
        if (facts_["counts"].size() == 1) {
            const auto of_a = structure_->outlines_of_a(shown_levels);
            for (const VolumeOutline& v : of_a) add_numbers(v, a_);
            if (of_a.empty()) return;
            facts_["volumes"] = kind_of(of_a.front());
            if (of_a.front().slabs.size() > 3) facts_["directions"] = directions_json(of_a.front());
            facts_["levels_a"] = levels_json(of_a);
            facts_["levels_b"] = levels_json(structure_->outlines_of_b(shown_levels));
        }
        for (const VolumeOutline& v : structure_->outlines_of_b(shown_levels)) add_numbers(v, b_);
    }

    [[nodiscard]] Json finish(PageData& data, std::size_t number) {
        data.add_floats(fmt::format("volumes_a{}", number), a_);
        data.add_floats(fmt::format("volumes_b{}", number), b_);
        return std::move(facts_);
    }

private:
    std::unique_ptr<hierarchies::PairStructure> structure_;
    Json facts_;
    std::vector<float> a_;
    std::vector<float> b_;  // frame by frame
};

std::vector<std::size_t> frames_of_page(std::size_t count) {
    const std::size_t shown = std::min(count, most_frames);
    std::vector<std::size_t> out;
    for (std::size_t i = 0; i < shown; ++i) out.push_back(i * (count - 1) / (shown - 1));
    return out;
}

}  // namespace

std::string hierarchies_page(const std::array<PlacedBody, 2>& bodies, std::span<const Pose> poses,
                             std::span<const PosePlace> places,
                             const scenes::Comparison& comparison) {
    PageScene scene = scene_of(bodies);
    scene.kind = "hierarchies";
    scene.title = fmt::format("{} moves past {}", bodies[1].name, bodies[0].name);
    std::string relations;
    for (const auto& [relation, n] : comparison.answers.relations)
        relations += fmt::format("{}{} {}", relations.empty() ? "" : ", ", n, relation);
    scene.summary = {fmt::format("{} frames: {}", comparison.frames, relations)};
    PageTimeline timeline;
    timeline.unit = "frame";
    timeline.bodies = {1};
    const std::vector<std::size_t> frames = frames_of_page(poses.size());
    for (const std::size_t f : frames) {
        timeline.times.push_back(static_cast<double>(f));
        timeline.poses.push_back(places[f]);
    }
    scene.timeline = std::move(timeline);
    PageData data;
    Json more;
    more["structures"] = Json::array();
    for (std::size_t i = 0; i < comparison.structures.size(); ++i) {
        StructureFilm film(comparison.structures[i], bodies);
        for (const std::size_t f : frames) film.add_frame(poses[f]);
        more["structures"].push_back(film.finish(data, i));
    }
    more["frames"] = comparison.frames;
    return page_text(scene, std::move(data), more);
}

}  // namespace trisect::app

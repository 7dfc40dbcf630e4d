// SPDX-License-Identifier: Apache-2.0
//
// Interference beside FCL and CGAL on identical doubles, in one process and on one thread. Prints a
// line of JSON for every scene, question and engine: microseconds a query as mean, median and 99th
// percentile over all placements (of each placement the best of some rounds, the engines taking
// turns), apart and colliding placements separately, what was counted, and with whom the engine
// disagrees.
//
//     compare_interference [--rounds 3] [--most 2000] [--scene NAME]... [--what QUESTION]...
//                          [--no-peers] [--trees]
//
// With --trees solids are asked by their own trees, too: one made of the mesh, and the result of a
// boolean where A is one.
//
// Questions: collide, coherent, contacts, distance; all of them when none is named.
// Scenes: see interference_scene.h. Volumes with which FCL copies and refits a whole model for each
// query are asked for every fiftieth placement only.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include <trisect/bsp/expression.h>
#include <trisect/bsp/interference/interference.h>
#include <trisect/bsp/interference/interference_model.h>
#include <trisect/bsp/interference/interference_query.h>
#include <trisect/bsp/interference/relation/boundary_pairs.h>
#include <trisect/bsp/interference/relation/distance_search.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>
#include <trisect/bsp/interference/relation/quick_relation.h>
#include <trisect/bsp/interference/solid_interference.h>
#include <trisect/bsp/solid.h>
#include <trisect/kernel/diagnostics.h>
#include <trisect/kernel/pose.h>

#include "interference_peers.h"
#include "interference_scene.h"

namespace {

using interference_peers::Peer;
using interference_peers::Placement;
using nlohmann::json;
using trisect::InterferenceModel;
using trisect::Pose;
using trisect::Solid;
using trisect::detail::BoundaryPairs;
using trisect::detail::DistanceSearch;
using trisect::detail::ObbWalk;
using trisect::detail::WalkCounters;

double now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

json quantiles(std::vector<double> times) {
    if (times.empty()) return nullptr;
    std::ranges::sort(times);
    double sum = 0;
    for (const double t : times) sum += t;
    const auto at = [&times](double q) {
        return times[std::min(times.size() - 1,
                              static_cast<std::size_t>(q * static_cast<double>(times.size())))];
    };
    const auto us = [](double t) { return std::round(1e8 * t) / 1e2; };
    return {{"n", times.size()},
            {"mean", us(sum / static_cast<double>(times.size()))},
            {"p50", us(at(0.5))},
            {"p99", us(at(0.99))}};
}

// Boundaries of two solids, as the peers see them: surfaces.
class Trisect : public Peer {
public:
    Trisect(const interference_scenes::Scene& scene) {
        const Solid a = Solid::from_mesh(scene.a);
        const double start = now();
        a_ = InterferenceModel(a);
        build_ = now() - start;
        b_ = InterferenceModel(Solid::from_mesh(scene.b));
        for (const Placement& p : scene.placements) poses_.push_back(Pose::from_doubles(p));
        for (const Placement& p : scene.path) path_.push_back(Pose::from_doubles(p));
    }
    [[nodiscard]] std::string name() const override { return "Trisect"; }
    [[nodiscard]] double build_seconds() const override { return build_; }
    [[nodiscard]] bool collide(std::size_t i) override {
        BoundaryPairs pairs(trisect::detail::data_of(a_), home_, trisect::detail::data_of(b_),
                            poses_[i], stack_);
        const bool meet = pairs.any().has_value();
        counters += pairs.counters();
        return meet;
    }
    [[nodiscard]] trisect::Relation relation(std::size_t i) const {
        return trisect::interfere(a_, home_, b_, poses_[i]).relation;
    }
    [[nodiscard]] std::optional<std::size_t> contacts(std::size_t i) override {
        BoundaryPairs pairs(trisect::detail::data_of(a_), home_, trisect::detail::data_of(b_),
                            poses_[i], stack_);
        std::size_t n = 0;
        pairs.all([&n](const BoundaryPairs::Meeting&) {
            ++n;
            return false;
        });
        counters += pairs.counters();
        return n;
    }
    [[nodiscard]] std::optional<double> distance(std::size_t i) override {
        DistanceSearch search(trisect::detail::data_of(a_), home_, trisect::detail::data_of(b_),
                              poses_[i]);
        search.run_for_bounds();
        counters.node_tests += search.counters().node_tests;
        counters.triangle_pairs += search.counters().triangle_pairs;
        return search.upper();
    }
    [[nodiscard]] json build_stages() const {
        const auto s = a_.stats();
        return {{"brep", 1e3 * s.brep_seconds},
                {"triangulate", 1e3 * s.triangulate_seconds},
                {"boxes", 1e3 * s.boxes_seconds},
                {"megabytes", 1e-6 * static_cast<double>(s.bytes)}};
    }

    // The path twice over: asked anew for each pose, and by an object that remembers.
    [[nodiscard]] json follow(int rounds) const {
        std::vector<double> fresh(path_.size(), std::numeric_limits<double>::infinity());
        std::vector<double> kept = fresh;
        std::size_t different = 0;
        WalkCounters walks;
        trisect::InterferenceQueryCounters query_counters;
        for (int round = 0; round < rounds; ++round) {
            trisect::InterferenceQuery query(a_, b_);
            const trisect::Diagnostics<trisect::InterferenceQueryCounters> diagnostics;
            different = 0;
            walks = {};
            for (std::size_t i = 0; i < path_.size(); ++i) {
                double start = now();
                const auto answer = trisect::interfere(a_, home_, b_, path_[i]).relation;
                fresh[i] = std::min(fresh[i], now() - start);
                start = now();
                const auto again = query.relation(home_, path_[i]);
                kept[i] = std::min(kept[i], now() - start);
                different += answer == again ? 0 : 1;
                ObbWalk::Stack stack;
                (void)trisect::detail::quick_relation(trisect::detail::data_of(a_), home_,
                                                      trisect::detail::data_of(b_), path_[i], stack,
                                                      &walks);
            }
            query_counters = diagnostics.counters();
        }
        const double n = static_cast<double>(path_.size());
        return {{"us_fresh", quantiles(fresh)},
                {"us_coherent", quantiles(kept)},
                {"node_tests_fresh", static_cast<double>(walks.node_tests) / n},
                {"node_tests_coherent", static_cast<double>(query_counters.node_tests) / n},
                {"plane_tests_coherent", static_cast<double>(query_counters.plane_tests) / n},
                {"by_balls", query_counters.by_balls},
                {"resumed_fronts", query_counters.resumed_fronts},
                {"kept", query_counters.kept},
                {"fresh_walks", query_counters.fresh_walks},
                {"different", different}};
    }
    [[nodiscard]] bool has_path() const { return !path_.empty(); }

    WalkCounters counters;

private:
    InterferenceModel a_;
    InterferenceModel b_;
    Pose home_;
    std::vector<Pose> poses_;
    std::vector<Pose> path_;
    ObbWalk::Stack stack_;
    double build_ = 0;
};

// Relations of the same models, containment included.
class Solids : public Peer {
public:
    explicit Solids(const Trisect& models) : models_(&models) {}
    [[nodiscard]] std::string name() const override { return "Trisect interfere"; }
    [[nodiscard]] double build_seconds() const override { return models_->build_seconds(); }
    [[nodiscard]] bool collide(std::size_t i) override {
        return models_->relation(i) != trisect::Relation::Disjoint;
    }

private:
    const Trisect* models_;
};

// Distances of solids by their own trees; A fresh, or as a boolean left it.
class OwnTrees : public Peer {
public:
    OwnTrees(std::string name, Solid a, const interference_scenes::Scene& scene)
        : name_(std::move(name)), a_(std::move(a)), b_(Solid::from_mesh(scene.b)) {
        for (const Placement& p : scene.placements) poses_.push_back(Pose::from_doubles(p));
    }
    [[nodiscard]] std::string name() const override { return name_; }
    [[nodiscard]] double build_seconds() const override { return 0; }
    [[nodiscard]] bool collide(std::size_t i) override {
        return trisect::interfere(a_, home_, b_, poses_[i]).relation != trisect::Relation::Disjoint;
    }
    [[nodiscard]] std::optional<double> distance(std::size_t i) override {
        return trisect::boundary_distance(a_, home_, b_, poses_[i])->upper;
    }

private:
    std::string name_;
    Solid a_;
    Solid b_;
    Pose home_;
    std::vector<Pose> poses_;
};

struct Options {
    int rounds = 3;
    std::size_t most = 2000;
    std::vector<std::string> scenes;
    std::vector<std::string> questions;
    bool peers = true;
    bool trees = false;
    [[nodiscard]] bool asks(const std::string& question) const {
        return questions.empty() || std::ranges::find(questions, question) != questions.end();
    }
};

// The times of one engine for one question.
struct Column {
    Peer* peer = nullptr;
    std::vector<std::size_t> placements;
    std::vector<double> best;
    std::vector<double> answer;
};

using Question = std::function<std::optional<double>(Peer&, std::size_t)>;

void ask(const interference_scenes::Scene& scene, const std::string& what, std::vector<Peer*> peers,
         int rounds, Trisect& ours, const Question& question) {
    std::vector<Column> columns;
    for (Peer* p : peers) {
        if (!question(*p, 0)) continue;
        Column c;
        c.peer = p;
        // Distances of these volumes are not slow.
        const bool slow = p->is_slow() && what != "distance";
        const std::size_t step = !slow ? 1 : what == "collide" ? 50 : 0;
        if (step == 0) continue;
        for (std::size_t i = 0; i < scene.placements.size(); i += step) c.placements.push_back(i);
        c.best.assign(c.placements.size(), std::numeric_limits<double>::infinity());
        c.answer.assign(c.placements.size(), 0);
        columns.push_back(std::move(c));
    }
    WalkCounters counted;
    for (int round = 0; round < rounds; ++round)
        for (Column& c : columns) {
            if (c.peer->is_slow() && what != "distance" && round > 0) continue;
            ours.counters = {};
            for (std::size_t k = 0; k < c.placements.size(); ++k) {
                const double start = now();
                const auto answer = question(*c.peer, c.placements[k]);
                c.best[k] = std::min(c.best[k], now() - start);
                c.answer[k] = answer.value_or(0);
            }
            if (c.peer == &ours) counted = ours.counters;
        }
    // Apart and colliding by our own answer.
    const Column& first = columns.front();
    for (const Column& c : columns) {
        std::vector<double> hit;
        std::vector<double> miss;
        json disagree = json::array();
        double total = 0;
        for (std::size_t k = 0; k < c.placements.size(); ++k) {
            const double own = first.answer[c.placements[k]];
            (own > 0 ? hit : miss).push_back(c.best[k]);
            total += c.answer[k];
            // Distances agree up to rounding; 0 and next to it are the same.
            const bool differs = what == "distance"
                                     ? std::abs(c.answer[k] - own) > 1e-9 * (1 + std::abs(own))
                                     : (c.answer[k] > 0) != (own > 0);
            if (differs && disagree.size() < 20) disagree.push_back(c.placements[k]);
        }
        json line{{"scene", scene.name},
                  {"what", what},
                  {"engine", c.peer->name()},
                  {"us", quantiles(c.best)},
                  {"us_colliding", quantiles(hit)},
                  {"us_apart", quantiles(miss)},
                  {"total", total},
                  {"build_ms", 1e3 * c.peer->build_seconds()},
                  {"disagrees", disagree}};
        if (c.peer == &ours) {
            const double n = static_cast<double>(c.placements.size());
            line["a_query"] = {{"node_tests", static_cast<double>(counted.node_tests) / n},
                               {"triangle_pairs", static_cast<double>(counted.triangle_pairs) / n},
                               {"crossing", static_cast<double>(counted.crossing) / n},
                               {"unknown", static_cast<double>(counted.unknown) / n}};
            line["build_stages_ms"] = ours.build_stages();
        }
        std::printf("%s\n", line.dump().c_str());
        std::fflush(stdout);
    }
}

void follow(const std::string& scene, const Trisect& ours, int rounds) {
    if (!ours.has_path()) return;
    json line = ours.follow(rounds);
    line["scene"] = scene;
    line["what"] = "coherent motion";
    line["engine"] = ours.name();
    std::printf("%s\n", line.dump().c_str());
    std::fflush(stdout);
}

void run(const std::string& name, const Options& options) {
    auto scene = interference_scenes::make(name, options.most);
    std::optional<Solid> left;
    if (!scene.tools.empty()) {
        left = Solid::from_mesh(scene.blank);
        for (const auto& tool : scene.tools) left = evaluate(*left - Solid::from_mesh(tool));
        scene.a = left->to_mesh();
    }
    Trisect ours(scene);
    interference_peers::Peers peers;
    if (options.peers) {
        interference_peers::add_fcl(peers, scene.a, scene.b, scene.placements);
        interference_peers::add_cgal(peers, scene.a, scene.b, scene.placements);
    }
    Solids solids(ours);
    OwnTrees fresh("Trisect solids", Solid::from_mesh(scene.a), scene);
    std::optional<OwnTrees> cut;
    if (left) cut.emplace("Trisect result", *left, scene);
    std::vector<Peer*> all{&ours, &solids};
    if (options.trees) all.push_back(&fresh);
    if (options.trees && cut) all.push_back(&*cut);
    for (const auto& p : peers) all.push_back(p.get());
    const auto ask_all = [&](const std::string& what, const Question& question) {
        if (options.asks(what)) ask(scene, what, all, options.rounds, ours, question);
    };
    ask_all("collide",
            [](Peer& p, std::size_t i) -> std::optional<double> { return p.collide(i) ? 1 : 0; });
    if (options.asks("coherent")) follow(scene.name, ours, options.rounds);
    ask_all("contacts", [](Peer& p, std::size_t i) -> std::optional<double> {
        const auto n = p.contacts(i);
        if (!n) return {};
        return static_cast<double>(*n);
    });
    ask_all("distance", [](Peer& p, std::size_t i) -> std::optional<double> {
        const auto d = p.distance(i);
        if (!d) return {};
        return std::max(*d, 0.0);
    });
}

Options parse(int argc, char** argv) {
    Options o;
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        if (word == "--no-peers") {
            o.peers = false;
        } else if (word == "--trees") {
            o.trees = true;
        } else if (word == "--rounds" && i + 1 < argc) {
            o.rounds = std::atoi(argv[++i]);
        } else if (word == "--most" && i + 1 < argc) {
            o.most = static_cast<std::size_t>(std::atoll(argv[++i]));
        } else if (word == "--scene" && i + 1 < argc) {
            o.scenes.emplace_back(argv[++i]);
        } else if (word == "--what" && i + 1 < argc) {
            o.questions.emplace_back(argv[++i]);
        } else {
            std::fprintf(stderr,
                         "usage: compare_interference [--rounds N] [--most N] [--scene NAME]... "
                         "[--what QUESTION]... [--no-peers] [--trees]\n");
            std::exit(2);
        }
    }
    if (o.scenes.empty()) o.scenes = interference_scenes::names();
    return o;
}

}  // namespace

int main(int argc, char** argv) {
    const Options options = parse(argc, argv);
    int status = 0;
    for (const std::string& scene : options.scenes) try {
            run(scene, options);
        } catch (const std::exception& e) {
            std::fprintf(stderr, "compare_interference: %s: %s\n", scene.c_str(), e.what());
            status = 1;
        }
    return status;
}

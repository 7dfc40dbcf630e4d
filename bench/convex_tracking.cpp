// SPDX-License-Identifier: Apache-2.0
//
// What tracked features of convex polytopes cost, in counts and in time of one thread. Prints the
// tables of bench/results/hierarchies_convex.md:
//
//     convex_tracking [track] [branching] [beside] [schedule] [chain]
//
//   track      walks from the last features against walks from the first vertices, for polytopes of
//              20 to 2,000 points and three speeds
//   branching  trees of hulls with 2, 4, 8 and 16 children over the scenes of two solids
//   beside     the same scenes by volumes of other kinds
//   schedule   1,000 convex bodies: pairs tested by a schedule, answers against all pairs
//   chain      boxes along a chain against a sweep and a grid
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <functional>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <trisect/bsp/hierarchies/convex/convex_hull.h>
#include <trisect/bsp/hierarchies/convex/convex_parts_structure.h>
#include <trisect/bsp/hierarchies/convex/feature_walk.h>
#include <trisect/bsp/hierarchies/convex/sub_part_tracker.h>
#include <trisect/bsp/hierarchies/motion/contact_schedule.h>
#include <trisect/bsp/hierarchies/pairs/queries.h>
#include <trisect/bsp/hierarchies/structures.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>
#include <trisect/bsp/interference/scene/broad_phases.h>
#include <trisect/bsp/interference/scene/chain_boxes.h>

#include "scenes/scenes.h"

namespace {

using namespace trisect;
using namespace trisect::hierarchies;
using trisect::detail::BodyBox;

double now() {
    std::timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

unsigned long long n(std::uint64_t v) { return v; }

double each(std::uint64_t v, std::uint64_t of) {
    return static_cast<double>(v) / static_cast<double>(of);
}

ConvexPolytope ball(std::uint64_t seed, int count) {
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> normal;
    std::vector<LatticePoint> p;
    while (static_cast<int>(p.size()) < count) {
        const std::array<double, 3> v{normal(engine), normal(engine), normal(engine)};
        const double length = std::hypot(v[0], v[1], v[2]);
        const auto c = [&](double t) { return std::llround(t / length * (1 << 20)); };
        p.push_back({c(v[0]), c(v[1]), c(v[2])});
    }
    return convex_hull(p, {});
}

void track() {
    std::printf(
        "| points | degrees a frame | steps | exact signs | us a frame | from anywhere: "
        "steps | us |\n|---|---|---|---|---|---|---|\n");
    for (const int points : {20, 60, 200, 600, 2000}) {
        const ConvexPolytope a = ball(1, points);
        const ConvexPolytope b = ball(2, points);
        for (const double speed : {0.1, 1.0, 10.0}) {
            constexpr int frames = 2000;
            std::vector<std::array<Pose, 2>> poses;
            for (int i = 0; i < frames; ++i) {
                const double angle = speed * i * 3.14159265358979 / 180;
                const auto turn = [&](double x, double y, double z, double by) {
                    const double s = std::sin(by / 2) / std::hypot(x, y, z);
                    const auto q = [](double v) { return std::llround(v * (1 << 20)); };
                    return std::array<std::int64_t, 4>{q(std::cos(by / 2)), q(s * x), q(s * y),
                                                       q(s * z)};
                };
                const double r = 2.1 * (1 << 20);
                poses.push_back(
                    {Pose::from_quaternion(turn(1, 2, 3, angle)),
                     Pose::from_quaternion(turn(3, -1, 1, 0.7 * angle),
                                           {r * std::cos(angle), r * std::sin(angle), 0.1 * r})});
            }
            std::array<WalkCounts, 2> counts;
            std::array<double, 2> seconds{};
            for (std::size_t cold = 0; cold < 2; ++cold) {
                FeaturePair pair;
                const double start = now();
                for (const auto& [pose_a, pose_b] : poses) {
                    const CommonFrame frame(pose_a, {}, a.largest(), pose_b, {}, b.largest());
                    FeatureWalk walk(a, b, frame, &counts[cold]);
                    const FeaturePair end = walk.run(pair).pair;
                    if (cold == 0) pair = end;
                }
                seconds[cold] = now() - start;
            }
            std::printf("| %d | %.1f | %.2f | %.4f | %.2f | %.1f | %.2f |\n", points, speed,
                        each(counts[0].steps, frames), each(counts[0].exact_signs, frames),
                        seconds[0] * 1e6 / frames, each(counts[1].steps, frames),
                        seconds[1] * 1e6 / frames);
        }
    }
}

void branching() {
    std::printf(
        "| scene | children | build ms | MB | hulls | levels | parts | faces: walks | ms | "
        "closest: walks | ms | tracker: walks | accepted | ms |\n"
        "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
    for (const std::string& name : scenes::pair_scene_names()) {
        const auto scene = scenes::make_pair_scene(name, scenes::Size::Small);
        if (!scene) continue;
        const InterferenceModel a(Solid::from_mesh(scene->a));
        const InterferenceModel b(Solid::from_mesh(scene->b));
        for (const std::uint32_t children : {2U, 4U, 8U, 16U}) {
            const auto s = make_convex_parts(a, b, {children, 4});
            const HullTree ta(a, {children, 1});
            const HullTree tb(b, {children, 1});
            SubPartTracker tracker(a, ta, b, tb);
            CostCounters faces;
            CostCounters nearest;
            SubPartCounts tracked;
            std::array<double, 3> seconds{};
            const std::size_t frames = std::min<std::size_t>(scene->frames.size(), 40);
            for (std::size_t f = 0; f < frames; ++f) {
                const Pose pose = scenes::pose_of(scene->frames[f]);
                double start = now();
                s->place(Pose(), pose, faces);
                const bool meet = !meeting_faces(*s, faces).empty();
                seconds[0] += now() - start;
                start = now();
                (void)distance(*s, nearest);
                seconds[1] += now() - start;
                start = now();
                tracker.update(Pose(), pose);
                seconds[2] += now() - start;
                tracked.walks.walks += tracker.counts().walks.walks;
                tracked.accepted += tracker.counts().accepted;
                if (tracker.meet() != meet) std::printf("DISAGREEMENT in frame %zu\n", f);
            }
            const BuildReport r = s->build_report();
            std::printf(
                "| %s | %u | %.0f | %.1f | %zu | %u | %zu + %zu | %.0f | %.2f | %.0f | "
                "%.2f | %.0f | %.0f | %.2f |\n",
                name.c_str(), children, r.seconds * 1e3, static_cast<double>(r.bytes) / 1048576,
                r.volumes, r.depth, ta.part_count(), tb.part_count(),
                each(faces.volume_tests, frames), seconds[0] * 1e3 / static_cast<double>(frames),
                each(nearest.volume_tests, frames), seconds[1] * 1e3 / static_cast<double>(frames),
                each(tracked.walks.walks, frames), each(tracked.accepted, frames),
                seconds[2] * 1e3 / static_cast<double>(frames));
            std::fflush(stdout);
        }
    }
}

void beside() {
    std::printf(
        "| scene | structure | build ms | faces: volumes | ms | closest: volumes | ms |\n"
        "|---|---|---|---|---|---|---|\n");
    for (const std::string& name : scenes::pair_scene_names()) {
        const auto scene = scenes::make_pair_scene(name, scenes::Size::Small);
        if (!scene) continue;
        const InterferenceModel a(Solid::from_mesh(scene->a));
        const InterferenceModel b(Solid::from_mesh(scene->b));
        const std::size_t frames = std::min<std::size_t>(scene->frames.size(), 40);
        for (const StructureKind kind : {StructureKind::Aabb, StructureKind::Kdop18,
                                         StructureKind::ObbWide, StructureKind::ConvexParts}) {
            const auto s = make_structure(kind, a, b);
            CostCounters faces;
            CostCounters nearest;
            std::array<double, 2> seconds{};
            for (std::size_t f = 0; f < frames; ++f) {
                const Pose pose = scenes::pose_of(scene->frames[f]);
                double start = now();
                s->place(Pose(), pose, faces);
                (void)meeting_faces(*s, faces);
                seconds[0] += now() - start;
                start = now();
                (void)distance(*s, nearest);
                seconds[1] += now() - start;
            }
            std::printf(
                "| %s | %s | %.0f | %.0f | %.2f | %.0f | %.2f |\n", name.c_str(),
                std::string(s->name()).c_str(), s->build_report().seconds * 1e3,
                each(faces.volume_tests, frames), seconds[0] * 1e3 / static_cast<double>(frames),
                each(nearest.volume_tests, frames), seconds[1] * 1e3 / static_cast<double>(frames));
            std::fflush(stdout);
        }
    }
}

BodyBox box_of(const ConvexPolytope& p) {
    BodyBox r;
    for (std::size_t k = 0; k < 3; ++k) {
        r.lo[k] = std::numeric_limits<double>::infinity();
        r.hi[k] = -r.lo[k];
        for (const auto& v : p.vertices()) {
            const double c = p.lattice().to_double(v[static_cast<int>(k)].to_double());
            r.lo[k] = std::min(r.lo[k], c);
            r.hi[k] = std::max(r.hi[k], c);
        }
    }
    return r;
}

using BodyPairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

// The scene of 1,000 convex bodies.
struct Swarm {
    std::vector<ConvexPolytope> shapes;
    std::vector<double> shape_radius;  // of a ball about the origin that contains the shape
    std::vector<std::size_t> shape_of;
    std::vector<std::vector<Pose>> poses;  // of each frame

    Swarm() {
        const auto scene = scenes::make_swarm_scene("convex", scenes::Size::Full);
        for (const PolygonMesh& m : scene.shapes) {
            const InterferenceModel model(Solid::from_mesh(m));
            const auto points = model.brep().points();
            shapes.push_back(enclosing_hull({points.begin(), points.end()}, model.lattice()));
            double most = 0;
            for (const auto& p : m.points) most = std::max(most, std::hypot(p[0], p[1], p[2]));
            shape_radius.push_back(most * (1 + 1e-12));
        }
        shape_of.assign(scene.shape_of.begin(), scene.shape_of.end());
        for (const auto& frame : scene.frames) {
            poses.emplace_back();
            for (const auto& rows : frame) poses.back().push_back(scenes::pose_of(rows));
        }
    }
    [[nodiscard]] std::uint32_t bodies() const {
        return static_cast<std::uint32_t>(shape_of.size());
    }
    [[nodiscard]] std::size_t frames() const { return poses.size(); }
    [[nodiscard]] const ConvexPolytope& shape(std::uint32_t body) const {
        return shapes[shape_of[body]];
    }
    [[nodiscard]] double radius(std::uint32_t body) const { return shape_radius[shape_of[body]]; }
    [[nodiscard]] Point3d center(std::size_t frame, std::uint32_t body) const {
        const auto& p = poses[frame][body].approximate();
        return {p[3], p[7], p[11]};
    }
    // The largest displacement of a body between two frames.
    [[nodiscard]] std::vector<double> speeds() const {
        std::vector<double> r(bodies(), 0);
        for (std::uint32_t i = 0; i < bodies(); ++i)
            for (std::size_t f = 1; f < frames(); ++f)
                r[i] = std::max(r[i],
                                displacement_bound(box_of(shape(i)), poses[f - 1][i], poses[f][i]));
        return r;
    }
    // A lower bound of the distance by balls: centres are translations, known within 2^-50 of
    // themselves.
    [[nodiscard]] double gap_of_balls(std::size_t frame, std::uint32_t i, std::uint32_t j) const {
        const Point3d p = center(frame, i);
        const Point3d q = center(frame, j);
        return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]) * (1 - 1e-12) - 1e-9 -
               1.000001 * (radius(i) + radius(j));
    }
    [[nodiscard]] CommonFrame common_frame(std::size_t frame, std::uint32_t i,
                                           std::uint32_t j) const {
        const ConvexPolytope& a = shape(i);
        const ConvexPolytope& b = shape(j);
        return CommonFrame(poses[frame][i], a.lattice(), a.largest(), poses[frame][j], b.lattice(),
                           b.largest());
    }
    [[nodiscard]] BodyBox box(std::size_t frame, std::uint32_t body) const {
        BodyBox r;
        const Point3d c = center(frame, body);
        const double reach = 1.000001 * radius(body);
        for (std::size_t k = 0; k < 3; ++k) {
            r.lo[k] = c[k] - reach;
            r.hi[k] = c[k] + reach;
        }
        return r;
    }
};

struct ScheduleCost {
    std::size_t pairs = 0;
    std::uint64_t first = 0;  // tests of the first frame
    std::uint64_t tests = 0;  // of all others
    std::uint64_t balls = 0;
    WalkCounts walks;
    double seconds = 0;            // of all frames but the first
    std::vector<BodyPairs> found;  // in contact, of each frame
};

// Pairs are tested when they are due: balls first, then a walk from the last features.
ScheduleCost run_schedule(const Swarm& swarm) {
    ScheduleCost r;
    ContactSchedule schedule(swarm.speeds());
    r.pairs = schedule.pair_count();
    std::vector<FeaturePair> last(r.pairs);
    r.found.resize(swarm.frames());
    for (std::size_t f = 0; f < swarm.frames(); ++f) {
        const auto test = [&](std::uint32_t i, std::uint32_t j) {
            if (const double d = swarm.gap_of_balls(f, i, j); d > 0) {
                ++r.balls;
                return d;
            }
            const CommonFrame frame = swarm.common_frame(f, i, j);
            FeatureWalk walk(swarm.shape(i), swarm.shape(j), frame, &r.walks);
            FeaturePair& pair = last[std::size_t{j} * (j - 1) / 2 + i];
            const WalkEnd& end = walk.run(pair);
            pair = end.pair;
            if (end.meet) r.found[f].emplace_back(i, j);
            return walk.bounds().lower;
        };
        const double start = now();
        const std::size_t tested = schedule.due(static_cast<double>(f), test);
        if (f > 0) r.seconds += now() - start;
        (f == 0 ? r.first : r.tests) += tested;
        std::sort(r.found[f].begin(), r.found[f].end());
    }
    return r;
}

struct SweepCost {
    std::uint64_t tests = 0;
    std::uint64_t met = 0;
    double seconds = 0;  // all of frames but the first
};

// What a sweep over boxes around the balls leaves, and takes.
SweepCost run_sweep(const Swarm& swarm) {
    SweepCost r;
    const auto sweep = trisect::detail::make_sweep_and_prune();
    std::vector<trisect::detail::BodyPair> met;
    for (std::size_t f = 0; f < swarm.frames(); ++f) {
        const double start = now();
        for (std::uint32_t i = 0; i < swarm.bodies(); ++i)
            f == 0 ? sweep->insert(i, swarm.box(f, i)) : sweep->update(i, swarm.box(f, i));
        sweep->pairs(met);
        if (f == 0) continue;
        r.seconds += now() - start;
        r.tests += sweep->work().box_tests;
        r.met += met.size();
    }
    return r;
}

// All pairs, walked, in every sixth frame; a rotation of doubles keeps lengths but for 1e-6. Says
// how many pairs there were.
std::uint64_t compare_with_all_pairs(const Swarm& swarm, const std::vector<BodyPairs>& found) {
    std::uint64_t compared = 0;
    for (std::size_t f = 0; f < swarm.frames(); f += 6) {
        BodyPairs all;
        for (std::uint32_t j = 1; j < swarm.bodies(); ++j)
            for (std::uint32_t i = 0; i < j; ++i, ++compared) {
                const CommonFrame frame = swarm.common_frame(f, i, j);
                FeatureWalk walk(swarm.shape(i), swarm.shape(j), frame);
                if (walk.run().meet) all.emplace_back(i, j);
            }
        std::sort(all.begin(), all.end());
        if (all != found[f]) std::printf("DISAGREEMENT in frame %zu\n", f);
    }
    return compared;
}

void schedule() {
    const Swarm swarm;
    const std::size_t frames = swarm.frames();
    const ScheduleCost s = run_schedule(swarm);
    const SweepCost sweep = run_sweep(swarm);
    const std::uint64_t compared = compare_with_all_pairs(swarm, s.found);
    std::uint64_t contacts = 0;
    for (const BodyPairs& found : s.found) contacts += found.size();
    const std::uint64_t pairs = s.pairs * (frames - 1);
    std::printf("%u bodies, %zu frames, %llu contacts\n", swarm.bodies(), frames, n(contacts));
    std::printf("  first frame: %llu tests of %zu pairs\n", n(s.first), s.pairs);
    std::printf("  then: %llu tests of %llu pairs (%.2f %% saved), %.0f a frame, %.0f us a frame\n",
                n(s.tests), n(pairs), 100 * (1 - each(s.tests, pairs)), each(s.tests, frames - 1),
                s.seconds * 1e6 / static_cast<double>(frames - 1));
    std::printf("  all tests: %llu by balls, %llu walks of %.2f steps\n", n(s.balls),
                n(s.walks.walks), each(s.walks.steps, s.walks.walks));
    std::printf("  a sweep: %.0f tests of boxes a frame, %.0f pairs meet, %.0f us a frame\n",
                each(sweep.tests, frames - 1), each(sweep.met, frames - 1),
                sweep.seconds * 1e6 / static_cast<double>(frames - 1));
    std::printf("  %llu pairs of every sixth frame walked one by one: compared\n", n(compared));
}

// A snake that coils: links bend more and more, in a helix.
std::vector<BodyBox> snake(std::size_t links, double bend) {
    std::vector<BodyBox> r;
    std::array<double, 3> p{};
    for (std::size_t i = 0; i < links; ++i) {
        const double a = bend * static_cast<double>(i);
        const std::array<double, 3> q{p[0] + std::cos(a), p[1] + std::sin(a), p[2] + 0.02};
        BodyBox box;
        for (std::size_t k = 0; k < 3; ++k) {
            box.lo[k] = std::min(p[k], q[k]) - 0.1;
            box.hi[k] = std::max(p[k], q[k]) + 0.1;
        }
        r.push_back(box);
        p = q;
    }
    return r;
}

void chain() {
    std::printf(
        "| links | boxes | tests a frame | refits or moves a frame | us a frame |\n"
        "|---|---|---|---|---|\n");
    struct Kind {
        const char* name;
        std::unique_ptr<trisect::detail::BroadPhase> (*make)();
    };
    for (const std::size_t links : {64U, 256U, 1024U, 4096U})
        for (const Kind& kind :
             {Kind{"chain", make_chain_boxes}, Kind{"sweep", trisect::detail::make_sweep_and_prune},
              Kind{"hash grid", make_hash_grid}, Kind{"R-tree", trisect::detail::make_box_tree}}) {
            const auto phase = kind.make();
            auto boxes = snake(links, 0);
            for (std::uint32_t i = 0; i < links; ++i) phase->insert(i, boxes[i]);
            std::vector<trisect::detail::BodyPair> pairs;
            phase->pairs(pairs);
            constexpr int frames = 200;
            std::uint64_t tests = 0;
            std::uint64_t moves = 0;
            double seconds = 0;
            for (int f = 1; f <= frames; ++f) {
                boxes = snake(links, 0.0005 * f);
                const double start = now();
                for (std::uint32_t i = 0; i < links; ++i) phase->update(i, boxes[i]);
                phase->pairs(pairs);
                seconds += now() - start;
                tests += phase->work().box_tests;
                moves += phase->work().moves;
            }
            std::printf("| %zu | %s | %.0f | %.0f | %.0f |\n", links, kind.name,
                        each(tests, frames), each(moves, frames), seconds * 1e6 / frames);
        }
}

}  // namespace

int main(int argc, char** argv) {
    const std::vector<std::string> wanted(argv + 1, argv + argc);
    const std::vector<std::pair<std::string, std::function<void()>>> all{{"track", track},
                                                                         {"branching", branching},
                                                                         {"beside", beside},
                                                                         {"schedule", schedule},
                                                                         {"chain", chain}};
    for (const auto& [name, run] : all)
        if (wanted.empty() || std::find(wanted.begin(), wanted.end(), name) != wanted.end()) run();
}

// SPDX-License-Identifier: Apache-2.0
//
// feature_walk_campaign: random pairs of convex polytopes on a small grid, where parallel faces and
// edges abound. Each is walked from two starts; both must end, at the same distance, with a pair
// that is proved to be the closest one (or a common point) in fractions, and every hundredth pair
// is compared with all pairs of features. Exits with 1 at the first difference.
//
//     feature_walk_campaign [--pairs N] [--seed S]

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>

#include <trisect/bsp/hierarchies/convex/feature_walk.h>

#include "support/convex_oracle.h"

namespace {

using convex_oracle::Engine;
using convex_oracle::Scene;
using trisect::Pose;
using namespace trisect::hierarchies;

struct Totals {
    std::uint64_t meeting = 0;
    std::uint64_t parallel = 0;
    std::uint64_t compared = 0;
    std::uint64_t flat = 0;
    std::uint32_t most_steps = 0;
};

PolytopeFeature random_feature(Engine& engine, const ConvexPolytope& p) {
    const std::size_t v = p.vertices().size();
    const std::size_t e = p.edges().size();
    std::size_t i = engine() % (v + e + p.face_count());
    if (i < v) return PolytopeFeature::vertex(i);
    if (i < v + e) return PolytopeFeature::edge(i - v);
    return PolytopeFeature::face(i - v - e);
}

bool is_right(std::uint64_t seed, Totals& totals, WalkCounts& counts) {
    Engine engine(seed);
    const int reach = 2 + static_cast<int>(engine() % 6);
    const ConvexPolytope a = convex_oracle::random_polytope(engine, reach);
    const ConvexPolytope b = convex_oracle::random_polytope(engine, reach);
    // Half of the pairs share a turn, so that what was parallel is so still.
    Pose pose_a = convex_oracle::random_pose(engine, 2 * reach);
    Pose pose_b = convex_oracle::random_pose(engine, 2 * reach);
    if (engine() % 2 == 0) {
        const auto far = [&] {
            return 0.5 * static_cast<double>(engine() % static_cast<unsigned>(16 * reach)) -
                   4.0 * reach;
        };
        pose_b = pose_a * Pose::from_translation({far(), far(), far()});
    }
    const CommonFrame frame(pose_a, a.lattice(), a.largest(), pose_b, b.lattice(), b.largest());
    FeatureWalk walk(a, b, frame, &counts);
    FeatureWalk other(a, b, frame, &counts);
    walk.run();
    other.run({random_feature(engine, a), random_feature(engine, b)});
    totals.most_steps = std::max({totals.most_steps, walk.closest().steps, other.closest().steps});
    if (a.dimension() < 3 || b.dimension() < 3) ++totals.flat;
    if (walk.closest().meet != other.closest().meet) return false;
    const Scene scene(a, pose_a, b, pose_b);
    if (walk.closest().meet) {
        ++totals.meeting;
        return scene.proves_meeting(walk.closest().pair) &&
               scene.proves_meeting(other.closest().pair);
    }
    const auto squared = walk.squared_distance();
    bool parallel = false;
    if (other.squared_distance() != squared) return false;
    if (!scene.proves_least(walk.closest().pair, squared, &parallel)) return false;
    if (parallel) ++totals.parallel;
    const FeaturePair smallest = walk.smallest_pair();
    if (other.smallest_pair() != smallest) return false;
    if (seed % 100 != 0) return true;
    ++totals.compared;
    const auto least = scene.least();
    return least.squared == squared && least.pair == smallest;
}

struct Options {
    std::uint64_t pairs = 1'000'000;
    std::uint64_t seed = 1;
};

bool parse(int argc, char** argv, Options& o) {
    for (int i = 1; i + 1 < argc; i += 2) {
        const std::string name = argv[i];
        if (name == "--pairs")
            o.pairs = std::strtoull(argv[i + 1], nullptr, 10);
        else if (name == "--seed")
            o.seed = std::strtoull(argv[i + 1], nullptr, 10);
        else
            return false;
    }
    return argc % 2 == 1;
}

int run(const Options& o) {
    const auto start = std::chrono::steady_clock::now();
    const auto n = [](std::uint64_t v) { return static_cast<unsigned long long>(v); };
    Totals totals;
    WalkCounts counts;
    for (std::uint64_t s = o.seed; s < o.seed + o.pairs; ++s)
        if (!is_right(s, totals, counts)) {
            std::printf("seed %llu: WRONG\n", n(s));
            return 1;
        }
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    std::printf("%llu pairs, seeds %llu to %llu, all right; %.0f s\n", n(o.pairs), n(o.seed),
                n(o.seed + o.pairs - 1), seconds.count());
    std::printf("  meeting              %llu\n", n(totals.meeting));
    std::printf("  closest and parallel %llu\n", n(totals.parallel));
    std::printf("  not solid            %llu\n", n(totals.flat));
    std::printf("  against all pairs    %llu\n", n(totals.compared));
    std::printf("  walks %llu, steps %llu, the longest %llu\n", n(counts.walks), n(counts.steps),
                n(totals.most_steps));
    std::printf("  signs %llu, by integers %llu\n", n(counts.signs), n(counts.exact_signs));
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    if (!parse(argc, argv, options)) {
        std::fprintf(stderr, "usage: feature_walk_campaign [--pairs N] [--seed S]\n");
        return 2;
    }
    try {
        return run(options);
    } catch (const std::exception& e) {
        std::fprintf(stderr, "%s\n", e.what());
        return 1;
    }
}

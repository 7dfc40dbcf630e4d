// SPDX-License-Identifier: Apache-2.0
//
// A scene of many bodies: a pallet of bricks that stand flush on each other, and a beam that swings
// through them. Bricks touch, and touching is told from overlapping without any tolerance, also
// after the whole pallet was turned.
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <map>
#include <vector>

#include <trisect/brep/primitives/box.h>
#include <trisect/trisect.h>

namespace {

using trisect::BodyId;
using trisect::Diagnostics;
using trisect::InterferenceModel;
using trisect::Pose;
using trisect::Relation;
using trisect::Scene;
using trisect::SceneCounters;
using trisect::Solid;

InterferenceModel block(double x, double y, double z) {
    return InterferenceModel(Solid::from_mesh(trisect::make_box({x, y, z})));
}

/// Stops when an answer is not the one that was foreseen.
void expect(bool holds, const char* what) {
    if (holds) return;
    std::cerr << "unexpected: " << what << '\n';
    std::exit(1);
}

}  // namespace

int main() {
    // 5 x 5 x 4 bricks of 2 x 1 x 1 side by side and on top of each other. One model for all.
    const InterferenceModel brick = block(2, 1, 1);
    Scene scene;
    std::vector<BodyId> bricks;
    std::vector<Pose> places;
    for (int z = 0; z < 4; ++z) {
        for (int y = 0; y < 5; ++y) {
            for (int x = 0; x < 5; ++x) {
                places.push_back(Pose::from_translation({2.0 * x, 1.0 * y, 1.0 * z}));
                bricks.push_back(scene.add(brick, places.back()));
            }
        }
    }
    auto pairs = scene.interfering();
    std::cout << bricks.size() << " bricks, " << pairs.size() << " pairs touch\n";
    for (const auto& pair : pairs) expect(pair.relation == Relation::Touching, "bricks only touch");
    // By faces, edges and corners. Along a row of 5 each brick is near itself and its neighbours,
    // 13 in all, along one of 4 it is 10; a hundred of them are with itself, and the rest twice.
    const std::size_t touching = pairs.size();
    expect(touching == (13 * 13 * 10 - 100) / 2, "the number of pairs");

    // Turn all of them by the angle with cosine 3/5 about z: an exact rotation, so nothing opens
    // and nothing overlaps. A matrix of doubles could not say this.
    const Pose turn = Pose::from_quaternion({2, 0, 0, 1});
    for (std::size_t i = 0; i < bricks.size(); ++i) scene.set_pose(bricks[i], turn * places[i]);
    pairs = scene.interfering();
    expect(pairs.size() == touching, "turned bricks touch as before");

    // A beam sweeps over the top layer and then through it. Only what moves is asked about.
    const BodyId beam = scene.add(block(1, 20, 1), turn * Pose::from_translation({-3, -8, 4}));
    for (int step = 0; step <= 8; ++step) {
        const double height = 4 - 0.125 * step;
        scene.set_pose(beam, turn * Pose::from_translation({-3.0 + step, -8, height}));
        std::map<Relation, int> count;
        const Diagnostics<SceneCounters> diagnostics;
        for (const auto& pair : scene.interfering())
            if (pair.b == beam) ++count[pair.relation];
        std::cout << "step " << step << ": the beam touches " << count[Relation::Touching]
                  << " and cuts " << count[Relation::Overlapping] << " bricks; "
                  << diagnostics.counters().kept << " pairs were known, "
                  << diagnostics.counters().asked << " asked\n";
    }
    return 0;
}

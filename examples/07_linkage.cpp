// SPDX-License-Identifier: Apache-2.0
//
// An articulated arm: a base, two arms on revolute joints and a rod that slides out of the second
// one. Joints turn by exact rational rotations, so the arm can reach out and touch a wall, not
// nearly but exactly, and the next smallest step is an overlap.
#include <array>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <string>

#include <trisect/brep/primitives/box.h>
#include <trisect/trisect.h>

namespace {

using trisect::BodyId;
using trisect::InterferenceModel;
using trisect::Joint;
using trisect::Pose;
using trisect::Ratio;
using trisect::Relation;
using trisect::Scene;
using trisect::Solid;

InterferenceModel block(const trisect::Point3d& low, const trisect::Point3d& high) {
    return InterferenceModel(Solid::from_mesh(trisect::make_box(low, high)));
}

void expect(bool holds, const char* what) {
    if (holds) return;
    std::cerr << "unexpected: " << what << '\n';
    std::exit(1);
}

}  // namespace

int main() {
    Scene scene;
    const BodyId base = scene.add(block({-2, -2, 0}, {2, 2, 1}));

    // The upper arm stands on the base and turns about y; the forearm turns about y at its end.
    trisect::LinkOptions shoulder;
    shoulder.mount = Pose::from_translation({0, 0, 1});
    const BodyId upper = scene.add_link(base, block({-0.5, -0.5, 0}, {0.5, 0.5, 10}),
                                        Joint::revolute({0, 0, 0}, {0, 1, 0}), shoulder);
    trisect::LinkOptions elbow;
    elbow.mount = Pose::from_translation({0, 0, 10});
    const BodyId forearm = scene.add_link(upper, block({-0.5, -0.5, 0}, {0.5, 0.5, 8}),
                                          Joint::revolute({0, 0, 0}, {0, 1, 0}), elbow);
    const BodyId rod = scene.add_link(forearm, block({-0.25, -0.25, 0}, {0.25, 0.25, 8}),
                                      Joint::prismatic({0, 0, 1}));
    // Drawn in, the rod reaches into the upper arm; that is how it is built.
    scene.ignore(rod, upper);

    // tan(a / 2) = 1/2 at the shoulder: cos a = 3/5. The elbow takes the rest of a right angle,
    // tan(b / 2) = 1/3 because tan(a / 2 + b / 2) = 1. So the forearm lies level.
    scene.set_joint(upper, {1, 2});
    scene.set_joint(forearm, {1, 3});
    const std::array<double, 12> at = scene.pose(forearm).approximate();
    std::cout << "the elbow is at " << at[3] << ", " << at[7] << ", " << at[11] << '\n';
    expect(at[3] == 8 && at[11] == 7, "the elbow stands over (8, 0) at a height of 7");

    // A wall 20 away. The rod is 8 long and slides by fractions: 8 + 8 + 4 = 20.
    const BodyId wall = scene.add(block({20, -5, 0}, {21, 5, 12}));
    const auto reach = [&](Ratio value) {
        scene.set_joint(rod, value);
        trisect::SceneQueryOptions options;
        options.contacts = true;
        const auto pairs = scene.interfering(options);
        std::cout << "slide " << value.numerator << "/" << value.denominator << ": ";
        for (const auto& pair : pairs) {
            const bool touches = pair.relation == Relation::Touching;
            expect(pair.a == rod && pair.b == wall, "only the rod meets the wall");
            std::cout << (touches ? "touches" : "enters") << " the wall, " << pair.contacts.size()
                      << " contacts\n";
            return pair.relation;
        }
        std::cout << "free\n";
        return Relation::Disjoint;
    };
    expect(reach({11, 3}) == Relation::Disjoint, "short of the wall");
    expect(reach({4, 1}) == Relation::Touching, "flush with the wall");
    expect(reach({(std::int64_t{4} << 40) + 1, std::int64_t{1} << 40}) == Relation::Overlapping,
           "a trillionth more");

    // Angles that are not made of small numbers are met as closely as one pays for in bits.
    scene.set_joint(rod, {0, 1});
    const Ratio twenty = scene.joint(upper).value_near(20);
    scene.set_joint(upper, twenty);
    std::cout << "tan 10 degrees as " << twenty.numerator << "/" << twenty.denominator << '\n';
    expect(scene.interfering().empty(), "free again");
    return 0;
}

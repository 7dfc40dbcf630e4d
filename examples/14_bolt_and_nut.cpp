// SPDX-License-Identifier: Apache-2.0
//
// A threaded bolt and its nut. The nut fits where the threads mesh, and after a turn if it has
// moved on by its share of the pitch; turned without that it would cut into the bolt.
#include <cmath>
#include <cstdlib>
#include <iostream>

#include <trisect/brep/primitives/prism.h>
#include <trisect/bsp/interference/solid_interference.h>
#include <trisect/trisect.h>

namespace {

using namespace trisect;

constexpr double pi = 3.14159265358979323846;
constexpr double pitch = 2;
constexpr int sides = 24;
constexpr int layers_a_turn = 24;

void expect(bool holds, const char* what) {
    if (holds) return;
    std::cerr << "unexpected: " << what << '\n';
    std::exit(1);
}

// A circle off the axis that turns while it rises: a thread whose depth is twice the distance.
Solid thread(double radius, double depth, double low, int turns) {
    PolygonMesh mesh;
    const auto layers = static_cast<std::uint32_t>(turns * layers_a_turn);
    for (std::uint32_t k = 0; k <= layers; ++k) {
        const double phase = 2 * pi * k / layers_a_turn;
        for (int i = 0; i < sides; ++i) {
            const double angle = 2 * pi * i / sides;
            mesh.points.push_back({depth / 2 * std::cos(phase) + radius * std::cos(angle),
                                   depth / 2 * std::sin(phase) + radius * std::sin(angle),
                                   low + pitch * k / layers_a_turn});
        }
    }
    std::vector<std::uint32_t> bottom;
    std::vector<std::uint32_t> top;
    for (std::uint32_t i = 0; i < sides; ++i) {
        bottom.push_back(sides - 1 - i);
        top.push_back(layers * sides + i);
        for (std::uint32_t k = 0; k < layers; ++k) {
            const std::uint32_t a = k * sides + i;
            const std::uint32_t b = k * sides + (i + 1) % sides;
            mesh.add_triangle(a, b, b + sides);
            mesh.add_triangle(a, b + sides, a + sides);
        }
    }
    mesh.add_face(bottom);
    mesh.add_face(top);
    return Solid::from_mesh(mesh);
}

Solid hexagon(double radius, double low, double height) {
    Outline corners;
    for (int i = 0; i < 6; ++i)
        corners.push_back({radius * std::cos(pi * i / 3), radius * std::sin(pi * i / 3)});
    return transformed(Solid::from_mesh(make_prism(corners, height)),
                       AffineMap::translation({0, 0, low}));
}

}  // namespace

int main() {
    const Solid bolt = evaluate(hexagon(9, -5, 5) | thread(5, 1, -1, 12));
    // Threads in step with the bolt's: the bore begins whole turns away.
    const Solid nut = evaluate(hexagon(9, 9, 6) - thread(5.1, 1, 5, 8));
    expect(interfere(bolt, Pose(), nut, Pose()).relation == Relation::Disjoint, "the nut fits");

    // A turn by the angle with the tangent 4/3: exact, as a quaternion.
    const Pose turn = Pose::from_quaternion({2, 0, 0, 1});
    const double rise = pitch * std::atan2(4, 3) / (2 * pi);
    const Pose screwed = Pose::from_translation({0, 0, rise}) * turn;
    expect(interfere(bolt, Pose(), nut, screwed).relation == Relation::Disjoint,
           "the nut goes on when it is turned");
    expect(interfere(bolt, Pose(), nut, turn).relation == Relation::Overlapping,
           "and is held when it is only turned");
    expect(interfere(bolt, Pose(), nut, Pose::from_translation({0, 0, 1})).relation ==
               Relation::Overlapping,
           "or only pulled");
    std::cout << "bolt " << volume(bolt) << ", nut " << volume(nut) << ": they fit\n";
    write_mesh("bolt.stl", bolt.to_mesh());
    write_mesh("nut.stl", nut.to_mesh());
    return 0;
}

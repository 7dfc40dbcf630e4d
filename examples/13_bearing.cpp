// SPDX-License-Identifier: Apache-2.0
//
// A ball bearing: two rings with a groove and seven balls. Nothing touches, the play is a certified
// interval, and the inner ring turns with its balls without a contact, which is proved.
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <vector>

#include <trisect/brep/primitives/sphere.h>
#include <trisect/brep/primitives/torus.h>
#include <trisect/bsp/interference/first_contact.h>
#include <trisect/bsp/interference/solid_interference.h>
#include <trisect/trisect.h>

namespace {

using namespace trisect;

constexpr double pi = 3.14159265358979323846;
constexpr int balls = 7;
constexpr double middle = 10;  // radius of the circle on which the balls run
constexpr double ball = 2.5;

void expect(bool holds, const char* what) {
    if (holds) return;
    std::cerr << "unexpected: " << what << '\n';
    std::exit(1);
}

Solid ring(double inner, double outer) {
    const Solid whole = revolution(
        region_of_outline({{inner, -3}, {outer, -3}, {outer, 3}, {inner, 3}}), {.segments = 60});
    // The groove is wider than the balls by the play.
    const Solid groove = Solid::from_mesh(make_torus(middle, ball + 0.1, 60, 40));
    return evaluate(whole - groove);
}

}  // namespace

int main() {
    const Solid inner = ring(5, 9);
    const Solid outer = ring(11, 15);
    const Solid one = Solid::from_mesh(make_icosphere(ball, 2));
    std::vector<Solid> all{inner, outer};
    for (int i = 0; i < balls; ++i) {
        const double angle = 2 * pi * i / balls;
        all.push_back(transformed(
            one, AffineMap::translation({middle * std::cos(angle), middle * std::sin(angle), 0})));
    }
    for (std::size_t i = 0; i < all.size(); ++i)
        for (std::size_t j = i + 1; j < all.size(); ++j)
            expect(interfere(all[i], Pose(), all[j], Pose()).relation == Relation::Disjoint,
                   "no two parts touch");
    const auto play = boundary_distance(inner, Pose(), all[2], Pose());
    std::cout << "play between " << play->lower << " and " << play->upper << '\n';

    // The inner ring turns by twice the angle whose tangent is 3 / 20, some 17 degrees.
    Screw screw;
    screw.turn = {20, 0, 0, 3};
    for (std::size_t i = 2; i < all.size(); ++i)
        expect(!first_contact(all[i], Motion(), inner, Motion::screw(Pose(), screw)).exists(),
               "the inner ring turns freely");
    std::cout << "the inner ring turns, proved\n";
    write_mesh(
        "bearing.stl",
        evaluate(Expression::any_of(std::vector<Expression>(all.begin(), all.end()))).to_mesh());
    return 0;
}

// SPDX-License-Identifier: Apache-2.0
//
// Two gears: how much play do they have? One is turned until its teeth touch those of the other,
// forwards and backwards; then both turn together. Times of contact are exact, and "no contact" is
// a proof, not a sample.
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <vector>

#include <trisect/brep/primitives/extrusion.h>
#include <trisect/bsp/interference/first_contact.h>
#include <trisect/bsp/interference/interference.h>
#include <trisect/trisect.h>

namespace {

using trisect::FirstContact;
using trisect::InterferenceModel;
using trisect::Motion;
using trisect::Point2d;
using trisect::Pose;
using trisect::Screw;
using trisect::Solid;

constexpr double pi = 3.14159265358979323846;
constexpr int teeth = 12;

// Trapezoids on a circle; the first tooth points along x.
Solid gear() {
    std::vector<Point2d> outline;
    const auto add = [&outline](double radius, double pitches) {
        const double angle = pitches * 2 * pi / teeth;
        outline.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    };
    for (int i = 0; i < teeth; ++i) {
        add(0.85, i - 0.32);
        add(1.12, i - 0.12);
        add(1.12, i + 0.12);
        add(0.85, i + 0.32);
    }
    return Solid::from_mesh(trisect::make_extrusion(outline, {}, 0, 0.5));
}

// A turn by twice the angle whose tangent is sense / 20, about an axis parallel to z.
Motion turn(const Pose& start, int sense, double x) {
    Screw screw;
    screw.turn = {20, 0, 0, sense};
    screw.center = {x, 0, 0};
    return Motion::screw(start, screw);
}

void expect(bool holds, const char* what) {
    if (holds) return;
    std::cerr << "unexpected: " << what << '\n';
    std::exit(1);
}

// The angle of `turn` at a contact.
double degrees_at(const FirstContact& c, int sense) {
    return 2 * std::atan(sense * c.time->to_double() / 20) * 180 / pi;
}

}  // namespace

int main() {
    const InterferenceModel model(gear());
    // The second gear stands at distance 2, turned by half a tooth, nearly: a rational rotation.
    const Pose second =
        Pose::from_translation({2, 0, 0}) * Pose::from_quaternion({7596, 0, 0, 1000});
    const auto at_start = interfere(model, Pose(), model, second).relation;
    std::cout << "at the start the gears are " << to_string(at_start) << '\n';
    expect(at_start == trisect::Relation::Disjoint, "gears that begin apart");

    const FirstContact forwards = first_contact(model, Motion(), model, turn(second, 3, 2));
    const FirstContact backwards = first_contact(model, Motion(), model, turn(second, -3, 2));
    expect(forwards.exists() && backwards.exists(), "teeth that meet");
    std::cout << "play: " << degrees_at(forwards, 3) << " degrees forwards, "
              << degrees_at(backwards, 3) << " backwards\n";
    std::cout << forwards.witnesses.size()
              << " pairs of features meet at s = " << forwards.time->to_double() << '\n';

    // Times compare exactly.
    std::cout << (*forwards.time < *backwards.time ? "less" : "not less")
              << " play forwards than backwards\n";

    // Both turn, in opposite senses, a few degrees: nothing touches.
    const FirstContact together =
        first_contact(model, turn(Pose(), -1, 0), model, turn(second, 1, 2));
    expect(!together.exists(), "gears in mesh that do not touch");
    std::cout << "turning together: no contact, proved\n";
    return 0;
}

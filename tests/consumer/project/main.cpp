// SPDX-License-Identifier: Apache-2.0
//
// The smallest program that needs all of the installed package: headers and libraries of every
// layer, the umbrella header, and what the static libraries link against.
#include <trisect/brep/measure.h>
#include <trisect/brep/primitives/box.h>
#include <trisect/kernel/plane.h>
#include <trisect/trisect.h>

int main() {
    using namespace trisect;
    const Solid big = Solid::from_mesh(make_box({2, 2, 2}));
    const Solid small = Solid::from_mesh(make_box({1, 1, 1}, {3, 3, 3}));
    const Brep difference = evaluate(big - small).to_brep();

    const auto floor = Plane::through({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    return exact_volume(difference) == ExactRational(7) && difference.counts().faces == 9 &&
                   floor.dominant_axis() == 2
               ? 0
               : 1;
}

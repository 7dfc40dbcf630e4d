// SPDX-License-Identifier: Apache-2.0
//
// The smallest program that needs all of the installed package: the umbrella header alone,
// libraries of every layer, and what the static libraries link against.
#include <trisect/trisect.h>

int main() {
    using namespace trisect;
    const Solid big = Solid::from_mesh(make_box({2, 2, 2}));
    const Solid small = Solid::from_mesh(make_box({1, 1, 1}, {3, 3, 3}));
    const Solid difference = evaluate(big - small);
    if (exact_volume(difference) != ExactRational(7)) return 1;
    if (difference.to_brep().counts().faces != 9) return 2;

    const Solid turned = transformed(difference, Pose::rotation_near({0, 0, 1}, 90));
    const Solid lower = evaluate(turned & Solid::half_space({0, 0, 1, -1}));
    if (volume(lower) != 4 || components(lower).size() != 1) return 3;

    const InterferenceModel a(difference);
    const Pose aside = Pose::from_translation({2, 0, 0});
    const auto proof = certify_relation(a, Pose(), a, aside);
    if (proof.relation != Relation::Touching) return 4;
    return check(proof, a.brep(), Pose(), a.brep(), aside) ? 5 : 0;
}

// SPDX-License-Identifier: Apache-2.0
//
// A box with a bite taken out by a sphere: evaluated, written to a file and measured. The volume is
// a fraction, so that equations between volumes hold as equations.

#include <iostream>

#include <trisect/brep/measure.h>
#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/trisect.h>

int main() {
    using namespace trisect;
    const Solid box = Solid::from_mesh(make_box({2, 2, 2}));
    const Solid ball = Solid::from_mesh(make_icosphere(1.5, 2));  // about the box's corner

    const Solid bitten = evaluate(box - ball);
    const Solid bite = evaluate(box & ball);

    write_mesh("hello_solid.off", bitten.to_mesh());

    const ExactRational v = exact_volume(bitten.to_brep());
    std::cout << "volume " << v.to_double() << ", exactly " << v.to_string() << '\n';

    const bool adds_up = v + exact_volume(bite.to_brep()) == ExactRational(8);
    std::cout << "what is left and what was bitten off " << (adds_up ? "are" : "are NOT")
              << " exactly the box\n";
    return adds_up ? 0 : 1;
}

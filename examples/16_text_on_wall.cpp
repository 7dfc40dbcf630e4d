// SPDX-License-Identifier: Apache-2.0
//
// Raised letters on a curved wall: outlines of a font, extruded through the wall and cut to a skin
// of one unit over it. The letters' ground is the wall's surface exactly, so nothing is left
// between.
#include <cstdlib>
#include <iostream>

#include <trisect/brep/primitives/cylinder.h>
#include <trisect/bsp/csg/csg_evaluate.h>
#include <trisect/trisect.h>

namespace {

using namespace trisect;

void expect(bool holds, const char* what) {
    if (holds) return;
    std::cerr << "unexpected: " << what << '\n';
    std::exit(1);
}

// In the plane xz, and 60 deep along -y.
Solid letters(const std::string& word) {
    return evaluate_csg(
        parse_csg("multmatrix([[1,0,0,0],[0,0,-1,0],[0,1,0,0],[0,0,0,1]])"
                  "linear_extrude(height = 60) text(text = \"" +
                      word + "\", size = 12, halign = \"center\", $fn = 24);",
                  "letters"));
}

}  // namespace

int main() {
    const Solid wall = Solid::from_mesh(make_cylinder(40, 40, 96));
    const Solid skin = evaluate(Solid::from_mesh(make_cylinder(41, 40, 96)) - wall);
    Solid word;
    try {
        word = transformed(letters("EXACT"), AffineMap::translation({0, 0, 14}));
    } catch (const UnsupportedError& e) {
        std::cout << "no text here: " << e.what() << '\n';
        return 0;
    }
    const Solid raised = evaluate(word & skin);
    const Solid labelled = evaluate(wall | raised);
    expect(!raised.is_empty(), "there are letters");
    expect(exact_volume(labelled) == exact_volume(wall) + exact_volume(raised),
           "letters stand on the wall without a gap or an overlap");
    expect(components(labelled).size() == 1, "and are one body with it");
    std::cout << counts(labelled).triangles << " triangles, letters of " << volume(raised) << '\n';
    write_mesh("text_on_wall.stl", labelled.to_mesh());
    return 0;
}

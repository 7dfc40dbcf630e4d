// SPDX-License-Identifier: Apache-2.0
//
// A bottle, and the two halves of the mould in which it is blown. The halves and the bottle with
// what is in it fill the block exactly, and both halves come off, which is proved for all times.
#include <cstdlib>
#include <iostream>
#include <vector>

#include <trisect/brep/primitives/box.h>
#include <trisect/bsp/interference/first_contact.h>
#include <trisect/trisect.h>

namespace {

using namespace trisect;

void expect(bool holds, const char* what) {
    if (holds) return;
    std::cerr << "unexpected: " << what << '\n';
    std::exit(1);
}

bool meets_on_the_way(const Solid& bottle, const Solid& half, double y) {
    const Motion way = Motion::translation(Pose(), {0, y, 0});
    return first_contact(bottle, Motion(), half, way, {.event = ContactEvent::Overlap}).exists();
}

}  // namespace

int main() {
    const std::vector<Point2d> body{{30, 4},   {30, 70},  {24, 86},  {12, 96},
                                    {12, 115}, {14, 118}, {14, 125}, {0, 125}};
    const auto outer_shape = [&](double dent) {
        std::vector<Point2d> outline{{0, dent}, {26, 0}};
        outline.insert(outline.end(), body.begin(), body.end());
        return revolution(region_of_outline(outline));
    };
    const Solid filled = outer_shape(0);
    const Solid inside = revolution(region_of_outline(
        {{0, 2}, {25, 2}, {28, 5}, {28, 70}, {22, 85}, {10, 95}, {10, 126}, {0, 126}}));
    const Solid bottle = evaluate(filled - inside);
    expect(components(bottle).size() == 1, "the bottle is one part");

    const Solid block = Solid::from_mesh(make_box({-45, -45, -15}, {45, 45, 125}));
    const Solid behind = Solid::half_space({0, -1, 0, 0});  // y >= 0
    const Solid back = evaluate((block & behind) - filled);
    const Solid front = evaluate((block - behind) - filled);
    expect(exact_volume(back) + exact_volume(front) + exact_volume(filled) == exact_volume(block),
           "nothing is lost");
    expect(!meets_on_the_way(bottle, back, 90), "the back half comes off");
    expect(!meets_on_the_way(bottle, front, -90), "the front half comes off");
    // A dent in the bottom holds the halves: it would take a third part of the mould.
    const Solid dented = outer_shape(3);
    expect(meets_on_the_way(dented, evaluate((block & behind) - dented), 90), "a dent holds it");

    std::cout << "the bottle takes " << volume(evaluate(inside & filled)) / 1000
              << " ml and weighs as much as " << volume(bottle) / 1000 << " ml of glass\n";
    write_mesh("bottle.stl", bottle.to_mesh());
    write_mesh("bottle_mould_back.stl", back.to_mesh());
    write_mesh("bottle_mould_front.stl", front.to_mesh());
    return 0;
}

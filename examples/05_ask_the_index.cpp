// SPDX-License-Identifier: Apache-2.0
//
// Asks a solid questions: what is at this point, what does this ray hit, how far is it to the
// boundary, what is in this plane? A drilled block answers without a B-rep being made first.
#include <array>
#include <cstdlib>
#include <iostream>
#include <optional>
#include <vector>

#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/cylinder.h>
#include <trisect/brep/transform.h>
#include <trisect/bsp/brep_index.h>
#include <trisect/trisect.h>

namespace {

using trisect::AffineMap;
using trisect::BrepIndex;
using trisect::Point3d;
using trisect::Solid;

/// Stops when an answer is not the one that was foreseen.
void expect(bool holds, const char* what) {
    if (holds) return;
    std::cerr << "unexpected: " << what << '\n';
    std::exit(1);
}

}  // namespace

int main() {
    // A block of 4 x 4 x 2 with a bore of radius 1 along z through its middle.
    const Solid block = Solid::from_mesh(trisect::make_box({-2, -2, 0}, {2, 2, 2}));
    const Solid bore = Solid::from_mesh(
        trisect::transformed(trisect::make_cylinder(1, 4, 32), AffineMap::translation({0, 0, -1})));
    const BrepIndex index(evaluate(block - bore));

    // Points. What is on the boundary is told exactly: the next double above the lid is outside.
    std::cout << "in the bore:    " << to_string(index.locate(Point3d{0, 0, 1}).location) << '\n'
              << "in the block:   " << to_string(index.locate(Point3d{1.5, 1.5, 1}).location)
              << '\n'
              << "on the lid:     " << to_string(index.locate(Point3d{1.5, 1.5, 2}).location)
              << '\n'
              << "on its rim:     " << to_string(index.locate(Point3d{2, 0.1, 2}).location) << '\n'
              << "at its corner:  " << to_string(index.locate(Point3d{2, 2, 2}).location) << '\n';
    expect(
        index.locate(Point3d{1.5, 1.5, 2.0000000000000004}).location == trisect::Location::Outside,
        "a point just above the lid");

    // A ray through the bore hits nothing; one from the side enters, crosses the bore and leaves.
    expect(!index.first_hit(trisect::Ray{{0, 0, 9}, {0, 0, -1}}), "a ray through the bore");
    const auto hits = index.all_hits(trisect::Ray{{-5, 0.1, 1}, {1, 0, 0}});
    std::cout << "crossings of a ray from the side:";
    for (const auto& hit : hits) {
        const bool of_the_bore = hit.place.faces[0].operand == bore.source_id();
        std::cout << ' ' << hit.enter.nearest() << (of_the_bore ? " (bore)" : " (block)");
    }
    std::cout << '\n';
    expect(hits.size() == 4, "four crossings");

    // Distance, and the section half way up.
    const auto distance = index.signed_distance({1.75, 1.75, 1});
    std::cout << "signed distance: " << distance->distance() << '\n';
    const auto section = index.section({0, 0, 1, -1});
    expect(section.size() == 1 && section[0].holes.size() == 1, "a square with a hole");
    std::cout << "section: " << section[0].outer.points.size() << " corners outside, "
              << section[0].holes[0].points.size() << " in the hole\n";
    return 0;
}

// SPDX-License-Identifier: Apache-2.0
//
// Drills a flange: a bore, eight bolt holes, a counterbore for each; then puts bolts into it.
//
//     drill_flange [result.stl]

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <numbers>
#include <vector>

#include <trisect/trisect.h>

namespace {

using namespace trisect;

void expect(bool holds, const char* what) {
    if (holds) return;
    std::cerr << "unexpected: " << what << '\n';
    std::exit(1);
}

Solid cylinder(double radius, double height, std::uint32_t segments, double z) {
    return transformed(Solid::from_mesh(make_cylinder(radius, height, segments)),
                       AffineMap::translation({0, 0, z}));
}

// Multiples of 1/1024, so that sums of coordinates are exact and copies congruent.
double on_grid(double v) { return std::round(v * 1024) / 1024; }

}  // namespace

int main(int argc, char** argv) {
    constexpr int bolts = 8;
    std::vector<Point3d> places;
    for (int i = 0; i < bolts; ++i) {
        const double angle = 2 * std::numbers::pi * i / bolts;
        places.push_back({on_grid(40 * std::cos(angle)), on_grid(40 * std::sin(angle)), 0});
    }
    const Solid flange = evaluate(cylinder(55, 12, 128, 0) | cylinder(28, 30, 96, 0));
    const Solid tool = evaluate(cylinder(5, 14, 32, -1) | cylinder(8, 8, 32, 8));
    std::vector<Solid> tools{cylinder(18, 32, 96, -1)};
    for (const Point3d& p : places) tools.push_back(transformed(tool, AffineMap::translation(p)));

    const Solid part = evaluate(flange - Expression::any_of(tools));  // one pass for all nine

    // What was cut away and what is left are the flange, to the last bit: tools meet no other one.
    ExactRational sum = exact_volume(part);
    for (const Solid& t : tools) sum += exact_volume(evaluate(flange & t));
    expect(sum == exact_volume(flange), "the parts' volumes add up");

    // One hole for the bore and one for each bolt: genus 9.
    const Brep brep = part.to_brep();
    expect(brep.genus(ShellId(0)) == 1 + bolts, "nine holes");

    // A bolt of the drill's size touches the hole and overlaps nothing; a thicker one collides.
    const Solid bolt = cylinder(5, 40, 32, -20);
    const Solid thick = cylinder(5 + std::ldexp(1, -20), 40, 32, -20);
    for (const Point3d& p : places) {
        const Pose pose = Pose::from_translation(p);
        expect(interfere(part, Pose(), bolt, pose).relation == Relation::Touching, "a bolt fits");
        expect(interfere(part, Pose(), thick, pose).relation == Relation::Overlapping,
               "a thicker one does not");
    }
    write_mesh(argc > 1 ? argv[1] : "drill_flange.stl", part.to_mesh());
    std::cout << counts(part).triangles << " triangles, " << brep.counts().faces
              << " faces, volume " << volume(part) << ", genus " << brep.genus(ShellId(0)) << '\n';
    return 0;
}

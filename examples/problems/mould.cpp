// SPDX-License-Identifier: Apache-2.0
//
// Makes a mould in two halves for a scanned part, and proves whether it opens.
//
//     mould [part.obj]

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <vector>

#include <trisect/trisect.h>

namespace {

using namespace trisect;

void expect(bool holds, const char* what) {
    if (holds) return;
    std::cerr << "unexpected: " << what << '\n';
    std::exit(1);
}

// A closed mesh such as a scanner makes: a ball with bumps, widest in the plane z = 0.
PolygonMesh pebble() {
    PolygonMesh mesh = make_uv_sphere(1, 16, 10);
    for (auto& [x, y, z] : mesh.points) {
        const double bumps = 1 + 0.06 * std::sin(5 * std::atan2(y, x)) * (1 - z * z);
        x *= 40 * bumps;
        y *= 30 * bumps;
        z *= 15;
    }
    return mesh;
}

// Faces over which a half of the mould cannot be drawn off: above the parting plane they look
// down, below it they look up. The plane of a face of a B-rep is exact, and so is its normal.
std::vector<FaceId> undercuts(const Solid& solid, double height) {
    const Brep brep = solid.to_brep();
    std::vector<FaceId> found;
    for (const FaceId f : brep.faces()) {
        double top = -HUGE_VAL;
        double bottom = HUGE_VAL;
        for (const HalfedgeId h : brep.halfedges(f)) {
            const double z = brep.lattice().to_double(brep.point(brep.origin(h)).nearest()[2]);
            top = std::max(top, z);
            bottom = std::min(bottom, z);
        }
        const int up = ExactRational(brep.plane(f).normal(2)).sign();
        if ((up < 0 && top > height) || (up > 0 && bottom < height)) found.push_back(f);
    }
    return found;
}

bool overlap_on_the_way(const Solid& still, const Solid& moves, double height) {
    const Motion way = Motion::translation(Pose(), {0, 0, height});
    return first_contact(still, Motion(), moves, way, {.event = ContactEvent::Overlap}).exists();
}

}  // namespace

int main(int argc, char** argv) {
    const Solid part = argc > 1
                           ? Solid::from_mesh(read_mesh(argv[1]), {.embedding = Embedding::Check})
                           : Solid::from_mesh(pebble());
    // Plastic shrinks by some per cent when it cools, so the cavity is larger: by a 64th.
    const Solid cavity = transformed(part, AffineMap::scaling({1.015625, 1.015625, 1.015625}));

    const Bounds box = bounds(cavity).value();
    double wall = 0;
    for (std::size_t i = 0; i < 3; ++i) wall = std::max(wall, 0.25 * (box.hi[i] - box.lo[i]));
    Point3d low = box.lo;
    Point3d high = box.hi;
    for (std::size_t i = 0; i < 3; ++i) {
        low[i] -= wall;
        high[i] += wall;
    }
    const Solid block = Solid::from_mesh(make_box(low, high));
    const double middle = 0.5 * (box.lo[2] + box.hi[2]);
    const Solid below = Solid::half_space({0, 0, 1, -middle});
    const Solid lower = evaluate((block & below) - cavity);
    const Solid upper = evaluate((block - below) - cavity);

    // Nothing is lost: both halves and the cavity are the block, exactly.
    expect(exact_volume(lower) + exact_volume(upper) + exact_volume(cavity) == exact_volume(block),
           "volumes add up");
    expect(evaluate(Expression::any_of({lower, upper, cavity}) ^ block).is_empty(),
           "nothing is lost");

    const auto found = undercuts(cavity, middle);
    if (argc == 1) {
        // The same by motion: the upper half is lifted, then the part. They may slide along each
        // other, but interiors must not meet. That is decided for all times at once.
        const double height = 2 * (box.hi[2] - box.lo[2]);
        expect(!overlap_on_the_way(cavity, upper, height), "the upper half lifts off");
        expect(!overlap_on_the_way(lower, cavity, height), "the part comes out");
        expect(found.empty(), "no undercuts");

        // A rod through the part and the wall, above the parting plane, locks the mould.
        const auto turn =
            compose(AffineMap::rotation({0, 1, 0}, 90), AffineMap::translation({0, 0, -60}));
        const Solid rod = transformed(transformed(Solid::from_mesh(make_cylinder(3, 120, 8)), turn),
                                      AffineMap::translation({0, 0, 6}));
        const Solid held = evaluate(cavity | rod);
        expect(overlap_on_the_way(held, evaluate(upper - rod), height), "the rod locks it");
        expect(!undercuts(held, middle).empty(), "the rod is an undercut");
    }
    write_mesh("mould_lower.stl", lower.to_mesh());
    write_mesh("mould_upper.stl", upper.to_mesh());
    std::cout << "cavity " << volume(cavity) << " in a block of " << volume(block) << ", "
              << counts(lower).triangles << " and " << counts(upper).triangles << " triangles\n";
    if (found.empty())
        std::cout << "the mould opens\n";
    else
        std::cout << found.size() << " faces are undercuts\n";
    return 0;
}

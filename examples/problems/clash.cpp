// SPDX-License-Identifier: Apache-2.0
//
// Finds all clashes of two assemblies: pipes against a steel frame, in millimetres. What is flush
// touches and is no clash; what penetrates by a millionth is one.

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <map>
#include <string>
#include <vector>

#include <trisect/trisect.h>

namespace {

using namespace trisect;

void expect(bool holds, const char* what) {
    if (holds) return;
    std::cerr << "unexpected: " << what << '\n';
    std::exit(1);
}

Solid box(double x, double y, double z) { return Solid::from_mesh(make_box({x, y, z})); }

// Only pairs of a part of the frame and a pipe are looked at.
constexpr CollisionFilter frame{.groups = 1, .looks_at = 2};
constexpr CollisionFilter pipes{.groups = 2, .looks_at = 1};

struct Assembly {
    Scene scene;
    std::map<BodyId, std::string> names;

    void add(const std::string& name, const Solid& solid, const Point3d& place,
             const CollisionFilter& filter) {
        names[scene.add(solid, Pose::from_translation(place), filter)] = name;
    }
};

}  // namespace

int main() {
    const Solid column = box(300, 300, 6000);
    const Solid beam = box(5700, 300, 400);
    const Solid duct = box(14000, 900, 750);
    const Solid pipe = transformed(Solid::from_mesh(make_cylinder(150, 14000, 48)),
                                   AffineMap::rotation({0, 1, 0}, 90));  // along x
    Assembly all;
    for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 4; ++k) {
            const std::string at = std::to_string(i) + std::to_string(k);
            all.add("column " + at, column, {6000.0 * i, 4000.0 * k, 0}, frame);
            if (i < 2) all.add("beam " + at, beam, {6000.0 * i + 300, 4000.0 * k, 5000}, frame);
        }
    }
    all.add("pipe through columns", pipe, {-500, 150, 3000}, pipes);
    all.add("pipe between columns", pipe, {-500, 2000, 3000}, pipes);
    // Its axis is exactly its radius away from the columns' faces.
    all.add("flush pipe", pipe, {-500, 4450, 3000}, pipes);
    // The top of this duct is exactly the underside of the beams; the next one is a millionth
    // higher.
    all.add("flush duct", duct, {-500, 8300, 4250}, pipes);
    all.add("high duct", duct, {-500, 11900, 4250 + std::ldexp(1, -20)}, pipes);

    std::map<std::string, std::vector<ExactRational>> clashes;
    std::map<std::string, int> touching;
    std::ofstream table("clashes.csv");
    table << "pipe,frame,volume\n";
    Scene& scene = all.scene;
    for (const ScenePair& pair : scene.interfering()) {
        const std::string& name = all.names[pair.b];
        if (pair.relation == Relation::Touching) {
            ++touching[name];
            continue;
        }
        const Overlap common = overlap(scene.solid(pair.a), scene.pose(pair.a), scene.solid(pair.b),
                                       scene.pose(pair.b));
        expect(common.is_exact, "nothing is rounded");
        clashes[name].push_back(common.volume);
        table << name << ',' << all.names[pair.a] << ',' << common.volume.to_double() << '\n';
        std::cout << name << " and " << all.names[pair.a] << ": " << common.volume.to_double()
                  << " mm^3\n";
    }
    // The pipe crosses three columns, in each by its section times the column's width, exactly.
    const ExactRational cut = exact_volume(pipe) / 14000 * 300;
    expect(clashes["pipe through columns"] == std::vector<ExactRational>(3, cut), "three columns");
    expect(clashes["pipe between columns"].empty() && touching["pipe between columns"] == 0,
           "a free pipe");
    expect(clashes["flush pipe"].empty() && touching["flush pipe"] == 3, "a flush pipe");
    expect(clashes["flush duct"].empty() && touching["flush duct"] == 5, "a flush duct");
    // Three columns, and two beams by a millionth of a millimetre.
    const ExactRational sliver = ExactRational(5700 * 300).scaled(-20);
    expect(clashes["high duct"].size() == 5, "the high duct");
    expect(std::count(clashes["high duct"].begin(), clashes["high duct"].end(), sliver) == 2,
           "two slivers");
    std::cout << "touching pairs, which are no clashes: flush pipe " << touching["flush pipe"]
              << ", flush duct " << touching["flush duct"] << '\n';
    return 0;
}

// SPDX-License-Identifier: Apache-2.0
//
// A sleeve with a filling of gyroids, the surfaces with which printers fill parts: where a function
// is above a level, within a box, as a solid like any other. It is cut by a boolean and exported,
// and nothing on the way can make it meet itself.
#include <cmath>
#include <cstdlib>
#include <iostream>

#include <trisect/trisect.h>

namespace {

using namespace trisect;

constexpr double period = 10;

void expect(bool holds, const char* what) {
    if (holds) return;
    std::cerr << "unexpected: " << what << '\n';
    std::exit(1);
}

/// Walls on both sides of the gyroid: above 0 where the function of it is near 0.
double walls(const Point3d& p) {
    constexpr double k = 2 * 3.14159265358979323846 / period;
    const double x = k * p[0];
    const double y = k * p[1];
    const double z = k * p[2];
    const double gyroid =
        std::sin(x) * std::cos(y) + std::sin(y) * std::cos(z) + std::sin(z) * std::cos(x);
    return 0.4 - std::fabs(gyroid);
}

Solid tube(double inner, double outer, double height) {
    return revolution(region_of_outline({{inner, 0}, {outer, 0}, {outer, height}, {inner, height}}),
                      {.segments = 96});
}

}  // namespace

int main() {
    const double height = 20;
    const Bounds box{{-15, -15, 0}, {15, 15, height}};
    const Solid filling = level_set(walls, box, period / 16);
    expect(bounds(filling) == box, "the filling is cut off at the box");
    const PolygonMesh mesh = filling.to_mesh();
    expect(validate(mesh).empty(), "it is closed and nowhere meets itself");

    const Solid core = tube(0, 14.5, height);
    const Solid part = evaluate((filling & core) | tube(14, 15, height));
    const auto rounded = certified_rounding(part.to_brep());
    expect(rounded.certificate.holds(), "the file bounds a solid");
    expect(exact_volume(evaluate(filling & core)) + exact_volume(evaluate(filling - core)) ==
               exact_volume(filling),
           "nothing is lost");

    // A gyroid divides space in halves; walls of this function take a quarter of it.
    const double density = volume(filling) / (30 * 30 * height);
    expect(density > 0.2 && density < 0.3, "a quarter is filled");
    std::cout << mesh.face_count() << " triangles of gyroid fill " << 100 * density
              << " per cent; the part has " << volume(part) / 1000 << " ml\n";
    write_mesh("gyroid.stl", part.to_mesh());
    return 0;
}

// SPDX-License-Identifier: Apache-2.0
//
// Counts integer points in a polyhedron, and gets its volume from the counts. Every point of the
// grid that is on a face, an edge or a corner must be recognised as such, or the sums are wrong.
//
// For a polyhedron with integer corners the number of integer points in its n-fold enlargement is a
// polynomial in n (Ehrhart, 1962): its leading coefficient is the volume, its value at 0 the Euler
// characteristic, and at -n it counts the points strictly inside, with the opposite sign.

#include <array>
#include <cmath>
#include <cstdint>
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

struct Count {
    std::int64_t inside = 0;
    std::int64_t on = 0;
    std::int64_t asked = 0;
};

// Integer points inside and on the boundary of the n-fold enlargement.
Count count(const Solid& solid, int n) {
    const double scale = n;
    const BrepIndex index(transformed(solid, AffineMap::scaling({scale, scale, scale})));
    const int reach = 9 * n + 1;
    std::vector<Point3d> points;
    for (int x = -reach; x <= reach; ++x)
        for (int y = -reach; y <= reach; ++y)
            for (int z = -reach; z <= reach; ++z) points.push_back({1.0 * x, 1.0 * y, 1.0 * z});
    std::vector<Location> found(points.size());
    index.classify(points, found);
    Count c{.inside = 0, .on = 0, .asked = std::ssize(points)};
    for (const Location l : found) {
        c.inside += l == Location::Inside;
        c.on += l != Location::Inside && l != Location::Outside;
    }
    return c;
}

}  // namespace

int main() {
    // An octahedron with a square tunnel through it and a cube that sticks out of it.
    const std::vector<Point3d> tips{{9, 0, 0},  {-9, 0, 0}, {0, 9, 0},
                                    {0, -9, 0}, {0, 0, 9},  {0, 0, -9}};
    const Solid octahedron = Solid::from_mesh(make_hull(tips));
    const Solid tunnel = Solid::from_mesh(make_box({-2, -1, -9}, {2, 1, 9}));
    const Solid cube = Solid::from_mesh(make_box({3, 3, -2}, {8, 8, 2}));
    const Solid solid = evaluate((octahedron | cube) - tunnel);

    // Points at 0, where it is the Euler characteristic of a solid with one tunnel, and at 1 to 3.
    std::array<std::int64_t, 4> total{0, 0, 0, 0};
    std::array<std::int64_t, 4> inside{};
    for (int n = 1; n <= 3; ++n) {
        const Count c = count(solid, n);
        total[static_cast<std::size_t>(n)] = c.inside + c.on;
        inside[static_cast<std::size_t>(n)] = c.inside;
        std::cout << "enlarged " << n << " times: " << c.inside << " inside, " << c.on
                  << " on the boundary, of " << c.asked << " points\n";
    }
    // Differences of the polynomial: the third one is six times the volume.
    const std::int64_t d1 = total[1] - total[0];
    const std::int64_t d2 = total[2] - 2 * total[1] + total[0];
    const std::int64_t d3 = total[3] - 3 * total[2] + 3 * total[1] - total[0];
    expect(exact_volume(solid) * 6 == ExactRational(d3), "the volume by counting");

    // Reciprocity: the counts of interior points, which were not used so far.
    for (std::int64_t n = 1; n <= 3; ++n) {
        const std::int64_t m = -n;
        const std::int64_t value =
            total[0] + m * d1 + m * (m - 1) / 2 * d2 + m * (m - 1) * (m - 2) / 6 * d3;
        expect(value == -inside[static_cast<std::size_t>(n)], "the points inside");
    }

    // A point that is off by the last bit of a double is not on the boundary.
    const BrepIndex index(solid);
    expect(index.locate({3, 3, 3}).location == Location::OnFace, "on the face");
    expect(index.locate({3, 3, std::nextafter(3.0, 4.0)}).location == Location::Outside, "above");
    expect(index.locate({3, 3, std::nextafter(3.0, 2.0)}).location == Location::Inside, "below");
    std::cout << "volume by counting: " << d3
              << "/6, exactly the volume of the solid: " << exact_volume(solid).to_string() << '\n';
    return 0;
}

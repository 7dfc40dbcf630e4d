// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <trisect/brep/import_mesh.h>
#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/brep/transform.h>
#include <trisect/brep/winding_number.h>
#include <trisect/bsp/brep_index.h>

#include <random>

namespace {

using namespace trisect;

LatticeMesh lattice_mesh(const PolygonMesh& mesh) { return import_mesh(mesh).mesh; }

ExactPoint point(std::int64_t x, std::int64_t y, std::int64_t z, std::int64_t w = 1) {
    const ExactRational d(w);
    return {ExactRational(x) / d, ExactRational(y) / d, ExactRational(z) / d};
}

PolygonMesh joined(PolygonMesh a, const PolygonMesh& b, bool turned = false) {
    const auto first = static_cast<std::uint32_t>(a.points.size());
    a.points.insert(a.points.end(), b.points.begin(), b.points.end());
    for (std::size_t f = 0; f < b.face_count(); ++f) {
        std::vector<std::uint32_t> loop(b.face(f).begin(), b.face(f).end());
        for (auto& c : loop) c += first;
        if (turned) std::reverse(loop.begin(), loop.end());
        a.add_face(loop);
    }
    return a;
}

TEST(WindingNumber, InsideOutsideAndOnABox) {
    const LatticeMesh box = lattice_mesh(make_box({0, 0, 0}, {4, 4, 4}));
    EXPECT_EQ(winding_number(box, point(2, 2, 2)), 1);
    EXPECT_EQ(winding_number(box, point(5, 2, 2)), 0);
    EXPECT_EQ(winding_number(box, point(-1, 2, 2)), 0);
    EXPECT_EQ(winding_number(box, point(4, 1, 2)), std::nullopt);
    EXPECT_EQ(winding_number(box, point(4, 4, 2)), std::nullopt);
    EXPECT_EQ(winding_number(box, point(0, 0, 0)), std::nullopt);
    EXPECT_EQ(winding_number(box, point(1, 3, 12, 3)), std::nullopt);
    EXPECT_EQ(winding_number(box, point(1, 3, 13, 3)), 0);
}

TEST(WindingNumber, RayThroughEdgesAndCorners) {
    // Beside the box in the planes of its faces, and level with its edges and corners.
    const LatticeMesh box = lattice_mesh(make_box({0, 0, 0}, {4, 4, 4}));
    for (const std::int64_t y : {0, 1, 4})
        for (const std::int64_t z : {0, 2, 4}) {
            EXPECT_EQ(winding_number(box, point(-3, y, z)), 0) << y << " " << z;
            EXPECT_EQ(winding_number(box, point(7, y, z)), 0) << y << " " << z;
        }
    EXPECT_EQ(winding_number(box, point(2, 2, 2)), 1);  // through the middle of a diagonal
}

TEST(WindingNumber, CoveredTwiceAndTurnedOver) {
    const PolygonMesh a = make_box({0, 0, 0}, {4, 4, 4});
    const PolygonMesh b = make_box({2, 2, 2}, {6, 6, 6});
    EXPECT_EQ(winding_number(lattice_mesh(joined(a, b)), point(3, 3, 3)), 2);
    EXPECT_EQ(winding_number(lattice_mesh(joined(a, b, true)), point(3, 3, 3)), 0);
    EXPECT_EQ(winding_number(lattice_mesh(joined(a, b, true)), point(5, 5, 5)), -1);
    EXPECT_EQ(winding_number(lattice_mesh(joined(a, a)), point(1, 1, 1)), 2);
}

TEST(WindingNumber, UnitsOfAnyLattice) {
    const LatticeMesh tiny = lattice_mesh(make_box({0, 0, 0}, {0x1p-100, 0x1p-100, 0x1p-100}));
    const ExactRational half = ExactRational(1).scaled(-101);
    EXPECT_EQ(winding_number(tiny, {half, half, half}), 1);
    EXPECT_EQ(winding_number(tiny, {half, half, half.scaled(1)}), std::nullopt);
    EXPECT_EQ(winding_number(tiny, {half, half, half.scaled(2)}), 0);
}

TEST(WindingNumber, AgreesWithTheIndexOnAGrid) {
    // A coarse sphere has corners, edges and faces level with many points of the grid.
    const PolygonMesh sphere = transformed(make_icosphere(4, 1), AffineMap::translation({1, 0, 0}));
    const ImportedMesh imported = import_mesh(sphere);
    const BrepIndex index(Solid::from_lattice_mesh(imported.mesh));
    for (int x = -7; x <= 11; ++x)
        for (int y = -9; y <= 9; y += 3)
            for (int z = -9; z <= 9; z += 3) {
                const std::array<double, 3> at{x * 0.5, y * 0.5, z * 0.5};
                const Place place = index.locate(at);
                const auto winding = winding_number(imported.mesh, point(x, y, z, 2));
                ASSERT_EQ(place.is_on_boundary(), !winding.has_value());
                if (winding) {
                    EXPECT_EQ(*winding == 1, place.location == Location::Inside);
                }
            }
}

}  // namespace

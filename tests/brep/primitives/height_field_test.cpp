// SPDX-License-Identifier: Apache-2.0
#include <trisect/brep/import_mesh.h>
#include <trisect/brep/measure.h>
#include <trisect/brep/primitives/height_field.h>
#include <trisect/brep/validate/embedding.h>
#include <trisect/brep/validate/validate.h>
#include <trisect/kernel/error.h>

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace trisect {
namespace {

std::string message_of(const HeightGrid& grid, double base) {
    try {
        (void)make_height_field(grid, base);
    } catch (const UsageError& e) {
        return e.what();
    }
    return {};
}

TEST(HeightField, IsThePrismBelowItsTriangles) {
    const std::vector<double> heights{1, 2, 3, 4, 5, 6};
    const PolygonMesh mesh = make_height_field({heights, 3, {10, 20}, {2, 4}}, -1);
    EXPECT_TRUE(validate(mesh).empty());
    // A rectangle's volume is its area times the mean height of its four triangles' corners, which
    // is that of its own corners.
    EXPECT_EQ(exact_volume(import_mesh(mesh).mesh).to_string(), "72");
    const auto box = bounds(mesh);
    EXPECT_EQ(box->lo, (Point3d{10, 20, -1}));
    EXPECT_EQ(box->hi, (Point3d{14, 24, 6}));
}

TEST(HeightField, OfAnyHeightsIsEmbedded) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> height(1e-9, 1e6);
    for (std::uint32_t columns = 2; columns < 8; ++columns) {
        std::vector<double> heights(columns * 9);
        for (double& h : heights) h = height(random);
        const HeightGrid grid{heights, columns, {1e9, -3}, {0.1, 1e-3}};
        EXPECT_TRUE(is_embedded(import_mesh(make_height_field(grid, 0)).mesh)) << columns;
    }
}

TEST(HeightField, NamesWhatIsWrong) {
    const double infinity = std::numeric_limits<double>::infinity();
    std::vector<double> heights{1, 1, 1, 1, 1, 1};
    EXPECT_EQ(message_of({heights, 3}, 0), "");
    EXPECT_NE(message_of({heights, 6}, 0), "");
    EXPECT_NE(message_of({heights, 4}, 0), "");
    EXPECT_NE(message_of({heights, 0}, 0), "");
    EXPECT_NE(message_of({heights, 3, {0, 0}, {0, 1}}, 0), "");
    EXPECT_NE(message_of({heights, 3, {1e17, 0}}, 0), "");
    EXPECT_NE(message_of({heights, 3, {infinity, 0}}, 0), "");
    EXPECT_NE(message_of({heights, 3}, infinity), "");
    heights[4] = 0;
    EXPECT_EQ(message_of({heights, 3}, 0), "the height in row 1, column 1 is not above the base");
}

}  // namespace
}  // namespace trisect

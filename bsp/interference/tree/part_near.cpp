// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/interference/tree/part_near.h>

#include <algorithm>
#include <cmath>

#include <trisect/brep/import_mesh.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/interference/boxes/approximate_map.h>

namespace trisect::detail {

namespace {

// In lattice units. \pre whole numbers
Solid box_solid(const DoubleBox& box, Lattice lattice) {
    LatticeMesh mesh{lattice, {}, {}, {}};
    for (std::size_t i = 0; i < 8; ++i) {
        const auto at = [&](std::size_t k) {
            return Coordinate((i >> k & 1U) != 0 ? box.hi[k] : box.lo[k]);
        };
        mesh.points.push_back({at(0), at(1), at(2)});
    }
    // Around each of the six sides, seen from outside.
    constexpr std::uint32_t sides[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                           {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    for (std::uint32_t f = 0; f < 6; ++f)
        for (std::size_t i = 2; i < 4; ++i) {
            mesh.triangles.push_back({sides[f][0], sides[f][i - 1], sides[f][i]});
            mesh.face_of_triangle.push_back(f);
        }
    return Solid::from_lattice_mesh(std::move(mesh));
}

}  // namespace

Solid part_near(const Solid& solid, const SolidBoundary& a, const Pose& pose_a,
                const SolidBoundary& b, const Pose& pose_b) {
    const ApproximateMap map = approximate_map(pose_a, a.lattice, pose_b, b.lattice);
    if (!map.is_usable()) return solid;
    DoubleBox box;
    box.lo.fill(HUGE_VAL);
    box.hi.fill(-HUGE_VAL);
    for (std::size_t i = 0; i < 8; ++i) {
        std::array<double, 3> corner{};
        for (std::size_t k = 0; k < 3; ++k) corner[k] = (i >> k & 1U) != 0 ? b.hi[k] : b.lo[k];
        const std::array<double, 3> at = map(corner);
        for (std::size_t k = 0; k < 3; ++k) {
            box.lo[k] = std::min(box.lo[k], at[k]);
            box.hi[k] = std::max(box.hi[k], at[k]);
        }
    }
    const double error = map.error_below(b.largest, b.position_error);
    bool contains = true;
    for (std::size_t k = 0; k < 3; ++k) {
        // Off B, and no farther out than just beyond A.
        const double room = error + 0x1p-20 * (box.hi[k] - box.lo[k]);
        const double low = std::floor(a.lo[k]) - 1;
        const double high = std::ceil(a.hi[k]) + 1;
        box.lo[k] = std::max(low, std::floor(box.lo[k] - room) - 1);
        box.hi[k] = std::min(high, std::ceil(box.hi[k] + room) + 1);
        if (!(box.lo[k] < box.hi[k])) return Solid();
        contains = contains && box.lo[k] == low && box.hi[k] == high;
    }
    return contains ? solid : evaluate(Expression(solid) & Expression(box_solid(box, a.lattice)));
}

}  // namespace trisect::detail

// SPDX-License-Identifier: Apache-2.0
//
// Volumes for pictures contain the corners of what they are around, in the world of A.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include <trisect/brep/primitives/torus.h>
#include <trisect/bsp/hierarchies/structures.h>
#include <trisect/bsp/interference/interference_model.h>
#include <trisect/bsp/solid.h>
#include <trisect/kernel/pose.h>

namespace {

using namespace trisect;
using namespace trisect::hierarchies;

double squared_distance_of(const Point3d& p, const Point3d& q) {
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) sum += (p[k] - q[k]) * (p[k] - q[k]);
    return sum;
}

bool has_inside(const VolumeOutline& v, const Point3d& p) {
    if (v.slabs.empty())
        return squared_distance_of(p, v.center) <= v.radius * v.radius * (1 + 1e-9);
    for (const Slab& s : v.slabs) {
        const double along = s.direction[0] * p[0] + s.direction[1] * p[1] + s.direction[2] * p[2];
        if (along < s.lower - 1e-9 || along > s.upper + 1e-9) return false;
    }
    return true;
}

// Volumes of one level and leaves above it have all of the boundary.
void expect_all_inside(const std::vector<VolumeOutline>& volumes, const PolygonMesh& mesh,
                       const Point3d& shift, unsigned level, const std::string& name) {
    for (Point3d p : mesh.points) {
        for (std::size_t k = 0; k < 3; ++k) p[k] += shift[k];
        bool found = false;
        for (const VolumeOutline& v : volumes)
            if ((v.level == level || (v.is_leaf && v.level < level)) && has_inside(v, p))
                found = true;
        ASSERT_TRUE(found) << name << ", level " << level;
    }
}

TEST(VolumeOutline, ContainsTheCornersAtEveryLevelAndPose) {
    const PolygonMesh mesh = make_torus(2, 0.5, 16, 8);
    const InterferenceModel model(Solid::from_mesh(mesh));
    const Point3d shift{1.25, -0.5, 3};
    std::size_t with_volumes = 0;
    std::size_t with_cells = 0;
    for (const StructureInfo& info : all_structures()) {
        const auto structure = make_structure(info.kind, model, model);
        CostCounters counters;
        structure->place(Pose(), Pose::from_translation(shift), counters);
        const auto of_a = structure->outlines_of_a(4);
        const auto of_b = structure->outlines_of_b(4);
        if (of_a.empty()) {
            EXPECT_TRUE(of_b.empty()) << info.name;
            continue;
        }
        ++(of_b.empty() ? with_cells : with_volumes);
        EXPECT_EQ(of_a.front().level, 0U);
        if (info.kind == StructureKind::HierarchicalGrid) {  // each triangle in one of its grids
            expect_all_inside(of_a, mesh, {}, 3, std::string(info.name));
            continue;
        }
        for (unsigned level = 0; level < 4; ++level) {
            expect_all_inside(of_a, mesh, {}, level, std::string(info.name));
            if (!of_b.empty()) expect_all_inside(of_b, mesh, shift, level, std::string(info.name));
        }
    }
    EXPECT_GE(with_volumes, 10U);
    EXPECT_EQ(with_cells, 4U);  // octree, k-d tree, two grids
}

}  // namespace

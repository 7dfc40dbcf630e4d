// SPDX-License-Identifier: Apache-2.0
//
// Hulls against CGAL's convex_hull_3 with exact predicates: same extreme points, same planes.

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>
#include <gtest/gtest.h>

#include <set>
#include <vector>

#include <trisect/bsp/hierarchies/convex/convex_hull.h>
#include <trisect/kernel/predicates.h>

#include "support/convex_oracle.h"
#include "support/lattice_arithmetic.h"

namespace {

using trisect::LatticePoint;
using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

TEST(ConvexHullAgainstCgal, SameVerticesAndPlanes) {
    for (const std::int64_t reach : {2, 5, 100, 1 << 26})
        for (std::uint64_t seed = 1; seed <= 40; ++seed) {
            convex_oracle::Engine engine(seed);
            std::uniform_int_distribution<std::int64_t> d(-reach, reach);
            std::vector<LatticePoint> points;
            std::vector<Kernel::Point_3> theirs;
            for (int i = 0; i < 80; ++i) {
                const LatticePoint p{d(engine), d(engine), d(engine)};
                points.push_back(p);
                theirs.emplace_back(p.x.to_double(), p.y.to_double(), p.z.to_double());
            }
            const auto ours = trisect::hierarchies::convex_hull(points, {});
            Mesh mesh;
            CGAL::convex_hull_3(theirs.begin(), theirs.end(), mesh);
            ASSERT_EQ(ours.dimension(), 3);
            const auto lattice = [](const Kernel::Point_3& p) {
                return LatticePoint{static_cast<std::int64_t>(CGAL::to_double(p.x())),
                                    static_cast<std::int64_t>(CGAL::to_double(p.y())),
                                    static_cast<std::int64_t>(CGAL::to_double(p.z()))};
            };
            // Their mesh is triangles and may keep points inside of edges and faces: every vertex
            // of ours is one of theirs, every triangle of theirs lies in a face of ours, and every
            // face of ours has one.
            std::set<LatticePoint> corners;
            for (const auto v : mesh.vertices()) corners.insert(lattice(mesh.point(v)));
            for (const LatticePoint& v : ours.vertices()) EXPECT_TRUE(corners.contains(v));
            for (const LatticePoint& v : corners) EXPECT_TRUE(ours.contains(v));
            std::set<std::size_t> found;
            for (const auto f : mesh.faces()) {
                std::size_t matches = 0;
                for (std::size_t g = 0; g < ours.face_count(); ++g) {
                    bool on = true;
                    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f)))
                        on = on &&
                             side_of(lattice(mesh.point(v)), ours.plane(g)) == trisect::Side::On;
                    if (!on) continue;
                    ++matches;
                    found.insert(g);
                }
                EXPECT_EQ(matches, 1U);
            }
            EXPECT_EQ(found.size(), ours.face_count());
        }
}

}  // namespace

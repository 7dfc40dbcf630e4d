// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/hierarchies/volumes/sphere_trees.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include <trisect/brep/exact_rational.h>
#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/brep/primitives/torus.h>
#include <trisect/bsp/interference/boundary_distance.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>
#include <trisect/bsp/solid.h>

namespace {

using trisect::ExactRational;
using trisect::InterferenceModel;
using trisect::make_torus;
using trisect::Pose;
using trisect::Solid;
using trisect::hierarchies::AnytimeAnswer;
using trisect::hierarchies::build_sphere_tree;
using trisect::hierarchies::CostCounters;
using trisect::hierarchies::SphereConstruction;
using trisect::hierarchies::SphereTree;
using trisect::hierarchies::SphereTrees;

constexpr SphereConstruction constructions[] = {
    SphereConstruction::Octree, SphereConstruction::MedialAxis, SphereConstruction::Vertices};

// Exactly: |vertex - centre| <= radius, in lattice units.
bool contains(const SphereTree& tree, std::uint32_t node, const std::array<double, 3>& vertex) {
    const auto& s = tree.volumes[node];
    const ExactRational unit = ExactRational::from_double(tree.frame.unit);
    ExactRational square;
    for (std::size_t k = 0; k < 3; ++k) {
        const ExactRational d = ExactRational::from_double(vertex[k]) -
                                ExactRational::from_double(tree.frame.origin[k]) -
                                unit * ExactRational::from_double(static_cast<double>(s.center[k]));
        square += d * d;
    }
    const ExactRational r = unit * ExactRational::from_double(static_cast<double>(s.radius));
    return square <= r * r;
}

TEST(SphereTrees, EverySphereContainsTheTrianglesBelowIt) {
    const InterferenceModel model(Solid::from_mesh(make_torus(4, 1, 24, 12)));
    const auto& data = trisect::detail::data_of(model);
    for (const SphereConstruction c : constructions) {
        const SphereTree tree = build_sphere_tree(data, c);
        std::vector<std::uint32_t> seen(data.triangles.size(), 0);
        std::vector<std::vector<std::uint32_t>> above(tree.shape.nodes.size());
        above[0] = {0};
        for (std::uint32_t n = 0; n < tree.shape.nodes.size(); ++n) {
            const auto& node = tree.shape.nodes[n];
            if (!node.leaf) {
                for (std::uint32_t k = 0; k < node.count; ++k) {
                    above[node.first + k] = above[n];
                    above[node.first + k].push_back(node.first + k);
                }
                continue;
            }
            for (const std::uint32_t t : tree.shape.things(node)) {
                ++seen[t];
                for (const auto v : data.triangles[t].vertex)
                    for (const std::uint32_t m : above[n])
                        EXPECT_TRUE(contains(tree, m, data.position(v)));
            }
        }
        for (const std::uint32_t s : seen) EXPECT_EQ(s, 1U);
    }
}

TEST(SphereTrees, DeeperLevelsAreTighter) {
    const InterferenceModel model(Solid::from_mesh(trisect::make_icosphere(3, 4)));
    for (const SphereConstruction c : constructions) {
        const SphereTree tree = build_sphere_tree(trisect::detail::data_of(model), c);
        const auto levels = tightness(model, tree, 1500);
        ASSERT_GE(levels.size(), 3U);
        EXPECT_EQ(levels.front().spheres, 1U);
        EXPECT_LT(levels.back().mean_protrusion, 0.5 * levels[1].mean_protrusion);
        EXPECT_LT(levels.back().largest_protrusion, 1.5);
    }
}

// A ball that is half in the tube of a torus: out it goes by its depth and a little more.
TEST(SphereTrees, BoundsOfTheDepthGetBetterAndPartTheSolids) {
    const InterferenceModel a(Solid::from_mesh(make_torus(4, 1, 24, 12)));
    const InterferenceModel b(Solid::from_mesh(trisect::make_icosphere(1, 3)));
    const double lattice_unit = std::ldexp(1.0, a.lattice().exponent);
    for (const SphereConstruction c : constructions) {
        SphereTrees trees(a, b, c);
        CostCounters counters;
        trees.place(Pose(), Pose::from_translation({5.5, 0, 0}), counters);
        double last = 1e300;
        for (const std::uint64_t tests : {26U, 200U, 2000U, 20000U, 200000U}) {
            const auto now = trees.depth_within(tests, counters);
            EXPECT_LE(now.at_most, last);
            EXPECT_GT(now.at_most, 0);
            last = now.at_most;
            const double by = now.at_most * lattice_unit;
            const auto out = [&](double s) {
                return Pose::from_translation(
                    {5.5 + s * now.direction[0], s * now.direction[1], s * now.direction[2]});
            };
            for (const double s : {by, 1.1 * by, 2 * by})
                EXPECT_EQ(interfere(a, Pose(), b, out(s)).relation, trisect::Relation::Disjoint);
        }
        EXPECT_LT(last * lattice_unit, 1);
        trees.place(Pose(), Pose::from_translation({7, 0, 0}), counters);
        EXPECT_EQ(trees.depth_within(200000, counters).at_most, 0);
    }
}

TEST(SphereTrees, AnswersGetBetterWithEveryTestAndNeverTooLarge) {
    const InterferenceModel a(Solid::from_mesh(make_torus(4, 1, 24, 12)));
    const InterferenceModel b(Solid::from_mesh(trisect::make_icosphere(1, 3)));
    const double lattice_unit = std::ldexp(1.0, a.lattice().exponent);
    for (const SphereConstruction c : constructions) {
        SphereTrees trees(a, b, c);
        for (const double x : {7.0, 6.25, 6.01, 5.5}) {
            CostCounters counters;
            const Pose pose = Pose::from_translation({x, 0, 0});
            trees.place(Pose(), pose, counters);
            const auto exact = boundary_distance(a, Pose(), b, pose);
            AnytimeAnswer last;
            for (const std::uint64_t tests : {1U, 20U, 200U, 2000U, 200000U}) {
                const AnytimeAnswer now = trees.answer_within(tests, counters);
                EXPECT_GE(now.at_least, last.at_least);
                EXPECT_GE(now.at_most * lattice_unit, exact->lower);
                EXPECT_LE(now.at_least * lattice_unit, exact->upper);
                EXPECT_EQ(now.apart, now.at_least > 0);
                last = now;
            }
            if (x > 6.2) {
                EXPECT_TRUE(last.apart);
            }
            if (x < 6) {
                EXPECT_FALSE(last.apart);
            }
        }
    }
}

}  // namespace

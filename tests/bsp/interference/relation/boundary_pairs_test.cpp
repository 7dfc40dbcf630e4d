// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include <trisect/brep/exact_rational.h>
#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/torus.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/interference/relation/boundary_pairs.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>

#include "engines/engines.h"
#include "reference/random_solids.h"
#include "support/triangle_oracle.h"

namespace {

using brute::Point3;
using brute::Rational;
using brute::Triangle3;
using reference::Random;
using trisect::InterferenceModel;
using trisect::Pose;
using trisect::Solid;
using trisect::detail::approximate_map;
using trisect::detail::ApproximateMap;
using trisect::detail::BoundaryPairs;
using trisect::detail::InterferenceModelData;
using trisect::detail::ObbWalk;

template <int N>
Rational rational(const trisect::WideInt<N>& v) {
    Rational r(trisect::ExactRational(v).to_string());
    r.canonicalize();
    return r;
}

// Where the pose puts a point of the model, in the user's units.
Point3 placed(const Pose& pose, const InterferenceModelData& m, trisect::VertexId v) {
    const auto h = m.brep.point(v).homogeneous();
    const Rational unit = m.brep.lattice().exponent >= 0
                              ? Rational(std::ldexp(1.0, m.brep.lattice().exponent))
                              : Rational(1) / Rational(std::ldexp(1.0, -m.brep.lattice().exponent));
    Point3 p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = rational(h.xyz[k]) / rational(h.w) * unit;
    Point3 r;
    for (std::size_t i = 0; i < 3; ++i) {
        r[i] = rational(pose.translation(i));
        for (std::size_t j = 0; j < 3; ++j) r[i] += rational(pose.matrix(i, j)) * p[j];
        r[i] /= rational(pose.denominator());
    }
    return r;
}

std::vector<Triangle3> placed(const Pose& pose, const InterferenceModelData& m) {
    std::vector<Point3> points;
    for (const auto v : m.brep.vertices()) points.push_back(placed(pose, m, v));
    std::vector<Triangle3> r;
    for (const auto& t : m.triangles)
        r.push_back(
            {points[t.vertex[0].index], points[t.vertex[1].index], points[t.vertex[2].index]});
    return r;
}

// All pairs against brute force; returns how many meet.
std::size_t expect_right(const InterferenceModel& a, const Pose& pose_a, const InterferenceModel& b,
                         const Pose& pose_b) {
    ObbWalk::Stack stack;
    BoundaryPairs pairs(trisect::detail::data_of(a), pose_a, trisect::detail::data_of(b), pose_b,
                        stack);
    std::set<std::pair<std::uint32_t, std::uint32_t>> found;
    EXPECT_FALSE(pairs.all([&](const BoundaryPairs::Meeting& m) {
        EXPECT_TRUE(found.insert({m.a, m.b}).second);
        return false;
    }));
    const auto p = placed(pose_a, trisect::detail::data_of(a));
    const auto q = placed(pose_b, trisect::detail::data_of(b));
    for (std::uint32_t i = 0; i < p.size(); ++i)
        for (std::uint32_t j = 0; j < q.size(); ++j)
            EXPECT_EQ(brute::meet(p[i], q[j]), found.count({i, j}) != 0) << i << ' ' << j;
    const auto any = pairs.any();
    EXPECT_EQ(any.has_value(), !found.empty());
    if (any) {
        EXPECT_EQ(found.count({any->a, any->b}), 1U);
    }
    return found.size();
}

Pose random_pose(Random& random) {
    const auto half = [&random] { return 0.5 * static_cast<double>(random.between(-12, 12)); };
    const std::array<double, 3> by{half(), half(), half()};
    switch (random.below(4)) {
        case 0:
            return Pose::from_translation(by);
        case 1:
            return Pose::from_quaternion({1, 0, 0, 1}, by);
        case 2:
            return Pose::from_quaternion({random.between(1, 3), random.between(-2, 2),
                                          random.between(-2, 2), random.between(-2, 2)},
                                         by);
        default: {
            std::array<double, 12> m{0.6, -0.8, 0, by[0], 0.8, 0.6, 0, by[1], 0, 0, 1, by[2]};
            if (random.chance(1, 3)) m[0] = 1.25;
            return Pose::from_doubles(m);
        }
    }
}

TEST(BoundaryPairs, RandomSolidsOnASmallGridUnderAllKindsOfPoses) {
    std::size_t meeting = 0;
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        Random random(seed);
        const InterferenceModel a(engines::solid(reference::random_embedded_solid(random)));
        const InterferenceModel b(engines::solid(reference::random_embedded_solid(random)));
        SCOPED_TRACE(seed);
        meeting += expect_right(a, random_pose(random), b, random_pose(random));
        // Flush: a common pose for both is as good as none.
        const Pose common = random_pose(random);
        meeting += expect_right(a, common, b, common);
    }
    EXPECT_GT(meeting, 1000U);
}

TEST(BoundaryPairs, ResultsWithCutPointsOffTheLattice) {
    const Solid torus = Solid::from_mesh(trisect::make_torus(1, 0.25, 8, 6));
    const Solid other = Solid::from_mesh(trisect::make_torus(1.125, 0.25, 7, 5));
    const InterferenceModel cut(evaluate(trisect::Expression(torus) - other));
    const InterferenceModel rest(evaluate(trisect::Expression(torus) & other));
    // Cut by the same surface: they touch all along it, in every common pose.
    const Pose turned = Pose::from_quaternion({3, 1, -2, 1}, {0.5, 0.25, 1});
    const std::size_t flush = expect_right(cut, Pose(), rest, Pose());
    EXPECT_GT(flush, 100U);
    EXPECT_EQ(expect_right(cut, turned, rest, turned), flush);
    (void)expect_right(cut, Pose(), rest, turned);
}

TEST(BoundaryPairs, LatticesOfDifferentUnits) {
    const InterferenceModel large(Solid::from_mesh(trisect::make_box({0, 0, 0}, {1024, 1, 1})));
    const InterferenceModel small(Solid::from_mesh(trisect::make_box({0, 0, 0}, {0x1p-40, 1, 1})));
    EXPECT_NE(large.lattice().exponent, small.lattice().exponent);
    EXPECT_GT(expect_right(large, Pose(), small, Pose::from_translation({-0x1p-40, 0, 0})), 0U);
    EXPECT_EQ(expect_right(large, Pose(), small, Pose::from_translation({-0x1p-39, 0, 0})), 0U);
    EXPECT_GT(expect_right(small, Pose::from_translation({1024, 0, 0}), large, Pose()), 0U);
}

TEST(ApproximateMap, ErrorsBoundTheDistanceToTheExactMap) {
    Random random(31);
    for (int i = 0; i < 400; ++i) {
        const Pose a = random_pose(random);
        const Pose b = random_pose(random);
        const trisect::Lattice la{8 * static_cast<int>(random.between(-6, 1))};
        const trisect::Lattice lb{8 * static_cast<int>(random.between(-6, 1))};
        const auto exact = trisect::detail::relative_pose(a, la, b, lb);
        for (const ApproximateMap& map : {approximate_map(a, la, b, lb), approximate_map(exact)}) {
            ASSERT_TRUE(map.is_usable());
            const auto number = [](const trisect::detail::BoundedInt& v) {
                return rational(v.to_wide<15>());
            };
            const Rational s = number(exact.denominator());
            for (std::size_t r = 0; r < 3; ++r) {
                for (std::size_t c = 0; c < 3; ++c)
                    EXPECT_LE(abs(number(exact.row(r)[c]) / s - Rational(map.m[r][c])),
                              Rational(map.m_error));
                EXPECT_LE(abs(number(exact.translation()[r]) / s - Rational(map.t[r])),
                          Rational(map.t_error));
            }
        }
    }
}

TEST(ApproximateMap, NearlySingularPosesAreNotUsableOrRight) {
    const Pose flat = Pose::from_doubles({1, 1, 0, 0, 1, 1 + 0x1p-52, 0, 0, 0, 0, 1, 0});
    const ApproximateMap map = approximate_map(flat, {}, Pose(), {});
    EXPECT_FALSE(map.is_usable());
    const InterferenceModel box(Solid::from_mesh(trisect::make_box({0, 0, 0}, {1, 1, 1})));
    EXPECT_GT(expect_right(box, flat, box, Pose()), 0U);
}

}  // namespace

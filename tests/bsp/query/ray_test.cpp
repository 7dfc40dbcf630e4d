// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <trisect/bsp/brep_index.h>
#include <trisect/bsp/expression.h>

#include "engines/engines.h"
#include "reference/random_solids.h"
#include "support/query_oracle.h"
#include "support/random_result.h"

namespace ray_test {
namespace {

using trisect::BrepIndex;
using trisect::Ray;
using trisect::RayHit;
using trisect::Segment;
using trisect::Solid;

std::string to_string(const std::vector<RayHit>& hits) {
    std::string s;
    for (const RayHit& h : hits)
        s += "[" + h.enter.exact().to_string() + ", " + h.leave.exact().to_string() + "] " +
             brute::to_string(h.place) + "; ";
    return s;
}

std::string to_string(const std::vector<brute::Hit>& hits) {
    std::string s;
    for (const brute::Hit& h : hits)
        s += "[" + h.enter.get_str() + ", " + h.leave.get_str() + "] " +
             brute::to_string(h.answer) + "; ";
    return s;
}

bool agree(const RayHit& a, const brute::Hit& b, bool named) {
    return brute::rational(a.enter.exact()) == b.enter &&
           brute::rational(a.leave.exact()) == b.leave && a.is_interval == b.is_interval &&
           brute::agrees(a.place, b.answer, named);
}

bool agree(const std::vector<RayHit>& a, const std::vector<brute::Hit>& b, bool named) {
    if (a.size() != b.size()) return false;
    for (std::size_t i = 0; i < a.size(); ++i)
        if (!agree(a[i], b[i], named)) return false;
    return true;
}

void expect_agreement(const BrepIndex& index, const brute::Boundary& boundary,
                      const trisect::LatticeMesh& mesh, bool named, std::uint64_t seed, int count) {
    brute::PointMaker make(mesh, seed);
    for (int i = 0; i < count; ++i) {
        const std::array<double, 3> from = make.any();
        const std::array<double, 3> to = make.any();
        if (from == to) continue;
        const bool segment = i % 3 == 0;
        const brute::Point3 o = brute::point(from);
        const brute::Point3 e = brute::point(to);
        const brute::Point3 d{e[0] - o[0], e[1] - o[1], e[2] - o[2]};
        std::vector<RayHit> hits;
        std::optional<RayHit> first;
        brute::Point3 direction = d;
        if (segment) {
            hits = index.all_hits(Segment{from, to});
            first = index.first_hit(Segment{from, to});
        } else {
            Ray ray{from, {to[0] - from[0], to[1] - from[1], to[2] - from[2]}};
            if (i % 3 == 1) {  // along an axis
                const std::size_t k = make.random().below(3);
                ray.direction = {};
                ray.direction[k] = make.random().chance(1, 2) ? 1 : -2;
            }
            direction = brute::point(ray.direction);
            hits = index.all_hits(ray);
            first = index.first_hit(ray);
        }
        const auto expected = boundary.hits(o, direction, segment);
        ASSERT_TRUE(agree(hits, expected, named))
            << "seed " << seed << " from " << from[0] << " " << from[1] << " " << from[2] << " to "
            << to[0] << " " << to[1] << " " << to[2] << "\n"
            << to_string(hits) << "\ninstead of\n"
            << to_string(expected);
        ASSERT_EQ(first.has_value(), !expected.empty());
        if (!first) continue;
        ASSERT_TRUE(agree(*first, expected.front(), named))
            << "seed " << seed << " " << to_string({*first}) << "\ninstead of\n"
            << to_string(expected);
    }
}

TEST(Rays, FreshMeshesOnASmallGrid) {
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        reference::Random random(seed);
        const auto mesh = engines::lattice_mesh(reference::random_embedded_solid(random));
        const Solid solid = Solid::from_lattice_mesh(mesh);
        const BrepIndex index(solid);
        expect_agreement(index, brute::Boundary::of_mesh(mesh, solid.source_id()), mesh, true, seed,
                         60);
    }
}

TEST(Rays, ResultsOfBooleansOnASmallGrid) {
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        const brute::RandomResult result = brute::random_result(seed, 3, true);
        expect_agreement(BrepIndex(result.solid), result.boundary, result.mesh, false, seed, 60);
    }
}

}  // namespace
}  // namespace ray_test

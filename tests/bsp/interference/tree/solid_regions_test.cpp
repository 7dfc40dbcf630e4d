// SPDX-License-Identifier: Apache-2.0
//
// Contact regions and overlaps of solids against those of their models.

#include <trisect/bsp/interference/solid_regions.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <sstream>
#include <string>
#include <vector>

#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid_measure.h>

#include "support/solid_interference_oracle.h"
#include "support/solids.h"

namespace {

using trisect::contact_regions;
using trisect::ContactPoint;
using trisect::evaluate;
using trisect::ExactRational;
using trisect::Expression;
using trisect::interfere;
using trisect::InterferenceModel;
using trisect::InterferenceOptions;
using trisect::NamedContact;
using trisect::NamedRegion;
using trisect::overlap;
using trisect::Overlap;
using trisect::Pose;
using trisect::Solid;

// A loop from its smallest corner on; all loops in order.
template <class Region>
std::string text_of(const Region& region) {
    std::vector<std::string> loops;
    for (const auto& loop : region.loops) {
        std::vector<std::string> corners;
        for (const ContactPoint& p : loop) {
            std::string corner;
            for (const ExactRational& x : p.exact) corner += x.to_string() + ' ';
            corners.push_back(corner + ';');
        }
        if (region.dimension == 1) std::ranges::sort(corners);
        std::ranges::rotate(corners, std::ranges::min_element(corners));
        std::string text;
        for (const std::string& c : corners) text += c;
        loops.push_back(text);
    }
    std::ranges::sort(loops);
    std::ostringstream out;
    out << int{region.dimension} << (region.opposite ? " opposite" : "");
    for (const std::string& l : loops) out << " (" << l << ')';
    return out.str();
}

template <class Regions>
std::vector<std::string> texts_of(const Regions& regions) {
    std::vector<std::string> out;
    for (const auto& r : regions) out.push_back(text_of(r));
    std::ranges::sort(out);
    return out;
}

void expect_same_regions(const Solid& a, const Pose& pose_a, const Solid& b, const Pose& pose_b) {
    InterferenceOptions options;
    options.regions = true;
    const auto expected =
        interfere(InterferenceModel(a), pose_a, InterferenceModel(b), pose_b, options);
    const std::vector<NamedRegion> found = contact_regions(a, pose_a, b, pose_b);
    EXPECT_EQ(texts_of(found), texts_of(expected.regions));
    // Points and segments have the names that contacts have.
    const auto contacts = interfere(a, pose_a, b, pose_b, {.contacts = true}).contacts;
    for (const NamedRegion& r : found) {
        if (r.dimension == 2) continue;
        EXPECT_TRUE(std::ranges::any_of(contacts, [&r](const NamedContact& c) {
            return c.a == r.a && c.b == r.b && c.dimension >= r.dimension;
        }));
    }
}

void expect_same_overlap(const Solid& a, const Pose& pose_a, const Solid& b, const Pose& pose_b) {
    const Overlap found = overlap(a, pose_a, b, pose_b);
    const Overlap expected = overlap(InterferenceModel(a), pose_a, InterferenceModel(b), pose_b);
    if (found.is_exact && expected.is_exact) {
        EXPECT_EQ(found.volume, expected.volume);
    }
    EXPECT_NEAR(found.volume.to_double(), expected.volume.to_double(), 1e-6);
}

const std::array<Pose, 4> poses{Pose(), Pose::from_translation({1, 0, 2}),
                                Pose::from_quaternion({1, 1, 0, 0}, {0, 1, 0}),
                                Pose::from_quaternion({3, 1, 0, 2}, {1, 0, -1})};

TEST(SolidRegions, OfASlotAndATongue) {
    const Solid block = solids::box(-20, -20, -20, 20, 20, 0);
    const Solid slot = solids::box(-2, -21, -2, 2, 21, 1);
    const Solid cut = evaluate(Expression(block) - Expression(slot));
    for (const Pose& pose : poses) {
        for (const double x : {0.0, 0.5}) {
            const Pose placed = pose * Pose::from_translation({x, 0, 0});
            expect_same_regions(cut, pose, solids::box(-2, -3, -2, 2, 3, 2), placed);
            expect_same_regions(solids::box(-1, -3, -2, 1, 3, 2), placed, cut, pose);
            expect_same_overlap(cut, pose, solids::box(-2, -3, -3, 2, 3, 2), placed);
        }
    }
}

TEST(SolidRegions, OfRandomSolids) {
    int regions = 0;
    for (std::uint64_t seed = 1; seed <= 250; ++seed) {
        reference::Random random(seed);
        const brute::Scene scene = brute::random_scene(random);
        const Solid a = brute::solid_of(scene.a, static_cast<std::uint32_t>(1 + seed % 7));
        const Solid b = brute::solid_of(scene.b, 4);
        if (a.is_empty() || b.is_empty()) continue;
        SCOPED_TRACE(seed);
        expect_same_regions(a, scene.pose_a, b, scene.pose_b);
        expect_same_overlap(a, scene.pose_a, b, scene.pose_b);
        regions += static_cast<int>(contact_regions(a, scene.pose_a, b, scene.pose_b).size());
    }
    EXPECT_GT(regions, 500);
}

TEST(SolidRegions, NameFacesOfOperands) {
    const Solid stock = solids::box(-8, 8);
    const Solid tool = solids::box(-1, -1, 7, 1, 1, 9);
    const Solid cut = evaluate(Expression(stock) - Expression(tool));
    const auto regions = contact_regions(cut, Pose(), tool, Pose());
    ASSERT_EQ(std::ranges::count(regions, 2, &NamedRegion::dimension), 5);
    for (const auto& r : regions) {
        if (r.dimension != 2) continue;
        EXPECT_EQ(r.a.faces[0], r.b.faces[0]);  // what the tool cut has the name of its face
        EXPECT_TRUE(r.opposite);
    }
}

// The overlap of a result with fractions as corners is exact where only a translation is between.
TEST(SolidRegions, OverlapOfResultsIsExact) {
    const Solid ball = solids::ball(4, 2);
    const Solid part = evaluate(Expression(ball) - Expression(solids::ball(3, 2, {2, 1, 0})));
    const Pose by = Pose::from_translation({0.25, 3, 0});
    const Overlap found = overlap(part, Pose(), ball, by);
    EXPECT_TRUE(found.is_exact);
    EXPECT_EQ(found.scale, ExactRational(1));
    EXPECT_GT(found.volume.sign(), 0);
    EXPECT_EQ(found.volume, exact_volume(found.scaled_solid));
}

}  // namespace

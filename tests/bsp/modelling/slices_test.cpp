// SPDX-License-Identifier: Apache-2.0
#include <trisect/brep/primitives/sphere.h>
#include <trisect/brep/transform.h>
#include <trisect/bsp/brep_index.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/flat_prism.h>
#include <trisect/bsp/modelling/projection.h>
#include <trisect/bsp/modelling/slices.h>
#include <trisect/bsp/solid_measure.h>
#include <trisect/bsp/solid_transform.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/stop_scope.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <utility>

#include "support/solids.h"

namespace trisect {
namespace {

using solids::box;
using Loops = std::vector<std::vector<Point2d>>;

Loops loops_of(const std::vector<Point2d>& points,
               const std::vector<std::vector<std::uint32_t>>& loops) {
    Loops out;
    for (const auto& loop : loops) {
        auto& corners = out.emplace_back();
        for (const std::uint32_t v : loop) corners.push_back(points[v]);
    }
    return out;
}

/// Each from its smallest corner on, and sorted.
Loops in_order(Loops loops) {
    for (auto& loop : loops)
        std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
    std::sort(loops.begin(), loops.end());
    return loops;
}

void expect_sections(const Solid& solid, const std::vector<double>& heights) {
    const std::vector<Slice> found = slices(solid, heights);
    ASSERT_EQ(found.size(), heights.size());
    for (std::size_t i = 0; i < heights.size(); ++i) {
        const PlaneRegion one = section(solid, heights[i]);
        EXPECT_EQ(found[i].height, heights[i]);
        EXPECT_EQ(found[i].points, one.points) << heights[i];
        EXPECT_EQ(found[i].loops, one.loops) << heights[i];
    }
}

/// Areas of regions and holes, and that each loop belongs to one region.
void expect_regions(const Slice& slice) {
    std::vector<int> uses(slice.loops.size(), 0);
    double sum = 0;
    for (std::size_t r = 0; r < slice.regions.size(); ++r) {
        for (const std::uint32_t loop : slice.regions[r]) ++uses[loop];
        EXPECT_GT(area_of_region(slice, r), 0);
        sum += area_of_region(slice, r);
    }
    EXPECT_TRUE(std::ranges::all_of(uses, [](int n) { return n == 1; }));
    EXPECT_NEAR(sum, area(slice), 1e-12 * (1 + sum));
}

class RandomSolids {
public:
    double number(std::uint32_t n) { return static_cast<double>(random_() % n); }
    Solid block() {
        const Point3d low{number(4), number(4), number(4)};
        return box(low, {low[0] + 1 + number(3), low[1] + 1 + number(3), low[2] + 1 + number(3)});
    }
    Solid blocks() {
        return evaluate(((block() | block() | block() | block()) - block()) ^ block());
    }
    /// Corners that are no doubles.
    Solid bitten() {
        const Solid ball = Solid::from_mesh(
            transformed(make_icosphere(2.5, 1), AffineMap::translation({2, 2, 2})));
        return evaluate((block() | block() | block()) - ball);
    }

private:
    std::mt19937 random_{20261129};
};

const std::vector<double> on_and_off{4, 0, 1, 2.5, 2, 3.1, 1, -7, 1e300, 0.1};

TEST(Slices, AreSectionsOfRandomBlocks) {
    RandomSolids random;
    for (int round = 0; round < 40; ++round) expect_sections(random.blocks(), on_and_off);
}

TEST(Slices, AreSectionsWhereCornersAreNoDoubles) {
    RandomSolids random;
    const AffineMap turn{{{{0.36, 0.48, -0.8, 0}, {-0.8, 0.6, 0, 0}, {0.48, 0.64, 0.6, 0}}}};
    for (int round = 0; round < 15; ++round) {
        const Solid solid = random.bitten();
        if (solid.is_empty()) continue;
        std::vector<double> heights = on_and_off;
        for (const Point3d& p : solid.to_mesh().points) heights.push_back(p[2]);
        expect_sections(solid, heights);
        expect_sections(transformed(solid, turn), heights);
        for (const Slice& slice : slices(solid, heights)) expect_regions(slice);
    }
}

TEST(Slices, CavitiesAreHolesOfTheirRegions) {
    const Expression shell = box({0, 0, -3}, {9, 9, 3}) - box({1, 1, -2}, {8, 8, 2});
    const Solid hollow =
        evaluate(shell | box({3, 3, -1}, {6, 6, 1}) | box({20, 0, -3}, {21, 1, 3}));
    const std::vector<double> heights{0, 2.5, 3, 4};
    const std::vector<Slice> found = slices(hollow, heights);
    expect_sections(hollow, heights);
    ASSERT_EQ(found[0].regions.size(), 3U);
    EXPECT_EQ(found[0].regions[0].size(), 2U);
    EXPECT_EQ(found[0].regions[1].size(), 1U);
    EXPECT_EQ(area_of_region(found[0], 0), 81 - 49);
    EXPECT_EQ(area_of_region(found[0], 1), 9);
    EXPECT_EQ(area(found[0]), 81 - 49 + 9 + 1);
    EXPECT_EQ(perimeter(found[0]), 36 + 28 + 12 + 4);
    EXPECT_EQ(area(found[1]), 82);
    EXPECT_EQ(area(found[2]), 82);
    EXPECT_TRUE(found[3].loops.empty());
    EXPECT_TRUE(found[3].regions.empty());
    for (const Slice& slice : found) {
        EXPECT_TRUE(slice.is_exact);
        expect_regions(slice);
    }
}

// Edges and corners in common; a hole that touches its outline.
TEST(Slices, OfPartsThatTouch) {
    const Solid touching = evaluate(box({0, 0, 0}, {2, 2, 2}) | box({2, 2, 0}, {4, 4, 2}) |
                                    box({2, 0, 2}, {4, 2, 4}) | box({4, 4, 1}, {5, 5, 3}));
    const std::vector<double> heights{0, 1, 2, 3, 4, 1.5};
    expect_sections(touching, heights);
    for (const Slice& slice : slices(touching, heights)) expect_regions(slice);
    const Solid pierced = evaluate(
        box({0, 0, 0}, {4, 4, 1}) -
        flat_prism(std::vector<Outline>{{{0, 2}, {2, 1}, {2, 3}}}, OutlineRule::Positive, -1, 2));
    const std::vector<double> middle{0.5};
    expect_sections(pierced, middle);
    EXPECT_EQ(area(slices(pierced, middle)[0]), 14);
    expect_regions(slices(pierced, middle)[0]);
}

TEST(Slices, RulesSayWhatAFaceInThePlaneIsWorth) {
    const Solid steps = evaluate(box({0, 0, 0}, {2, 2, 1}) | box({1, 0, -1}, {3, 2, 0}));
    const std::vector<double> heights{-1, -0.5, 0, 0.5, 1};
    const auto areas = [&](SliceRule rule) {
        SliceOptions options;
        options.rule = rule;
        std::vector<double> out;
        for (const Slice& slice : slices(steps, heights, options)) out.push_back(area(slice));
        return out;
    };
    EXPECT_EQ(areas(SliceRule::Closed), (std::vector<double>{4, 4, 6, 4, 4}));
    EXPECT_EQ(areas(SliceRule::Below), (std::vector<double>{0, 4, 4, 4, 4}));
    EXPECT_EQ(areas(SliceRule::Above), (std::vector<double>{4, 4, 4, 4, 0}));
}

/// Points (x, y, z) become (y, z, x), so that z is where x was.
AffineMap turned(int times) {
    const AffineMap once{{{{0, 1, 0, 0}, {0, 0, 1, 0}, {1, 0, 0, 0}}}};
    const AffineMap twice{{{{0, 0, 1, 0}, {1, 0, 0, 0}, {0, 1, 0, 0}}}};
    return times == 0 ? AffineMap() : times == 1 ? once : twice;
}

TEST(Slices, AcrossOtherAxesAreThoseOfTheTurnedSolid) {
    RandomSolids random;
    for (int round = 0; round < 12; ++round) {
        const Solid solid = round % 2 == 0 ? random.blocks() : random.bitten();
        for (int axis = 0; axis < 3; ++axis) {
            SliceOptions options;
            options.frame = SliceFrame::across(axis);
            const std::vector<Slice> one = slices(solid, on_and_off, options);
            const std::vector<Slice> other =
                slices(transformed(solid, turned((axis + 1) % 3)), on_and_off);
            for (std::size_t i = 0; i < one.size(); ++i)
                EXPECT_EQ(in_order(loops_of(one[i].points, one[i].loops)),
                          in_order(loops_of(other[i].points, other[i].loops)))
                    << axis << ' ' << on_and_off[i];
        }
    }
}

/// The areas of loops in space about a direction, sorted.
std::vector<double> areas_about(const Point3d& normal,
                                const std::vector<std::vector<Point3d>>& loops) {
    const double length = std::hypot(normal[0], normal[1], normal[2]);
    std::vector<double> out;
    for (const auto& loop : loops) {
        double twice = 0;
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const Point3d& p = loop[i];
            const Point3d& q = loop[(i + 1) % loop.size()];
            for (std::size_t k = 0; k < 3; ++k)
                twice += normal[k] / length *
                         (p[(k + 1) % 3] * q[(k + 2) % 3] - p[(k + 2) % 3] * q[(k + 1) % 3]);
        }
        out.push_back(twice / 2);
    }
    std::sort(out.begin(), out.end());
    return out;
}

std::vector<std::vector<Point3d>> in_space(const Slice& slice, const SliceFrame& frame) {
    std::vector<std::vector<Point3d>> out;
    for (const auto& loop : slice.loops) {
        auto& corners = out.emplace_back();
        for (const std::uint32_t v : loop)
            corners.push_back(frame.space(slice.points[v], slice.height));
    }
    return out;
}

std::vector<std::vector<Point3d>> in_space(const std::vector<SectionRegion>& regions) {
    std::vector<std::vector<Point3d>> out;
    for (const SectionRegion& region : regions) {
        out.push_back(region.outer.rounded);
        for (const SectionLoop& hole : region.holes) out.push_back(hole.rounded);
    }
    return out;
}

void expect_sections_of_index(const Solid& solid, const Point3d& normal) {
    SliceOptions options;
    options.frame = SliceFrame(normal);
    const std::vector<double> heights{0, 3, -3, 6.25, -1.7, 1, 9};
    const BrepIndex index(solid);
    for (const Slice& slice : slices(solid, heights, options)) {
        const auto one = areas_about(normal, in_space(slice, options.frame));
        const auto other = areas_about(
            normal, in_space(index.section({normal[0], normal[1], normal[2], -slice.height})));
        ASSERT_EQ(one.size(), other.size()) << slice.height;
        for (std::size_t i = 0; i < one.size(); ++i)
            EXPECT_NEAR(one[i], other[i], 1e-12) << slice.height;
        expect_regions(slice);
    }
}

TEST(Slices, AcrossAnyDirectionAreSectionsOfAnIndex) {
    RandomSolids random;
    for (int round = 0; round < 12; ++round) {
        const Solid solid = round % 2 == 0 ? random.blocks() : random.bitten();
        if (solid.is_empty()) continue;
        for (const Point3d& normal : {Point3d{1, 1, 1}, Point3d{0, -2, 1}, Point3d{-3, 0.7, 0.1},
                                      Point3d{0, 0, -1}, Point3d{0, -1, 0}, Point3d{0, 0, 3}})
            expect_sections_of_index(solid, normal);
    }
}

TEST(Slices, MeasuresOfSlantedPlanesAreThoseInSpace) {
    SliceOptions options;
    options.frame = SliceFrame({1, 1, 1});
    const std::vector<double> heights{3};
    const Slice hexagon = slices(box({0, 0, 0}, {2, 2, 2}), heights, options)[0];
    EXPECT_NEAR(area(hexagon, options.frame), 3 * std::sqrt(3.0), 1e-12);
    EXPECT_NEAR(perimeter(hexagon, options.frame), 6 * std::sqrt(2.0), 1e-12);
}

TEST(Slices, SayWhetherCornersAreDoubles) {
    const auto is_exact = [](const Solid& solid, double height) {
        const std::vector<double> heights{height};
        const Slice slice = slices(solid, heights)[0];
        EXPECT_FALSE(slice.loops.empty());
        return slice.is_exact;
    };
    // A pyramid: its sides pass through the plane at thirds, or at halves.
    PolygonMesh mesh;
    mesh.points = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {1, 1, 3}};
    mesh.add_face(std::array<std::uint32_t, 4>{0, 3, 2, 1});
    for (std::uint32_t i = 0; i < 4; ++i) mesh.add_triangle(i, (i + 1) % 4, 4);
    const Solid pyramid = Solid::from_mesh(mesh);
    EXPECT_TRUE(is_exact(pyramid, 0));
    EXPECT_TRUE(is_exact(pyramid, 1.5));
    EXPECT_TRUE(is_exact(pyramid, 0.75));
    EXPECT_FALSE(is_exact(pyramid, 1));
    EXPECT_TRUE(is_exact(box({0.1, 0.1, 0.1}, {0.7, 0.7, 0.7}), 0.3));
    EXPECT_FALSE(is_exact(Solid::from_mesh(make_icosphere(1, 1)), 0.3));
}

TEST(Slices, DoNotDependOnThreads) {
    RandomSolids random;
    const Solid solid = evaluate(random.bitten() | random.bitten());
    std::vector<double> heights;
    for (int i = 0; i < 200; ++i) heights.push_back(0.03 * i);
    SliceOptions options;
    options.evaluate.threads = 1;
    const std::vector<Slice> one = slices(solid, heights, options);
    for (const std::uint32_t threads : {2U, 5U, 0U}) {
        options.evaluate.threads = threads;
        EXPECT_EQ(slices(solid, heights, options), one) << threads;
    }
}

// Two balls in one mesh.
TEST(Slices, OfMeshesThatMeetThemselves) {
    PolygonMesh both = make_icosphere(2, 2);
    const auto n = static_cast<std::uint32_t>(both.points.size());
    const PolygonMesh other =
        transformed(make_icosphere(2, 2), AffineMap::translation({1, 0.5, 0.25}));
    both.points.insert(both.points.end(), other.points.begin(), other.points.end());
    for (std::size_t f = 0; f < other.face_count(); ++f)
        both.add_triangle(n + other.face(f)[0], n + other.face(f)[1], n + other.face(f)[2]);
    const std::vector<double> heights{0.1, 0.6, 1.9};
    const std::vector<Slice> found = slices_of_mesh(both, heights);
    for (std::size_t i = 0; i < heights.size(); ++i)
        EXPECT_NEAR(area(found[i]), volume(section_of_mesh(both, heights[i])), 1e-12);
    SolidOptions options;
    options.embedding = Embedding::Resolve;
    expect_sections(Solid::from_mesh(both, options), heights);
}

TEST(Slices, OfNothing) {
    const std::vector<double> heights{0, 1};
    for (const Slice& slice : slices(Solid(), heights)) EXPECT_EQ(slice.loops.size(), 0U);
    EXPECT_EQ(slices(Solid(), heights)[1].height, 1);
    EXPECT_TRUE(slices(box(0, 1), {}).empty());
}

TEST(Slices, RefuseWhatHasNone) {
    const std::vector<double> heights{0, 1};
    EXPECT_THROW(static_cast<void>(slices(evaluate(~box(0, 1)), heights)), UnsupportedError);
    EXPECT_THROW(static_cast<void>(slices(Solid::half_space({0, 0, 1, 0}), heights)),
                 UnsupportedError);
    for (const double bad :
         {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
        EXPECT_THROW(static_cast<void>(slices(box(0, 1), std::vector<double>{0, bad})), UsageError);
        EXPECT_THROW(SliceFrame({bad, 0, 1}), UsageError);
    }
    EXPECT_THROW(SliceFrame({0, 0, 0}), UsageError);
    EXPECT_THROW(static_cast<void>(SliceFrame::across(3)), UsageError);
}

TEST(Slices, StopWhenAsked) {
    const std::vector<double> heights{0.1, 0.2, 0.3, 0.4};
    const std::atomic<bool> cancel = true;
    const StopScope cancelled(&cancel);
    EXPECT_THROW(static_cast<void>(slices(box(0, 1), heights)), CancelledError);
}

TEST(Slices, KeepTheLimitOfWork) {
    const std::vector<double> heights{0.1, 0.2, 0.3, 0.4};
    StopLimits limits;
    limits.max_work = 20;
    const StopScope scope(limits);
    EXPECT_THROW(static_cast<void>(slices(box(0, 1), heights)), LimitError);
}

// The sum over a fine stack is the volume, but for what a step is off by.
TEST(Slices, SumUpToTheVolume) {
    const Solid shell =
        evaluate(Solid::from_mesh(make_icosphere(2, 3)) - Solid::from_mesh(make_icosphere(1, 2)));
    std::vector<double> heights;
    for (int i = 0; i < 400; ++i) heights.push_back(-2 + (i + 0.5) / 100);
    double sum = 0;
    for (const Slice& slice : slices(shell, heights)) sum += area(slice) / 100;
    EXPECT_NEAR(sum, volume(shell), 1e-3);
}

}  // namespace
}  // namespace trisect

// SPDX-License-Identifier: Apache-2.0
//
// Which corners and sides of polygons searches of events look at: each of them at least once, and
// nothing within a polygon.

#include <trisect/bsp/interference/motion/solid_events.h>

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <trisect/bsp/expression.h>
#include <trisect/bsp/interference/relation/exact_place.h>

#include "engines/engines.h"
#include "support/interference_oracle.h"
#include "support/solids.h"

namespace {

using trisect::Point;
using trisect::Solid;
using trisect::detail::exact_place;
using trisect::detail::ExactPlace;
using trisect::detail::PolygonId;
using trisect::detail::SolidBoundary;
using trisect::detail::SolidEvents;

using Side = std::pair<ExactPlace, ExactPlace>;

Side side(const Point& p, const Point& q) {
    ExactPlace a = exact_place(p);
    ExactPlace b = exact_place(q);
    return b < a ? Side{b, a} : Side{a, b};
}

struct Features {
    std::set<ExactPlace> corners;
    std::set<Side> sides;
    friend bool operator==(const Features&, const Features&) = default;
};

Features owned(SolidEvents& events, const std::set<std::uint32_t>& parts) {
    Features out;
    for (const std::uint32_t part : parts) {
        const auto fan = events.triangles_of(part);
        for (std::uint32_t t = fan.begin; t < fan.end; ++t)
            for (std::size_t i = 0; i < 3; ++i) {
                const Point& p = events.point(t, i);
                if (events.owns_vertex(t, i)) out.corners.insert(exact_place(p));
                if (events.owns_edge(t, i)) out.sides.insert(side(p, events.point(t, (i + 1) % 3)));
            }
    }
    return out;
}

std::size_t expect_all(const Solid& solid) {
    const SolidBoundary boundary(solid);
    if (boundary.is_empty()) return 0;
    SolidEvents events(boundary);
    std::set<std::uint32_t> parts;
    std::set<PolygonId> polygons;
    for (std::uint32_t t = 0, count = events.open_all(); t < count; ++t) {
        parts.insert(events.part_of(t));
        polygons.insert(boundary.origin(t).polygon());
    }
    EXPECT_EQ(parts.size(), polygons.size());
    Features expected;
    std::size_t turned = 0;
    for (const PolygonId& p : polygons) {
        const trisect::ConvexPolygon part = p.part();
        const std::span<const Point> corners = part.vertices();
        for (std::size_t i = 0; i < corners.size(); ++i) {
            expected.corners.insert(exact_place(corners[i]));
            expected.sides.insert(side(corners[i], corners[(i + 1) % corners.size()]));
        }
        if (p.is_flipped()) ++turned;
    }
    EXPECT_TRUE(owned(events, parts) == expected);
    return turned;
}

TEST(SolidEvents, EveryCornerAndSideBelongsToATriangle) {
    std::size_t turned = 0;
    for (std::uint64_t seed = 1; seed <= 150; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        reference::Random random(seed);
        const brute::Scene scene = brute::random_scene(random);
        std::vector<Solid> operands;
        for (const auto& operand : scene.a.operands) operands.push_back(engines::solid(operand));
        trisect::EvaluateOptions options;
        options.leaf_polygons = static_cast<std::uint32_t>(1 + seed % 6);
        const Solid solid = evaluate(engines::formula(scene.a.formula, operands), options);
        turned += expect_all(solid);
        // Faces of a cavity, which are turned alone.
        turned += expect_all(evaluate(
            trisect::Expression(solids::box(-20, 40)) - trisect::Expression(solid), options));
    }
    EXPECT_GT(turned, 100U);
}

}  // namespace

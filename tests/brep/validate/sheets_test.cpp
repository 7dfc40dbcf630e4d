// SPDX-License-Identifier: Apache-2.0
//
// What validation does not compare: pairs within sheets, and pairs that turned boxes keep apart.
// Everything is compared with all pairs asked one by one.

#include <trisect/brep/validate/sheets.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include <trisect/brep/contact/triangle_contact.h>
#include <trisect/brep/face/region_outline.h>
#include <trisect/brep/lattice_mesh.h>
#include <trisect/brep/validate/oriented_box.h>
#include <trisect/brep/validate/triangle_tree.h>
#include <trisect/brep/validate/validate.h>
#include <trisect/kernel/plane.h>
#include <trisect/kernel/predicates.h>

#include "support/lattice_arithmetic.h"

namespace trisect {
namespace {

using detail::OutlineEdge;
using Random = std::mt19937;
using Triangle = std::array<std::uint32_t, 3>;

std::int64_t below(Random& random, std::int64_t n) {
    return static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(n));
}

// Outlines, by brute force on a small grid.

std::int64_t turn(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

bool is_on(const LatticePoint& p, const LatticePoint& a, const LatticePoint& b) {
    return turn(a, b, p) == 0 && std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) &&
           std::min(a.y, b.y) <= p.y && p.y <= std::max(a.y, b.y);
}

bool meet_beyond_names(const std::vector<LatticePoint>& p, OutlineEdge e, OutlineEdge g) {
    const LatticePoint &a = p[e.from], &b = p[e.to], &c = p[g.from], &d = p[g.to];
    const auto is_end_of = [](std::uint32_t v, OutlineEdge s) { return v == s.from || v == s.to; };
    for (const std::uint32_t v : {g.from, g.to})
        if (is_on(p[v], a, b) && !is_end_of(v, e)) return true;
    for (const std::uint32_t v : {e.from, e.to})
        if (is_on(p[v], c, d) && !is_end_of(v, g)) return true;
    if (is_end_of(e.from, g) && is_end_of(e.to, g)) return true;
    const auto sign = [](std::int64_t v) { return v > 0 ? 1 : (v < 0 ? -1 : 0); };
    return sign(turn(a, b, c)) * sign(turn(a, b, d)) < 0 &&
           sign(turn(c, d, a)) * sign(turn(c, d, b)) < 0;
}

// Beside the middle of a segment, so near that nothing is in between.
int winding_beside(const std::vector<LatticePoint>& p, const std::vector<OutlineEdge>& edges,
                   OutlineEdge e, double side) {
    const LatticePoint &a = p[e.from], &b = p[e.to];
    const double dx = static_cast<double>(b.x - a.x);
    const double dy = static_cast<double>(b.y - a.y);
    const double x = static_cast<double>(a.x + b.x) / 2 - 1e-4 * side * dy;
    const double y = static_cast<double>(a.y + b.y) / 2 + 1e-4 * side * dx;
    double angle = 0;
    for (const OutlineEdge& g : edges) {
        const double px = p[g.from].x.to_double() - x;
        const double py = p[g.from].y.to_double() - y;
        const double qx = p[g.to].x.to_double() - x;
        const double qy = p[g.to].y.to_double() - y;
        angle += std::atan2(px * qy - py * qx, px * qx + py * qy);
    }
    return static_cast<int>(std::lround(angle / (2 * std::numbers::pi)));
}

bool is_region_by_brute_force(const std::vector<LatticePoint>& p,
                              const std::vector<OutlineEdge>& edges) {
    for (std::size_t i = 0; i < edges.size(); ++i)
        for (std::size_t k = 0; k < i; ++k)
            if (meet_beyond_names(p, edges[i], edges[k])) return false;
    return std::all_of(edges.begin(), edges.end(), [&](const OutlineEdge& e) {
        return winding_beside(p, edges, e, 1) == 1 && winding_beside(p, edges, e, -1) == 0;
    });
}

TEST(RegionOutline, RandomLoopsThatShareVerticesAgreeWithBruteForce) {
    Random random(11);  // NOLINT
    int regions = 0;
    int others = 0;
    for (int round = 0; round < 60000; ++round) {
        // All names at different places, so that only segments decide.
        std::vector<LatticePoint> p;
        for (std::int64_t x = 0; x < 5; ++x)
            for (std::int64_t y = 0; y < 5; ++y) p.push_back({x, y, below(random, 9)});
        std::vector<OutlineEdge> edges;
        for (std::int64_t loop = 1 + below(random, 3); loop > 0; --loop) {
            std::vector<std::uint32_t> corners;
            for (std::int64_t n = 3 + below(random, 3); n > 0; --n)
                corners.push_back(static_cast<std::uint32_t>(below(random, 25)));
            if (std::adjacent_find(corners.begin(), corners.end()) != corners.end() ||
                corners.front() == corners.back())
                continue;
            for (std::size_t i = 0; i < corners.size(); ++i)
                edges.push_back({corners[i], corners[(i + 1) % corners.size()]});
        }
        const bool expected = is_region_by_brute_force(p, edges);
        ASSERT_EQ(detail::is_region_outline(p, {0, 1}, edges), expected) << round;
        ++(expected ? regions : others);
    }
    EXPECT_GT(regions, 3000);
    EXPECT_GT(others, 3000);
}

TEST(RegionOutline, RingAndIslandInItsHole) {
    std::vector<LatticePoint> p;
    std::vector<OutlineEdge> edges;
    const auto square = [&](std::int64_t low, std::int64_t high, bool left) {
        const auto first = static_cast<std::uint32_t>(p.size());
        p.insert(p.end(), {{low, low, 0}, {high, low, 0}, {high, high, 0}, {low, high, 0}});
        for (std::uint32_t i = 0; i < 4; ++i) {
            const OutlineEdge e{first + i, first + (i + 1) % 4};
            edges.push_back(left ? e : OutlineEdge{e.to, e.from});
        }
    };
    square(0, 9, true);
    square(2, 7, false);
    square(3, 5, true);
    EXPECT_TRUE(detail::is_region_outline(p, {0, 1}, edges));
    EXPECT_FALSE(detail::is_region_outline(p, {1, 0}, edges));  // from below
    square(4, 4 + 1, true);                                     // covered twice, and touches
    EXPECT_FALSE(detail::is_region_outline(p, {0, 1}, edges));
}

TEST(RegionOutline, DifferentNamesInOnePlaceTouch) {
    const std::vector<LatticePoint> p{{0, 0, 0}, {2, 0, 0},  {0, 2, 0},
                                      {0, 0, 5}, {-2, 0, 0}, {0, -2, 0}};
    const std::vector<OutlineEdge> edges{{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}};
    EXPECT_FALSE(detail::is_region_outline(p, {0, 1}, edges));
    const std::vector<OutlineEdge> named{{0, 1}, {1, 2}, {2, 0}, {0, 4}, {4, 5}, {5, 0}};
    EXPECT_TRUE(detail::is_region_outline(p, {0, 1}, named));
}

// Meshes, against all pairs.

struct PairCounts {
    std::size_t crossing = 0;
    std::size_t touching = 0;
};

PairCounts count_all_pairs(const LatticeMesh& mesh) {
    PairCounts out;
    for (std::size_t a = 0; a < mesh.triangles.size(); ++a)
        for (std::size_t b = 0; b < a; ++b) {
            const auto kind =
                detail::find_contact(mesh.points, mesh.triangles[a], mesh.triangles[b]).kind;
            if (kind == detail::ContactKind::None) continue;
            ++(kind == detail::ContactKind::Touch ? out.touching : out.crossing);
        }
    return out;
}

// Points of equal value must have equal names; triangles without area go.
void tidy(LatticeMesh& mesh) {
    for (auto& t : mesh.triangles)
        for (auto& c : t)
            c = static_cast<std::uint32_t>(
                std::find(mesh.points.begin(), mesh.points.end(), mesh.points[c]) -
                mesh.points.begin());
    std::erase_if(mesh.triangles, [&](const Triangle& t) {
        return are_collinear(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]);
    });
}

// Returns whether nothing was found.
bool expect_same_pairs(LatticeMesh mesh) {
    tidy(mesh);
    const PairCounts expected = count_all_pairs(mesh);
    const ValidationReport report = validate(mesh);
    EXPECT_EQ(report.count(DefectKind::SelfIntersection), expected.crossing);
    EXPECT_EQ(report.count(DefectKind::FacesTouch), expected.touching);
    return expected.crossing + expected.touching == 0;
}

// A grid of n × n corners placed by `corner`, two triangles a square.
template <class Corner>
LatticeMesh grid_mesh(std::uint32_t n, const Corner& corner) {
    LatticeMesh mesh;
    for (std::uint32_t i = 0; i < n; ++i)
        for (std::uint32_t k = 0; k < n; ++k) mesh.points.push_back(corner(i, k));
    for (std::uint32_t i = 0; i + 1 < n; ++i)
        for (std::uint32_t k = 0; k + 1 < n; ++k) {
            const std::uint32_t a = i * n + k;
            mesh.triangles.push_back({a, a + n, a + n + 1});
            mesh.triangles.push_back({a, a + n + 1, a + 1});
        }
    return mesh;
}

TEST(Sheets, BumpySurfacesWithFoldsAgreeWithAllPairs) {
    Random random(5);  // NOLINT
    int clean = 0;
    int found = 0;
    for (int round = 0; round < 150; ++round) {
        const std::int64_t stretch = 2 + below(random, 4);
        const std::int64_t shake = below(random, 5);
        const std::int64_t height = 1 + below(random, 12);
        const auto mesh = grid_mesh(9, [&](std::uint32_t i, std::uint32_t k) {
            return LatticePoint{stretch * i + below(random, shake + 1),
                                stretch * k + below(random, shake + 1), below(random, height)};
        });
        ++(expect_same_pairs(mesh) ? clean : found);
    }
    EXPECT_GT(clean, 20);
    EXPECT_GT(found, 20);
}

TEST(Sheets, RampsAboveThemselvesAgreeWithAllPairs) {
    // Two turns of a winding stair, the second a bit wider: every triangle faces up, and the
    // projection is covered twice.
    for (const std::int64_t rise : {0, 1, 3}) {
        const std::array<LatticePoint, 4> way{{{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}}};
        const auto mesh = grid_mesh(9, [&](std::uint32_t i, std::uint32_t k) {
            const auto w = way[k % 4];
            const std::int64_t r = 4 + 2 * i + k / 4;
            return LatticePoint{w.x * r, w.y * r, rise * k};
        });
        EXPECT_EQ(expect_same_pairs(mesh), rise > 0);
    }
}

// Fans of needles around apexes that may be anywhere, cut by others.
TEST(Sheets, FansOfNeedlesAgreeWithAllPairs) {
    Random random(9);  // NOLINT
    int found = 0;
    for (int round = 0; round < 12; ++round) {
        LatticeMesh mesh;
        for (int fan = 0; fan < 3; ++fan) {
            const auto apex = static_cast<std::uint32_t>(mesh.points.size());
            mesh.points.push_back({below(random, 900), below(random, 900), below(random, 200)});
            const std::int64_t height = below(random, 3) * 100;
            const std::uint32_t n = 90;
            for (std::uint32_t i = 0; i < n; ++i) {
                const double a = 2 * std::numbers::pi * i / n;
                mesh.points.push_back({std::lround(450 + 400 * std::cos(a)),
                                       std::lround(450 + 400 * std::sin(a)),
                                       height + below(random, 1 + round)});
            }
            for (std::uint32_t i = 0; i < n; ++i)
                mesh.triangles.push_back({apex, apex + 1 + i, apex + 1 + (i + 1) % n});
        }
        if (!expect_same_pairs(mesh)) ++found;
    }
    EXPECT_GT(found, 5);
}

// A prism over a convex polygon of n corners whose caps are fans, turned so that no face but the
// caps is parallel to another; rounding bends the caps a little.
LatticeMesh fan_prism(std::uint32_t n) {
    LatticeMesh mesh;
    const double r = 0x1p40;
    for (const double z : {0.0, 0.25})
        for (std::uint32_t i = 0; i < n; ++i) {
            const double a = 2 * std::numbers::pi * i / n;
            const double x = std::cos(a);
            const double y = std::sin(a);
            mesh.points.push_back({std::llround(r * (2 * x + y + 2 * z) / 3),
                                   std::llround(r * (-2 * x + 2 * y + z) / 3),
                                   std::llround(r * (-x - 2 * y + 2 * z) / 3)});
        }
    for (std::uint32_t i = 1; i + 1 < n; ++i) {
        mesh.triangles.push_back({0, i + 1, i});
        mesh.triangles.push_back({n, n + i, n + i + 1});
    }
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t k = (i + 1) % n;
        mesh.triangles.push_back({i, k, n + k});
        mesh.triangles.push_back({i, n + k, n + i});
    }
    return mesh;
}

TEST(Sheets, PrismWithFansForCapsTakesFewPairs) {
    for (const std::uint32_t n : {3000U, 12000U}) {
        ValidateOptions options;
        options.pair_limit = 400 * n;
        const ValidationReport report = validate(fan_prism(n), options);
        EXPECT_EQ(report.count(DefectKind::SelfIntersection), 0U) << report.to_string();
        EXPECT_EQ(report.count(DefectKind::FacesTouch), 0U);
    }
}

TEST(Sheets, ConeOfManyTrianglesIsOneSheet) {
    const std::uint32_t n = 4000;
    LatticeMesh mesh;
    mesh.points.push_back({0, 0, std::int64_t{1} << 42});
    for (std::uint32_t i = 0; i < n; ++i) {
        const double a = 2 * std::numbers::pi * i / n;
        mesh.points.push_back(
            {std::llround(0x1p40 * std::cos(a)), std::llround(0x1p40 * std::sin(a)), 0});
    }
    for (std::uint32_t i = 0; i < n; ++i) mesh.triangles.push_back({0, 1 + i, 1 + (i + 1) % n});
    ValidateOptions options;
    options.pair_limit = 100;
    EXPECT_EQ(validate(mesh, options).count(DefectKind::SelfIntersection), 0U);
}

// Needles from one corner to lines along a bar, which turn to and fro around it: neighbours are
// seen from opposite sides.
LatticeMesh bar_of_needles(std::uint32_t lines, std::uint32_t n) {
    LatticeMesh mesh;
    mesh.points.push_back({0, 0, 0});
    for (std::uint32_t j = 0; j < lines; ++j) {
        const auto first = static_cast<std::uint32_t>(mesh.points.size());
        for (std::uint32_t i = 0; i <= n; ++i) {
            const double along = 0x1p40 * (n + 3 * i);
            const double a = 2 * std::numbers::pi * j / lines + (i % 2 == 0 ? 0.01 : -0.01);
            const double y = 0x1p42 * std::cos(a);
            const double z = 0x1p42 * std::sin(a);
            mesh.points.push_back({std::llround((2 * along + y + 2 * z) / 3),
                                   std::llround((-2 * along + 2 * y + z) / 3),
                                   std::llround((-along - 2 * y + 2 * z) / 3)});
        }
        for (std::uint32_t i = 0; i < n; ++i)
            mesh.triangles.push_back({0, first + i, first + i + 1});
    }
    return mesh;
}

TEST(Sheets, NeedlesAlongABarAgreeWithAllPairs) {
    LatticeMesh mesh = bar_of_needles(5, 40);
    EXPECT_TRUE(expect_same_pairs(mesh));
    // From the first line to the third one, through the second.
    mesh.triangles.push_back({0, 1, 83});
    mesh.triangles.push_back({0, 41, 72});
    EXPECT_FALSE(expect_same_pairs(mesh));
}

TEST(Sheets, NeedlesAlongABarTakeFewPairs) {
    const std::uint32_t n = 600;
    const LatticeMesh mesh = bar_of_needles(4, n);
    ValidateOptions options;
    options.pair_limit = 100;
    EXPECT_EQ(validate(mesh, options).count(DefectKind::SelfIntersection), 0U);
}

TEST(TurnedBox, BoxesThatAreApartHoldNothingThatMeets) {
    Random random(3);  // NOLINT
    int apart = 0;
    for (int round = 0; round < 20000; ++round) {
        // Needles through a common region, at all sizes of coordinates.
        const int bits = 3 + static_cast<int>(below(random, 50));
        const std::int64_t reach = std::int64_t{1} << bits;
        std::vector<LatticePoint> p;
        const auto anywhere = [&] {
            return LatticePoint{below(random, reach), below(random, reach), below(random, reach)};
        };
        const auto near = [&](const LatticePoint& q) {
            return LatticePoint{q.x + below(random, 4), q.y + below(random, 4),
                                q.z + below(random, 4)};
        };
        std::vector<Triangle> triangles;
        for (std::uint32_t side = 0; side < 2; ++side) {
            const LatticePoint a = anywhere();
            const LatticePoint b = anywhere();
            for (std::uint32_t i = 0; i < 3; ++i) {
                const auto first = static_cast<std::uint32_t>(p.size());
                p.insert(p.end(), {near(a), near(a), near(b)});
                triangles.push_back({first, first + 1, first + 2});
            }
        }
        const detail::BoxFrame frame({0, 0, 0}, {reach + 3, reach + 3, reach + 3});
        const std::array<std::uint32_t, 3> low{0, 1, 2};
        const std::array<std::uint32_t, 3> high{3, 4, 5};
        const auto x = detail::TurnedBox::around(frame, p, triangles, low);
        const auto y = detail::TurnedBox::around(frame, p, triangles, high);
        if (!x || !y || !x->is_apart(*y, frame)) continue;
        ++apart;
        for (const std::uint32_t i : low)
            for (const std::uint32_t k : high) {
                const auto& t = triangles[i];
                const auto& u = triangles[k];
                if (are_collinear(p[t[0]], p[t[1]], p[t[2]]) ||
                    are_collinear(p[u[0]], p[u[1]], p[u[2]]))
                    continue;
                ASSERT_EQ(detail::find_contact(p, t, u).kind, detail::ContactKind::None) << round;
            }
    }
    EXPECT_GT(apart, 2000);
}

}  // namespace
}  // namespace trisect

// SPDX-License-Identifier: Apache-2.0
//
// Boxes of parts of facets (facet_clip.h), against points of the facets.

#include <trisect/bsp/two_meshes/facet_clip.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>

#include <gtest/gtest.h>

namespace {

using trisect::LatticeMesh;
using trisect::LatticePoint;
using trisect::detail::Box;
using trisect::detail::FacetClip;
using trisect::detail::Frame;
using trisect::detail::PackedBox;

struct Facet {
    LatticeMesh mesh;
    Frame frame;
    PackedBox box;

    explicit Facet(const std::array<LatticePoint, 3>& corners, const Box& all) {
        mesh.points.assign(corners.begin(), corners.end());
        mesh.triangles = {{0, 1, 2}};
        frame = Frame::covering(all);
        Box own;
        for (const LatticePoint& p : corners) own.add(p);
        box = PackedBox::of(frame, own, 0);
    }
    [[nodiscard]] PackedBox clipped(const PackedBox& within) const {
        return FacetClip(frame, mesh).clipped(0, within.intersected(box));
    }
};

// Positions of a frame are the rounded ones of cells.
struct Cells {
    std::mt19937 random;
    std::int64_t reach;

    std::int64_t coordinate() {
        const double part = static_cast<double>(random()) * 0x1p-31 - 1;
        return static_cast<std::int64_t>(part * static_cast<double>(reach));
    }
    LatticePoint point() { return {coordinate(), coordinate(), coordinate()}; }
    [[nodiscard]] Box all() const {
        Box b;
        b.add(LatticePoint{-reach, -reach, -reach});
        b.add(LatticePoint{reach, reach, reach});
        return b;
    }
    PackedBox box(const Frame& frame) {
        Box b;
        b.add(point());
        b.add(point());
        return PackedBox::of(frame, b);
    }
};

bool has(const PackedBox& box, const std::array<int, 3>& at) {
    for (std::size_t k = 0; k < 3; ++k)
        if (at[k] < box.low(k) || at[k] > box.high(k)) return false;
    return true;
}

// A point of the facet by its parts of the sides, and where it is in the frame.
std::array<int, 3> position(const Facet& f, double u, double v) {
    std::array<int, 3> at{};
    for (int k = 0; k < 3; ++k) {
        const auto c = [&](std::size_t i) { return f.mesh.points[i][k].to_double(); };
        const double x = c(0) + u * (c(1) - c(0)) + v * (c(2) - c(0));
        at[static_cast<std::size_t>(k)] =
            f.frame.at(static_cast<std::size_t>(k), static_cast<std::int64_t>(std::floor(x)));
    }
    return at;
}

void expect_all_points_kept(std::int64_t reach, std::uint32_t seed) {
    Cells cells{std::mt19937(seed), reach};
    std::size_t empty = 0;
    std::size_t smaller = 0;
    for (int round = 0; round < 300; ++round) {
        std::array<LatticePoint, 3> corners{cells.point(), cells.point(), cells.point()};
        // Long and thin, half of the time.
        if (round % 2 == 0)
            corners[2] = {corners[0].x.to_integer() + reach / 1000, corners[0].y, corners[0].z};
        const Facet facet(corners, cells.all());
        const PackedBox within = cells.box(facet.frame).intersected(facet.box);
        const PackedBox part = facet.clipped(within);
        empty += part.is_empty() && !within.is_empty() ? 1 : 0;
        if (within.is_empty()) continue;
        EXPECT_TRUE(part.is_empty() || within.contains(part));
        smaller += !part.is_empty() && !part.contains(within) ? 1 : 0;
        for (int i = 0; i <= 40; ++i)
            for (int j = 0; i + j <= 40; ++j) {
                const auto at = position(facet, i / 40.0, j / 40.0);
                EXPECT_EQ(has(part, at), has(within, at));
            }
    }
    EXPECT_GT(empty, 10U);
    EXPECT_GT(smaller, 10U);
}

TEST(FacetClip, KeepsAllPointsOfTheFacetInTheBox) {
    expect_all_points_kept(1000, 1);
    expect_all_points_kept(std::int64_t{1} << 30, 2);
    expect_all_points_kept(std::int64_t{1} << 51, 3);
}

TEST(FacetClip, FollowsALongFacet) {
    Cells cells{std::mt19937(1), 30000};
    const Facet needle({LatticePoint{-20000, -20000, -20000}, LatticePoint{20000, 20000, 20000},
                        LatticePoint{20000, 20000, 19000}},
                       cells.all());
    Box slab;
    slab.add(LatticePoint{5000, -30000, -30000});
    slab.add(LatticePoint{6000, 30000, 30000});
    const PackedBox part = needle.clipped(PackedBox::of(needle.frame, slab));
    for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_GE(part.low(k), k == 2 ? 4000 : 4990);
        EXPECT_LE(part.high(k), 6010);
    }
    Box beside;
    beside.add(LatticePoint{5000, 7000, -30000});
    beside.add(LatticePoint{6000, 30000, 30000});
    EXPECT_TRUE(needle.clipped(PackedBox::of(needle.frame, beside)).is_empty());
}

TEST(FacetClip, LeavesWhatEndsInTheBox) {
    Cells cells{std::mt19937(1), 30000};
    const Facet facet({LatticePoint{1, 2, 3}, LatticePoint{40, 2, 3}, LatticePoint{1, 50, 9}},
                      cells.all());
    const PackedBox all = facet.clipped(PackedBox::of(facet.frame, cells.all()));
    EXPECT_EQ(all.lo, facet.box.lo);
    EXPECT_EQ(all.minus_hi, facet.box.minus_hi);
}

}  // namespace

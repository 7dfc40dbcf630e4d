// SPDX-License-Identifier: Apache-2.0
//
// The header of a native file, and its cells one by one.

#include <trisect/bsp/native_file.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/bsp/brep_index.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid_measure.h>
#include <trisect/kernel/error.h>

#include "support/solids.h"

namespace {

using trisect::NativeCell;
using trisect::NativeFile;
using trisect::NativeInfo;
using trisect::Solid;

NativeFile file_of(const Solid& solid, bool divided) {
    return NativeFile::of_bytes(native_bytes(solid, {.divided = divided}), "memory");
}

TEST(NativeCells, TheHeaderOfAnImport) {
    const NativeInfo info = file_of(solids::box(0, 4), false).info();
    EXPECT_EQ(info.version, 1U);
    EXPECT_EQ(info.cells, 1U);
    EXPECT_EQ(info.depth, 1U);
    EXPECT_EQ(info.triangles, 12U);
    EXPECT_EQ(info.points, 8U);
    EXPECT_EQ(info.polygons, 12U);
    EXPECT_EQ(info.sources, 1U);
    EXPECT_EQ(info.fragments, 0U);
    EXPECT_FALSE(info.is_unbounded);
    EXPECT_EQ(info.bounds.lo, (trisect::Point3d{0, 0, 0}));
    EXPECT_EQ(info.bounds.hi, (trisect::Point3d{4, 4, 4}));
}

TEST(NativeCells, TheHeaderOfUnboundedSets) {
    EXPECT_TRUE(file_of(Solid::whole_space(), false).info().is_unbounded);
    EXPECT_GT(file_of(Solid(), false).info().bounds.lo[0],
              file_of(Solid(), false).info().bounds.hi[0]);
    const NativeInfo info = file_of(Solid::half_space({0, 0, 1, 0}), false).info();
    EXPECT_TRUE(info.is_unbounded);
    EXPECT_TRUE(std::isinf(info.bounds.hi[1]));
}

TEST(NativeCells, TheOneCellOfAnImport) {
    const NativeFile file = file_of(solids::box(0, 4), false);
    const NativeCell cell = file.cell(0);
    EXPECT_TRUE(std::isinf(cell.bounds.lo[0]));
    EXPECT_TRUE(std::isinf(cell.bounds.hi[2]));
    EXPECT_EQ(cell.winding, 0);
    EXPECT_EQ(cell.polygons.size(), 12U);
    for (const auto& p : cell.polygons) {
        EXPECT_TRUE(p.whole);
        ASSERT_EQ(p.corners.size(), 3U);
        for (const auto& c : p.corners)
            EXPECT_TRUE(std::ranges::all_of(c, [](double x) { return x == 0 || x == 4; }));
    }
    EXPECT_THROW((void)file.cell(1), trisect::UsageError);
}

TEST(NativeCells, OfAHalfSpace) {
    const NativeCell cell = file_of(Solid::half_space({0, 0, 1, 0}), false).cell(0);
    ASSERT_EQ(cell.polygons.size(), 1U);
    EXPECT_TRUE(cell.polygons[0].corners.empty());
}

// Cells fill space, their references are where they say, and together they list every facet.
TEST(NativeCells, TogetherAreTheSolid) {
    const Solid part = evaluate(Solid::from_mesh(trisect::make_icosphere(3, 4)) -
                                solids::ball(2, 2, {3, 0, 0}) - solids::box(-1, 1));
    const NativeFile file = file_of(part, true);
    ASSERT_GT(file.info().cells, 8U);
    const trisect::BrepIndex index(part);
    std::set<std::tuple<std::uint32_t, std::uint32_t>> named;
    for (std::uint64_t i = 0; i < file.info().cells; ++i) {
        const NativeCell cell = file.cell(i);
        for (std::size_t k = 0; k < 3; ++k) {
            EXPECT_LE(cell.bounds.lo[k], cell.reference[k]);
            EXPECT_GE(cell.bounds.hi[k], cell.reference[k]);
        }
        const bool inside = (cell.winding > 0) != cell.complement;
        EXPECT_EQ(index.locate(cell.reference).location,
                  inside ? trisect::Location::Inside : trisect::Location::Outside);
        for (const auto& p : cell.polygons) {
            EXPECT_GE(p.corners.size(), 3U);
            named.insert({p.source.operand, p.source.face});
        }
    }
    trisect::MeshMap map;
    (void)part.to_mesh(map);
    for (const auto& s : map.source) EXPECT_TRUE(named.contains({s.operand, s.face}));
}

// A cell needs its own blocks, and no others.
TEST(NativeCells, AreReadBesideDamage) {
    std::string bytes =
        native_bytes(Solid::from_mesh(trisect::make_icosphere(3, 6)), {.divided = true});
    ASSERT_GT(bytes.size(), std::size_t{8} << 16U);
    bytes[70000] = static_cast<char>(bytes[70000] ^ 1);
    const NativeFile file = NativeFile::of_bytes(bytes, "memory");
    std::size_t damaged = 0;
    for (std::uint64_t i = 0; i < file.info().cells; ++i) {
        try {
            (void)file.cell(i);
        } catch (const trisect::InputError& e) {
            ++damaged;
            EXPECT_EQ(e.place().offset, 65536U);
        }
    }
    EXPECT_GT(damaged, 0U);
    EXPECT_LT(damaged, file.info().cells);
    EXPECT_THROW((void)file.solid(), trisect::InputError);
}

}  // namespace

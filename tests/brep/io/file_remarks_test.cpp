// SPDX-License-Identifier: Apache-2.0
//
// What files say beside their mesh: normals of STL and empty fields of OBJ.
#include <trisect/brep/io/file_remarks.h>
#include <trisect/brep/io/formats/binary.h>

#include "support/mesh_files.h"

#include <limits>

namespace {

using namespace trisect;

std::vector<FileRemark> remarks(const std::string& text, MeshFormat format) {
    (void)io_test::read(text, format);  // remarks are for files that can be read
    return file_remarks(text, format, "test");
}

std::string facet(const std::string& normal, const std::string& c = "0 1 0") {
    return "facet" + normal + "\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex " + c +
           "\nendloop\nendfacet\n";
}

std::vector<FileRemark> ascii(const std::string& facets) {
    return remarks("solid facet normal\n" + facets + "endsolid\n", MeshFormat::StlAscii);
}

TEST(FileRemarks, AgreeingNormalsAreNotWorthARemark) {
    EXPECT_TRUE(ascii(facet(" normal 0 0 1") + facet(" NORMAL 3 -4 +1e-9")).empty());
}

TEST(FileRemarks, ANormalInTheFacetsPlaneOpposesNothing) {
    EXPECT_TRUE(ascii(facet(" normal 1 0 0")).empty());
}

TEST(FileRemarks, OpposedNormalsAreCountedFromTheFirst) {
    const auto all =
        ascii(facet(" normal 0 0 1") + facet(" normal 0 0 -1") + facet(" normal 1 0 -1e-300"));
    ASSERT_EQ(all.size(), 1U);
    EXPECT_EQ(all[0].kind, RemarkKind::FacetNormalOpposed);
    EXPECT_EQ(all[0].count, 2U);
    EXPECT_EQ(all[0].of, 3U);
    EXPECT_EQ(all[0].first.line, 9U);
    EXPECT_EQ(all[0].first.column, 1U);
}

TEST(FileRemarks, ZeroAbsentAndInfiniteNormalsAreMissing) {
    for (const char* normal :
         {" normal 0 0 0", "", " normal nan 0 1", " normal 0 1", " normal x"}) {
        const auto all = ascii(facet(normal));
        ASSERT_EQ(all.size(), 1U) << normal;
        EXPECT_EQ(all[0].kind, RemarkKind::FacetNormalMissing) << normal;
        EXPECT_EQ(all[0].first.to_string(), "test:2:1") << normal;
    }
}

TEST(FileRemarks, FacetsWithoutAreaHaveNoSide) {
    EXPECT_TRUE(ascii(facet(" normal 0 0 -1", "2 0 0")).empty());
}

// The corner is above the line by less than the products' last bits.
TEST(FileRemarks, TheSideOfASliverIsExact) {
    const std::string sliver =
        "\nouter loop\nvertex 0.1 0.1 0\nvertex 0.7 0.7 0\nvertex 0.3 0.3000000000000001 0\n"
        "endloop\nendfacet\n";
    EXPECT_TRUE(ascii("facet normal 0 0 1" + sliver).empty());
    EXPECT_EQ(ascii("facet normal 0 0 -1" + sliver).size(), 1U);
}

TEST(FileRemarks, BinaryPlacesAreBytes) {
    std::string s(80, ' ');
    detail::store(s, std::uint32_t{3}, false);
    const float infinite = std::numeric_limits<float>::infinity();
    for (const float z : {1.0F, -1.0F, infinite}) {
        for (const float v : {0.F, 0.F, z, 0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 0.F})
            detail::store(s, v, false);
        s += "ab";
    }
    const auto all = remarks(s, MeshFormat::Stl);
    ASSERT_EQ(all.size(), 2U);
    EXPECT_EQ(all[0].kind, RemarkKind::FacetNormalMissing);
    EXPECT_EQ(all[0].first.to_string(), "test: byte 184");
    EXPECT_EQ(all[1].kind, RemarkKind::FacetNormalOpposed);
    EXPECT_EQ(all[1].first.to_string(), "test: byte 134");
}

TEST(FileRemarks, ObjCornersThatEndInASlash) {
    const std::string points = "v 0 0 0\nv 1 0 0\nv 0 1 0\n# f 1/ 2/\n";
    EXPECT_TRUE(remarks(points + "f 1//1 2/2 3/1/1\n", MeshFormat::Obj).empty());
    const auto all = remarks(points + "f 1 2/1/ 3/\\\n\nf 1 2 3//\n", MeshFormat::Obj);
    ASSERT_EQ(all.size(), 1U);
    EXPECT_EQ(all[0].kind, RemarkKind::EmptyIndexField);
    EXPECT_EQ(all[0].count, 3U);
    EXPECT_EQ(all[0].of, 6U);
    EXPECT_EQ(all[0].first.to_string(), "test:5:5");
}

TEST(FileRemarks, KindsHaveNamesAndOtherFormatsHaveNone) {
    EXPECT_EQ(name_of(RemarkKind::FacetNormalMissing), "facet_normal_missing");
    EXPECT_EQ(name_of(RemarkKind::FacetNormalOpposed), "facet_normal_opposed");
    EXPECT_EQ(name_of(RemarkKind::EmptyIndexField), "empty_index_field");
    for (const MeshFormat format : {MeshFormat::Off, MeshFormat::Ply}) {
        const std::string bytes = format_mesh(io_test::tetrahedron(), {.format = format}).bytes;
        EXPECT_TRUE(remarks(bytes, format).empty());
    }
}

}  // namespace

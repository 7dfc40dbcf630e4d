// SPDX-License-Identifier: Apache-2.0
//
// Half-spaces: solids with one unbounded face. They cut, and they make bounded solids together;
// what stays unbounded has no B-rep and says so.

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>
#include <vector>

#include <trisect/brep/measure.h>
#include <trisect/kernel/error.h>

#include "figures.h"
#include "reference/random_solids.h"

namespace {

using degeneracy::cube;
using degeneracy::Figures;
using degeneracy::figures;
using trisect::evaluate;
using trisect::Expression;
using trisect::Plane;
using trisect::Solid;

Solid below(std::int64_t nx, std::int64_t ny, std::int64_t nz, std::int64_t d) {
    return Solid::half_space(Plane(nx, ny, nz, Plane::Coefficient(d)), {});
}

Figures of(const Expression& e) { return figures(evaluate(e).to_brep()); }

const Figures cube4{8, 12, 6, 6, 1, "64", 96};

class HalfSpaces : public ::testing::Test {
protected:
    const Solid c = engines::solid(cube(0, 4));
};

TEST_F(HalfSpaces, CutThroughFaces) {
    const Solid h = below(1, 0, 0, -1);  // x < 1
    EXPECT_EQ(of(c & h), (Figures{8, 12, 6, 6, 1, "16", 48}));
    EXPECT_EQ(of(c - h), (Figures{8, 12, 6, 6, 1, "48", 80}));
    EXPECT_EQ(of(c & ~h), (Figures{8, 12, 6, 6, 1, "48", 80}));
}

TEST_F(HalfSpaces, CutBetweenLatticePositions) {
    const Solid h = below(3, 0, 0, -4);  // x < 4/3
    EXPECT_EQ(of(c & h).volume, "64/3");
    EXPECT_EQ(of(c - h).volume, "128/3");
}

TEST_F(HalfSpaces, CutThroughTwoOppositeEdges) {
    const Solid h = below(1, -1, 0, 0);  // x < y
    const Figures half{6, 9, 5, 5, 1, "32", 48 + 16 * std::sqrt(2.0)};
    EXPECT_EQ(of(c & h), half);
    EXPECT_EQ(of(c - h), half);
}

TEST_F(HalfSpaces, CutThroughThreeVertices) {
    const Solid h = below(1, 1, 1, -4);
    EXPECT_EQ(of(c & h), (Figures{4, 6, 4, 4, 1, "32/3", 24 + 8 * std::sqrt(3.0)}));
    EXPECT_EQ(of(c - h), (Figures{7, 12, 7, 7, 1, "160/3", 72 + 8 * std::sqrt(3.0)}));
}

TEST_F(HalfSpaces, CutInAHexagon) {
    const Solid h = below(1, 1, 1, -6);  // through the middles of six edges
    const Figures half{10, 15, 7, 7, 1, "32", 48 + 12 * std::sqrt(3.0)};
    EXPECT_EQ(of(c & h), half);
    EXPECT_EQ(of(c - h), half);
}

TEST_F(HalfSpaces, TouchAVertexAnEdgeOrAFace) {
    for (const Solid& h : {below(1, 1, 1, -12), below(1, 1, 0, -8), below(1, 0, 0, -4)}) {
        EXPECT_EQ(of(c & h), cube4);
        EXPECT_TRUE(evaluate(c - h).is_empty());
        EXPECT_EQ(of(c - ~h), cube4);
        EXPECT_TRUE(evaluate(c & ~h).to_brep().is_empty());
    }
}

TEST_F(HalfSpaces, MissTheSolid) {
    EXPECT_EQ(of(c & below(1, 0, 0, -9)), cube4);
    EXPECT_TRUE(evaluate(c & below(1, 0, 0, 9)).is_empty());
}

TEST_F(HalfSpaces, FlushWithACut) {
    const Solid h = below(1, 0, 0, -1);
    const Solid rest = evaluate(c - h);
    EXPECT_EQ(of(rest - h), of(rest));
    EXPECT_EQ(of(rest | (c & h)), cube4);
}

TEST_F(HalfSpaces, ThreeMakeACorner) {
    const Expression corner = below(1, 0, 0, -2) & below(0, 1, 0, -2) & below(0, 0, 1, -2);
    EXPECT_EQ(of(c & corner), (Figures{8, 12, 6, 6, 1, "8", 24}));
    EXPECT_EQ(of(c - corner), (Figures{14, 21, 9, 9, 1, "56", 96}));
    const Solid evaluated = evaluate(corner);
    EXPECT_EQ(of(c & evaluated), (Figures{8, 12, 6, 6, 1, "8", 24}));
}

TEST_F(HalfSpaces, ThreeMakeASlantedCornerAtAVertex) {
    // Their planes meet in the cube's vertex (4, 4, 4) and cut it in six congruent parts.
    const Expression part = below(1, -1, 0, 0) & below(0, 1, -1, 0);
    EXPECT_EQ(of(c & part).volume, "32/3");
    EXPECT_EQ(of(c & part).vertices, 4U);
}

TEST_F(HalfSpaces, SixMakeABox) {
    const std::vector<Expression> sides{below(1, 0, 0, -4), below(-1, 0, 0, 0), below(0, 1, 0, -4),
                                        below(0, -1, 0, 0), below(0, 0, 1, -4), below(0, 0, -1, 0)};
    const Solid made = evaluate(Expression::all_of(sides));
    EXPECT_TRUE(evaluate(made ^ c).to_brep().is_empty());
    EXPECT_EQ(of(made & c), cube4);
    EXPECT_EQ(of(made), cube4);
}

TEST_F(HalfSpaces, OppositeOnesAreEverythingAndNothing) {
    const Solid h = below(1, 2, 3, -4);
    const Solid g = below(-1, -2, -3, 4);
    EXPECT_TRUE(evaluate(h | ~h).is_whole_space());
    EXPECT_TRUE(evaluate(h & ~h).is_empty());
    EXPECT_TRUE(evaluate(h & g).to_brep().is_empty());
    EXPECT_TRUE(evaluate(h ^ g ^ Solid::whole_space()).to_brep().is_empty());
    // The same plane with multiplied coefficients.
    EXPECT_TRUE(evaluate(h ^ below(5, 10, 15, -20)).to_brep().is_empty());
}

TEST_F(HalfSpaces, UnboundedBoundariesAreRefused) {
    const Solid h = below(1, 1, 0, 0);
    EXPECT_THROW((void)h.to_brep(), trisect::UnsupportedError);
    EXPECT_THROW((void)h.to_mesh(), trisect::UnsupportedError);
    EXPECT_THROW((void)evaluate(~h).to_brep(), trisect::UnsupportedError);
    EXPECT_THROW((void)evaluate(c | h).to_brep(), trisect::UnsupportedError);
    EXPECT_THROW((void)evaluate(h - c).to_brep(), trisect::UnsupportedError);
    EXPECT_THROW((void)evaluate(h & below(-1, -1, 0, -3)).to_brep(), trisect::UnsupportedError);
    EXPECT_FALSE(h.is_empty());
    EXPECT_FALSE(h.is_whole_space());
}

// Groups of fifteen decimal digits.
template <int N>
trisect::WideInt<N> decimal(std::initializer_list<std::int64_t> groups) {
    const trisect::WideInt<1> base(std::int64_t{1'000'000'000'000'000});
    trisect::WideInt<N> value(0);
    for (const std::int64_t g : groups)
        value = trisect::multiply<N>(value, base) + trisect::WideInt<N>(g);
    return value;
}

trisect::Int128 decimal128(std::int64_t high, std::int64_t low) {
    return trisect::Int128{high} * 1'000'000'000'000'000 + low;
}

trisect::PolygonMesh mesh_of(const reference::Operand& operand) {
    const trisect::LatticeMesh lattice_mesh = engines::lattice_mesh(operand);
    trisect::PolygonMesh mesh;
    for (const auto& p : lattice_mesh.points) mesh.points.push_back(p.doubles());
    for (const auto& t : lattice_mesh.triangles) mesh.add_triangle(t[0], t[1], t[2]);
    return mesh;
}

// A plane through an edge of a solid, cut by another plane where further facets pass by: several
// vertices lie within a unit in the last place of each other, on an edge along which one coordinate
// does not change. Their order follows from signs alone. Found by verifying random results.
TEST_F(HalfSpaces, VerticesNearerToEachOtherThanDoublesCanTell) {
    reference::Random random(8);
    const trisect::PolygonMesh a = mesh_of(reference::random_embedded_solid(random));
    const trisect::PolygonMesh b = mesh_of(reference::random_embedded_solid(random));
    trisect::PolygonMesh moved = evaluate(Solid::from_mesh(a) | Solid::from_mesh(b)).to_mesh();
    for (std::size_t i = 0; i < moved.points.size(); ++i)
        if (random.chance(1, 6)) moved.points[i][i % 3] += random.chance(1, 2) ? 0.125 : -0.125;
    trisect::SolidOptions options;
    options.import.lattice = trisect::Lattice{-48};
    options.import.require_closed = false;
    options.embedding = trisect::Embedding::Resolve;
    const Expression difference =
        (Expression(Solid::from_mesh(a, options)) | Solid::from_mesh(b, options)) ^
        Solid::from_mesh(moved, options);
    const Solid across = Solid::half_space(
        Plane(-256, 0, 0, decimal<6>({647, 421'111'883'655'301})), trisect::Lattice{-48});
    const Solid along = Solid::half_space(
        Plane(decimal128(121'052'679'546'074, 197'102'485'208'651),
              decimal128(31'413'198'769'670, 819'350'603'989'429),
              decimal128(151'545'855'209'223, 92'059'580'759'731),
              -decimal<6>({469'996'917'169'182, 401'677'154'693'457, 65'189'528'567'808})),
        trisect::Lattice{-48});
    const auto volume = [](const Expression& e) {
        return trisect::exact_volume(evaluate(e).to_brep());
    };
    EXPECT_EQ(volume(difference & across & along) + volume((difference & across) - along),
              volume(difference & across));
}

}  // namespace

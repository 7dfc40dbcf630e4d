// SPDX-License-Identifier: Apache-2.0
//
// Lines in which three planes or more meet and sectors of inside and outside alternate six times or
// more: faces go straight across each other there, and the line is an edge of all of them.

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <vector>

#include <trisect/brep/brep_mesh.h>
#include <trisect/brep/certificate.h>
#include <trisect/brep/measure.h>
#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/prism.h>
#include <trisect/brep/transform.h>
#include <trisect/brep/validate/validate.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid.h>
#include <trisect/bsp/solid_measure.h>
#include <trisect/bsp/solid_transform.h>
#include <trisect/kernel/diagnostics.h>

#include "support/solids.h"

namespace {

using trisect::AffineMap;
using trisect::Brep;
using trisect::Certificate;
using trisect::evaluate;
using trisect::exact_volume;
using trisect::ExactRational;
using trisect::Expression;
using trisect::Outline;
using trisect::PolygonMesh;
using trisect::Solid;

PolygonMesh slab_of(const Outline& outline, double low = -1, double high = 1) {
    return trisect::transformed(trisect::make_prism(outline, high - low),
                                AffineMap::translation({0, 0, low}));
}

Solid of(const PolygonMesh& mesh) { return Solid::from_mesh(mesh); }

PolygonMesh tetrahedron(const std::array<trisect::Point3d, 4>& corners) {
    PolygonMesh mesh;
    mesh.points.assign(corners.begin(), corners.end());
    mesh.corners = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
    for (const std::uint32_t end : {3U, 6U, 9U, 12U}) mesh.face_begin.push_back(end);
    return mesh;
}

// Of determinant 7; it takes prisms along an axis to prisms along none.
const AffineMap oblique{{{{1, 2, 0, 0}, {0, 1, 3, 0}, {1, 0, 1, 0}}}};

// Half-planes through the origin, in the square of half width 3.
const Outline left_half{{-3, -3}, {0, -3}, {0, 3}, {-3, 3}};
const Outline lower_half{{-3, -3}, {3, -3}, {3, 0}, {-3, 0}};
const Outline diagonal_half{{-3, -3}, {3, -3}, {-3, 3}};

// Their sectors: three wedges that have the axis in common.
Expression sectors(const AffineMap& map = AffineMap::translation({0, 0, 0})) {
    return of(transformed(slab_of(left_half), map)) ^ of(transformed(slab_of(lower_half), map)) ^
           of(transformed(slab_of(diagonal_half), map));
}

// Where corners are rounded it may remain undecided whether faces meet.
void expect_certified(const Certificate& certificate) {
    EXPECT_TRUE(certificate.closed);
    EXPECT_TRUE(certificate.oriented);
    EXPECT_EQ(certificate.self_intersecting_pairs.value_or(0), 0U);
}

// No face meets another one beyond the edges and corners that both have, in the mesh and in the
// B-rep, and the parts are found.
void expect_no_crossings(const Solid& set, const ExactRational& volume, std::size_t parts) {
    const PolygonMesh mesh = set.to_mesh(1);
    expect_certified(trisect::certify(mesh));
    EXPECT_TRUE(trisect::certify(mesh).holds());
    const PolygonMesh again = set.to_mesh(2);
    EXPECT_EQ(again.points, mesh.points);
    EXPECT_EQ(again.corners, mesh.corners);
    EXPECT_EQ(exact_volume(set), volume);
    for (const bool maximal_faces : {true, false}) {
        const Brep brep = set.to_brep({.maximal_faces = maximal_faces});
        EXPECT_TRUE(trisect::validate(brep).is_solid());
        EXPECT_EQ(exact_volume(brep), volume);
        expect_certified(trisect::certify(brep, trisect::to_polygon_mesh(brep)));
    }
    const std::vector<Solid> all = trisect::components(set);
    EXPECT_EQ(all.size(), parts);
    ExactRational sum(0);
    for (const Solid& part : all) sum = sum + exact_volume(part);
    EXPECT_EQ(sum, volume);
}

TEST(ThreePlanesThroughALine, FacesEndAtTheLine) {
    const Solid set = evaluate(sectors());
    expect_no_crossings(set, ExactRational(36), 3);
    const Brep brep = set.to_brep();
    EXPECT_EQ(brep.counts().shells, 3U);
    EXPECT_EQ(brep.edge_contact_count(), 1U);
    EXPECT_EQ(brep.counts().euler_characteristic(), 6);
}

TEST(ThreePlanesThroughALine, PrismsThatDoNotTouchAreArrangedInAPlane) {
    const Solid a = of(slab_of({{-5, -5}, {0, -5}, {0, 4}, {-5, 4}}));
    const Solid b = of(slab_of({{-3, -6}, {3, -6}, {3, 0}, {-3, 0}}));
    const Solid c = of(slab_of({{2, -2}, {-2, 2}, {-9, -5}, {-5, -9}}));
    const trisect::Diagnostics<trisect::EvaluateCounters> counted;
    const Solid set = evaluate(a ^ b ^ c);
    EXPECT_EQ(counted.counters().prism_leaves, 1U);
    const auto volume = [](const Expression& e) { return exact_volume(evaluate(e)); };
    const ExactRational two(2);
    const ExactRational pairs = volume(a & b) + volume(a & c) + volume(b & c);
    const ExactRational triple = volume(a & b & c);
    expect_no_crossings(set, volume(a) + volume(b) + volume(c) - two * pairs + two * two * triple,
                        trisect::components(set).size());
}

TEST(ThreePlanesThroughALine, ObliquePrismsDoTheSame) {
    expect_no_crossings(evaluate(sectors(oblique)), ExactRational(36 * 7), 3);
}

TEST(ThreePlanesThroughALine, AChainGivesTheSameBoundary) {
    Solid set = evaluate(of(slab_of(left_half)) ^ of(slab_of(lower_half)));
    set = evaluate(set ^ of(slab_of(diagonal_half)));
    expect_no_crossings(set, ExactRational(36), 3);
    const Brep brep = set.to_brep();
    EXPECT_EQ(brep.counts(), evaluate(sectors()).to_brep().counts());
}

TEST(ThreePlanesThroughALine, MeshesMayHaveAnEdgeOnTheLine) {
    const Outline a{{-3, -3}, {0, -3}, {0, 0}, {0, 3}, {-3, 3}};
    const Outline b{{-3, -3}, {3, -3}, {3, 0}, {0, 0}, {-3, 0}};
    const Outline c{{-3, -3}, {3, -3}, {0, 0}, {-3, 3}};
    for (unsigned with_edge = 1; with_edge < 8; ++with_edge) {
        SCOPED_TRACE(with_edge);
        const Solid set = evaluate(of(slab_of((with_edge & 1U) != 0 ? a : left_half)) ^
                                   of(slab_of((with_edge & 2U) != 0 ? b : lower_half)) ^
                                   of(slab_of((with_edge & 4U) != 0 ? c : diagonal_half)));
        expect_no_crossings(set, ExactRational(36), 3);
        EXPECT_EQ(set.to_brep().counts(), evaluate(sectors()).to_brep().counts());
    }
}

TEST(ThreePlanesThroughALine, ResultsAreOperands) {
    const Solid set = evaluate(sectors());
    const Solid of_mesh = Solid::from_mesh(set.to_mesh());
    const Solid of_brep = Solid::from_brep(set.to_brep());
    expect_no_crossings(of_mesh, ExactRational(36), 3);
    expect_no_crossings(of_brep, ExactRational(36), 3);
    const Solid slab = solids::box(-4, -4, 0, 4, 4, 2);
    for (const Solid& operand : {set, of_mesh, of_brep}) {
        // Below the slab's lower side the sectors are as they were, above it they are filled.
        expect_no_crossings(evaluate(operand ^ slab), ExactRational(36 + 128 - 36),
                            trisect::components(evaluate(operand ^ slab)).size());
        // A cube around part of the axis leaves the sectors above and below it as they were.
        expect_no_crossings(evaluate(operand - solids::box(-1, -1, -0.5, 1, 1, 0.5)),
                            ExactRational(36) - ExactRational(2), 3);
    }
}

// Facets of two planes pass through whole, with an edge on the axis. Those of the third one were
// cut elsewhere, and are joined with their neighbours but not across the axis.
TEST(ThreePlanesThroughALine, FacetsThatPassThroughCount) {
    const Solid of_mesh = Solid::from_mesh(evaluate(sectors()).to_mesh());
    const Expression holes = solids::box(-0.5, -0.125, -0.5, -0.25, 0.125, 0.5) |
                             solids::box(0.25, -0.125, -0.5, 0.5, 0.125, 0.5);
    const Solid set = evaluate(of_mesh - holes);
    expect_no_crossings(set, exact_volume(set), 3);
}

TEST(FivePlanesThroughALine, FacesEndAtTheLine) {
    const std::vector<Outline> halves{{{-6, -6}, {0, -6}, {0, 6}, {-6, 6}},
                                      {{-6, -6}, {6, -6}, {6, 0}, {-6, 0}},
                                      {{-6, -6}, {6, -6}, {-6, 6}},
                                      {{-6, -6}, {6, -6}, {6, 6}},
                                      {{-6, -6}, {6, -6}, {6, 3}, {-6, -3}}};
    const auto all = [&](const AffineMap& map) {
        Expression formula = of(transformed(slab_of(halves[0]), map));
        for (std::size_t i = 1; i < halves.size(); ++i)
            formula = formula ^ of(transformed(slab_of(halves[i]), map));
        return evaluate(formula);
    };
    const Solid set = all(AffineMap::translation({0, 0, 0}));
    expect_no_crossings(set, ExactRational(144), 5);
    EXPECT_EQ(set.to_brep().edge_contact_count(), 1U);
    expect_no_crossings(all(oblique), ExactRational(144 * 7), 5);
}

// Three families of parallel planes. Sides of the square meet the lines away from where those meet.
TEST(CheckerboardOfTriangles, EveryTriangleIsAPart) {
    const std::vector<Outline> outlines{{{1, 1}, {2, 1}, {2, 7}, {1, 7}},
                                        {{1, 1}, {4, 1}, {4, 7}, {1, 7}},
                                        {{1, 1}, {6, 1}, {6, 7}, {1, 7}},
                                        {{1, 1}, {7, 1}, {7, 2}, {1, 2}},
                                        {{1, 1}, {7, 1}, {7, 4}, {1, 4}},
                                        {{1, 1}, {7, 1}, {7, 6}, {1, 6}},
                                        {{1, 1}, {3, 1}, {1, 3}},
                                        {{1, 1}, {5, 1}, {1, 5}},
                                        {{1, 1}, {7, 1}, {1, 7}},
                                        {{1, 1}, {7, 1}, {7, 3}, {3, 7}, {1, 7}},
                                        {{1, 1}, {7, 1}, {7, 5}, {5, 7}, {1, 7}}};
    Expression formula = of(slab_of(outlines[0]));
    for (std::size_t i = 1; i < outlines.size(); ++i) formula = formula ^ of(slab_of(outlines[i]));
    const Solid set = evaluate(formula);
    expect_no_crossings(set, ExactRational(36), 15);
    EXPECT_EQ(set.to_brep().edge_contact_count(), 9U);
}

// The sectors end within the faces: the plane x = 0 goes on above and below them.
TEST(SectorsThatEnd, AFaceGoesOnBeyondThem) {
    const Solid set = evaluate(of(slab_of(left_half, -3, 3)) ^ of(slab_of(lower_half)) ^
                               of(slab_of(diagonal_half, -2, 2)));
    expect_no_crossings(set, ExactRational(90), trisect::components(set).size());
}

// Two tetrahedra with a common edge, vertically opposite each other; the edge lies in the upper
// side of a block. There that side is slit, from one end of the edge to the other.
TEST(SectorsThatEnd, AFaceIsSlitWhereTheyAreWithinIt) {
    const Solid block = solids::box(-4, -4, -4, 4, 4, 0);
    const auto wedge = [](double z) {
        return tetrahedron({{{-1, 0, 0}, {1, 0, 0}, {0, z, z}, {0, -z, z}}});
    };
    const Solid upper = of(wedge(1));
    const Solid lower = of(wedge(-1));
    const Solid set = evaluate(block ^ upper ^ lower);
    expect_no_crossings(set, ExactRational(256), 2);
    const Brep brep = set.to_brep();
    EXPECT_EQ(brep.counts().shells, 2U);
    EXPECT_EQ(brep.edge_contact_count(), 1U);
    // A wedge that stands on the side does not slit it.
    const Solid standing = evaluate(block | upper);
    EXPECT_EQ(standing.to_brep().counts().euler_characteristic(), 4);
    EXPECT_EQ(standing.to_brep().edge_contact_count(), 0U);
    // The set used again.
    const Solid cut = evaluate(Solid::from_brep(set.to_brep()) - solids::box(-5, -5, -5, 0, 5, 5));
    expect_no_crossings(cut, ExactRational(128), 2);
}

}  // namespace

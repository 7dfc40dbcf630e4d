// SPDX-License-Identifier: Apache-2.0
//
// Two solids in every way in which they can touch. The figures of each result were derived by hand;
// the naive engine checks the boundary itself.
//
// How contacts are counted. Where the solid touches itself the boundary is taken apart so that its
// inside decides what stays connected (see Brep):
//  - edge on edge, vertex on vertex, vertex on edge: copies on both sides, one contact a place. An
//    edge that is met in part, or at a vertex, is divided there;
//  - a vertex or an edge that meets the inside of a face leaves the face whole: no contact, no
//    vertex; neither do two edges that cross;
//  - faces with common area join, or cancel.

#include <gtest/gtest.h>

#include <cmath>
#include <ostream>
#include <string>
#include <vector>

#include "figures.h"

namespace touching_pairs_test {
namespace {

using degeneracy::cube;
using degeneracy::Figures;
using degeneracy::octahedron;
using reference::axes_rotated;
using reference::box;
using reference::Operand;
using reference::prism;
using reference::pyramid;
using reference::tetrahedron;
using Kind = reference::Expression::Kind;

struct Configuration {
    std::string name;
    Operand a;
    Operand b;
    Figures joined;  // a | b
    Figures common;  // a & b
    Figures a_less;  // a - b
    Figures b_less;  // b - a
    Figures either;  // a ^ b
};

std::ostream& operator<<(std::ostream& out, const Configuration& c) { return out << c.name; }

const Figures nothing;
const Figures cube4{8, 12, 6, 6, 1, "64", 96};
const Operand block = cube(0, 4);

double root(double x) { return std::sqrt(x); }

Figures plain_box(const std::string& volume, double area) { return {8, 12, 6, 6, 1, volume, area}; }
Figures plain_tetrahedron(const std::string& volume, double area) {
    return {4, 6, 4, 4, 1, volume, area};
}

// Interiors apart: nothing in common, nothing taken away, either is both.
Configuration apart(std::string name, const Operand& b, const Figures& of_b,
                    const Figures& joined) {
    return {std::move(name), block, b, joined, nothing, cube4, of_b, joined};
}
// b inside the cube: a cavity or a notch is left.
Configuration within(std::string name, const Operand& b, const Figures& of_b, const Figures& left) {
    return {std::move(name), block, b, cube4, of_b, left, nothing, left};
}

std::vector<Configuration> vertex_contacts() {
    const Operand on_edge = tetrahedron({4, 4, 2}, {7, 5, 2}, {5, 7, 2}, {5, 5, 5});
    const double on_edge_area = 4 + root(94) + root(22);
    const Operand on_face = tetrahedron({4, 2, 2}, {7, 1, 1}, {7, 3, 1}, {7, 2, 3});
    const double on_face_area = 2 + root(10) + root(46);
    const double in_corner_area = 1.5 * root(17) + root(3) / 2;
    const double in_edge_area = 4 + root(26) + root(2);
    return {
        apart("VertexOnVertex", cube(4, 6), plain_box("8", 24),
              {16, 24, 12, 12, 2, "72", 120, 1, 0}),
        apart("VertexOnEdge", on_edge, plain_tetrahedron("4", on_edge_area),
              {13, 19, 10, 10, 2, "68", 96 + on_edge_area, 1, 0}),
        apart("VertexOnFace", on_face, plain_tetrahedron("2", on_face_area),
              {12, 18, 10, 10, 2, "66", 96 + on_face_area, 0, 0}),
        within("VertexOnVertexFromInside", tetrahedron({0, 0, 0}, {1, 2, 2}, {2, 1, 2}, {2, 2, 1}),
               plain_tetrahedron("5/6", in_corner_area),
               {12, 18, 10, 10, 2, "379/6", 96 + in_corner_area, 1, 0}),
        within("VertexOnEdgeFromInside", tetrahedron({4, 4, 2}, {1, 3, 2}, {3, 1, 2}, {2, 2, 1}),
               plain_tetrahedron("4/3", in_edge_area),
               {13, 19, 10, 10, 2, "188/3", 96 + in_edge_area, 1, 0}),
        within("VertexOnFaceFromInside", tetrahedron({4, 2, 2}, {1, 1, 1}, {1, 3, 1}, {1, 2, 3}),
               plain_tetrahedron("2", on_face_area),
               {12, 18, 10, 10, 2, "62", 96 + on_face_area, 0, 0}),
        {"VerticesOnSixFacesFromInside",
         cube(-4, 4),
         octahedron({0, 0, 0}, 4),
         {8, 12, 6, 6, 1, "512", 384},
         {6, 12, 8, 8, 1, "256/3", 64 * root(3)},
         {14, 24, 14, 14, 2, "1280/3", 384 + 64 * root(3)},
         nothing,
         {14, 24, 14, 14, 2, "1280/3", 384 + 64 * root(3)}},
    };
}

std::vector<Configuration> edge_on_edge() {
    const double crossing_area = 2 * root(152) + 2 * root(26);
    const double whole_area = 2 * root(52) + root(33);
    const double part_area = 2 * root(13) + root(27);
    const Operand wedge = prism({{0, 0}, {3, 1}, {1, 3}}, 0, 4);
    const double wedge_side = 2 * root(10) + 2 * root(2);
    return {
        apart("EdgeCrossingEdge", tetrahedron({2, 6, 2}, {6, 2, 2}, {7, 7, 1}, {7, 7, 3}),
              plain_tetrahedron("8", crossing_area),
              {12, 18, 10, 10, 2, "72", 96 + crossing_area, 0, 0}),
        apart("EdgeOnEqualEdge", box({4, 4, 0}, {6, 6, 4}), plain_box("16", 40),
              {16, 24, 12, 12, 2, "80", 136, 2, 1}),
        apart("EdgeInsideEdge", box({4, 4, 1}, {6, 6, 3}), plain_box("8", 24),
              {18, 26, 12, 12, 2, "72", 120, 2, 1}),
        apart("EdgeOverlappingTheEndOfAnEdge", box({4, 4, 2}, {6, 6, 6}), plain_box("16", 40),
              {18, 26, 12, 12, 2, "80", 136, 2, 1}),
        apart("EdgeOnPartOfAnEdgeWithACommonEnd", box({4, 4, 0}, {6, 6, 2}), plain_box("8", 24),
              {17, 25, 12, 12, 2, "72", 120, 2, 1}),
        // The material on the two sides of the groove meets along the edge only: two copies of the
        // edge between the same two vertices, which stay whole.
        within("EdgeOnEqualEdgeFromInside", tetrahedron({4, 4, 0}, {4, 4, 4}, {1, 2, 2}, {2, 1, 2}),
               plain_tetrahedron("10/3", whole_area),
               {10, 18, 10, 10, 1, "182/3", 96 + whole_area, 0, 1}),
        within("EdgeInsideEdgeFromInside", tetrahedron({4, 4, 1}, {4, 4, 3}, {1, 2, 2}, {2, 1, 2}),
               plain_tetrahedron("5/3", part_area),
               {12, 20, 10, 10, 1, "187/3", 96 + part_area, 0, 1}),
        // Open at both ends: those vertices come apart as well.
        within("TunnelAlongAnEdge", wedge, {6, 9, 5, 5, 1, "16", 8 + 4 * wedge_side},
               {14, 21, 9, 9, 1, "48", 88 + 4 * wedge_side, 2, 1}),
        {"OctahedraOnACommonEdge",
         octahedron({0, 0, 0}, 4),
         octahedron({4, 4, 0}, 4),
         {12, 24, 16, 16, 2, "512/3", 128 * root(3), 2, 1},
         nothing,
         {6, 12, 8, 8, 1, "256/3", 64 * root(3)},
         {6, 12, 8, 8, 1, "256/3", 64 * root(3)},
         {12, 24, 16, 16, 2, "512/3", 128 * root(3), 2, 1}},
    };
}

std::vector<Configuration> edge_on_face() {
    const double inner = 4 * root(10);
    const double to_edge = 4 * root(10) + root(13);
    const double to_vertex = 3 + 2 * root(19) + root(13);
    const double across = 4 * root(10) + 2 * root(13);
    const double diagonal = 2 * root(88) + 2 * root(34);
    return {
        apart("EdgeInFace", tetrahedron({4, 1, 2}, {4, 3, 2}, {7, 2, 1}, {7, 2, 3}),
              plain_tetrahedron("2", inner), {12, 18, 10, 10, 2, "66", 96 + inner, 0, 0}),
        apart("EdgeInFaceEndingOnItsEdge", tetrahedron({4, 0, 2}, {4, 3, 2}, {7, 2, 1}, {7, 2, 3}),
              plain_tetrahedron("3", to_edge), {13, 19, 10, 10, 2, "67", 96 + to_edge, 1, 0}),
        apart("EdgeInFaceEndingOnItsVertex",
              tetrahedron({4, 4, 4}, {4, 2, 2}, {7, 2, 1}, {7, 2, 3}),
              plain_tetrahedron("2", to_vertex), {12, 18, 10, 10, 2, "66", 96 + to_vertex, 1, 0}),
        apart("EdgeInFaceRunningOutOverItsEdge",
              tetrahedron({4, 3, 2}, {4, 6, 2}, {7, 4, 1}, {7, 4, 3}),
              plain_tetrahedron("3", to_edge), {12, 18, 10, 10, 2, "67", 96 + to_edge, 0, 0}),
        apart("EdgeAcrossFaceFromEdgeToEdge",
              tetrahedron({4, 0, 2}, {4, 4, 2}, {7, 2, 1}, {7, 2, 3}),
              plain_tetrahedron("4", across), {14, 20, 10, 10, 2, "68", 96 + across, 2, 0}),
        apart("EdgeAcrossFaceFromVertexToVertex",
              tetrahedron({4, 0, 0}, {4, 4, 4}, {7, 1, 3}, {7, 3, 1}),
              plain_tetrahedron("8", diagonal), {12, 18, 10, 10, 2, "72", 96 + diagonal, 2, 0}),
        within("EdgeInFaceFromInside", tetrahedron({4, 1, 2}, {4, 3, 2}, {1, 2, 1}, {1, 2, 3}),
               plain_tetrahedron("2", inner), {12, 18, 10, 10, 2, "62", 96 + inner, 0, 0}),
        within("EdgeAcrossFaceFromInside", tetrahedron({4, 0, 2}, {4, 4, 2}, {1, 2, 1}, {1, 2, 3}),
               plain_tetrahedron("4", across), {14, 20, 10, 10, 2, "60", 96 + across, 2, 0}),
    };
}

std::vector<Configuration> edges_through() {
    // The slanted sides of the tetrahedron, halved by the face x = 4.
    const double sides = 6 * root(2) + root(37);
    // A triangular bar along y, whose edge lies in the face x = 4 and leaves over the edge x = y
    // = 4.
    const Operand grazing = axes_rotated(prism({{2, 4}, {1, 1}, {3, 1}}, 2, 6), 1);
    const double grazing_side = 2 + 2 * root(10);
    // The same along the edge x = z = 4, leaving through the vertex.
    const Operand along = axes_rotated(prism({{4, 4}, {3, 1}, {1, 3}}, 2, 6), 1);
    const double along_side = 2 * root(10) + 2 * root(2);
    return {
        {"ThreeEdgesThroughAFace",
         block,
         tetrahedron({1, 2, 2}, {7, 2, 2}, {7, 1, 1}, {7, 3, 1}),
         {14, 21, 10, 11, 1, "263/4", 96.75 + 0.75 * sides},
         {4, 6, 4, 4, 1, "1/4", 0.25 + sides / 4},
         {12, 18, 9, 10, 1, "255/4", 95.75 + sides / 4},
         {6, 9, 5, 5, 1, "7/4", 1.25 + 0.75 * sides},
         {18, 27, 14, 15, 2, "131/2", 97 + sides, 3, 3}},
        {"EdgeInFaceThroughItsEdge",
         block,
         grazing,
         {14, 22, 10, 10, 1, "70", 96 + 2 * grazing_side},
         {6, 9, 5, 5, 1, "6", 6 + 2 * grazing_side},
         {14, 22, 10, 10, 1, "58", 96 + 2 * grazing_side},
         {6, 9, 5, 5, 1, "6", 6 + 2 * grazing_side},
         {20, 31, 15, 15, 2, "64", 102 + 4 * grazing_side, 3, 3}},
        {"EdgeOnEdgeThroughItsVertex",
         block,
         along,
         {13, 21, 10, 10, 1, "72", 96 + 2 * along_side},
         {6, 9, 5, 5, 1, "8", 8 + 2 * along_side},
         {14, 22, 10, 10, 1, "56", 96 + 2 * along_side, 1, 1},
         {6, 9, 5, 5, 1, "8", 8 + 2 * along_side},
         {20, 31, 15, 15, 2, "64", 104 + 4 * along_side, 3, 4}},
    };
}

std::vector<Configuration> opposite_faces() {
    const Operand roof = axes_rotated(pyramid({{0, 0}, {4, 0}, {4, 4}, {0, 4}}, 4, {2, 2, 6}), 1);
    const Operand diamond = axes_rotated(prism({{2, 0}, {4, 2}, {2, 4}, {0, 2}}, 4, 6), 1);
    return {
        apart("FaceOnEqualFace", box({4, 0, 0}, {8, 4, 4}), cube4, plain_box("128", 160)),
        apart("FaceOnEqualFaceOfAPyramid", roof, {5, 8, 5, 5, 1, "32/3", 16 + 16 * root(2)},
              {9, 16, 9, 9, 1, "224/3", 80 + 16 * root(2)}),
        apart("FaceInsideFace", box({4, 1, 1}, {6, 3, 3}), plain_box("8", 24),
              {16, 24, 11, 12, 1, "72", 112}),
        apart("FaceInCornerOfFace", box({4, 0, 0}, {6, 2, 2}), plain_box("8", 24),
              {14, 21, 9, 9, 1, "72", 112}),
        apart("FaceAtEdgeOfFace", box({4, 1, 0}, {6, 3, 2}), plain_box("8", 24),
              {16, 24, 10, 10, 1, "72", 112}),
        apart("FaceAcrossFace", box({4, 1, 0}, {6, 3, 4}), plain_box("16", 40),
              {16, 24, 10, 10, 1, "80", 120}),
        apart("FaceOnPartOfFace", box({4, 2, 2}, {6, 6, 6}), plain_box("32", 64),
              {18, 28, 12, 12, 1, "96", 152}),
        apart("FaceCrossingFace", box({4, 1, -1}, {6, 3, 5}), plain_box("24", 56),
              {20, 32, 14, 14, 1, "88", 136}),
        // Its corners are the middles of the sides: four triangles are left of the face.
        apart("FaceWithVerticesOnTheEdgesOfFace", diamond, plain_box("16", 16 + 16 * root(2)),
              {16, 28, 14, 14, 1, "80", 96 + 16 * root(2)}),
        {"FaceOnFaceAsAStar",
         prism({{0, 0}, {12, 0}, {6, 12}}, 0, 2),
         prism({{0, 8}, {6, -4}, {12, 8}}, 2, 4),
         {18, 30, 14, 14, 1, "288", 240 + 48 * root(5)},
         nothing,
         {6, 9, 5, 5, 1, "144", 168 + 24 * root(5)},
         {6, 9, 5, 5, 1, "144", 168 + 24 * root(5)},
         {18, 30, 14, 14, 1, "288", 240 + 48 * root(5)}},
        {"SlantedFaceOnFaceAsAStar",
         octahedron({0, 0, 0}, 4),
         octahedron({3, 3, 2}, 4),
         {18, 36, 20, 20, 1, "512/3", 118 * root(3)},
         nothing,
         {6, 12, 8, 8, 1, "256/3", 64 * root(3)},
         {6, 12, 8, 8, 1, "256/3", 64 * root(3)},
         {18, 36, 20, 20, 1, "512/3", 118 * root(3)}},
        {"SquareFillsTheCornerOfAnL",
         prism({{0, 0}, {4, 0}, {4, 2}, {2, 2}, {2, 4}, {0, 4}}, 0, 2),
         box({2, 2, 0}, {4, 4, 2}),
         plain_box("32", 64),
         nothing,
         {12, 18, 8, 8, 1, "24", 56},
         plain_box("8", 24),
         plain_box("32", 64)},
    };
}

std::vector<Configuration> flush_faces() {
    return {
        within("FlushWithEqualFace", box({2, 0, 0}, {4, 4, 4}), plain_box("32", 64),
               plain_box("32", 64)),
        within("FlushInsideFace", box({2, 1, 1}, {4, 3, 3}), plain_box("8", 24),
               {16, 24, 11, 12, 1, "56", 112}),
        within("FlushInCornerOfThreeFaces", box({2, 0, 0}, {4, 2, 2}), plain_box("8", 24),
               {14, 21, 9, 9, 1, "56", 96}),
        within("FlushWithTwoOppositeFaces", box({1, 1, 0}, {3, 3, 4}), plain_box("16", 40),
               {16, 24, 10, 12, 1, "48", 120}),
        {"FlushWithPartOfTwoFaces",
         block,
         box({2, 2, 0}, {6, 6, 4}),
         {16, 24, 10, 10, 1, "112", 152},
         plain_box("16", 40),
         {12, 18, 8, 8, 1, "48", 88},
         {12, 18, 8, 8, 1, "48", 88},
         {24, 36, 16, 16, 2, "96", 176, 4, 2}},
        {"CrossingBarsInOnePlane",
         box({0, 2, 0}, {6, 4, 2}),
         box({2, 0, 0}, {4, 6, 2}),
         {24, 36, 14, 14, 1, "40", 88},
         plain_box("8", 24),
         {16, 24, 12, 12, 2, "16", 48},
         {16, 24, 12, 12, 2, "16", 48},
         {32, 48, 24, 24, 4, "32", 96, 8, 4}},
        {"FlushAsAStar",
         prism({{0, 0}, {12, 0}, {6, 12}}, 0, 2),
         prism({{0, 8}, {6, -4}, {12, 8}}, 0, 2),
         {24, 36, 14, 14, 1, "192", 224 + 32 * root(5)},
         {12, 18, 8, 8, 1, "96", 112 + 16 * root(5)},
         {18, 27, 15, 15, 3, "48", 72 + 24 * root(5)},
         {18, 27, 15, 15, 3, "48", 72 + 24 * root(5)},
         {36, 54, 30, 30, 6, "96", 144 + 48 * root(5), 12, 6}},
    };
}

std::vector<Configuration> without_contact() {
    return {
        apart("Disjoint", cube(5, 6), plain_box("1", 6), {16, 24, 12, 12, 2, "65", 102}),
        within("Nested", cube(1, 3), plain_box("8", 24), {16, 24, 12, 12, 2, "56", 120}),
        within("Equal", block, cube4, nothing),
        {"OverlappingCorners",
         block,
         cube(2, 6),
         {20, 30, 12, 12, 1, "120", 168},
         plain_box("8", 24),
         {14, 21, 9, 9, 1, "56", 96},
         {14, 21, 9, 9, 1, "56", 96},
         {28, 42, 18, 18, 2, "112", 192, 6, 6}},
    };
}

class TouchingPairs : public ::testing::TestWithParam<Configuration> {
protected:
    static Figures of(const Operand& a, Kind kind, const Operand& b) {
        return degeneracy::checked_figures({a, b}, reference::pair_expression(kind));
    }
};

TEST_P(TouchingPairs, HaveTheFiguresOfTheTable) {
    const Configuration& c = GetParam();
    EXPECT_EQ(of(c.a, Kind::Union, c.b), c.joined);
    EXPECT_EQ(of(c.b, Kind::Union, c.a), c.joined);
    EXPECT_EQ(of(c.a, Kind::Intersection, c.b), c.common);
    EXPECT_EQ(of(c.a, Kind::Difference, c.b), c.a_less);
    EXPECT_EQ(of(c.b, Kind::Difference, c.a), c.b_less);
    EXPECT_EQ(of(c.a, Kind::Xor, c.b), c.either);
}

std::string name_of(const ::testing::TestParamInfo<Configuration>& info) { return info.param.name; }

#define TRISECT_TOUCHING_TABLE(table) \
    INSTANTIATE_TEST_SUITE_P(table, TouchingPairs, ::testing::ValuesIn(table()), name_of)

TRISECT_TOUCHING_TABLE(vertex_contacts);
TRISECT_TOUCHING_TABLE(edge_on_edge);
TRISECT_TOUCHING_TABLE(edge_on_face);
TRISECT_TOUCHING_TABLE(edges_through);
TRISECT_TOUCHING_TABLE(opposite_faces);
TRISECT_TOUCHING_TABLE(flush_faces);
TRISECT_TOUCHING_TABLE(without_contact);

}  // namespace
}  // namespace touching_pairs_test

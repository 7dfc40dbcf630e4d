// SPDX-License-Identifier: Apache-2.0

#include <trisect/brep/io/exact_boundary.h>

#include <gtest/gtest.h>

#include <string>

#include <trisect/brep/brep_mesh.h>
#include <trisect/brep/measure.h>
#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid.h>
#include <trisect/kernel/error.h>

#include "support/fractions.h"
#include "support/solids.h"

namespace {

using trisect::Brep;
using trisect::exact_text;
using trisect::Expression;
using trisect::make_box;
using trisect::read_exact;

void expect_same(const Brep& a, const Brep& b) {
    ASSERT_EQ(a.counts(), b.counts());
    EXPECT_EQ(a.lattice().exponent, b.lattice().exponent);
    for (const auto v : a.vertices()) {
        const auto& p = a.point(v);
        const auto& q = b.point(v);
        ASSERT_EQ(p.is_lattice(), q.is_lattice());
        if (p.is_lattice())
            EXPECT_EQ(p.lattice(), q.lattice());
        else
            EXPECT_EQ(p.plane_point()->planes, q.plane_point()->planes);
    }
    for (const auto h : a.halfedges()) {
        EXPECT_EQ(a.origin(h), b.origin(h));
        EXPECT_EQ(a.twin(h), b.twin(h));
    }
    for (const auto f : a.faces()) {
        EXPECT_EQ(a.plane(f), b.plane(f));
        EXPECT_EQ(a.source(f), b.source(f));
        EXPECT_EQ(a.shell(f), b.shell(f));
        EXPECT_EQ(a.loops(f).size(), b.loops(f).size());
    }
    EXPECT_EQ(a.vertex_contact_count(), b.vertex_contact_count());
    EXPECT_EQ(a.edge_contact_count(), b.edge_contact_count());
    EXPECT_EQ(exact_volume(a), exact_volume(b));
}

void expect_round_trip(const Expression& e) {
    const Brep brep = evaluate(e).to_brep();
    const std::string text = exact_text(brep);
    const Brep again = read_exact(text, "text");
    expect_same(brep, again);
    EXPECT_EQ(exact_text(again), text);
}

TEST(ExactBoundary, ResultsOfBooleansAreReadBackBitForBit) {
    const auto ball = solids::of_mesh(trisect::make_icosphere(1.1, 2));
    const auto cube = solids::of_mesh(make_box({0, 0, 0}, {1.3, 1.7, 0.9}));
    expect_round_trip(ball | cube);
    expect_round_trip(ball - cube);
    expect_round_trip(ball & cube);
    expect_round_trip(cube - solids::of_mesh(make_box({0.2, 0.3, -1}, {0.4, 0.5, 2})));  // a hole
    expect_round_trip(cube -
                      solids::of_mesh(make_box({0.2, 0.3, 0.1}, {0.4, 0.5, 0.2})));  // a cavity
    expect_round_trip(cube & solids::of_mesh(make_box({2, 2, 2}, {3, 3, 3})));       // nothing
}

TEST(ExactBoundary, SolidsThatTouchThemselves) {
    const auto box = [](double x, double y, double z) {
        return solids::of_mesh(make_box({x, y, z}, {x + 1, y + 1, z + 1}));
    };
    expect_round_trip(box(0, 0, 0) | box(1, 1, 0));  // in an edge
    expect_round_trip(box(0, 0, 0) | box(1, 1, 1));  // in a vertex
    expect_round_trip(box(0, 0, 0) | box(1, 1, 0) | box(1, 0, 1));
}

void expect_error(const std::string& text, const std::string& message) {
    try {
        (void)read_exact(text, "e");
        ADD_FAILURE() << "read: " << text;
    } catch (const trisect::InputError& e) {
        EXPECT_EQ(e.what(), message);
    }
}

const std::string head = "trisect-exact 1\nlattice 0\n";
const std::string planes = "planes 4\n-1 0 0 0\n0 -1 0 0\n0 0 -1 0\n1 1 1 -1\n";
const std::string vertices = "vertices 4\np 0 0 0\np 1 0 0\nq 0 2 3\np 0 0 1\n";
const std::string faces =
    "faces 4\n0 0 0 1 3 0 3 2\n1 0 1 1 3 0 1 3\n2 0 2 1 3 0 2 1\n3 0 3 1 3 1 2 3\n";

// Two wedges, vertically opposite each other on an edge within a side of a box: it is slit there.
TEST(ExactBoundary, ASlitIsReadBack) {
    const auto wedge = [](double z) {
        trisect::PolygonMesh mesh;
        mesh.points = {{-1, 0, 0}, {1, 0, 0}, {0, z, z}, {0, -z, z}};
        mesh.corners = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
        for (const std::uint32_t end : {3U, 6U, 9U, 12U}) mesh.face_begin.push_back(end);
        return Expression(trisect::Solid::from_mesh(mesh));
    };
    expect_round_trip(Expression(trisect::Solid::from_mesh(make_box({-4, -4, -4}, {4, 4, 0}))) ^
                      wedge(1) ^ wedge(-1));
}

// The same points on coarser lattices: the coordinates of corners have bits behind the point.
TEST(ExactBoundary, FractionsAreReadBackBitForBit) {
    const Brep whole =
        trisect::evaluate(Expression(trisect::Solid::from_mesh(trisect::make_icosphere(1, 1))) -
                          trisect::Solid::from_mesh(make_box({-0.3, -0.2, -2}, {0.4, 0.1, 2})))
            .to_brep();
    for (const int bits : {32, 56}) {
        const Brep brep = trisect::test::with_fractions(whole, bits);
        const std::string text = exact_text(brep);
        EXPECT_EQ(text.rfind("trisect-exact 2\n", 0), 0U);
        const Brep again = read_exact(text, "text");
        expect_same(brep, again);
        EXPECT_EQ(exact_text(again), text);
        EXPECT_EQ(exact_volume(again), exact_volume(whole));
        EXPECT_EQ(again.counts(), whole.counts());
        EXPECT_EQ(area(again).value, area(whole).value);
        EXPECT_EQ(trisect::centroid(again), trisect::centroid(whole));
    }
}

TEST(ExactBoundary, FractionsBeyondTheBounds) {
    const std::string start = "trisect-exact 2\nlattice 0\nplanes 0\nvertices 1\n";
    expect_error(start + "p 0.5 1e-30 0\n",
                 "e:5:7: '1e-30', read as a coordinate, has more than 73 bits behind the point");
    expect_error(start + "p 0.5 9007199254740992 0\n",
                 "e:5:7: '9007199254740992', read as a coordinate, is not below 2^53");
}

TEST(ExactBoundary, UnitsThatAreNoMultipleOf8AreOfVersion2) {
    trisect::LatticeMesh mesh{.lattice = {-3},
                              .points = {{0, 0, 0}, {8, 0, 0}, {0, 8, 0}, {0, 0, 8}},
                              .triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}},
                              .face_of_triangle = {}};
    for (const int exponent : {-3, -1147, 971, -8}) {
        mesh.lattice.exponent = exponent;
        const Brep brep = trisect::brep_from_lattice_mesh(mesh);
        const std::string text = exact_text(brep);
        EXPECT_EQ(text.rfind(exponent % 8 == 0 ? "trisect-exact 1\n" : "trisect-exact 2\n", 0), 0U);
        const Brep again = read_exact(text, "text");
        expect_same(brep, again);
        EXPECT_EQ(exact_text(again), text);
    }
    expect_error("trisect-exact 2\nlattice -1201\n",
                 "e:2:9: '-1201', read as the lattice's exponent, is not from -1200 to 1016");
}

TEST(ExactBoundary, ATetrahedronByHand) {
    const Brep brep = read_exact(head + planes + vertices + faces, "e");
    EXPECT_EQ(brep.counts().vertices, 4U);
    EXPECT_EQ(exact_volume(brep).to_string(), "1/6");
}

TEST(ExactBoundary, ErrorsNameTheirPlace) {
    expect_error("", "e:1:1: the file ends where 'trisect-exact' is expected");
    expect_error("off\n", "e:1:1: 'off' where 'trisect-exact' is expected");
    expect_error("trisect-exact 3\n", "e:1:15: '3', read as the version, is neither 1 nor 2");
    expect_error("trisect-exact 1\nlattice 4\n",
                 "e:2:9: '4', read as the lattice's exponent, is not a multiple of 8 from -1200 to "
                 "1016");
    expect_error(head + "planes 1\n0 0 0 5\n", "e:4:1: a plane without a normal");
    expect_error(head + "planes 1\n0 0 1.5 5\n",
                 "e:4:5: '1.5', read as a coefficient of a plane, is not an integer");
    const std::string large = "1" + std::string(33, '0');
    expect_error(head + "planes 1\n0 0 " + large + " 5\n",
                 "e:4:5: '" + large + "', read as a coefficient of a plane, is not below 2^109");
    expect_error(head + "planes 9999999\n",
                 "e:3:8: more planes than the rest of the file can hold");
    expect_error(head + planes + "vertices 1\nq 0 0 1\n",
                 "e:9:1: the planes of a vertex do not meet in one point");
    expect_error(head + planes + "vertices 1\nq 0 1 4\n",
                 "e:9:7: '4', read as a plane of a vertex, is out of range");
    expect_error(head + planes + "vertices 2\np 0 0 0\nq 0 1 2\n",
                 "e:10:1: a vertex at the place of vertex 0");
    expect_error(head + planes + "vertices 1\np 9007199254740992 0 0\n",
                 "e:9:3: '9007199254740992', read as a coordinate, is not below 2^53");
    expect_error(head + planes + vertices + "faces 1\n0 0 0 1 3 0 1 2\n",
                 "e:14:13: '1', read as a corner, is not on the plane of its face");
    expect_error(head + planes + vertices + "faces 1\n0 0 0 1 2 0 3\n",
                 "e:14:9: '2', read as the number of corners of a loop, is less than 3");
    expect_error(head + planes + vertices + "faces 1\n0 0 0 1 3 0 2 3\n",
                 "e:14:9: the outer loop of a face runs clockwise");
    expect_error(head + planes + vertices + "faces 1\n0 0 0 2 3 0 3 2 3 0 3 2\n",
                 "e:14:17: a hole of a face runs counter-clockwise");
    expect_error(head + planes + vertices + "faces 2\n0 0 0 1 3 0 3 2\n",
                 "e:15:1: the file ends before face 1 of 2");
    expect_error(head + planes + vertices + faces + "7\n", "e:18:1: '7' after the last face");
    EXPECT_THROW((void)read_exact(head + planes + vertices + "faces 1\n0 0 0 1 3 0 3 2\n", "e"),
                 trisect::Error);  // does not close
}

TEST(ExactBoundary, VerticesOfOtherKindsAndLimits) {
    expect_error(head + planes + "vertices 1\nr 0 0 0\n",
                 "e:9:1: 'r' where 'p' or 'q' is expected");
    expect_error(head + planes + "vertices 1\np 0 0 9007199254740992\n",
                 "e:9:7: '9007199254740992', read as a coordinate, is not below 2^53");
    const std::string text = head + planes + vertices + faces;
    const auto limited = [&](auto set) {
        trisect::ReadLimits limits;
        set(limits);
        try {
            (void)read_exact(text, "e", limits);
        } catch (const trisect::LimitError& e) {
            return std::string(e.what());
        }
        return std::string();
    };
    const auto mentions = [](const std::string& message, const std::string& part) {
        return message.find(part) != std::string::npos;
    };
    EXPECT_TRUE(mentions(limited([](auto& l) { l.bytes = 60; }), "more than 60 bytes"));
    EXPECT_TRUE(
        mentions(limited([](auto& l) { l.loop_corners = 2; }), "a loop of more than 2 corners"));
    EXPECT_EQ(limited([](auto& l) { l.loop_corners = 3; }), "");
}

}  // namespace

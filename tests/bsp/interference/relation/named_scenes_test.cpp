// SPDX-License-Identifier: Apache-2.0
//
// Scenes that people know by name: the placements that other programs got wrong, and those that
// mechanical assemblies consist of. Numbers of the FCL scenes are those of the reports.

#include <trisect/bsp/interference/interference.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/cylinder.h>
#include <trisect/brep/primitives/prism.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/interference/relation/interference_model_data.h>

#include "support/models.h"
#include "support/pose_oracle.h"
#include "support/solids.h"

namespace {

using models::box;
using trisect::Expression;
using trisect::InterferenceModel;
using trisect::InterferenceResult;
using trisect::make_box;
using trisect::Pose;
using trisect::Relation;
using trisect::Solid;

InterferenceModel model(const trisect::PolygonMesh& mesh) {
    return InterferenceModel(Solid::from_mesh(mesh));
}
InterferenceModel model(const Expression& expression) {
    return InterferenceModel(evaluate(expression));
}

Relation relation(const InterferenceModel& a, const InterferenceModel& b, const Pose& pose_b = {},
                  const Pose& pose_a = {}) {
    return interfere(a, pose_a, b, pose_b).relation;
}

std::size_t count(const InterferenceResult& r, int dimension) {
    return static_cast<std::size_t>(std::ranges::count_if(
        r.regions, [&](const auto& region) { return region.dimension == dimension; }));
}

InterferenceResult all(const InterferenceModel& a, const InterferenceModel& b,
                       const Pose& pose_b = {}, const Pose& pose_a = {}) {
    return interfere(a, pose_a, b, pose_b, {.contacts = true, .regions = true});
}

// Placements in the world that change nothing between two solids. No double knows them.
std::vector<Pose> frames() {
    return {Pose(), Pose::from_quaternion({7, -3, 2, 5}, {0.1, 1e6, -3.7}),
            Pose::from_doubles(
                {0.94096063217417758029, 0.29296840037289501035, 0.16959541586174811667, 0.1,
                 -0.23569836841299879326, 0.92661523595848427348, -0.29296840037289506586, 0.3,
                 -0.2429801799032638987, 0.23569836841299884878, 0.94096063217417758029, 1e3}),
            Pose::from_doubles({0, -1, 0, 3, -1.1, 0.3, 0, 1e-3, 0, 0, 0.7, 0})};
}

// ---------------------------------------------------------------- the six clash relations

TEST(NamedScenes, SixClashRelationsOfABuilding) {  // IfcOpenShell#4278
    const auto wall = box({0, 0, 0}, {4, 0.25, 3});
    for (const Pose& frame : frames()) {
        const auto to_wall = [&](const InterferenceModel& other) {
            return relation(wall, other, frame, frame);
        };
        EXPECT_EQ(to_wall(box({1, -0.5, 1}, {1.5, 0.125, 1.5})),
                  Relation::Overlapping);  // protrudes
        EXPECT_EQ(to_wall(box({1, 0.0625, 1}, {1.5, 0.125, 1.5})),
                  Relation::Contains);                                              // enveloped
        EXPECT_EQ(to_wall(box({1, -1, 1}, {1.5, 1, 1.5})), Relation::Overlapping);  // pierces
        EXPECT_EQ(to_wall(box({1, 0.25, 1}, {1.5, 1, 1.5})), Relation::Touching);   // touches
        EXPECT_EQ(to_wall(box({1, 0.375, 1}, {1.5, 1, 1.5})), Relation::Disjoint);  // encroaches
        EXPECT_EQ(to_wall(box({0, 0, 0}, {4, 0.25, 3})), Relation::Equal);          // duplicate
        // Inside, but flush with one face or with two: still a subset.
        EXPECT_EQ(to_wall(box({1, 0.125, 1}, {1.5, 0.25, 1.5})), Relation::Contains);
        EXPECT_EQ(to_wall(box({1, 0, 1}, {1.5, 0.25, 1.5})), Relation::Contains);
    }
}

// Two walls in a row that overlap by 50 mm: every corner of either lies in planes of the other.
TEST(NamedScenes, AlignedWalls) {  // IfcOpenShell#4594
    const auto first = box({0, 0, 0}, {1000, 200, 3000});
    const auto second = box({0, 0, 0}, {1000, 200, 3000});
    for (const Pose& frame : frames()) {
        const auto shifted = [&](double x, double y) {
            return relation(first, second, frame * Pose::from_translation({x, y, 0}), frame);
        };
        EXPECT_EQ(shifted(950, 0), Relation::Overlapping);
        EXPECT_EQ(shifted(950, 2), Relation::Overlapping);
        EXPECT_EQ(shifted(1000, 0), Relation::Touching);
        EXPECT_EQ(shifted(1000, 200), Relation::Touching);  // along an edge
        EXPECT_EQ(shifted(std::nextafter(1000, 2000), 0), Relation::Disjoint);
        EXPECT_EQ(shifted(std::nextafter(1000, 0), 0), Relation::Overlapping);
        EXPECT_EQ(shifted(0, 0), Relation::Equal);
    }
}

// ---------------------------------------------------------------- reports to FCL

// Two convex bodies by separating axes, in rationals: an oracle of its own.
Relation by_separating_axes(const InterferenceModel& a, const Pose& pose_a,
                            const InterferenceModel& b, const Pose& pose_b) {
    struct Body {
        std::vector<oracle::RationalPoint> points;
        std::vector<oracle::RationalPoint> edges;
        std::vector<oracle::RationalPoint> normals;
    };
    using Vector = oracle::RationalPoint;
    const auto minus = [](const Vector& u, const Vector& v) {
        return Vector{u[0] - v[0], u[1] - v[1], u[2] - v[2]};
    };
    const auto cross = [](const Vector& u, const Vector& v) {
        return Vector{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                      u[0] * v[1] - u[1] * v[0]};
    };
    const auto body = [&](const InterferenceModel& m, const Pose& pose) {
        const auto map = oracle::composed(
            oracle::map_of(pose), oracle::scaling(oracle::power_of_two(m.lattice().exponent)));
        Body out;
        const auto& brep = m.brep();
        for (const auto& p : brep.points()) out.points.push_back(map(oracle::rational(p)));
        const auto at = [&](trisect::VertexId v) { return out.points[v.index]; };
        for (const auto e : brep.edges()) {
            const auto h = brep.halfedge(e);
            out.edges.push_back(minus(at(brep.target(h)), at(brep.origin(h))));
        }
        for (const auto f : brep.faces()) {
            const auto h = brep.halfedges(f)[0];
            out.normals.push_back(cross(minus(at(brep.target(h)), at(brep.origin(h))),
                                        minus(at(brep.target(brep.next(h))), at(brep.origin(h)))));
        }
        return out;
    };
    const Body u = body(a, pose_a);
    const Body v = body(b, pose_b);
    std::vector<Vector> axes = u.normals;
    axes.insert(axes.end(), v.normals.begin(), v.normals.end());
    for (const Vector& e : u.edges)
        for (const Vector& f : v.edges)
            if (const Vector n = cross(e, f); n != Vector{}) axes.push_back(n);
    bool touching = false;
    for (const Vector& n : axes) {
        const auto range = [&](const Body& w) {
            const auto along = [&](const Vector& p) -> mpq_class {
                return n[0] * p[0] + n[1] * p[1] + n[2] * p[2];
            };
            mpq_class lo = along(w.points[0]);
            mpq_class hi = lo;
            for (const Vector& p : w.points) {
                const mpq_class x = along(p);
                if (x < lo) lo = x;
                if (x > hi) hi = x;
            }
            return std::pair(lo, hi);
        };
        const auto [ul, uh] = range(u);
        const auto [vl, vh] = range(v);
        if (uh < vl || vh < ul) return Relation::Disjoint;
        touching = touching || uh == vl || vh == ul;
    }
    return touching ? Relation::Touching : Relation::Overlapping;
}

InterferenceModel centred_box(double x, double y, double z) {
    return box({-x / 2, -y / 2, -z / 2}, {x / 2, y / 2, z / 2});
}

void expect_as_axes_say(const InterferenceModel& a, const Pose& pose_a, const InterferenceModel& b,
                        const Pose& pose_b) {
    EXPECT_EQ(relation(a, b, pose_b, pose_a), by_separating_axes(a, pose_a, b, pose_b));
}

TEST(NamedScenes, BoxesThatFclThrewAt) {
    const auto expect = [](const InterferenceModel& a, const std::array<double, 12>& pose_a,
                           const InterferenceModel& b, const std::array<double, 12>& pose_b,
                           Relation expected) {
        const Pose pa = Pose::from_doubles(pose_a);
        const Pose pb = Pose::from_doubles(pose_b);
        expect_as_axes_say(a, pa, b, pb);
        EXPECT_EQ(relation(a, b, pb, pa), expected);
    };
    // fcl#399
    expect(
        centred_box(0.23768037557601928711, 0.15702305734157562256, 0.25),
        {-0.099432387353076273628, 0.99504432079443971837, 0, 0.29526406526565551758,
         -0.99504432079443971837, -0.099432387353076273628, 0, -0.013230856508016586304, 0, 0, 1,
         0},
        centred_box(0.010000000000000000208, 0.78165709972381591797, 0.25),
        {0.99506598442099225554, 0.099215354901756730444, 0, 0.22759585694545214629,
         -0.099215354901756730444, 0.99506598442099225554, 0, 0.14974093549228112421, 0, 0, 1, 0},
        Relation::Overlapping);
    // fcl#493
    expect(centred_box(0.5, 0.5, 0.5),
           {0.96193976625564348026, 0.15401279915737359216, 0.22572537250328919556,
            2.0770063995786869349, -0.19134171618254486313, 0.96936494951283913579,
            0.15401279915737359216, 0.48468247475641951239, -0.19509032201612822033,
            -0.19134171618254486313, 0.96193976625564348026, 1.1543291419087275962},
           centred_box(0.5, 0.5, 0.5),
           {0.96193976625564348026, 0.15401279915737359216, 0.22572537250328919556, 2,
            -0.19134171618254486313, 0.96936494951283913579, 0.15401279915737359216, 0,
            -0.19509032201612822033, -0.19134171618254486313, 0.96193976625564348026, 1.25},
           Relation::Overlapping);
}

// fcl#495: boxes of one orientation whose distance is about the rounding error of the pose. The
// reports are of single cases of this family.
TEST(NamedScenes, TiltedKissingBoxes) {
    const std::array<double, 9> r{
        0.94096063217417758029,  0.29296840037289501035, 0.16959541586174811667,
        -0.23569836841299879326, 0.92661523595848427348, -0.29296840037289506586,
        -0.2429801799032638987,  0.23569836841299884878, 0.94096063217417758029};
    std::array<int, 3> seen{};
    for (const double size : {0.25, 0.5, 10.0, 1000.0})
        for (const double gap : {-1e-15, -2.5e-16, -1e-16, 0.0, 1e-16, 2.5e-16, 1e-15}) {
            const double d = size + gap * std::max(1.0, size);
            const auto cube = centred_box(size, size, size);
            const auto pose = [&](double y) {
                return Pose::from_doubles({r[0], r[1], r[2], r[1] * y, r[3], r[4], r[5], r[4] * y,
                                           r[6], r[7], r[8], 5 * size + r[7] * y});
            };
            const Relation expected = by_separating_axes(cube, pose(0), cube, pose(d));
            EXPECT_EQ(relation(cube, cube, pose(d), pose(0)), expected);
            ++seen[static_cast<std::size_t>(expected)];
        }
    EXPECT_GT(seen[0], 5);  // disjoint
    EXPECT_GT(seen[2], 5);  // overlapping
    // The same boxes exactly side by side in a common frame, which is what was meant.
    const auto cube = centred_box(0.25, 0.25, 0.25);
    for (const Pose& frame : frames()) {
        const auto found = all(cube, cube, frame * Pose::from_translation({0, 0.25, 0}), frame);
        EXPECT_EQ(found.relation, Relation::Touching);
        ASSERT_EQ(found.regions.size(), 1U);
        EXPECT_EQ(found.regions[0].dimension, 2);
        EXPECT_TRUE(found.regions[0].opposite);
        ASSERT_EQ(found.regions[0].loops.size(), 1U);
        EXPECT_EQ(found.regions[0].loops[0].size(), 4U);  // not thirty, none beside the face
    }
}

// fcl#319: a box and a cylinder; the turns are those of the given quaternions.
TEST(NamedScenes, BoxAndCylinder) {
    const auto slab = centred_box(.05, 0.39, 1.47);
    auto mesh = trisect::make_cylinder(0.18, 0.18, 64);
    for (auto& p : mesh.points) p[2] -= 0.09;
    const auto cylinder = model(mesh);
    const auto pose = [](double w, double z, const std::array<double, 3>& t) {
        return Pose::from_quaternion({std::llround(w * 1e6), 0, 0, std::llround(z * 1e6)}, t);
    };
    expect_as_axes_say(slab, pose(0.707107, 0.707107, {0.8, -0.385, 0.735}), cylinder,
                       pose(0.991445, -0.130526, {0.4, -0.4, 0.93}));
}

// ---------------------------------------------------------------- parts that belong together

// A groove and its tongue, cut by one boolean: three areas touch, whatever the placement.
TEST(NamedScenes, Dovetail) {
    const auto block = solids::of_mesh(make_box({0, 0, 0}, {10, 6, 5}));
    auto tail_mesh = trisect::make_prism({{3, 3}, {7, 3}, {6, 5}, {4, 5}}, 6);
    for (auto& p : tail_mesh.points) p = {p[0], 6 - p[2], p[1]};  // laid down along y
    const auto tail = solids::of_mesh(tail_mesh);
    const auto groove = model(block - tail);
    const auto tongue = model(block & tail);
    ASSERT_FALSE(tongue.is_empty());
    for (const Pose& frame : frames()) {
        const auto found = all(groove, tongue, frame, frame);
        EXPECT_EQ(found.relation, Relation::Touching);
        EXPECT_EQ(count(found, 2), 3U);
        for (const auto& region : found.regions) EXPECT_TRUE(region.opposite);
        const auto shifted = [&](double x, double y, double z) {
            return relation(groove, tongue, frame * Pose::from_translation({x, y, z}), frame);
        };
        EXPECT_EQ(shifted(0, 2.5, 0), Relation::Touching);      // it slides,
        EXPECT_EQ(shifted(0, 0, 1e-9), Relation::Overlapping);  // but does not lift
        EXPECT_EQ(shifted(1e-9, 0, 0), Relation::Overlapping);
        EXPECT_EQ(shifted(0, 6, 0), Relation::Touching);
        EXPECT_EQ(shifted(0, 6.5, 0), Relation::Disjoint);
    }
}

// What a boolean leaves and what it takes, with vertices that are no lattice points.
TEST(NamedScenes, WhatIsCutOffFitsWhereItWas) {
    const auto ball = solids::of_mesh(trisect::make_icosphere(3, 2));
    const auto cutter = solids::of_mesh(make_box({1, -4, -4}, {4, 0.3, 0.7}));
    const auto rest = model(ball - cutter);
    const auto chip = model(ball & cutter);
    const auto whole = model(ball);
    for (const Pose& frame : frames()) {
        const auto found = all(rest, chip, frame, frame);
        EXPECT_EQ(found.relation, Relation::Touching);
        EXPECT_EQ(count(found, 2), 3U);
        EXPECT_EQ(relation(whole, chip, frame, frame), Relation::Contains);
        EXPECT_EQ(relation(rest, whole, frame, frame), Relation::Inside);
        EXPECT_EQ(relation(rest, rest, frame, frame), Relation::Equal);
    }
}

TEST(NamedScenes, ShellsInShells) {
    const auto ball = [](double radius) {
        return solids::of_mesh(trisect::make_icosphere(radius, 2));
    };
    // Hollow, with a hollow ball in the cavity.
    const auto nested = model((ball(8) - ball(6)) | (ball(4) - ball(2)));
    const auto in = [&](double radius) { return relation(nested, model(ball(radius))); };
    EXPECT_EQ(in(1), Relation::Disjoint);
    EXPECT_EQ(in(2), Relation::Touching);  // fills the inner cavity exactly
    EXPECT_EQ(in(3), Relation::Overlapping);
    EXPECT_EQ(in(5), Relation::Overlapping);  // covers the inner ball and its cavity
    EXPECT_EQ(in(8), Relation::Inside);       // flush with the outer shell
    EXPECT_EQ(in(9), Relation::Inside);
    const auto gap = model(ball(5) - ball(4.5));
    EXPECT_EQ(relation(nested, gap), Relation::Disjoint);  // between the shells
    const auto skin = model(ball(7.5) - ball(6.5));
    EXPECT_EQ(relation(nested, skin), Relation::Contains);
    EXPECT_EQ(relation(nested, model(ball(8) - ball(6))), Relation::Contains);  // one of two bodies
    EXPECT_EQ(relation(nested, model(ball(6) - ball(4))), Relation::Touching);  // fills the gap
    EXPECT_EQ(relation(nested, model(ball(1)), Pose::from_translation({7.5, 0, 0})),
              Relation::Overlapping);
}

TEST(NamedScenes, NutOnItsBolt) {
    const auto hexagon = solids::of_mesh(trisect::make_regular_prism(6, 4, 2));
    const auto bolt_mesh = trisect::make_regular_prism(8, 2, 10);
    const auto nut = model(hexagon - solids::of_mesh(bolt_mesh));
    const auto bolt = model(bolt_mesh);
    const auto down = [](double z) { return Pose::from_translation({0, 0, z}); };
    EXPECT_EQ(relation(nut, bolt), Relation::Touching);
    EXPECT_EQ(relation(nut, bolt, down(-5)), Relation::Touching);
    EXPECT_EQ(count(all(nut, bolt, down(-5)), 2), 8U);
    EXPECT_EQ(relation(nut, bolt, down(2)), Relation::Touching);  // at the ends of eight edges
    EXPECT_EQ(relation(nut, bolt, down(3)), Relation::Disjoint);
    // Half a turn keeps the eight sides where they are, a small one does not.
    EXPECT_EQ(relation(nut, bolt, Pose::from_quaternion({0, 0, 0, 1}, {0, 0, -5})),
              Relation::Touching);
    EXPECT_EQ(relation(nut, bolt, Pose::from_quaternion({100, 0, 0, 1}, {0, 0, -5})),
              Relation::Overlapping);
}

// ---------------------------------------------------------------- boundaries that touch themselves

trisect::PolygonMesh tetrahedron(const std::array<trisect::Point3d, 4>& corners) {
    trisect::PolygonMesh mesh;
    mesh.points.assign(corners.begin(), corners.end());
    mesh.add_triangle(0, 2, 1);
    mesh.add_triangle(0, 1, 3);
    mesh.add_triangle(1, 2, 3);
    mesh.add_triangle(2, 0, 3);
    return mesh;
}

// A tunnel whose edge lies in the outer face of its block, along a diagonal of that face's
// triangulation.
TEST(NamedScenes, EdgeOfATunnelInTheFloorOfItsBlock) {
    const auto block = solids::of_mesh(make_box({3, 3, 0}, {13, 12, 5})) -
                       solids::of_mesh(trisect::make_prism({{5, 3}, {12, 8}, {7, 10}}, 5));
    const auto tunnelled = model(block);
    EXPECT_TRUE(trisect::detail::data_of(tunnelled).touches_itself());
    const auto slab = [&](double low, double high) { return box({3, low, -1}, {8, high, 4}); };
    for (const Pose& frame : frames()) {
        EXPECT_EQ(relation(tunnelled, slab(2, 3), frame, frame), Relation::Touching);
        EXPECT_EQ(relation(slab(2, 3), tunnelled, frame, frame), Relation::Touching);
        EXPECT_EQ(relation(tunnelled, slab(2, 3.5), frame, frame), Relation::Overlapping);
    }
}

// A tetrahedron on a block, with an edge in the block's face. The wall of a channel that is cut
// into both passes through that face just along this edge, where no crossing is.
TEST(NamedScenes, TetrahedronStandingWithAnEdgeInABlocksFace) {
    const auto block = solids::of_mesh(make_box({0, 0, 0}, {4, 4, 4}));
    const auto tent = solids::of_mesh(tetrahedron({{{1, 3, 4}, {3, 3, 4}, {1, 4, 7}, {3, 0, 7}}}));
    const auto channel = solids::of_mesh(make_box({2, 1, -1}, {5, 3, 5}));
    const auto whole = model(block | tent);
    const auto cut = model((block | tent) - channel);
    EXPECT_TRUE(trisect::detail::data_of(whole).touches_itself());
    for (const Pose& frame : frames()) {
        EXPECT_EQ(relation(cut, whole, frame, frame), Relation::Inside);
        EXPECT_EQ(relation(whole, cut, frame, frame), Relation::Contains);
        EXPECT_EQ(relation(whole, whole, frame, frame), Relation::Equal);
    }
    EXPECT_EQ(relation(cut, whole, Pose::from_translation({0, 0.5, 0})), Relation::Overlapping);
}

// ---------------------------------------------------------------- names

TEST(NamedScenes, ContactsNameTheirEntities) {
    const auto lower = box({0, 0, 0}, {4, 4, 4});
    const auto upper = box({0, 0, 0}, {2, 2, 2});
    const auto kinds = [](const InterferenceResult& r) {
        std::vector<std::array<int, 3>> out;
        for (const auto& region : r.regions)
            out.push_back({region.dimension, static_cast<int>(region.a.kind()),
                           static_cast<int>(region.b.kind())});
        return out;
    };
    const auto at = [&](double x, double y, double z) {
        return all(lower, upper, Pose::from_translation({x, y, z}));
    };
    constexpr int vertex = 0;
    constexpr int edge = 1;
    constexpr int face = 2;
    using Kinds = std::vector<std::array<int, 3>>;
    EXPECT_EQ(kinds(at(4, 4, 4)), (Kinds{{0, vertex, vertex}}));
    EXPECT_EQ(kinds(at(4, 4, 1)), (Kinds{{1, edge, edge}}));
    EXPECT_EQ(kinds(at(4, 1, 1)), (Kinds{{2, face, face}}));
    EXPECT_EQ(kinds(at(4, 1, 4)), (Kinds{{1, edge, edge}}));
    // A quarter turn brings the edge of a wedge down.
    const auto wedge = model(trisect::make_prism({{0, 0}, {2, -1}, {2, 1}}, 2));
    const auto down = Pose::from_quaternion({1, 0, -1, 0}, {3, 2, 4});
    const auto found = all(lower, wedge, down);
    EXPECT_EQ(found.relation, Relation::Touching);
    EXPECT_EQ(kinds(found), (Kinds{{1, face, edge}}));
    EXPECT_EQ(kinds(all(lower, upper, Pose::from_quaternion({1, 0, 0, 0}, {1, 1, 4}))),
              (Kinds{{2, face, face}}));
}

// Where faces keep touching, corners are found in place, not near it.
TEST(NamedScenes, RegionsHaveExactCorners) {
    const auto a = box({0, 0, 0}, {3, 3, 1});
    const auto b = box({0, 0, 0}, {1, 1, 1});
    // A cube on a plate, turned by the angle of the 3-4-5 triangle.
    const auto found = all(a, b, Pose::from_quaternion({2, 0, 0, 1}, {1.5, 1, 1}));
    ASSERT_EQ(found.regions.size(), 1U);
    ASSERT_EQ(found.regions[0].loops.size(), 1U);
    std::vector<std::array<std::string, 3>> corners;
    for (const auto& p : found.regions[0].loops[0])
        corners.push_back({p.exact[0].to_string(), p.exact[1].to_string(), p.exact[2].to_string()});
    const auto regions_only = interfere(
        a, Pose(), b, Pose::from_quaternion({2, 0, 0, 1}, {1.5, 1, 1}), {.regions = true});
    EXPECT_EQ(regions_only.regions.size(), 1U);
    EXPECT_TRUE(regions_only.contacts.empty());
    const auto first = std::ranges::find(corners, std::array<std::string, 3>{"3/2", "1", "1"});
    ASSERT_NE(first, corners.end());
    std::rotate(corners.begin(), first, corners.end());
    EXPECT_EQ(corners, (std::vector<std::array<std::string, 3>>{{"3/2", "1", "1"},
                                                                {"21/10", "9/5", "1"},
                                                                {"13/10", "12/5", "1"},
                                                                {"7/10", "8/5", "1"}}));
}

TEST(NamedScenes, EmptySolidsAreDisjointFromEverything) {
    const auto cube = box({0, 0, 0}, {1, 1, 1});
    EXPECT_EQ(relation(InterferenceModel(), cube), Relation::Disjoint);
    EXPECT_EQ(relation(cube, InterferenceModel()), Relation::Disjoint);
    EXPECT_EQ(relation(InterferenceModel(), InterferenceModel()), Relation::Disjoint);
}

// Beyond the range of doubles everything is decided by integers.
TEST(NamedScenes, FarBeyondTheRangeOfDoubles) {
    const auto cube = box({0, 0, 0}, {1, 1, 1});
    const Pose far = Pose::from_translation({0x1p400, 0, 0});
    EXPECT_EQ(relation(cube, cube, far, far), Relation::Equal);
    EXPECT_EQ(relation(cube, cube, far), Relation::Disjoint);
    EXPECT_EQ(relation(cube, cube, far * Pose::from_translation({1, 0, 0}), far),
              Relation::Touching);
}

}  // namespace

// SPDX-License-Identifier: Apache-2.0

#include <trisect/brep/brep_builder.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <trisect/brep/planar_loops.h>
#include <trisect/kernel/error.h>

#include "support/breps.h"

namespace {

using namespace trisect;
using namespace trisect::test;

// The invariants of Brep, by their numbers.
void expect_invariants(const Brep& b) {
    for (const HalfedgeId h : b.halfedges()) {
        EXPECT_NE(b.twin(h), h);
        EXPECT_EQ(b.twin(b.twin(h)), h);
        EXPECT_EQ(b.origin(b.twin(h)), b.origin(b.next(h)));
        EXPECT_EQ(b.prev(b.next(h)), h);
        EXPECT_EQ(b.edge(h), b.edge(b.twin(h)));
        EXPECT_EQ(b.shell(b.face(h)), b.shell(b.face(b.twin(h))));
        EXPECT_EQ(side_of(b.point(b.origin(h)), b.plane(b.face(h))), Side::On);
    }
    std::size_t outgoing = 0;
    for (const VertexId v : b.vertices()) {
        const auto fan = b.outgoing_halfedges(v);
        outgoing += fan.size();
        for (const HalfedgeId h : fan) EXPECT_EQ(b.origin(h), v);
    }
    EXPECT_EQ(outgoing, b.counts().halfedges);
    std::size_t faces = 0;
    for (const ShellId s : b.shells()) faces += b.faces(s).size();
    EXPECT_EQ(faces, b.counts().faces);
}

TEST(BrepBuilder, EmptyInputGivesTheEmptyBrep) {
    const Brep b = BrepBuilder(Lattice{8}).build();
    EXPECT_TRUE(b.is_empty());
    EXPECT_EQ(b.counts(), BrepCounts{});
    EXPECT_EQ(b.lattice(), Lattice{8});
    EXPECT_EQ(Brep().counts(), BrepCounts{});
}

TEST(BrepBuilder, CubeFromQuads) {
    const Brep b = cube(2);
    expect_invariants(b);
    EXPECT_EQ(b.counts(), (BrepCounts{8, 24, 12, 6, 6, 1}));
    EXPECT_EQ(b.genus(ShellId(0)), 0);
    EXPECT_EQ(b.vertex_contact_count(), 0U);
    for (const VertexId v : b.vertices()) EXPECT_EQ(b.outgoing_halfedges(v).size(), 3U);
}

TEST(BrepBuilder, Tetrahedron) {
    SolidSketch s;
    const LatticePoint o{0, 0, 0}, x{5, 0, 0}, y{0, 5, 0}, z{0, 0, 5};
    const Brep b =
        s.face({{o, y, x}}).face({{o, x, z}}).face({{o, z, y}}).face({{x, y, z}}).build();
    expect_invariants(b);
    EXPECT_EQ(b.counts(), (BrepCounts{4, 12, 6, 4, 4, 1}));
}

TEST(BrepBuilder, ThroughHoleHasGenusOne) {
    const Brep b = prism({rectangle(0, 0, 9, 9), reversed(rectangle(3, 3, 6, 6))}, 9);
    expect_invariants(b);
    EXPECT_EQ(b.counts(), (BrepCounts{16, 48, 24, 12, 10, 1}));
    EXPECT_EQ(b.counts().euler_characteristic(), 0);
    EXPECT_EQ(b.genus(ShellId(0)), 1);
    EXPECT_EQ(b.inner_loops(FaceId(8)).size(), 1U);
    EXPECT_EQ(b.inner_loops(FaceId(0)).size(), 0U);
}

TEST(BrepBuilder, CavityIsAShellOfItsOwn) {
    const Brep b = SolidSketch().box({0, 0, 0}, {9, 9, 9}).box({3, 3, 3}, {6, 6, 6}, false).build();
    expect_invariants(b);
    EXPECT_EQ(b.counts().shells, 2U);
    EXPECT_EQ(b.faces(ShellId(1)).front(), FaceId(6));
    EXPECT_EQ(b.genus(ShellId(1)), 0);
}

TEST(BrepBuilder, CubesSharingAnEdgeComeApart) {
    const Brep b = SolidSketch().box({0, 0, 0}, {1, 1, 1}).box({1, 1, 0}, {2, 2, 1}).build();
    expect_invariants(b);
    EXPECT_EQ(b.counts(), (BrepCounts{16, 48, 24, 12, 12, 2}));
    ASSERT_EQ(b.edge_contact_count(), 1U);
    EXPECT_EQ(b.vertex_contact_count(), 2U);
    std::size_t copies = 0;
    for (const EdgeId e : b.edges()) {
        if (b.copies(e).empty()) continue;
        ++copies;
        ASSERT_EQ(b.copies(e).size(), 2U);
        const FaceId f = b.face(b.halfedge(e));
        EXPECT_EQ(b.shell(f), b.shell(b.face(b.twin(b.halfedge(e)))));
        const VertexId v = b.origin(b.halfedge(e));
        EXPECT_EQ(b.copies(v).size(), 2U);
    }
    EXPECT_EQ(copies, 2U);
}

// The complement of two cubes that share an edge, within a block: the inside wedges are the other
// two quarters, so each quarter of material stays connected and joins the two cavities.
TEST(BrepBuilder, CavitiesSharingAnEdgeArePairedAcrossTheMaterial) {
    const Brep b = SolidSketch()
                       .box({-1, -1, -1}, {3, 3, 2})
                       .box({0, 0, 0}, {1, 1, 1}, false)
                       .box({1, 1, 0}, {2, 2, 1}, false)
                       .build();
    expect_invariants(b);
    EXPECT_EQ(b.counts().shells, 2U);
    ASSERT_EQ(b.edge_contact_count(), 1U);
    // The ends of the edge stay single: there the material is connected all around.
    EXPECT_EQ(b.vertex_contact_count(), 0U);
    EXPECT_EQ(b.counts(ShellId(1)), (BrepCounts{14, 48, 24, 12, 12, 1}));
    EXPECT_EQ(b.genus(ShellId(1)), 0);
    for (const EdgeId e : b.edges()) {
        if (b.copies(e).empty()) continue;
        const std::uint32_t f = b.face(b.halfedge(e)).index;
        const std::uint32_t g = b.face(b.twin(b.halfedge(e))).index;
        EXPECT_NE((f - 6) / 6, (g - 6) / 6) << "one face of each cavity";
    }
}

TEST(BrepBuilder, CubesSharingAVertexComeApart) {
    const Brep b = SolidSketch().box({0, 0, 0}, {1, 1, 1}).box({1, 1, 1}, {2, 2, 2}).build();
    expect_invariants(b);
    EXPECT_EQ(b.counts(), (BrepCounts{16, 48, 24, 12, 12, 2}));
    EXPECT_EQ(b.edge_contact_count(), 0U);
    ASSERT_EQ(b.vertex_contact_count(), 1U);
    for (const VertexId v : b.vertices())
        for (const VertexId w : b.copies(v)) EXPECT_EQ(b.point(v), b.point(w));
}

// Three wedges with irregular angles around one edge, built in every order.
TEST(BrepBuilder, SixFacesAtAnEdge) {
    const LatticePoint lo{0, 0, 0}, hi{0, 0, 7};
    const std::array<std::array<LatticePoint, 2>, 3> wedges{
        {{LatticePoint{9, -1, 3}, LatticePoint{8, 2, 3}},
         {LatticePoint{7, 3, 3}, LatticePoint{-2, 9, 3}},
         {LatticePoint{-9, 1, 3}, LatticePoint{1, -8, 3}}}};
    std::array<int, 3> order{0, 1, 2};
    do {
        SolidSketch s;
        for (const int i : order) {
            const auto [p, q] = wedges[static_cast<std::size_t>(i)];
            s.face({{lo, hi, q}}).face({{hi, lo, p}}).face({{p, lo, q}}).face({{hi, p, q}});
        }
        const Brep b = s.build();
        expect_invariants(b);
        EXPECT_EQ(b.counts(), (BrepCounts{12, 36, 18, 12, 12, 3}));
        EXPECT_EQ(b.edge_contact_count(), 1U);
        EXPECT_EQ(b.vertex_contact_count(), 2U);
        for (const FaceId f : b.faces()) EXPECT_EQ(b.shell(f).index, f.index / 4);
    } while (std::next_permutation(order.begin(), order.end()));
}

TEST(BrepBuilder, WedgesThatDifferByOneUnitInALargeLattice) {
    constexpr std::int64_t L = (std::int64_t{1} << 52) - 1;
    const LatticePoint lo{0, 0, -L}, hi{0, 0, L};
    // Directions (L, 1), (L, 2) and (L-1, 2), (L-1, 3): doubles cannot order their normals.
    const LatticePoint a{L, 1, 0}, b{L, 2, 0}, c{L - 1, 2, 0}, d{L - 1, 3, 0};
    SolidSketch s;
    for (const auto& [p, q] : {std::pair{c, d}, std::pair{a, b}})
        s.face({{lo, hi, q}}).face({{hi, lo, p}}).face({{p, lo, q}}).face({{hi, p, q}});
    const Brep brep = s.build();
    expect_invariants(brep);
    EXPECT_EQ(brep.counts().shells, 2U);
}

TEST(BrepBuilder, CubesSharingAFaceStayApart) {
    const Brep b = SolidSketch().box({0, 0, 0}, {1, 1, 1}).box({1, 0, 0}, {2, 1, 1}).build();
    expect_invariants(b);
    EXPECT_EQ(b.counts(), (BrepCounts{16, 48, 24, 12, 12, 2}));
    EXPECT_EQ(b.edge_contact_count(), 4U);
}

// An L-shaped plate whose step only meets itself at one edge: the ring closes in an edge contact.
TEST(BrepBuilder, RingClosedByAnEdgeContactOpens) {
    const Polygon outline{{0, 0, 0}, {4, 0, 0}, {4, 2, 0}, {2, 2, 0}, {2, 4, 0}, {0, 4, 0}};
    const Polygon hole{{1, 1, 0}, {1, 2, 0}, {2, 2, 0}, {2, 1, 0}};
    const Brep b = prism({outline, hole}, 3);
    expect_invariants(b);
    EXPECT_EQ(b.counts().shells, 1U);
    EXPECT_EQ(b.edge_contact_count(), 1U);
}

// The plate is a ring that is open by an infinitesimal gap where the hole touches the rim.
TEST(BrepBuilder, HoleThatTouchesTheRimOpensTheRing) {
    const Polygon outline{{0, 0, 0}, {4, 0, 0}, {8, 0, 0}, {8, 8, 0}, {0, 8, 0}};
    const Brep b = prism({outline, {{4, 0, 0}, {3, 3, 0}, {5, 3, 0}}}, 2);
    expect_invariants(b);
    EXPECT_EQ(b.counts(), (BrepCounts{16, 48, 24, 10, 10, 1}));
    EXPECT_EQ(b.genus(ShellId(0)), 0);
    EXPECT_EQ(b.edge_contact_count(), 1U);
    EXPECT_EQ(b.vertex_contact_count(), 2U);
}

// The same ring from outlines that touch themselves: one boundary, whatever the description.
TEST(BrepBuilder, HoleAndOutlineMayBeOneLoop) {
    const Polygon one{{0, 0, 0}, {4, 0, 0}, {3, 3, 0}, {5, 3, 0},
                      {4, 0, 0}, {8, 0, 0}, {8, 8, 0}, {0, 8, 0}};
    const Brep b = prism({one}, 2);
    expect_invariants(b);
    EXPECT_EQ(b.counts(), (BrepCounts{16, 48, 24, 10, 10, 1}));
    EXPECT_EQ(b.genus(ShellId(0)), 0);
}

// A pit whose mouth touches the rim in a vertex, narrowing below: no material is cut.
TEST(BrepBuilder, PitThatTouchesTheRimKeepsTheVertex) {
    SolidSketch s;
    const LatticePoint rim{4, 0, 8}, p{3, 3, 8}, q{5, 3, 8}, bottom{4, 2, 4};
    const Polygon outline{{0, 0, 8}, rim, {8, 0, 8}, {8, 8, 8}, {0, 8, 8}};
    const Polygon base = lifted(outline, -8);
    s.face(Plane(0, 0, 1, Plane::Coefficient(-8)), {outline, {rim, p, q}});
    s.face(Plane(0, 0, -1, Plane::Coefficient(0)), {reversed(base)});
    s.walls(base, 8);
    s.face({{p, rim, bottom}}).face({{q, p, bottom}}).face({{rim, q, bottom}});
    const Brep b = s.build();
    expect_invariants(b);
    EXPECT_EQ(b.vertex_contact_count(), 0U);
    EXPECT_EQ(b.counts().shells, 1U);
    EXPECT_EQ(b.genus(ShellId(0)), 0);
}

TEST(BrepBuilder, FaceCutByItsHoleBecomesTwo) {
    const Polygon hole{{0, 0, 0}, {3, 5, 0}, {8, 8, 0}, {5, 3, 0}};
    const Brep b = prism({rectangle(0, 0, 8, 8), hole}, 2);
    expect_invariants(b);
    EXPECT_EQ(b.counts(), (BrepCounts{16, 48, 24, 12, 12, 2}));
    EXPECT_EQ(b.source(FaceId(8)), b.source(FaceId(9)));
}

TEST(BrepBuilder, OpenBoundaryNamesTheEdge) {
    SolidSketch s(Lattice{8});
    const LatticePoint o{0, 0, 0}, x{5, 0, 0}, y{0, 5, 0}, z{0, 0, 5};
    s.face({{o, y, x}}).face({{o, x, z}}).face({{o, z, y}});
    try {
        (void)s.build();
        FAIL() << "an open boundary must be refused";
    } catch (const Error& e) {
        EXPECT_EQ(e.code(), ErrorCode::InvalidSolid);
        EXPECT_NE(std::string(e.what()).find("(0, 1280, 0) to (1280, 0, 0)"), std::string::npos)
            << e.what();
    }
}

TEST(BrepBuilder, FacesThatDisagreeOnOutsideAreRefused) {
    SolidSketch s;
    const LatticePoint o{0, 0, 0}, x{5, 0, 0}, y{0, 5, 0}, z{0, 0, 5};
    s.face({{o, y, x}}).face({{o, x, z}}).face({{o, z, y}}).face({{y, x, z}});
    EXPECT_THROW((void)s.build(), Error);
}

TEST(BrepBuilder, MalformedLoopsAreRefused) {
    BrepBuilder b{Lattice{}};
    for (int i = 0; i < 3; ++i) b.add_vertex(LatticePoint{i, i * i, 0});
    const Plane plane(0, 0, 1, Plane::Coefficient(0));
    EXPECT_THROW(b.add_face(plane, {}, {}), Error);
    EXPECT_THROW(b.add_face(plane, {{0, 1}}, {}), Error);
    EXPECT_THROW(b.add_face(plane, {{0, 1, 2}, {0}}, {}), Error);
    EXPECT_THROW(b.add_face(plane, {{0, 1, 3}}, {}), Error);
}

TEST(BrepBuilder, UnusedVerticesAreDropped) {
    SolidSketch s;
    s.vertex({100, 100, 100});
    const Brep b = s.box({0, 0, 0}, {1, 1, 1}).build();
    EXPECT_EQ(b.counts().vertices, 8U);
    EXPECT_EQ(b.point(VertexId(0)), Point(LatticePoint{0, 0, 0}));
}

TEST(BrepBuilder, PlanePointsNameVertices) {
    // The pyramid cut from the corner of the octant by 3x + 5y + 7z = 11.
    const Plane x(-1, 0, 0, Plane::Coefficient(0)), y(0, -1, 0, Plane::Coefficient(0));
    const Plane z(0, 0, -1, Plane::Coefficient(0)), cut(3, 5, 7, Plane::Coefficient(-11));
    BrepBuilder b{Lattice{}};
    const auto o = b.add_vertex(Point(x, y, z)), px = b.add_vertex(Point(cut, y, z));
    const auto py = b.add_vertex(Point(x, cut, z)), pz = b.add_vertex(Point(x, y, cut));
    b.add_face(z, {{o, py, px}}, {0, 0});
    b.add_face(y, {{o, px, pz}}, {0, 1});
    b.add_face(x, {{o, pz, py}}, {0, 2});
    b.add_face(cut, {{px, py, pz}}, {1, 7});
    const Brep brep = std::move(b).build();
    expect_invariants(brep);
    EXPECT_EQ(brep.source(FaceId(3)), (FaceSource{1, 7}));
}

// Squares of a chessboard that touch in corners, each with up to two holes, all loops of one call
// in any order: every square is a region of its own, with the holes that lie in it.
TEST(ConnectedRegions, SquaresOfAChessboardWithHoles) {
    std::mt19937 random(3);  // NOLINT
    const Plane floor = Plane::axis_aligned(2, 1, 0);
    for (int round = 0; round < 200; ++round) {
        const bool halves = round % 2 != 0;  // corners that are no lattice points
        std::vector<Point> points;
        const auto corner = [&](std::int64_t x, std::int64_t y) {
            const Point p = halves ? Point(Plane::axis_aligned(0, 2, 2 * x + 1),
                                           Plane::axis_aligned(1, 2, 2 * y + 1), floor)
                                   : Point(LatticePoint{x, y, 0});
            const auto at = static_cast<std::size_t>(std::find(points.begin(), points.end(), p) -
                                                     points.begin());
            if (at == points.size()) points.push_back(p);
            return static_cast<std::uint32_t>(at);
        };
        const auto square = [&](std::int64_t x, std::int64_t y, std::int64_t side) {
            return IndexLoop{corner(x, y), corner(x + side, y), corner(x + side, y + side),
                             corner(x, y + side)};
        };
        std::vector<IndexLoop> loops;
        std::set<std::set<std::set<std::uint32_t>>> expected;
        for (std::int64_t i = 0; i < 4; ++i) {
            for (std::int64_t k = 0; k < 4; ++k) {
                if ((i + k) % 2 != 0 || random() % 5 == 0) continue;
                std::set<std::set<std::uint32_t>> region;
                const auto add = [&](IndexLoop loop, bool is_hole) {
                    region.insert({loop.begin(), loop.end()});
                    if (is_hole) std::reverse(loop.begin(), loop.end());
                    std::rotate(loop.begin(), loop.begin() + random() % 4, loop.end());
                    loops.push_back(std::move(loop));
                };
                add(square(9 * i, 9 * k, 9), false);
                if (random() % 2 == 0) add(square(9 * i + 1, 9 * k + 1, 2), true);
                if (random() % 2 == 0) add(square(9 * i + 4, 9 * k + 4, 3), true);
                expected.insert(std::move(region));
            }
        }
        if (loops.empty()) continue;
        std::shuffle(loops.begin(), loops.end(), random);
        std::set<std::set<std::set<std::uint32_t>>> found;
        for (const auto& region : connected_regions(floor, points, loops)) {
            std::set<std::set<std::uint32_t>> names;
            for (const IndexLoop& loop : region) {
                EXPECT_EQ(loop.size(), 4U);
                names.insert({loop.begin(), loop.end()});
            }
            EXPECT_TRUE(expected.contains(names)) << "round " << round;
            found.insert(std::move(names));
        }
        EXPECT_EQ(found, expected) << "round " << round;
    }
}

TEST(BrepBuilder, PolygonThatPassesThroughAVertexTwiceBecomesTwoFaces) {
    // Two cubes that share a vertical edge; their floors and lids are drawn as one loop each.
    const auto prism_of = [](bool once) {
        SolidSketch s;
        for (const std::int64_t x : {0, 4}) s.walls(rectangle(x, x, x + 4, x + 4), 4);
        for (const bool top : {false, true}) {
            const std::int64_t z = top ? 4 : 0;
            const Polygon both{{0, 0, z}, {4, 0, z}, {4, 4, z}, {8, 4, z},
                               {8, 8, z}, {4, 8, z}, {4, 4, z}, {0, 4, z}};
            const Polygon loop = top ? both : reversed(both);
            const Plane up = Plane::axis_aligned(2, 1, z);
            const Plane plane = top ? up : up.flipped();
            if (once) {
                std::vector<std::uint32_t> ids;
                for (const LatticePoint& p : loop) ids.push_back(s.vertex(p));
                s.builder().add_polygon(plane, ids, {});
            } else {
                s.face(plane, {loop});
            }
        }
        return s.build();
    };
    for (const bool once : {true, false}) {
        const Brep b = prism_of(once);
        expect_invariants(b);
        EXPECT_EQ(b.counts(), (BrepCounts{16, 48, 24, 12, 12, 2})) << once;
    }
}

}  // namespace

// SPDX-License-Identifier: Apache-2.0
//
// Queries of solids whose coordinates have bits behind the point: of the same solid in units that
// are 2^n times as large, and of one with more digits than whole coordinates have, against brute
// force.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <trisect/bsp/brep_index.h>

#include "engines/engines.h"
#include "reference/random_solids.h"
#include "support/fractions.h"
#include "support/query_oracle.h"
#include "support/random_result.h"

namespace {

using trisect::BrepIndex;
using trisect::Coordinate;
using trisect::ExactRational;
using trisect::LatticeMesh;
using trisect::LatticePoint;
using trisect::Location;
using trisect::Nearest;
using trisect::Place;
using trisect::Plane;
using trisect::Point3d;
using trisect::Ray;
using trisect::RayHit;
using trisect::Segment;
using trisect::Solid;
using trisect::test::with_fractions;

constexpr std::array bits_of_units{8, 24, 56, 72};

// The same solid twice --------------------------------------------------------------------------

// The operands of two solids have different names.
bool same(const Place& a, const Place& b) {
    bool faces = a.face_count == b.face_count;
    for (std::size_t i = 0; faces && i < a.face_count; ++i)
        faces = a.faces[i].face == b.faces[i].face;
    return faces && a.location == b.location && a.corner.corner == b.corner.corner &&
           a.face == b.face && a.edge == b.edge && a.vertex == b.vertex;
}

bool same(const RayHit& a, const RayHit& b) {
    const auto exact = [](const trisect::RayParameter& t) {
        return t.is_infinite() ? ExactRational(-1) : t.exact();
    };
    return exact(a.enter) == exact(b.enter) && exact(a.leave) == exact(b.leave) &&
           a.is_interval == b.is_interval && same(a.place, b.place);
}

bool same(const std::optional<Nearest>& a, const std::optional<Nearest>& b) {
    if (!a || !b) return a.has_value() == b.has_value();
    return same(a->place, b->place) && a->point == b->point &&
           a->squared_distance == b->squared_distance && a->squared_rounded == b->squared_rounded &&
           a->distance == b->distance;
}

bool same(const trisect::SectionLoop& a, const trisect::SectionLoop& b) {
    return a.rounded == b.rounded;
}

bool same(const trisect::SectionRegion& a, const trisect::SectionRegion& b) {
    return same(a.outer, b.outer) &&
           std::equal(a.holes.begin(), a.holes.end(), b.holes.begin(), b.holes.end(),
                      [](const auto& x, const auto& y) { return same(x, y); });
}

template <class T>
bool same(const std::vector<T>& a, const std::vector<T>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const T& x, const T& y) { return same(x, y); });
}

template <class Entities>
bool same_boxes(const Entities& a, const Entities& b) {
    const bool faces = std::equal(a.faces.begin(), a.faces.end(), b.faces.begin(), b.faces.end(),
                                  [](const auto& x, const auto& y) { return x.face == y.face; });
    return faces && a.face_ids == b.face_ids && a.edge_ids == b.edge_ids &&
           a.vertex_ids == b.vertex_ids;
}

// In lattice units.
trisect::ExactPoint exact_point(const trisect::Point& p) {
    const trisect::HomogeneousPoint h = p.homogeneous();
    const ExactRational w(h.w);
    return {ExactRational(h.xyz[0]) / w, ExactRational(h.xyz[1]) / w, ExactRational(h.xyz[2]) / w};
}

class SameSolid {
public:
    SameSolid(const BrepIndex& whole, const BrepIndex& fractions, const LatticeMesh& mesh,
              std::uint64_t seed)
        : whole_(whole), fractions_(fractions), mesh_(mesh), make_(mesh, seed) {}

    void expect_same_answers(int count) {
        std::vector<Point3d> points;
        for (int i = 0; i < count; ++i) {
            const Point3d p = make_.any();
            const Point3d q = make_.any();
            points.push_back(p);
            locate(p);
            nearest(p);
            if (p != q) {
                line(Ray{p, {q[0] - p[0], q[1] - p[1], q[2] - p[2]}});
                line(Segment{p, q});
                box(p, q);
            }
        }
        const auto places = whole_.locate(points);
        const auto others = fractions_.locate(points);
        EXPECT_TRUE(same(places, others));
        std::vector<Location> found(points.size());
        fractions_.classify(points, found);
        for (std::size_t i = 0; i < points.size(); ++i) EXPECT_EQ(found[i], places[i].location);
        for (int i = 0; i < count / 5; ++i) plane();
    }

private:
    void locate(const Point3d& p) {
        const Place place = whole_.locate(p);
        EXPECT_TRUE(same(place, fractions_.locate(p))) << p[0] << " " << p[1] << " " << p[2];
        const trisect::ExactPoint exact{ExactRational::from_double(p[0]),
                                        ExactRational::from_double(p[1]),
                                        ExactRational::from_double(p[2])};
        EXPECT_TRUE(same(place, fractions_.locate(exact)));
    }
    void nearest(const Point3d& p) {
        EXPECT_TRUE(same(whole_.nearest(p), fractions_.nearest(p)));
        EXPECT_TRUE(same(whole_.nearest_edge(p), fractions_.nearest_edge(p)));
        EXPECT_TRUE(same(whole_.nearest_vertex(p), fractions_.nearest_vertex(p)));
        const auto exact = whole_.signed_distance(p);
        const auto bounds = fractions_.distance(p);
        ASSERT_EQ(exact.has_value(), bounds.has_value());
        if (!exact) return;
        EXPECT_EQ(exact->sign, fractions_.signed_distance(p)->sign);
        EXPECT_LE(bounds->lo, exact->nearest.distance);
        EXPECT_GE(bounds->hi, exact->nearest.distance);
    }
    template <class Line>
    void line(const Line& l) {
        EXPECT_TRUE(same(whole_.all_hits(l), fractions_.all_hits(l)));
        const auto a = whole_.first_hit(l);
        const auto b = fractions_.first_hit(l);
        const auto facet = fractions_.first_facet(l);
        ASSERT_EQ(a.has_value(), b.has_value());
        ASSERT_EQ(a.has_value(), facet.has_value());
        if (!a) return;
        EXPECT_TRUE(same(*a, *b));
        EXPECT_EQ(a->enter.nearest(), b->enter.nearest());
        EXPECT_EQ(facet->face.face, a->place.faces[0].face);
        EXPECT_LE(ExactRational::from_double(facet->lo), a->enter.exact());
        EXPECT_GE(ExactRational::from_double(facet->hi), a->enter.exact());
    }
    void box(const Point3d& p, const Point3d& q) {
        Point3d lo{};
        Point3d hi{};
        for (std::size_t k = 0; k < 3; ++k) {
            lo[k] = std::min(p[k], q[k]);
            hi[k] = std::max(p[k], q[k]);
        }
        EXPECT_TRUE(same_boxes(whole_.in_box(lo, hi), fractions_.in_box(lo, hi)));
        EXPECT_TRUE(same_boxes(whole_.in_box(p, p), fractions_.in_box(p, p)));
    }
    // A plane of the solid or another one through three of its corners, on both lattices.
    void plane() {
        std::array<LatticePoint, 3> c;
        auto& random = make_.random();
        do {
            const auto& t = mesh_.triangles[random.below(mesh_.triangles.size())];
            for (std::size_t i = 0; i < 3; ++i) c[i] = mesh_.points[t[i]];
            if (random.chance(2, 3)) c[0] = mesh_.points[random.below(mesh_.points.size())];
        } while (trisect::are_collinear(c[0], c[1], c[2]));
        const Plane plane = Plane::through(c[0], c[1], c[2]);
        const int bits = fractions_.solid().lattice().exponent;
        const Plane other = Plane::through(with_fractions(c[0], bits), with_fractions(c[1], bits),
                                           with_fractions(c[2], bits));
        const trisect::Lattice lattice = fractions_.solid().lattice();
        EXPECT_TRUE(same(whole_.section(plane, {}), fractions_.section(other, lattice)));
        EXPECT_EQ(whole_.relation_to(plane, {}), fractions_.relation_to(other, lattice));
    }

    const BrepIndex& whole_;
    const BrepIndex& fractions_;
    const LatticeMesh& mesh_;
    brute::PointMaker make_;
};

TEST(QueryFractions, OfFreshMeshesOnASmallGrid) {
    for (std::uint64_t seed = 1; seed <= 24; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        reference::Random random(seed);
        const auto mesh = engines::lattice_mesh(reference::random_embedded_solid(random));
        const BrepIndex whole(Solid::from_lattice_mesh(mesh));
        const int bits = bits_of_units[seed % bits_of_units.size()];
        const BrepIndex fractions(Solid::from_lattice_mesh(with_fractions(mesh, bits)));
        SameSolid(whole, fractions, mesh, seed).expect_same_answers(30);
    }
}

TEST(QueryFractions, OfHandles) {
    for (std::uint64_t seed = 1; seed <= 16; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        reference::Random random(seed);
        const auto mesh = engines::lattice_mesh(reference::random_embedded_solid(random));
        const BrepIndex whole = BrepIndex(Solid::from_lattice_mesh(mesh)).with_brep();
        const int bits = bits_of_units[seed % bits_of_units.size()];
        const BrepIndex fractions =
            BrepIndex(Solid::from_lattice_mesh(with_fractions(mesh, bits))).with_brep();
        ASSERT_EQ(whole.brep().edges().size(), fractions.brep().edges().size());
        SameSolid(whole, fractions, mesh, seed).expect_same_answers(20);
    }
}

// Convex parts of planes whose corners are points that planes have in common.
TEST(QueryFractions, OfExactBoundaries) {
    for (std::uint64_t seed = 1; seed <= 16; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const brute::RandomResult result = brute::random_result(seed, 2, false);
        if (result.solid.is_empty()) continue;
        const trisect::Brep brep = result.solid.to_brep();
        const int bits = bits_of_units[seed % bits_of_units.size()];
        const BrepIndex whole(Solid::from_brep(brep));
        const BrepIndex fractions(Solid::from_brep(with_fractions(brep, bits)));
        SameSolid(whole, fractions, result.mesh, seed).expect_same_answers(20);
        for (const trisect::VertexId v : brep.vertices()) {
            EXPECT_EQ(fractions.locate(exact_point(brep.point(v))).location, Location::OnVertex);
        }
    }
}

// More digits than whole coordinates have -------------------------------------------------------

// A star-shaped ball of random radii, its corners what sines and cosines make of them: near the
// axes they have bits far below the unit, which is 2^-exponent of the largest radius.
LatticeMesh star(std::uint32_t rings, std::uint32_t sides, int exponent, std::uint64_t seed) {
    reference::Random random(seed);
    LatticeMesh mesh;
    mesh.lattice.exponent = -exponent;
    const double pi = std::acos(-1.0);
    const auto add = [&](double up, double around) {
        const double r = 0.7 + 0.3 * static_cast<double>(random.next() >> 11) * 0x1p-53;
        const auto at = [&](double v) {
            // Bits below fraction_limit are cut off.
            const double unit = 0x1p-73;
            const double scaled = std::ldexp(v, exponent);
            return Coordinate(std::fabs(scaled) < 0x1p-20 ? std::nearbyint(scaled / unit) * unit
                                                          : scaled);
        };
        mesh.points.push_back({at(r * std::cos(up) * std::cos(around)),
                               at(r * std::cos(up) * std::sin(around)), at(r * std::sin(up))});
    };
    for (std::uint32_t i = 0; i < rings; ++i)
        for (std::uint32_t j = 0; j < sides; ++j)
            add(pi * (0.5 - (i + 1.0) / (rings + 1.0)), 2 * pi * j / sides);
    const std::uint32_t top = rings * sides;
    add(0.5 * pi, 0);
    add(-0.5 * pi, 0);
    const auto corner = [&](std::uint32_t i, std::uint32_t j) { return i * sides + j % sides; };
    for (std::uint32_t j = 0; j < sides; ++j) {
        mesh.triangles.push_back({corner(0, j), corner(0, j + 1), top});
        mesh.triangles.push_back({corner(rings - 1, j + 1), corner(rings - 1, j), top + 1});
        for (std::uint32_t i = 1; i < rings; ++i) {
            mesh.triangles.push_back({corner(i, j), corner(i, j + 1), corner(i - 1, j)});
            mesh.triangles.push_back({corner(i - 1, j), corner(i, j + 1), corner(i - 1, j + 1)});
        }
    }
    return mesh;
}

class QueryStar : public testing::TestWithParam<int> {
protected:
    QueryStar()
        : mesh_(star(13, 16, GetParam(), 7)),
          solid_(Solid::from_lattice_mesh(mesh_)),
          boundary_(brute::Boundary::of_mesh(mesh_, solid_.source_id())) {}

    // From lattice units to the user's, exactly.
    [[nodiscard]] Point3d user(Point3d p) const {
        for (double& x : p) x = std::ldexp(x, mesh_.lattice.exponent);
        return p;
    }
    // The middle of two doubles if it is one.
    static bool has_middle(const Point3d& a, const Point3d& b, Point3d& middle) {
        bool exact = true;
        for (std::size_t k = 0; k < 3; ++k) {
            middle[k] = 0.5 * (a[k] + b[k]);
            exact = exact && brute::Rational(a[k]) + b[k] == 2 * brute::Rational(middle[k]);
        }
        return exact;
    }
    // Some on the boundary, the others next to it in the last place, or anywhere.
    Point3d some_point(brute::PointMaker& make) {
        Point3d p = make.random().chance(1, 2) ? make.any() : make.corner();
        if (make.random().chance(1, 2)) {
            const std::size_t k = make.random().below(3);
            p[k] = std::nextafter(p[k], make.random().chance(1, 2) ? HUGE_VAL : -HUGE_VAL);
        }
        return p;
    }

    LatticeMesh mesh_;
    Solid solid_;
    brute::Boundary boundary_;
};

TEST_P(QueryStar, OwnVerticesAreVertices) {
    const BrepIndex index(solid_);
    std::vector<Point3d> own;
    for (const LatticePoint& p : mesh_.points) own.push_back(user(p.doubles()));
    const auto places = index.locate(own);
    for (std::uint32_t i = 0; i < own.size(); ++i) {
        const Place place = index.locate(own[i]);
        EXPECT_EQ(place.location, Location::OnVertex);
        EXPECT_EQ(place.corner.corner, i);
        EXPECT_EQ(places[i], place);
        EXPECT_EQ(index.locate(mesh_.points[i]), place);
        EXPECT_EQ(index.nearest(own[i])->place, place);
        EXPECT_EQ(index.nearest_vertex(own[i])->distance, 0);
        EXPECT_EQ(index.signed_distance(own[i])->sign, 0);
    }
}

TEST_P(QueryStar, OwnVerticesByTheNamesOfPlanes) {
    const BrepIndex index(solid_);
    std::vector<std::vector<Plane>> planes(mesh_.points.size());
    for (const auto& t : mesh_.triangles)
        for (const std::uint32_t v : t)
            planes[v].push_back(
                Plane::through(mesh_.points[t[0]], mesh_.points[t[1]], mesh_.points[t[2]]));
    for (std::uint32_t v = 0; v < planes.size(); ++v) {
        const auto& p = planes[v];
        if (!trisect::meet_in_a_point(p[0], p[1], p[2])) continue;
        const Place place = index.locate(trisect::Point(p[0], p[1], p[2]));
        EXPECT_EQ(place.location, Location::OnVertex);
        EXPECT_EQ(place.corner.corner, v);
    }
}

TEST_P(QueryStar, MiddlesThatAreDoublesAreOnEdges) {
    const BrepIndex index(solid_);
    int count = 0;
    for (const auto& t : mesh_.triangles)
        for (std::size_t i = 0; i < 3; ++i) {
            Point3d middle{};
            if (!has_middle(mesh_.points[t[i]].doubles(), mesh_.points[t[(i + 1) % 3]].doubles(),
                            middle))
                continue;
            ++count;
            EXPECT_EQ(index.locate(user(middle)).location, Location::OnEdge);
            for (const double to : {-HUGE_VAL, HUGE_VAL}) {
                Point3d beside = middle;
                beside[0] = std::nextafter(middle[0], to);
                EXPECT_TRUE(brute::agrees(index.locate(user(beside)),
                                          boundary_.locate(brute::point(beside)), true));
            }
        }
    EXPECT_GT(count, 10);
}

TEST_P(QueryStar, LocatesLikeBruteForce) {
    const BrepIndex index(solid_);
    brute::PointMaker make(mesh_, 1);
    std::vector<Point3d> points;
    for (int i = 0; i < 600; ++i) points.push_back(some_point(make));
    std::vector<Point3d> in_user_units;
    for (const Point3d& p : points) in_user_units.push_back(user(p));
    std::vector<Location> found(points.size());
    index.classify(in_user_units, found);
    int on = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const brute::Answer expected = boundary_.locate(brute::point(points[i]));
        const Place place = index.locate(in_user_units[i]);
        ASSERT_TRUE(brute::agrees(place, expected, true))
            << brute::to_string(place) << " instead of " << brute::to_string(expected);
        EXPECT_EQ(found[i], expected.location);
        on += place.is_on_boundary() ? 1 : 0;
    }
    EXPECT_GT(on, 50);
}

TEST_P(QueryStar, HitsAreThoseOfBruteForce) {
    const BrepIndex index(solid_);
    brute::PointMaker make(mesh_, 2);
    for (int i = 0; i < 150; ++i) {
        const Point3d from = some_point(make);
        const Point3d to = some_point(make);
        if (from == to) continue;
        const brute::Point3 o = brute::point(from);
        const brute::Point3 e = brute::point(to);
        const auto expected = boundary_.hits(o, {e[0] - o[0], e[1] - o[1], e[2] - o[2]}, true);
        const Segment segment{user(from), user(to)};
        const auto hits = index.all_hits(segment);
        ASSERT_EQ(hits.size(), expected.size());
        for (std::size_t h = 0; h < hits.size(); ++h) {
            EXPECT_EQ(brute::rational(hits[h].enter.exact()), expected[h].enter);
            EXPECT_EQ(brute::rational(hits[h].leave.exact()), expected[h].leave);
            EXPECT_TRUE(brute::agrees(hits[h].place, expected[h].answer, true));
        }
        const auto first = index.first_hit(segment);
        ASSERT_EQ(first.has_value(), !expected.empty());
        if (!first) continue;
        EXPECT_EQ(brute::rational(first->enter.exact()), expected[0].enter);
    }
}

TEST_P(QueryStar, NearestPointsAreAsNearAsThoseOfBruteForce) {
    const BrepIndex index(solid_);
    brute::PointMaker make(mesh_, 3);
    const brute::Rational unit(std::ldexp(1.0, mesh_.lattice.exponent));
    for (int i = 0; i < 60; ++i) {
        const Point3d p = some_point(make);
        const auto found = index.nearest(user(p));
        const auto expected = boundary_.squared_distance(brute::point(p));
        ASSERT_TRUE(found && expected);
        EXPECT_EQ(brute::rational(found->squared_distance), *expected * unit * unit);
        brute::Point3 q;
        for (std::size_t k = 0; k < 3; ++k) q[k] = brute::rational(found->point[k]) / unit;
        EXPECT_TRUE(brute::agrees(found->place, boundary_.locate(q), true));
    }
}

// 48: near what import makes of them; 0: all that counts is behind the point.
INSTANTIATE_TEST_SUITE_P(Units, QueryStar, testing::Values(0, 24, 48));

// Points so near to a corner that products with small edges leave the range of doubles.
TEST(QueryFractions, NextToACornerAtTheOrigin) {
    LatticeMesh mesh;
    const auto at = [](double x, double y, double z) {
        return LatticePoint{Coordinate(x * 0x1p-73), Coordinate(y * 0x1p-73),
                            Coordinate(z * 0x1p-73)};
    };
    mesh.points = {at(0, 0, 0), at(3, 1, 1), at(1, 3, 1), at(1, 1, 3)};
    mesh.triangles = {{0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {1, 2, 3}};
    const Solid solid = Solid::from_lattice_mesh(mesh);
    const BrepIndex index(solid);
    const auto boundary = brute::Boundary::of_mesh(mesh, solid.source_id());
    reference::Random random(5);
    for (const int e : {-74, -200, -499, -501, -700, -880, -902, -960, -1040})
        for (int i = 0; i < 60; ++i) {
            Point3d p{};
            for (double& x : p)
                x = std::ldexp(static_cast<double>(random.between(0, 4)),
                               e - (random.chance(1, 4) ? 30 : 0));
            ASSERT_TRUE(brute::agrees(index.locate(p), boundary.locate(brute::point(p)), true))
                << e << ": " << p[0] << " " << p[1] << " " << p[2];
            const Ray ray{p, {1, 1, 1}};
            const auto hits = index.all_hits(ray);
            const auto expected = boundary.hits(brute::point(p), brute::point({1, 1, 1}), false);
            ASSERT_EQ(hits.size(), expected.size());
            for (std::size_t h = 0; h < hits.size(); ++h)
                EXPECT_EQ(brute::rational(hits[h].enter.exact()), expected[h].enter);
            EXPECT_EQ(brute::rational(index.nearest(p)->squared_distance),
                      *boundary.squared_distance(brute::point(p)));
        }
}

}  // namespace

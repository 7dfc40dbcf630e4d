// SPDX-License-Identifier: Apache-2.0
//
// The oracle against CGAL's Nef polyhedra with rational coordinates: an engine of entirely
// different construction (spheres around vertices) must find the same boundaries, face by face, for
// random pairs of solids on a small grid, which touch and coincide more often than not.
#include <CGAL/Cartesian.h>
#include <CGAL/Gmpq.h>
#include <CGAL/Nef_polyhedron_3.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Polyhedron_incremental_builder_3.h>
#include <gtest/gtest.h>

#include <map>
#include <vector>

#include "canonical_boundary.h"
#include "naive_boolean.h"
#include "random_solids.h"

namespace {

using namespace reference;
using Kind = Expression::Kind;

using Kernel = CGAL::Cartesian<CGAL::Gmpq>;
using Polyhedron = CGAL::Polyhedron_3<Kernel>;
using Nef = CGAL::Nef_polyhedron_3<Kernel>;

class Builder : public CGAL::Modifier_base<Polyhedron::HalfedgeDS> {
public:
    explicit Builder(const Operand& operand) : operand_(operand) {}

    void operator()(Polyhedron::HalfedgeDS& target) override {
        std::map<LatticePoint, std::size_t> indices;
        for (const Triangle& triangle : operand_) {
            for (const LatticePoint& p : triangle) {
                indices.emplace(p, indices.size());
            }
        }
        std::vector<LatticePoint> points(indices.size());
        for (const auto& [point, index] : indices) {
            points[index] = point;
        }
        CGAL::Polyhedron_incremental_builder_3<Polyhedron::HalfedgeDS> builder(target, true);
        builder.begin_surface(points.size(), operand_.size());
        for (const LatticePoint& p : points) {
            const auto number = [](std::int64_t x) { return CGAL::Gmpq(static_cast<int>(x)); };
            builder.add_vertex(Kernel::Point_3(number(p[0]), number(p[1]), number(p[2])));
        }
        for (const Triangle& triangle : operand_) {
            builder.begin_facet();
            for (const LatticePoint& p : triangle) {
                builder.add_vertex_to_facet(indices.at(p));
            }
            builder.end_facet();
        }
        builder.end_surface();
    }

private:
    const Operand& operand_;
};

Nef to_nef(const Operand& operand) {
    Polyhedron polyhedron;
    Builder builder(operand);
    polyhedron.delegate(builder);
    return Nef(polyhedron);
}

Rational to_rational(const CGAL::Gmpq& value) { return Rational(value.mpq()); }

OrientedPlane to_plane(const Kernel::Plane_3& plane) {
    const std::array<Rational, 4> values{to_rational(plane.a()), to_rational(plane.b()),
                                         to_rational(plane.c()), to_rational(plane.d())};
    Integer scale = 1;
    for (const Rational& value : values) {
        scale = lcm(scale, value.get_den());
    }
    return OrientedPlane(Integer(values[0] * scale), Integer(values[1] * scale),
                         Integer(values[2] * scale), Integer(values[3] * scale));
}

// The regularised boundary: faces between a volume in the set and one outside of it, seen from
// outside. A halfface's plane points into its incident volume, and its cycles run accordingly.
CanonicalBoundary boundary_of(const Nef& nef) {
    std::vector<Polygon> polygons;
    for (auto face = nef.halffacets_begin(); face != nef.halffacets_end(); ++face) {
        if (face->incident_volume()->mark() || !face->twin()->incident_volume()->mark()) {
            continue;
        }
        Polygon polygon{to_plane(face->plane()), {}};
        for (auto cycle = face->facet_cycles_begin(); cycle != face->facet_cycles_end(); ++cycle) {
            if (!cycle.is_shalfedge()) {
                continue;  // an isolated vertex in the face
            }
            const Nef::SHalfedge_const_handle first(cycle);
            Nef::SHalfedge_around_facet_const_circulator step(first);
            const auto last = step;
            std::vector<Point3> loop;
            do {
                const Kernel::Point_3& p = step->source()->center_vertex()->point();
                loop.push_back({to_rational(p.x()), to_rational(p.y()), to_rational(p.z())});
            } while (++step != last);
            polygon.loops.push_back(std::move(loop));
        }
        polygons.push_back(std::move(polygon));
    }
    return canonical_boundary(polygons);
}

TEST(NaiveAgainstNef, single_solids) {
    Random random(21);
    for (int round = 0; round < 30; ++round) {
        SCOPED_TRACE(round);
        const Operand solid = random_embedded_solid(random);
        EXPECT_EQ(
            explain_difference(canonical_boundary(polygons_of(solid)), boundary_of(to_nef(solid))),
            "");
    }
}

TEST(NaiveAgainstNef, pairs) {
    Random random(22);
    for (int round = 0; round < 100; ++round) {
        SCOPED_TRACE(round);
        const std::vector<Operand> pair = random_family(random, 2, true);
        const Nef a = to_nef(pair[0]);
        const Nef b = to_nef(pair[1]);
        const auto compare = [&](Kind kind, const Nef& nef) {
            const Result result = evaluate(pair, pair_expression(kind));
            const CanonicalBoundary naive = canonical_boundary(result.cells);
            const CanonicalBoundary expected = boundary_of(nef);
            EXPECT_EQ(volume(naive), volume(expected));
            EXPECT_EQ(explain_difference(naive, expected), "");
        };
        compare(Kind::Union, a + b);
        compare(Kind::Intersection, a * b);
        compare(Kind::Difference, a - b);
        compare(Kind::Xor, a ^ b);
    }
}

TEST(NaiveAgainstNef, three_operands_in_a_chain) {
    Random random(23);
    for (int round = 0; round < 20; ++round) {
        SCOPED_TRACE(round);
        const std::vector<Operand> family = random_family(random, 3, true);
        const Nef a = to_nef(family[0]);
        const Nef b = to_nef(family[1]);
        const Nef c = to_nef(family[2]);
        const Expression expression =
            Expression::node(Kind::Difference, {pair_expression(Kind::Union), Expression::leaf(2)});
        const Result result = evaluate(family, expression);
        EXPECT_EQ(explain_difference(canonical_boundary(result.cells), boundary_of((a + b) - c)),
                  "");
        const Expression mixed =
            Expression::node(Kind::Intersection, {pair_expression(Kind::Xor), Expression::leaf(2)});
        EXPECT_EQ(explain_difference(canonical_boundary(evaluate(family, mixed).cells),
                                     boundary_of((a ^ b) * c)),
                  "");
    }
}

}  // namespace

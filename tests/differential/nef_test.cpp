// SPDX-License-Identifier: Apache-2.0
//
// Booleans against CGAL's Nef polyhedra with rational coordinates, face by face: random solids on a
// small grid, in pairs and in chains.

#include <CGAL/Cartesian.h>
#include <CGAL/Gmpq.h>
#include <CGAL/Nef_polyhedron_3.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Polyhedron_incremental_builder_3.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "engines/engines.h"

namespace {

using reference::Integer;
using reference::Rational;
using trisect::Embedding;
using trisect::Expression;
using trisect::Solid;

using Kernel = CGAL::Cartesian<CGAL::Gmpq>;
using Polyhedron = CGAL::Polyhedron_3<Kernel>;
using Nef = CGAL::Nef_polyhedron_3<Kernel>;

class Builder : public CGAL::Modifier_base<Polyhedron::HalfedgeDS> {
public:
    explicit Builder(const trisect::LatticeMesh& mesh) : mesh_(mesh) {}

    void operator()(Polyhedron::HalfedgeDS& target) override {
        CGAL::Polyhedron_incremental_builder_3<Polyhedron::HalfedgeDS> builder(target, true);
        builder.begin_surface(mesh_.points.size(), mesh_.triangles.size());
        const auto number = [](trisect::Coordinate x) { return CGAL::Gmpq(x.to_double()); };
        for (const trisect::LatticePoint& p : mesh_.points)
            builder.add_vertex(Kernel::Point_3(number(p.x), number(p.y), number(p.z)));
        for (const auto& triangle : mesh_.triangles) {
            builder.begin_facet();
            for (const std::uint32_t corner : triangle) builder.add_vertex_to_facet(corner);
            builder.end_facet();
        }
        builder.end_surface();
    }

private:
    const trisect::LatticeMesh& mesh_;
};

Nef nef(const reference::Operand& operand) {
    const trisect::LatticeMesh mesh = engines::lattice_mesh(operand);
    Polyhedron polyhedron;
    Builder builder(mesh);
    polyhedron.delegate(builder);
    return Nef(polyhedron);
}

Rational rational(const CGAL::Gmpq& value) { return Rational(value.mpq()); }

// CGAL's planes have rational coefficients here.
reference::OrientedPlane oriented(const Kernel::Plane_3& plane) {
    const std::array<Rational, 4> c{rational(plane.a()), rational(plane.b()), rational(plane.c()),
                                    rational(plane.d())};
    Integer scale = 1;
    for (const Rational& v : c) scale = lcm(scale, v.get_den());
    const auto whole = [&](std::size_t i) { return Integer(c[i] * scale); };
    return {whole(0), whole(1), whole(2), whole(3)};
}

// What separates the set from its outside. A halffacet's plane points into its volume; isolated
// vertices and lower-dimensional parts are no boundary of a regularised set.
reference::CanonicalBoundary boundary(const Nef& set) {
    std::vector<reference::Polygon> polygons;
    for (auto f = set.halffacets_begin(); f != set.halffacets_end(); ++f) {
        if (f->incident_volume()->mark() || !f->twin()->incident_volume()->mark()) continue;
        reference::Polygon polygon{oriented(f->plane()), {}};
        for (auto c = f->facet_cycles_begin(); c != f->facet_cycles_end(); ++c) {
            if (!c.is_shalfedge()) continue;
            Nef::SHalfedge_around_facet_const_circulator at{Nef::SHalfedge_const_handle(c)};
            const auto first = at;
            auto& loop = polygon.loops.emplace_back();
            do {
                const Kernel::Point_3& p = at->source()->center_vertex()->point();
                loop.push_back({rational(p.x()), rational(p.y()), rational(p.z())});
            } while (++at != first);
        }
        polygons.push_back(std::move(polygon));
    }
    return reference::canonical_boundary(polygons);
}

std::string disagreement(const Expression& ours, const Nef& theirs, std::uint64_t seed) {
    trisect::EvaluateOptions options;
    if (seed % 2 == 0) options.leaf_polygons = 4;
    return engines::difference(trisect::evaluate(ours, options).to_brep(), boundary(theirs));
}

TEST(AgainstNef, Pairs) {
    for (std::uint64_t seed = 500; seed < 600; ++seed) {
        SCOPED_TRACE(seed);
        reference::Random random(seed);
        const auto pair = reference::random_family(random, 2, true);
        const auto embedding = seed % 3 == 0 ? Embedding::Resolve : Embedding::Assume;
        const Solid a = engines::solid(pair[0], embedding);
        const Solid b = engines::solid(pair[1], embedding);
        const Nef x = nef(pair[0]);
        const Nef y = nef(pair[1]);
        EXPECT_EQ(disagreement(a | b, x + y, seed), "");
        EXPECT_EQ(disagreement(a & b, x * y, seed), "");
        EXPECT_EQ(disagreement(a - b, x - y, seed), "");
        EXPECT_EQ(disagreement(a ^ b, x ^ y, seed), "");
    }
}

TEST(AgainstNef, ChainsOfFour) {
    for (std::uint64_t seed = 700; seed < 720; ++seed) {
        SCOPED_TRACE(seed);
        reference::Random random(seed);
        const auto family = reference::random_family(random, 4, true);
        std::vector<Solid> s;
        std::vector<Nef> n;
        for (const auto& o : family) {
            s.push_back(engines::solid(o, Embedding::Assume));
            n.push_back(nef(o));
        }
        EXPECT_EQ(disagreement(((s[0] | s[1]) - s[2]) ^ s[3], ((n[0] + n[1]) - n[2]) ^ n[3], seed),
                  "");
        // The same, one evaluation a step.
        const Solid joined = trisect::evaluate(s[0] | s[1]);
        const Solid rest = trisect::evaluate(joined - s[2]);
        EXPECT_EQ(disagreement(rest & s[3], ((n[0] + n[1]) - n[2]) * n[3], seed), "");
    }
}

}  // namespace

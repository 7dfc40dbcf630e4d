// SPDX-License-Identifier: Apache-2.0
#include "nef_polyhedron.h"

#include <CGAL/Polyhedron_3.h>
#include <CGAL/Polyhedron_incremental_builder_3.h>

#include <map>
#include <utility>
#include <vector>

namespace reference {
namespace {

using Polyhedron = CGAL::Polyhedron_3<NefKernel>;

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
            builder.add_vertex(NefKernel::Point_3(number(p[0]), number(p[1]), number(p[2])));
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

}  // namespace

Nef to_nef(const Operand& operand) {
    Polyhedron polyhedron;
    Builder builder(operand);
    polyhedron.delegate(builder);
    return Nef(polyhedron);
}

namespace {

Rational to_rational(const CGAL::Gmpq& value) { return Rational(value.mpq()); }

OrientedPlane to_plane(const NefKernel::Plane_3& plane) {
    const std::array<Rational, 4> values{to_rational(plane.a()), to_rational(plane.b()),
                                         to_rational(plane.c()), to_rational(plane.d())};
    Integer scale = 1;
    for (const Rational& value : values) {
        scale = lcm(scale, value.get_den());
    }
    return OrientedPlane(Integer(values[0] * scale), Integer(values[1] * scale),
                         Integer(values[2] * scale), Integer(values[3] * scale));
}

}  // namespace

// A halfface's plane points into its incident volume, and its cycles run accordingly.
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
                const NefKernel::Point_3& p = step->source()->center_vertex()->point();
                loop.push_back({to_rational(p.x()), to_rational(p.y()), to_rational(p.z())});
            } while (++step != last);
            polygon.loops.push_back(std::move(loop));
        }
        polygons.push_back(std::move(polygon));
    }
    return canonical_boundary(polygons);
}

}  // namespace reference

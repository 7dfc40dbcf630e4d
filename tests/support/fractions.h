// SPDX-License-Identifier: Apache-2.0
//
// The same solid on a coarser lattice, where its coordinates have bits behind the point.
#pragma once

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include <trisect/brep/brep_builder.h>
#include <trisect/brep/lattice_mesh.h>

namespace trisect::test {

/// The unit is 2^bits times as large. \pre coordinates need no more than fraction_limit bits then.
inline LatticePoint with_fractions(const LatticePoint& p, int bits) {
    const auto scaled = [bits](Coordinate c) {
        return Coordinate(std::ldexp(c.to_double(), -bits));
    };
    return {scaled(p.x), scaled(p.y), scaled(p.z)};
}

inline LatticeMesh with_fractions(LatticeMesh mesh, int bits) {
    for (LatticePoint& p : mesh.points) p = with_fractions(p, bits);
    mesh.lattice.exponent += bits;
    return mesh;
}

/// The plane n · (2^bits x) + d = 0.
inline Plane with_fractions(const Plane& p, int bits) {
    const auto n = [&](int i) { return p.normal(i).shifted_left(bits); };
    return {n(0), n(1), n(2), p.offset()};
}

inline Brep with_fractions(const Brep& brep, int bits) {
    BrepBuilder builder(Lattice{brep.lattice().exponent + bits});
    for (const VertexId v : brep.vertices()) {
        const Point& p = brep.point(v);
        if (p.is_lattice()) {
            builder.add_vertex(with_fractions(p.lattice(), bits));
            continue;
        }
        const auto& planes = p.plane_point()->planes;
        builder.add_vertex(Point(with_fractions(planes[0], bits), with_fractions(planes[1], bits),
                                 with_fractions(planes[2], bits)));
    }
    for (const FaceId f : brep.faces()) {
        std::vector<std::vector<std::uint32_t>> loops;
        for (const LoopId l : brep.loops(f)) {
            auto& loop = loops.emplace_back();
            for (const HalfedgeId h : brep.halfedges(l)) loop.push_back(brep.origin(h).index);
        }
        builder.add_face(with_fractions(brep.plane(f), bits), loops, brep.source(f));
    }
    return std::move(builder).build();
}

}  // namespace trisect::test

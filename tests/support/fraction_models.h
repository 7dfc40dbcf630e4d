// SPDX-License-Identifier: Apache-2.0
//
// Models of solids whose coordinates have bits behind the point.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <trisect/brep/import_mesh.h>
#include <trisect/brep/lattice_mesh.h>
#include <trisect/brep/polygon_mesh.h>
#include <trisect/bsp/interference/interference_model.h>
#include <trisect/bsp/solid.h>

#include "fractions.h"

namespace trisect::test {

/// The same solid in units 2^bits times as large.
inline InterferenceModel with_fractions(const InterferenceModel& model, int bits) {
    if (bits == 0 || model.is_empty()) return model;
    return InterferenceModel(Solid::from_brep(with_fractions(model.brep(), bits)));
}

/// Doubles as they come, in units of 2^exponent; what is smaller than the last bit of a coordinate
/// is rounded. \pre the mesh is closed
inline LatticeMesh in_units_of(const PolygonMesh& mesh, int exponent) {
    LatticeMesh out = import_mesh(mesh).mesh;
    out.lattice.exponent = exponent;
    const auto coordinate = [exponent](double v) {
        const double c = std::ldexp(v, -exponent);
        const double fine = std::ldexp(c, fraction_limit);
        return Coordinate(
            std::abs(fine) < 0x1p53 ? std::ldexp(std::nearbyint(fine), -fraction_limit) : c);
    };
    for (std::size_t i = 0; i < out.points.size(); ++i) {
        const auto& p = mesh.points[i];
        out.points[i] = {coordinate(p[0]), coordinate(p[1]), coordinate(p[2])};
    }
    return out;
}

inline InterferenceModel model_in_units_of(const PolygonMesh& mesh, int exponent) {
    return InterferenceModel(Solid::from_lattice_mesh(in_units_of(mesh, exponent)));
}

}  // namespace trisect::test

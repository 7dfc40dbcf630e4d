// SPDX-License-Identifier: Apache-2.0
//
// Shapes of GDML as meshes, in steps of 1e-9 mm.
#pragma once

#include <trisect/brep/polygon_mesh.h>
#include <trisect/brep/primitives/point_2d.h>

#include <array>
#include <cstdint>
#include <numbers>
#include <optional>
#include <vector>

#include "gdml_document.h"
#include "gdml_values.h"

namespace trisect::app {

/// A mesh less another one, and how far its facets may be from the shape that is meant.
struct GdmlShape {
    PolygonMesh mesh;
    PolygonMesh hole;  ///< mostly empty
    double deviation = 0;
    bool is_round = false;
    /// Half-spaces that cut it: a x + b y + c z + d <= 0.
    std::vector<std::array<double, 4>> cuts;
};

[[nodiscard]] inline double radians(double degrees) { return degrees * (std::numbers::pi / 180); }

/// What shapes are made from.
struct GdmlSource {
    const GdmlDocument& document;
    const GdmlValues& values;
    std::uint32_t facets = 120;  ///< of a whole circle
};

/// A corner that is no decimal is rounded to a step in each coordinate.
inline constexpr double rounding_of_corners = 1;

/// Boxes, trapezoids, extrusions, tessellated shapes and others with flat faces; none: another kind
/// of shape. \throw InputError, UnsupportedError
[[nodiscard]] std::optional<GdmlShape> flat_gdml_shape(const GdmlSource& source,
                                                       const GdmlElement& element);
/// Tubes, cones, spheres and others that go round an axis.
[[nodiscard]] std::optional<GdmlShape> round_gdml_shape(const GdmlSource& source,
                                                        const GdmlElement& element);

/// A half-profile in the plane of radius and z, turned about the z axis from one angle to another.
/// Circles have corners where a whole one has them, and at both ends; so circles of one radius have
/// the same corners.
struct GdmlTurn {
    double start = 0;  ///< degrees
    double extent = 360;
    std::uint32_t sides = 0;  ///< of a regular polygon; 0: a circle
    double scale_x = 1;       ///< of the radius
    double scale_y = 1;
};
[[nodiscard]] PolygonMesh turned_profile(const GdmlSource& source, const Outline& profile,
                                         const GdmlTurn& turn);

/// Turned over where it is inside out.
void make_outward(PolygonMesh& mesh);

}  // namespace trisect::app

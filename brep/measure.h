// SPDX-License-Identifier: Apache-2.0
//
// Measures of boundaries: volume, area, centroid and bounds.
//
// All results are in the user's units. Volume, moments and therefore the centroid of a solid are
// rational numbers and available exactly; the doubles are those exact values rounded once, and
// mostly come from a cheaper computation with an enclosure of the error.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include <trisect/brep/brep.h>
#include <trisect/brep/exact_mesh.h>
#include <trisect/brep/exact_point.h>
#include <trisect/brep/exact_rational.h>
#include <trisect/brep/lattice_mesh.h>
#include <trisect/brep/polygon_mesh.h>

namespace trisect {

/// The signed volume below the faces: negative for a boundary that is turned inside out.
/// Linear for lattice points. Plane points have different denominators, so the fraction of a
/// solid with n of them has about n times their bits; it is summed by a balanced tree.
[[nodiscard]] ExactRational exact_volume(const Brep& brep);
[[nodiscard]] ExactRational exact_volume(const Brep& brep, ShellId shell);
[[nodiscard]] ExactRational exact_volume(const ExactMesh& mesh);
[[nodiscard]] ExactRational exact_volume(const LatticeMesh& mesh);

/// The exact volume, correctly rounded. Linear.
[[nodiscard]] double volume(const Brep& brep);
[[nodiscard]] double volume(const Brep& brep, ShellId shell);
[[nodiscard]] double volume(const ExactMesh& mesh);
[[nodiscard]] double volume(const LatticeMesh& mesh);

/// -1 for a boundary that is inside out, however small it is: as a double its volume may be 0.
[[nodiscard]] int sign_of_volume(const Brep& brep);
/// -1 for a shell that bounds a cavity, 1 for one that bounds material.
[[nodiscard]] int sign_of_volume(const Brep& brep, ShellId shell);

/// A sum of square roots of rationals.
struct Area {
    /// Correctly rounded, unless the exact value is not rational and within 2^-8190 square units of
    /// the lattice of the middle between two doubles.
    double value = 0;
    /// Present when the area of every face is rational, as it is for axis-aligned faces.
    std::optional<ExactRational> exact;
};
[[nodiscard]] Area area(const Brep& brep);
[[nodiscard]] Area area(const Brep& brep, FaceId face);
[[nodiscard]] Area area(const ExactMesh& mesh);
[[nodiscard]] Area area(const LatticeMesh& mesh);

/// The centre of mass of the solid, or nothing when its volume is 0.
[[nodiscard]] std::optional<ExactPoint> exact_centroid(const Brep& brep);
[[nodiscard]] std::optional<ExactPoint> exact_centroid(const ExactMesh& mesh);
[[nodiscard]] std::optional<ExactPoint> exact_centroid(const LatticeMesh& mesh);
/// The same, correctly rounded.
[[nodiscard]] std::optional<Point3d> centroid(const Brep& brep);
[[nodiscard]] std::optional<Point3d> centroid(const ExactMesh& mesh);
[[nodiscard]] std::optional<Point3d> centroid(const LatticeMesh& mesh);

/// An axis-aligned box. Its ends are the solid's extremes, correctly rounded.
struct Bounds {
    Point3d lo{};
    Point3d hi{};
    friend bool operator==(const Bounds&, const Bounds&) = default;
};
/// Nothing for the empty set.
[[nodiscard]] std::optional<Bounds> bounds(const Brep& brep);
/// Of all points.
[[nodiscard]] std::optional<Bounds> bounds(const ExactMesh& mesh);
/// Of the points that faces use, as they are.
[[nodiscard]] std::optional<Bounds> bounds(const PolygonMesh& mesh);
/// Of the points that triangles use.
[[nodiscard]] std::optional<Bounds> bounds(const LatticeMesh& mesh);

}  // namespace trisect

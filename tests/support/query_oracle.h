// SPDX-License-Identifier: Apache-2.0
//
// Queries answered by looking at every polygon in exact rationals: the oracle of BrepIndex. No
// tree, no code shared with the library's queries.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <trisect/brep/polygon_mesh.h>
#include <trisect/bsp/brep_index.h>

#include "reference/naive_boolean.h"
#include "reference/random_solids.h"
#include "reference/rational.h"

namespace brute {

using reference::Integer;
using reference::Point3;
using reference::Rational;

/// A closed convex polygon of the boundary, counter-clockwise seen from outside.
struct Polygon {
    std::array<Integer, 3> normal;
    Integer offset;
    std::vector<Point3> corners;
    std::array<double, 3> lo{};  // contain the corners
    std::array<double, 3> hi{};
    trisect::FaceSource name;
};

/// What the point is on. Names as in trisect::Place, when the polygons have names.
struct Answer {
    trisect::Location location = trisect::Location::Outside;
    std::vector<trisect::FaceSource> faces;
};

/// A part of a line on one entity.
struct Hit {
    Rational enter;
    Rational leave;
    bool is_interval = false;
    Answer answer;
};

class Boundary {
public:
    /// The facets of a mesh, named by the solid's source and the facet.
    static Boundary of_mesh(const trisect::LatticeMesh& mesh, std::uint32_t operand);
    /// The same for a mesh of triangles, of its doubles as they are.
    static Boundary of_triangles(const trisect::PolygonMesh& mesh, std::uint32_t operand);
    /// The cells of a reference result; without names.
    static Boundary of_result(const reference::Result& result);

    [[nodiscard]] const std::vector<Polygon>& polygons() const { return polygons_; }
    /// Coordinates in lattice units.
    [[nodiscard]] Answer locate(const Point3& p) const;
    /// Points o + t d with 0 <= t, and t <= 1 for segments.
    [[nodiscard]] std::vector<Hit> hits(const Point3& o, const Point3& d, bool segment) const;
    /// The squared distance to the boundary; nothing when there is none.
    [[nodiscard]] std::optional<Rational> squared_distance(const Point3& p) const;

private:
    void add(std::vector<Point3> corners, trisect::FaceSource name);
    [[nodiscard]] Answer answer_on(std::vector<const Polygon*> on) const;
    [[nodiscard]] bool is_inside(const Point3& p) const;

    std::vector<Polygon> polygons_;
    bool unbounded_ = false;
};

[[nodiscard]] Point3 point(const std::array<double, 3>& p);
[[nodiscard]] Rational rational(const trisect::ExactRational& v);
/// In words, for messages.
[[nodiscard]] std::string to_string(const Answer& a);
[[nodiscard]] std::string to_string(const trisect::Place& p);
/// Whether a place says the same; names only when `named`.
[[nodiscard]] bool agrees(const trisect::Place& place, const Answer& answer, bool named);

/// Points on and off a boundary in all the ways that matter: uniform ones, corners, points of edges
/// and faces, of planes beyond their faces; all doubles.
class PointMaker {
public:
    PointMaker(const trisect::LatticeMesh& mesh, std::uint64_t seed);
    [[nodiscard]] std::array<double, 3> uniform();
    [[nodiscard]] std::array<double, 3> grid();
    [[nodiscard]] std::array<double, 3> corner();
    [[nodiscard]] std::array<double, 3> on_edge();
    [[nodiscard]] std::array<double, 3> on_face();
    [[nodiscard]] std::array<double, 3> on_plane();
    /// One of them, a third of all exactly on something.
    [[nodiscard]] std::array<double, 3> any();
    [[nodiscard]] reference::Random& random() { return random_; }

private:
    [[nodiscard]] const std::array<std::uint32_t, 3>& triangle();
    [[nodiscard]] std::array<double, 3> combined(const std::array<int, 3>& eighths);
    const trisect::LatticeMesh& mesh_;
    reference::Random random_;
    std::array<double, 3> lo_{};
    std::array<double, 3> hi_{};
};

}  // namespace brute

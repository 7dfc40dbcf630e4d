// SPDX-License-Identifier: Apache-2.0
//
// CheckedMesh: the input of the checks of validate(), and their vocabulary.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <trisect/brep/import/edge_table.h>
#include <trisect/brep/import/prepared_mesh.h>
#include <trisect/brep/validate/defect.h>
#include <trisect/brep/validate/validate.h>

namespace trisect::detail {

struct CheckedMesh {
    explicit CheckedMesh(PreparedMesh prepared)
        : mesh(std::move(prepared)), edges(mesh.points.size(), mesh.loop_begin, mesh.corners) {}

    /// A point of the input and its welded name.
    struct NamedPoint {
        std::uint32_t point, id;
    };

    PreparedMesh mesh;
    std::vector<NamedPoint> unused;    ///< points that no face names
    std::vector<NamedPoint> repeated;  ///< points equal to an earlier one
    EdgeTable edges;

    [[nodiscard]] Point3d place(std::uint32_t id) const {
        return to_user(mesh.points[id], mesh.report.lattice);
    }
    /// The vertex's index in the input.
    [[nodiscard]] std::uint32_t name(std::uint32_t id) const { return mesh.source_point[id]; }
    /// "vertex 3 (0, 1, 0)"
    [[nodiscard]] std::string vertex_text(std::uint32_t id) const {
        return "vertex " + std::to_string(name(id)) + " " + place_text(place(id));
    }
    [[nodiscard]] std::string edge_text(std::uint32_t a, std::uint32_t b) const {
        return "edge from " + vertex_text(a) + " to " + vertex_text(b);
    }
    [[nodiscard]] std::string face_text(std::uint32_t face) const {
        std::string s = "face " + std::to_string(face);
        if (!mesh.loop(face).empty()) s += " at " + place_text(place(mesh.loop(face)[0]));
        return s;
    }
    [[nodiscard]] Point3d face_place(std::uint32_t face) const {
        return mesh.loop(face).empty() ? Point3d{} : place(mesh.loop(face)[0]);
    }
};

/// All checks, on the lattice of the options or else the coordinates as they are (Kept) or rounded.
[[nodiscard]] ValidationReport validate_as_written(const PolygonMesh& mesh,
                                                   const ValidateOptions& options,
                                                   Fractions fractions);

// One check for each kind of defect, each in a file of its name.
// Also finds T-vertices and flipped faces.
void check_open_edges(const CheckedMesh& m, ValidationReport& report);
[[nodiscard]] Defect describe_flipped_face(const CheckedMesh& m, const NetEdge& edge,
                                           const std::vector<std::uint32_t>& faces);
void check_non_manifold_edges(const CheckedMesh& m, ValidationReport& report);
void check_non_manifold_vertices(const CheckedMesh& m, ValidationReport& report);
void check_repeated_corners(const CheckedMesh& m, ValidationReport& report);
void check_degenerate_faces(const CheckedMesh& m, ValidationReport& report);
void check_non_planar_faces(const CheckedMesh& m, ValidationReport& report);
void check_non_simple_faces(const CheckedMesh& m, ValidationReport& report);
void check_duplicate_faces(const CheckedMesh& m, ValidationReport& report);  // both orientations
void check_self_intersections(const CheckedMesh& m, const ValidateOptions& options,
                              ValidationReport& report);
void check_duplicate_points(const CheckedMesh& m, ValidationReport& report);
void check_unused_points(const CheckedMesh& m, ValidationReport& report);
void check_shells(const CheckedMesh& m, ValidationReport& report);  // orientation and nesting
void check_emptiness(const CheckedMesh& m, ValidationReport& report);
void check_holes(const Brep& brep, ValidationReport& report);

}  // namespace trisect::detail

// SPDX-License-Identifier: Apache-2.0
//
// StepShapes: solids and surface models of a STEP file as meshes.
//
// Corners are the vertices of the file. Planes and lines say nothing that these do not, but that a
// face is planar and an edge straight: all other surfaces and curves are refused by name. Loops
// give the side of a face; one that runs against its plane is an error. How far corners are from
// their planes is reported. A face with holes is one polygon with bridges (brep/joined_loops.h).
#pragma once

#include <trisect/brep/io/models/step/text.h>
#include <trisect/brep/io/read_model.h>
#include <trisect/brep/planar_loops.h>
#include <trisect/brep/polygon_mesh.h>

#include <array>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

namespace trisect::detail {

class StepShapes {
public:
    StepShapes(const StepText& text, ModelReport& report);

    /// Whether an entity of that keyword is a shape: a B-rep, or a model of shells.
    [[nodiscard]] static bool is_shape(std::string_view keyword);

    struct Shells {
        bool is_solid = false;
        std::vector<std::uint64_t> ids;
    };
    /// The shells that a shape is made of.
    [[nodiscard]] Shells shells(const StepEntity& shape) const;

    /// The mesh of a shape. Corners farther from the plane of their face than `uncertainty` are
    /// counted in the report.
    /// \throw InputError, UnsupportedError with entity and line; LimitError
    [[nodiscard]] PolygonMesh read(const StepEntity& shape, double uncertainty);

    /// The three numbers of a CARTESIAN_POINT or DIRECTION.
    [[nodiscard]] Point3d triple(const StepEntity& entity, std::string_view keyword) const;

private:
    struct Edge {
        std::uint32_t first = 0;
        std::uint32_t last = 0;
    };
    struct StatedPlane {
        Point3d location{};
        Point3d normal{};  ///< of the face
    };

    void add_shell(const StepEntity& shell, bool forward);
    void add_face(const StepEntity& face, bool forward);
    [[nodiscard]] IndexLoop bound_loop(const StepEntity& bound, bool forward);
    [[nodiscard]] IndexLoop poly_loop(const StepEntity& loop);
    [[nodiscard]] IndexLoop edge_loop(const StepEntity& loop);
    [[nodiscard]] Edge oriented_edge(const StepEntity& oriented);
    [[nodiscard]] std::uint32_t edge_number(std::uint64_t id, const char* from);
    [[nodiscard]] std::uint32_t point_number(std::uint64_t id, const char* from);
    void require_line(StepEntity curve, const StepEntity& edge) const;
    [[nodiscard]] StatedPlane plane_of(const StepEntity& face, bool forward) const;
    void check_plane(const StepEntity& face, const StatedPlane& plane,
                     const std::vector<IndexLoop>& loops);
    void add_polygons(const StepEntity& face, const std::vector<IndexLoop>& loops);
    void add_polygon(const StepEntity& face, const IndexLoop& polygon);
    [[nodiscard]] std::uint32_t local_number(std::uint32_t point);

    const StepText& text_;
    ModelReport& report_;
    double uncertainty_ = 0;
    std::uint64_t corners_left_;  ///< what unshared entities of a file of that size can have
    // By the place of an entity in the order of numbers: a number beyond 0, of points or edges.
    std::vector<std::uint32_t> known_;
    std::vector<Point3d> points_;
    std::vector<Edge> edges_;
    PolygonMesh mesh_;
    std::vector<std::uint32_t> local_;  ///< by point: its number in the mesh, from 1
    std::vector<std::uint32_t> touched_;
};

}  // namespace trisect::detail

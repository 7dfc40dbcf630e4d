// SPDX-License-Identifier: Apache-2.0
//
// Conversion of Eigen matrices of vertices and triangles.
// Vertices are an n×3 matrix of doubles, triangles an m×3 matrix of ints, the convention of
// libigl and of many Python bindings. Header-only; needs Eigen 3.4.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <trisect/brep/lattice_mesh.h>
#include <trisect/brep/polygon_mesh.h>
#include <trisect/kernel/error.h>

namespace trisect {

/// Vertices and faces as rows.
struct EigenMesh {
    Eigen::MatrixXd vertices;
    Eigen::MatrixXi faces;
};

/// Rows of F name rows of V; F may have any number of columns (3: triangles, 4: quadrilaterals).
/// Nothing is rounded. \throw UsageError for a wrong shape or an index out of range.
template <class DerivedV, class DerivedF>
[[nodiscard]] PolygonMesh from_eigen(const Eigen::MatrixBase<DerivedV>& vertices,
                                     const Eigen::MatrixBase<DerivedF>& faces) {
    if (vertices.cols() != 3) throw UsageError("the vertex matrix needs three columns");
    if (faces.rows() > 0 && faces.cols() < 3)
        throw UsageError("the face matrix needs at least three columns");
    PolygonMesh mesh;
    mesh.points.reserve(static_cast<std::size_t>(vertices.rows()));
    for (Eigen::Index i = 0; i < vertices.rows(); ++i)
        mesh.points.push_back({static_cast<double>(vertices(i, 0)),
                               static_cast<double>(vertices(i, 1)),
                               static_cast<double>(vertices(i, 2))});
    std::vector<std::uint32_t> loop(static_cast<std::size_t>(faces.cols()));
    for (Eigen::Index f = 0; f < faces.rows(); ++f) {
        for (Eigen::Index k = 0; k < faces.cols(); ++k) {
            const auto v = static_cast<Eigen::Index>(faces(f, k));
            if (v < 0 || v >= vertices.rows())
                throw UsageError("row " + std::to_string(f) + " of the face matrix names vertex " +
                                 std::to_string(v));
            loop[static_cast<std::size_t>(k)] = static_cast<std::uint32_t>(v);
        }
        mesh.add_face(loop);
    }
    return mesh;
}

namespace detail {

inline int eigen_index(std::uint32_t i) {
    if (i > static_cast<std::uint32_t>(std::numeric_limits<int>::max()))
        throw LimitError("more vertices than an int can name");
    return static_cast<int>(i);
}

}  // namespace detail

/// Nothing is rounded. \throw UsageError for a face that is not a triangle: import_mesh makes
/// triangles.
[[nodiscard]] inline EigenMesh to_eigen(const PolygonMesh& mesh) {
    EigenMesh out;
    out.vertices.resize(static_cast<Eigen::Index>(mesh.points.size()), 3);
    out.faces.resize(static_cast<Eigen::Index>(mesh.face_count()), 3);
    for (std::size_t i = 0; i < mesh.points.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k)
            out.vertices(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) =
                mesh.points[i][k];
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        const auto loop = mesh.face(f);
        if (loop.size() != 3)
            throw UsageError("face " + std::to_string(f) + " has " + std::to_string(loop.size()) +
                             " corners; a face matrix holds triangles");
        for (std::size_t k = 0; k < 3; ++k)
            out.faces(static_cast<Eigen::Index>(f), static_cast<Eigen::Index>(k)) =
                detail::eigen_index(loop[k]);
    }
    return out;
}

/// In the user's units; exact unless a coordinate underflows.
[[nodiscard]] inline EigenMesh to_eigen(const LatticeMesh& mesh) {
    EigenMesh out;
    out.vertices.resize(static_cast<Eigen::Index>(mesh.points.size()), 3);
    out.faces.resize(static_cast<Eigen::Index>(mesh.triangles.size()), 3);
    for (std::size_t i = 0; i < mesh.points.size(); ++i)
        for (int k = 0; k < 3; ++k)
            out.vertices(static_cast<Eigen::Index>(i), k) =
                mesh.lattice.to_double(mesh.points[i][k].to_double());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k)
            out.faces(static_cast<Eigen::Index>(t), static_cast<Eigen::Index>(k)) =
                detail::eigen_index(mesh.triangles[t][k]);
    return out;
}

}  // namespace trisect

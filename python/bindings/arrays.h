// SPDX-License-Identifier: Apache-2.0
//
// Conversions between numpy arrays and the arrays of the library.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <trisect/brep/brep.h>
#include <trisect/brep/polygon_mesh.h>
#include <trisect/brep/triangle_view.h>
#include <trisect/kernel/point3d.h>

namespace trisect::python {

namespace py = pybind11;

/// A mesh of vertices (n, 3), of any real type, and faces: an array (m, k) of any integer type, or
/// a sequence of sequences. Indices are checked; coordinates are not.
/// \throw py::type_error, UsageError naming the argument and the place
[[nodiscard]] PolygonMesh mesh_of(const py::object& vertices, const py::object& faces);

/// Triangles in numpy's memory where they lie as the library reads them: doubles, and indices of 32
/// bits. Others are converted and kept here. Coordinates and indices are not checked.
class TriangleArrays {
public:
    /// Nothing where the faces are no array of triangles.
    /// \throw py::type_error, UsageError naming the argument
    [[nodiscard]] static std::optional<TriangleArrays> of(const py::object& vertices,
                                                          const py::object& faces);
    [[nodiscard]] TriangleView view() const { return view_; }
    /// \throw UsageError naming a face with an index that is out of range, and the first vertex
    /// that is not finite
    void require_valid() const;

private:
    py::array given_;  // faces as they came, for messages
    py::array vertices_;
    py::array faces_;
    TriangleView view_;
};

/// \throw UsageError naming the first vertex that is not finite
void require_finite(std::span<const Point3d> points);

/// A pair (vertices, faces), or whatever has these two as attributes. `what` names it in errors.
[[nodiscard]] PolygonMesh mesh_of_pair(const py::object& mesh, const char* what);

/// An array (n, 3) of doubles, without a copy where it is one. `what` names it in errors.
/// \throw py::type_error, UsageError
[[nodiscard]] py::array_t<double, py::array::c_style> points_array(const py::object& points,
                                                                   const char* what);
/// Three numbers. \throw as above
[[nodiscard]] Point3d point_of(const py::object& point, const char* what);
/// `count` numbers. \throw as above
[[nodiscard]] std::vector<double> numbers_of(const py::object& numbers, std::size_t count,
                                             const char* what);
/// The same for any number of them.
[[nodiscard]] std::vector<double> numbers_of(const py::object& numbers, const char* what);
/// Any number of points of the plane. \throw as above
[[nodiscard]] std::vector<std::array<double, 2>> outline_of(const py::object& points,
                                                            const char* what);

[[nodiscard]] py::array_t<double> to_array(const Point3d& point);
/// Arrays that own the vector's memory: nothing is copied.
[[nodiscard]] py::array_t<double> to_array(std::vector<Point3d>&& points);
[[nodiscard]] py::array_t<std::int32_t> to_array(std::vector<std::uint32_t>&& corners);
/// (n, 2): the operand and the face.
[[nodiscard]] py::array_t<std::uint32_t> to_array(std::vector<FaceSource>&& sources);

/// Vertices and triangles. \pre all faces of the mesh are triangles
[[nodiscard]] std::pair<py::array, py::array> triangle_arrays(PolygonMesh&& mesh);

/// An array of one dimension or more that owns the memory of a vector.
template <class Number, class Element>
py::array_t<Number> adopt(std::vector<Element>&& elements, std::vector<py::ssize_t> shape) {
    auto* const kept = new std::vector<Element>(std::move(elements));
    const py::capsule owner(kept, [](void* p) { delete static_cast<std::vector<Element>*>(p); });
    return py::array_t<Number>(std::move(shape), reinterpret_cast<const Number*>(kept->data()),
                               owner);
}

}  // namespace trisect::python

// SPDX-License-Identifier: Apache-2.0

#include "arrays.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <span>
#include <string>

#include <trisect/brep/validate/defect.h>
#include <trisect/kernel/error.h>

namespace trisect::python {

namespace {

constexpr std::size_t corner_limit = std::numeric_limits<std::uint32_t>::max();

std::string shape_text(const py::array& a) { return py::str(a.attr("shape")); }

std::string type_text(const py::array& a) { return py::str(a.attr("dtype")); }

std::string class_text(const py::object& o) { return py::str(py::type::of(o).attr("__name__")); }

// Whatever numpy makes an array of. Ragged sequences are none.
py::array array_of(const py::object& o, const char* what) {
    if (py::isinstance<py::array>(o)) return py::reinterpret_borrow<py::array>(o);
    if (o.is_none() || py::isinstance<py::str>(o))
        throw py::type_error(std::string(what) + ": must be an array, not " + class_text(o));
    PyObject* const made = py::detail::npy_api::get().PyArray_FromAny_(
        o.ptr(), nullptr, 0, 0, py::detail::npy_api::NPY_ARRAY_ENSUREARRAY_, nullptr);
    if (made == nullptr) {
        py::error_already_set reason;
        throw py::type_error(std::string(what) + ": no array can be made of this " + class_text(o) +
                             ": " + reason.what());
    }
    return py::reinterpret_steal<py::array>(made);
}

bool is_real(const py::array& a) {
    const char kind = a.dtype().kind();
    return kind == 'f' || kind == 'i' || kind == 'u' || kind == 'b';
}

// Doubles, row by row; a copy only where it is needed.
py::array_t<double, py::array::c_style> doubles_of(const py::array& a, const char* what) {
    if (!is_real(a) && a.size() != 0)
        throw py::type_error(std::string(what) + ": must be an array of numbers, not of " +
                             type_text(a));
    auto made = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(a);
    if (!made) throw py::type_error(std::string(what) + ": cannot be read as doubles");
    return made;
}

[[noreturn]] void throw_index(std::size_t face, const std::string& index, std::size_t points) {
    throw UsageError("faces: face " + std::to_string(face) + " names vertex " + index +
                     ", and there are " + std::to_string(points) +
                     (points == 0 ? "" : ": 0 to " + std::to_string(points - 1)));
}

// Copies indices of one type; none may be below zero or beyond the points.
template <class Index>
void copy_corners(const py::array& faces, std::size_t points, std::vector<std::uint32_t>& corners) {
    const auto from = py::array_t<Index, py::array::c_style>::ensure(faces);
    if (!from) throw py::type_error("faces: cannot be read as integers");
    const auto count = static_cast<std::size_t>(from.size());
    const std::span<const Index> indices(from.data(), count);
    corners.resize(count);
    // An index below zero is a large one without its sign.
    using Unsigned = std::make_unsigned_t<Index>;
    Unsigned largest = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const auto index = static_cast<Unsigned>(indices[i]);
        largest = std::max(largest, index);
        corners[i] = static_cast<std::uint32_t>(index);
    }
    if (count == 0 || largest < points) return;
    const auto per_face = static_cast<std::size_t>(faces.shape(1));
    for (std::size_t i = 0; i < count; ++i)
        if (static_cast<Unsigned>(indices[i]) >= points)
            throw_index(i / per_face, std::to_string(indices[i]), points);
}

template <class Index>
py::array narrowed(const py::array& faces) {
    const auto from = py::array_t<Index, py::array::c_style>::ensure(faces);
    if (!from) throw py::type_error("faces: cannot be read as integers");
    std::vector<std::uint32_t> corners(static_cast<std::size_t>(from.size()));
    const Index* const indices = from.data();
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const auto index = static_cast<std::make_unsigned_t<Index>>(indices[i]);
        corners[i] = index > corner_limit ? static_cast<std::uint32_t>(corner_limit)
                                          : static_cast<std::uint32_t>(index);
    }
    return adopt<std::uint32_t>(std::move(corners), {faces.shape(0), faces.shape(1)});
}

void set_corners(const py::array& faces, std::size_t points, std::vector<std::uint32_t>& corners) {
    const char kind = faces.dtype().kind();
    const auto size = faces.itemsize();
    if (kind == 'i' && size == 4) {
        copy_corners<std::int32_t>(faces, points, corners);
    } else if (kind == 'i' && size == 8) {
        copy_corners<std::int64_t>(faces, points, corners);
    } else if (kind == 'u' && size == 4) {
        copy_corners<std::uint32_t>(faces, points, corners);
    } else if (kind == 'u' && size == 8) {
        copy_corners<std::uint64_t>(faces, points, corners);
    } else if (kind == 'i') {
        copy_corners<std::int64_t>(py::array(faces.attr("astype")("int64")), points, corners);
    } else {
        copy_corners<std::uint64_t>(py::array(faces.attr("astype")("uint64")), points, corners);
    }
}

void set_faces(const py::array& faces, PolygonMesh& mesh) {
    const char kind = faces.dtype().kind();
    if (faces.size() != 0 && kind != 'i' && kind != 'u')
        throw py::type_error("faces: must be an array of integers, not of " + type_text(faces));
    if (faces.size() == 0 && faces.ndim() == 1) return;
    if (faces.ndim() != 2 || faces.shape(1) < 3)
        throw UsageError(
            "faces: must have the shape (m, 3), or (m, k) for polygons of k corners, "
            "not " +
            shape_text(faces));
    const auto count = static_cast<std::size_t>(faces.shape(0));
    const auto per_face = static_cast<std::size_t>(faces.shape(1));
    if (count > corner_limit / per_face)
        throw LimitError("faces: " + std::to_string(count) + " faces of " +
                         std::to_string(per_face) + " corners are more than 2^32 - 1 corners");
    set_corners(faces, mesh.points.size(), mesh.corners);
    mesh.face_begin.resize(count + 1);
    for (std::size_t f = 0; f <= count; ++f)
        mesh.face_begin[f] = static_cast<std::uint32_t>(per_face * f);
}

// A sequence of loops, each a sequence of integers.
void set_polygons(const py::sequence& faces, PolygonMesh& mesh) {
    std::size_t number = 0;
    for (const py::handle loop : faces) {
        if (!py::isinstance<py::sequence>(loop) && !py::isinstance<py::array>(loop))
            throw py::type_error("faces: face " + std::to_string(number) +
                                 " must be a sequence of integers");
        for (const py::handle corner : loop) {
            const py::object index =
                py::reinterpret_steal<py::object>(PyNumber_Index(corner.ptr()));
            if (!index) {
                PyErr_Clear();
                throw py::type_error("faces: face " + std::to_string(number) +
                                     " has a corner that is no integer");
            }
            int overflow = 0;
            const long long v = PyLong_AsLongLongAndOverflow(index.ptr(), &overflow);
            if (overflow != 0 || v < 0 || static_cast<std::size_t>(v) >= mesh.points.size())
                throw_index(number, py::str(index), mesh.points.size());
            mesh.corners.push_back(static_cast<std::uint32_t>(v));
        }
        const std::size_t corners = mesh.corners.size() - mesh.face_begin.back();
        if (corners < 3)
            throw UsageError("faces: face " + std::to_string(number) + " has " +
                             std::to_string(corners) + " corners, and needs three");
        if (mesh.corners.size() > corner_limit)
            throw LimitError("faces: more than 2^32 - 1 corners");
        mesh.face_begin.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
        ++number;
    }
}

// Indices of 32 bits, row by row: the array itself where it is that. An index that does not fit
// into 32 bits becomes the largest one, which is out of range.
py::array indices_of(const py::array& faces) {
    const char kind = faces.dtype().kind();
    const auto size = faces.itemsize();
    const bool is_native = faces.dtype().attr("isnative").cast<bool>();
    if ((kind == 'i' || kind == 'u') && size == 4 && is_native) {
        if ((faces.flags() & py::array::c_style) != 0) return faces;
        return py::array(faces.attr("copy")("C"));
    }
    if (size == 8 && is_native && kind == 'i') return narrowed<std::int64_t>(faces);
    if (size == 8 && is_native && kind == 'u') return narrowed<std::uint64_t>(faces);
    return narrowed<std::int64_t>(py::array(faces.attr("astype")("int64")));
}

// Loops of different lengths make no array of numbers.
bool is_ragged(const py::object& faces) {
    if (py::isinstance<py::array>(faces))
        return py::reinterpret_borrow<py::array>(faces).dtype().kind() == 'O';
    if (!py::isinstance<py::list>(faces) && !py::isinstance<py::tuple>(faces)) return false;
    const auto list = py::reinterpret_borrow<py::sequence>(faces);
    if (list.size() == 0) return false;
    py::ssize_t length = -1;
    for (const py::handle loop : list) {
        const py::ssize_t n = PyObject_Length(loop.ptr());
        if (n < 0) {
            PyErr_Clear();
            return true;  // set_polygons says which face it is
        }
        if (length >= 0 && n != length) return true;
        length = n;
    }
    return length < 3;
}

}  // namespace

py::array_t<double, py::array::c_style> points_array(const py::object& points, const char* what) {
    const py::array a = array_of(points, what);
    const bool is_nothing = a.size() == 0 && a.ndim() == 1;
    if (!is_nothing && (a.ndim() != 2 || a.shape(1) != 3))
        throw UsageError(std::string(what) + ": must have the shape (n, 3), not " + shape_text(a));
    if (static_cast<std::size_t>(a.shape(0)) > corner_limit)
        throw LimitError(std::string(what) + ": " + std::to_string(a.shape(0)) +
                         " are more than 2^32 - 1");
    return doubles_of(a, what);
}

PolygonMesh mesh_of(const py::object& vertices, const py::object& faces) {
    const auto points = points_array(vertices, "vertices");
    const auto count = static_cast<std::size_t>(points.size()) / 3;
    PolygonMesh mesh;
    mesh.points.resize(count);
    if (count != 0) std::memcpy(mesh.points.data(), points.data(), count * sizeof(Point3d));
    if (is_ragged(faces)) {
        set_polygons(py::reinterpret_borrow<py::sequence>(faces), mesh);
    } else {
        set_faces(array_of(faces, "faces"), mesh);
    }
    return mesh;
}

std::optional<TriangleArrays> TriangleArrays::of(const py::object& vertices,
                                                 const py::object& faces) {
    if (is_ragged(faces)) return std::nullopt;
    const py::array given = array_of(faces, "faces");
    const char kind = given.dtype().kind();
    const bool is_triangles = given.ndim() == 2 && given.shape(1) == 3 && given.shape(0) != 0;
    if (!is_triangles || (kind != 'i' && kind != 'u')) return std::nullopt;
    const auto count = static_cast<std::size_t>(given.shape(0));
    if (count > corner_limit / 3) return std::nullopt;  // mesh_of() says so
    TriangleArrays arrays;
    arrays.given_ = given;
    const auto points = points_array(vertices, "vertices");
    arrays.vertices_ = points;
    arrays.faces_ = indices_of(given);
    using Triangle = std::array<std::uint32_t, 3>;
    arrays.view_ = {{reinterpret_cast<const Point3d*>(points.data()),
                     static_cast<std::size_t>(points.size()) / 3},
                    {static_cast<const Triangle*>(arrays.faces_.data()), count}};
    return arrays;
}

void TriangleArrays::require_valid() const {
    const std::size_t points = view_.points.size();
    for (std::size_t f = 0; f < view_.triangles.size(); ++f)
        for (std::size_t i = 0; i < 3; ++i)
            if (view_.triangles[f][i] >= points)
                throw_index(f, py::str(given_.attr("item")(f, i)), points);
    require_finite(view_.points);
}

void require_finite(std::span<const Point3d> points) {
    for (std::size_t v = 0; v < points.size(); ++v)
        for (const double c : points[v])
            if (!std::isfinite(c))
                throw UsageError("vertices: vertex " + std::to_string(v) + " is " +
                                 place_text(points[v]) + ": coordinates must be finite");
}

PolygonMesh mesh_of_pair(const py::object& mesh, const char* what) {
    if (py::hasattr(mesh, "vertices") && py::hasattr(mesh, "faces"))
        return mesh_of(mesh.attr("vertices"), mesh.attr("faces"));
    if ((py::isinstance<py::tuple>(mesh) || py::isinstance<py::list>(mesh)) && py::len(mesh) == 2) {
        const auto pair = py::reinterpret_borrow<py::sequence>(mesh);
        return mesh_of(pair[0], pair[1]);
    }
    throw py::type_error(std::string(what) +
                         ": must be a pair (vertices, faces), such as that of "
                         "Solid.mesh(), or have these two as attributes");
}

std::vector<double> numbers_of(const py::object& numbers, std::size_t count, const char* what) {
    const auto a = doubles_of(array_of(numbers, what), what);
    if (static_cast<std::size_t>(a.size()) != count || a.ndim() != 1)
        throw UsageError(std::string(what) + ": must be " + std::to_string(count) +
                         " numbers, not an array of shape " + shape_text(a));
    return {a.data(), a.data() + count};
}

std::vector<double> numbers_of(const py::object& numbers, const char* what) {
    const auto a = doubles_of(array_of(numbers, what), what);
    if (a.ndim() != 1)
        throw UsageError(std::string(what) + ": must have the shape (n,), not " + shape_text(a));
    return {a.data(), a.data() + a.size()};
}

Point3d point_of(const py::object& point, const char* what) {
    const std::vector<double> v = numbers_of(point, 3, what);
    return {v[0], v[1], v[2]};
}

std::vector<std::array<double, 2>> outline_of(const py::object& points, const char* what) {
    const auto a = doubles_of(array_of(points, what), what);
    if (a.ndim() != 2 || a.shape(1) != 2)
        throw UsageError(std::string(what) + ": must have the shape (n, 2), not " + shape_text(a));
    std::vector<std::array<double, 2>> outline(static_cast<std::size_t>(a.shape(0)));
    if (!outline.empty())
        std::memcpy(outline.data(), a.data(), outline.size() * sizeof(outline[0]));
    return outline;
}

py::array_t<double> to_array(const Point3d& point) { return py::array_t<double>(3, point.data()); }

py::array_t<double> to_array(std::vector<Point3d>&& points) {
    const auto n = static_cast<py::ssize_t>(points.size());
    return adopt<double>(std::move(points), {n, 3});
}

py::array_t<std::int32_t> to_array(std::vector<std::uint32_t>&& corners) {
    const auto n = static_cast<py::ssize_t>(corners.size() / 3);
    return adopt<std::int32_t>(std::move(corners), {n, 3});
}

py::array_t<std::uint32_t> to_array(std::vector<FaceSource>&& sources) {
    static_assert(sizeof(FaceSource) == 2 * sizeof(std::uint32_t));
    const auto n = static_cast<py::ssize_t>(sources.size());
    return adopt<std::uint32_t>(std::move(sources), {n, 2});
}

std::pair<py::array, py::array> triangle_arrays(PolygonMesh&& mesh) {
    if (mesh.points.size() > (std::size_t{1} << 31))
        throw LimitError("more than 2^31 vertices do not fit into an array of int32");
    return {to_array(std::move(mesh.points)), to_array(std::move(mesh.corners))};
}

}  // namespace trisect::python

// SPDX-License-Identifier: Apache-2.0
//
// The class Solid: made of arrays, combined by operators, turned into arrays again.

#include <optional>
#include <string>
#include <vector>

#include <pybind11/stl.h>

#include <trisect/brep/brep_mesh.h>
#include <trisect/brep/io/exact_boundary.h>
#include <trisect/bsp/native_file.h>
#include <trisect/bsp/solid.h>
#include <trisect/bsp/solid_measure.h>

#include "arrays.h"
#include "bind.h"
#include "embedding.h"
#include "run.h"
#include "solids.h"

namespace trisect::python {

namespace {

constexpr const char* solid_doc = R"(An immutable set of points bounded by planar polygons.

Every decision about it is exact; there is no tolerance. It may be empty, unbounded or the whole
space. Copies cost nothing, and any number of threads may read one.

Parameters
----------
vertices : array_like, shape (n, 3)
    Coordinates of any real type. Doubles stay as they are where all of them span at most 126
    bits, as nearly always.
faces : array_like, shape (m, 3) or (m, k), or sequence of sequences
    Indices of vertices, of any integer type, counter-clockwise seen from outside.
embedding : {'assume', 'check', 'resolve'}
    'assume': the boundary does not meet itself. 'check': find that out first, some microseconds
    a triangle, and resolve a boundary that does. 'resolve': it may.
inside_out : bool
    Accept a mesh that is inside out, for ``evaluate(..., winding='nonzero')``.
lattice_exponent : int, optional
    Round coordinates to multiples of two to this power.

Raises
------
InvalidSolid
    When the mesh is not closed and oriented, or inside out; ``report`` has the places.
UsageError, TypeError
    For wrong shapes and types, indices out of range, coordinates that are not finite.
LimitError
    For coordinates that leave the range of the lattice.

Examples
--------
>>> a = Solid(vertices, faces)
>>> b = Solid.box((0, 0, 0), (1, 1, 1))
>>> vertices, faces = (a - b).mesh()
)";

SolidOptions options_of(const std::string& embedding, bool inside_out,
                        std::optional<int> lattice_exponent) {
    SolidOptions options;
    options.embedding = embedding_of(embedding);
    options.inside_out = inside_out ? InsideOut::Accept : InsideOut::Refuse;
    if (lattice_exponent) options.import.lattice = Lattice{*lattice_exponent};
    return options;
}

py::object mesh_arrays(const Solid& solid, bool sources) {
    MeshMap map;
    PolygonMesh mesh = run_on_threads([&](std::uint32_t threads) {
        return sources ? solid.to_mesh(map, threads) : solid.to_mesh(threads);
    });
    auto [vertices, faces] = triangle_arrays(std::move(mesh));
    if (!sources) return py::make_tuple(vertices, faces);
    return py::make_tuple(vertices, faces, to_array(std::move(map.source)));
}

std::string solid_repr(const Solid& solid) {
    if (solid.is_whole_space()) return "<trisect.Solid: all of space>";
    try {
        const SolidCounts made = run([&] { return counts(solid); });
        if (made.triangles == 0) return "<trisect.Solid: empty>";
        return "<trisect.Solid: " + std::to_string(made.vertices) + " vertices, " +
               std::to_string(made.triangles) + " triangles>";
    } catch (const UnsupportedError&) {
        return "<trisect.Solid: unbounded>";
    }
}

// Both of an operator's operands are solids; Python tries the other's operator otherwise.
template <class Combine>
py::object combined(const Solid& a, const py::object& b, const Combine& combine) {
    if (!py::isinstance<Solid>(b)) return py::reinterpret_borrow<py::object>(Py_NotImplemented);
    return py::cast(evaluated(combine(Expression(a), Expression(b.cast<const Solid&>()))));
}

void bind_operators(py::class_<Solid>& c) {
    c.def(
         "__or__",
         [](const Solid& a, const py::object& b) {
             return combined(a, b, [](const auto& x, const auto& y) { return x | y; });
         },
         "Union.")
        .def(
            "__and__",
            [](const Solid& a, const py::object& b) {
                return combined(a, b, [](const auto& x, const auto& y) { return x & y; });
            },
            "Intersection.")
        .def(
            "__sub__",
            [](const Solid& a, const py::object& b) {
                return combined(a, b, [](const auto& x, const auto& y) { return x - y; });
            },
            "Difference.")
        .def(
            "__xor__",
            [](const Solid& a, const py::object& b) {
                return combined(a, b, [](const auto& x, const auto& y) { return x ^ y; });
            },
            "Symmetric difference.")
        .def(
            "__invert__", [](const Solid& a) { return evaluated(~Expression(a)); }, "Complement.");
}

Solid solid_of_bytes(const py::bytes& data) {
    return solid_of(NativeFile::of_bytes(std::string(data), "bytes of a solid"));
}

void bind_copies(py::class_<Solid>& c) {
    c.def(
         "exact_text", [](const Solid& s) { return exact_boundary_text(s); },
         R"(The boundary as exact text, which `from_exact_text` reads back to the last bit.

The boundary of a complement is that of the set itself.

Raises
------
UnsupportedError
    When the boundary is unbounded.
)")
        .def_static(
            "from_exact_text",
            [](const std::string& text) {
                return run([&] { return Solid::from_brep(read_exact(text, "exact text")); });
            },
            py::arg("text"), R"(The solid of a text that `exact_text` or ``--boundary`` made.

Raises
------
InputError
    With line and column, for what does not follow the format.
)")
        .def(
            "to_bytes", [](const Solid& s) { return py::bytes(native_bytes_of(s)); },
            R"(What a native file of the solid holds: its tree, its exact boundary, the names of its faces.

`write` writes the same to a file whose name ends in ``.trisect``, and `pickle` keeps it.
)")
        .def_static(
            "from_bytes", [](const py::bytes& data) { return solid_of_bytes(data); },
            py::arg("data"), R"(The solid of what `to_bytes` made, to the last bit.

Faces keep their numbers. Operands have numbers that nothing else in this process has, in the order
that they had, since the bytes may come from another one.

Raises
------
InputError
    With the place, for what is cut off, damaged, of another version, or impossible.
)")
        .def("__copy__", [](const Solid& s) { return s; })
        .def(
            "__deepcopy__", [](const Solid& s, const py::dict&) { return s; }, py::arg("memo"))
        .def(py::pickle(
            [](const Solid& s) { return py::make_tuple(2, py::bytes(native_bytes_of(s))); },
            [](const py::tuple& t) {
                if (t.size() != 2 || t[0].cast<int>() != 2)
                    throw UsageError("this pickle of a Solid is of another version");
                return solid_of_bytes(t[1].cast<py::bytes>());
            }));
}

}  // namespace

void bind_solid_type(py::module_& m) {
    py::class_<Solid> c(m, "Solid", solid_doc);
    c.def(py::init<>())
        .def(py::init([](const py::object& vertices, const py::object& faces,
                         const std::string& embedding, bool inside_out,
                         std::optional<int> lattice_exponent) {
                 return import_solid(vertices, faces,
                                     options_of(embedding, inside_out, lattice_exponent));
             }),
             py::arg("vertices"), py::arg("faces"), py::kw_only(), py::arg("embedding") = "assume",
             py::arg("inside_out") = false, py::arg("lattice_exponent") = py::none())
        .def("mesh", &mesh_arrays, py::kw_only(), py::arg("sources") = false,
             R"(The boundary as triangles, with coordinates rounded once, correctly.

Parameters
----------
sources : bool
    Also return where each triangle comes from.

Returns
-------
vertices : ndarray, shape (n, 3), float64
faces : ndarray, shape (m, 3), int32
sources : ndarray, shape (m, 2), uint32
    If requested: the operand, as its `source_id`, and the number of the operand's face.

Raises
------
UnsupportedError
    When the set is unbounded.
)")
        .def_property_readonly(
            "source_id", [](const Solid& s) { return s.source_id(); },
            "What ``mesh(sources=True)`` calls this operand, if made of a mesh.")
        .def_property_readonly(
            "lattice_exponent", [](const Solid& s) { return s.lattice().exponent; },
            "The unit of coordinates is two to this power.")
        .def_property_readonly(
            "is_empty", [](const Solid& s) { return run([&] { return s.is_empty(); }); },
            "Whether this is the empty set.")
        .def_property_readonly(
            "is_whole_space",
            [](const Solid& s) { return run([&] { return s.is_whole_space(); }); },
            "Whether this is all of space.")
        .def_static("whole_space", &Solid::whole_space, "All of space.")
        .def_static(
            "half_space",
            [](const py::object& plane) {
                const std::vector<double> v = numbers_of(plane, 4, "plane");
                return Solid::half_space({v[0], v[1], v[2], v[3]});
            },
            py::arg("plane"), R"(The points with a x + b y + c z + d <= 0, exactly.

Parameters
----------
plane : array_like, shape (4,)
    a, b, c, d.
)")
        .def(
            "refine", [](const Solid& s) { run_on_threads([&](std::uint32_t n) { s.refine(n); }); },
            "Divides large cells now, so that small cuts into a large part cost what is near them.")
        .def("__repr__", &solid_repr);
    bind_operators(c);
    bind_copies(c);
}

}  // namespace trisect::python

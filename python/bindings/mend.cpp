// SPDX-License-Identifier: Apache-2.0
//
// Mending of meshes, each kind where it is asked for.

#include <cstdint>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <pybind11/stl.h>

#include <trisect/brep/mend/mend.h>
#include <trisect/kernel/error.h>

#include "arrays.h"
#include "bind.h"
#include "run.h"

namespace trisect::python {

namespace {

InnerShells inner_of(const std::string& word) {
    if (word == "cavities") return InnerShells::Cavities;
    if (word == "material") return InnerShells::Material;
    throw UsageError("inner: must be 'cavities' or 'material', not '" + word + "'");
}

std::optional<std::uint32_t> name_of_face(std::uint32_t face) {
    return face == no_face ? std::nullopt : std::optional(face);
}

template <class Entry, class Of>
py::list list_of(const std::vector<Entry>& all, const Of& of) {
    py::list out;
    for (const Entry& entry : all) out.append(of(entry));
    return out;
}

// An array (m, k) where all faces have k corners, or a list of lists.
py::object faces_of(const PolygonMesh& mesh) {
    const std::size_t k = mesh.face_count() == 0 ? 3 : mesh.face(0).size();
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        if (mesh.face(f).size() == k) continue;
        py::list out;
        for (std::size_t g = 0; g < mesh.face_count(); ++g)
            out.append(std::vector<std::uint32_t>(mesh.face(g).begin(), mesh.face(g).end()));
        return py::object(std::move(out));
    }
    return adopt<std::int32_t>(
        std::vector<std::uint32_t>(mesh.corners),
        {static_cast<py::ssize_t>(mesh.face_count()), static_cast<py::ssize_t>(k)});
}

void bind_open(py::module_& m) {
    py::class_<OpenBoundary>(m, "OpenBoundary", "Open edges that are connected.")
        .def_property_readonly(
            "edges", [](const OpenBoundary& b) { return b.edges; }, "How many there are (int).")
        .def_property_readonly(
            "length", [](const OpenBoundary& b) { return b.length; }, "Of all of them, rounded.")
        .def_property_readonly(
            "vertex", [](const OpenBoundary& b) { return b.vertex; },
            "One of its vertices, as the mesh that was given numbers them (int).")
        .def_property_readonly(
            "face", [](const OpenBoundary& b) { return name_of_face(b.face); },
            "One of its faces (int), or None for one that was added.")
        .def_property_readonly(
            "place", [](const OpenBoundary& b) { return to_array(b.place); },
            "The vertex, array of shape (3,).")
        .def_property_readonly(
            "is_loop", [](const OpenBoundary& b) { return b.is_loop; },
            "Whether two edges meet at each vertex.")
        .def("__repr__", [](const OpenBoundary& b) {
            return "<OpenBoundary: " + std::to_string(b.edges) + " edges, at vertex " +
                   std::to_string(b.vertex) + ">";
        });
}

using ReportClass = py::class_<MendReport>;

void bind_lists(ReportClass& report) {
    report
        .def_property_readonly(
            "unorientable",
            [](const MendReport& r) {
                return list_of(r.unorientable, [](const UnorientablePart& p) {
                    return py::make_tuple(p.face, p.faces, py::make_tuple(p.edge[0], p.edge[1]));
                });
            },
            "Connected parts without an orientation: first face, number of faces, and the two "
            "vertices of an edge at which faces contradict each other.")
        .def_property_readonly(
            "shells_left",
            [](const MendReport& r) {
                return list_of(r.shells_left, [](const ShellLeft& s) {
                    return py::make_tuple(name_of_face(s.face), s.faces, name_of(s.trouble));
                });
            },
            "Shells that were left as they are: first face, number of faces, and why: 'open', "
            "'no_volume', 'meets_others', 'within_meeting'.")
        .def_property_readonly(
            "joined",
            [](const MendReport& r) {
                return list_of(r.joined, [](const JoinedVertex& j) {
                    return py::make_tuple(j.vertex, j.into, j.move);
                });
            },
            "Vertices that became others: vertex, the other one, and how far it moved.")
        .def_property_readonly(
            "divided",
            [](const MendReport& r) {
                return list_of(r.divided, [](const DividedEdge& d) {
                    return py::make_tuple(py::make_tuple(d.edge[0], d.edge[1]), d.vertex, d.gap);
                });
            },
            "Vertices that were put into edges: the edge, the vertex, and how far away it was.")
        .def_property_readonly(
            "open", [](const MendReport& r) { return r.open; },
            "What is still open, longest first (list of `OpenBoundary`).");
}

void bind_report(py::module_& m) {
    ReportClass report(m, "MendReport", R"(What `mend` did, and what it left.

Faces and vertices are those of the mesh that was given; of vertices with equal coordinates the
first one.
)");
    report
        .def_property_readonly(
            "turned_faces", [](const MendReport& r) { return r.turned_faces; },
            "Faces that were turned over (list of int).")
        .def_property_readonly(
            "turned_shells", [](const MendReport& r) { return r.turned_shells; },
            "How many shells were turned over.")
        .def_property_readonly(
            "cut_faces", [](const MendReport& r) { return r.cut_faces; },
            "Faces that were cut into triangles, since an edge was divided (list of int).")
        .def_property_readonly(
            "degenerate_faces", [](const MendReport& r) { return r.degenerate_faces; },
            "Faces without area that were left out (list of int).")
        .def_property_readonly(
            "duplicate_faces", [](const MendReport& r) { return r.duplicate_faces; },
            "Faces with the corners of others that were left out (list of int).")
        .def_property_readonly(
            "duplicates_left", [](const MendReport& r) { return r.duplicates_left; },
            "Pairs of opposite faces with the same corners that were left.")
        .def_property_readonly(
            "filled_holes", [](const MendReport& r) { return r.filled_holes; },
            "How many holes got a face.")
        .def_property_readonly(
            "max_move", [](const MendReport& r) { return r.max_move; },
            "The farthest that a vertex moved.")
        .def_property_readonly(
            "max_gap", [](const MendReport& r) { return r.max_gap; },
            "The largest distance between an edge and a vertex that was put into it.")
        .def_property_readonly(
            "misoriented_edges", [](const MendReport& r) { return r.misoriented_edges; },
            "Edges of an even number of faces that do not run along it as often each way.")
        .def_property_readonly("is_closed", &MendReport::is_closed,
                               "Whether the boundary closes now.")
        .def_property_readonly(
            "rounding", [](const MendReport& r) { return r.lattice; },
            "The `Rounding` of coordinates that span too many bits.")
        .def("__bool__", &MendReport::changed, "Whether anything changed.")
        .def("__repr__", [](const MendReport& r) {
            return std::string("<MendReport: ") + (r.changed() ? "mended" : "nothing mended") +
                   (r.is_closed() ? ", closed>" : ", not closed>");
        });
    bind_lists(report);
}

void bind_mesh(py::module_& m) {
    py::class_<MendedMesh>(m, "MendedMesh", "What `mend` returns.")
        .def_property_readonly(
            "vertices",
            [](const MendedMesh& x) { return to_array(std::vector<Point3d>(x.mesh.points)); },
            "Array of shape (n, 3): coordinates that were given, to the bit.")
        .def_property_readonly(
            "faces", [](const MendedMesh& x) { return faces_of(x.mesh); },
            "Array of shape (m, k) where all faces have k corners, otherwise a list of lists.")
        .def_property_readonly(
            "source_faces",
            [](const MendedMesh& x) {
                return list_of(x.source_of_face,
                               [](std::uint32_t f) { return py::cast(name_of_face(f)); });
            },
            "Of each face the one that it was, or None for one that was added.")
        .def_property_readonly(
            "source_vertices", [](const MendedMesh& x) { return x.source_of_point; },
            "Of each vertex the one that it was (list of int).")
        .def_property_readonly(
            "report", [](const MendedMesh& x) { return x.report; }, "`MendReport`");
}

}  // namespace

void bind_mend(py::module_& m) {
    bind_open(m);
    bind_report(m);
    bind_mesh(m);
    m.def(
        "mend",
        [](const py::object& vertices, const py::object& faces, bool orient, bool shells,
           const std::string& inner, std::optional<double> seams, bool drop, bool fill) {
            const PolygonMesh mesh =
                faces.is_none() ? mesh_of_pair(vertices, "mend") : mesh_of(vertices, faces);
            MendOptions options;
            options.orient_faces = orient;
            options.orient_shells = shells;
            options.inner_shells = inner_of(inner);
            options.seams = seams;
            options.drop_duplicates = drop;
            options.fill_planar_holes = fill;
            return run([&] { return mended(mesh, options); });
        },
        py::arg("vertices"), py::arg("faces") = py::none(), py::kw_only(),
        py::arg("orient") = false, py::arg("shells") = false, py::arg("inner") = "cavities",
        py::arg("seams") = py::none(), py::arg("drop") = false, py::arg("fill") = false,
        R"(Mends a mesh that bounds no solid, in the ways that are asked for and no other.

Decisions are exact, and everything that was touched is in the report. `check` says whether the
outcome bounds a solid.

Parameters
----------
vertices : array_like, shape (n, 3)
    Or a pair (vertices, faces), or an object that has both as attributes.
faces : array_like, shape (m, 3) or (m, k), or sequence of sequences
    Indices of vertices.
orient : bool
    Turn faces over so that each edge of two faces is used once each way.
shells : bool
    Turn closed shells over so that each bounds its inside, or as `inner` says.
inner : {'cavities', 'material'}
    What a shell within another one bounds.
seams : float, optional
    Join vertices of open edges up to this distance, nearest first, and put them into open edges
    that are as near. 0 puts in those that are exactly on edges.
drop : bool
    Leave out faces with the corners of others.
fill : bool
    Add a face where open edges form a simple loop in a plane, exactly.

Returns
-------
MendedMesh
)");
}

}  // namespace trisect::python

// SPDX-License-Identifier: Apache-2.0

#include <filesystem>
#include <optional>
#include <string>

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <trisect/brep/io/read_mesh.h>
#include <trisect/brep/io/write_mesh.h>
#include <trisect/bsp/native_file.h>
#include <trisect/bsp/solid.h>

#include "arrays.h"
#include "bind.h"
#include "embedding.h"
#include "run.h"
#include "solids.h"

namespace trisect::python {

namespace {

std::optional<MeshFormat> format_of(const std::optional<std::string>& name) {
    if (!name) return std::nullopt;
    const auto format = mesh_format_from_name(*name);
    if (!format)
        throw UsageError(
            "format: '" + *name +
            "' is none of obj, stl, stl-ascii, stl-binary, off, ply, 3mf, glb, amf, step and dxf");
    return format;
}

bool has_triangles_only(const PolygonMesh& mesh) {
    for (std::size_t f = 0; f < mesh.face_count(); ++f)
        if (mesh.face(f).size() != 3) return false;
    return true;
}

py::object face_arrays(PolygonMesh&& mesh) {
    if (has_triangles_only(mesh)) return to_array(std::move(mesh.corners));
    py::list faces;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        const auto loop = mesh.face(f);
        py::array_t<std::int32_t> face(static_cast<py::ssize_t>(loop.size()));
        for (std::size_t i = 0; i < loop.size(); ++i)
            face.mutable_data()[i] = static_cast<std::int32_t>(loop[i]);
        faces.append(face);
    }
    return faces;
}

// Native files are for solids only: a mesh has no tree.
bool is_native_file(const std::filesystem::path& path, const std::optional<std::string>& format) {
    return format ? *format == "trisect" : path.extension() == ".trisect";
}

Solid read_solid(const std::filesystem::path& path, const std::string& embedding,
                 const std::optional<std::string>& format) {
    SolidOptions options;
    options.embedding = embedding_of(embedding);
    if (is_native_file(path, format)) return solid_of(run([&] { return NativeFile::open(path); }));
    const ReadOptions reading{format_of(format), {}};
    const PolygonMesh mesh = run([&] { return read_mesh(path, reading); });
    return import_solid(mesh, options);
}

void write_solid(const Solid& solid, const std::filesystem::path& path,
                 const std::optional<std::string>& format) {
    if (is_native_file(path, format)) {
        run_on_threads([&](std::uint32_t threads) {
            NativeWriteOptions options;
            options.threads = threads;
            write_native(solid, path, options);
        });
        return;
    }
    const WriteOptions writing{format_of(format), PlyEncoding::BinaryLittleEndian};
    run_on_threads(
        [&](std::uint32_t threads) { write_mesh(path, solid.to_mesh(threads), writing); });
}

}  // namespace

void bind_files(py::module_& m) {
    py::class_<Solid> c = solid_class(m);
    c.def_static(
        "read", &read_solid, py::arg("path"), py::kw_only(), py::arg("embedding") = "check",
        py::arg("format") = py::none(),
        R"(The solid of an OBJ, STL, OFF, PLY, 3MF, GLB, AMF, STEP or DXF file, or of a native one (``.trisect``).

Parameters
----------
path : path_like
embedding : {'check', 'assume', 'resolve'}
    See `Solid`; meshes are checked by default.
format : {'obj', 'stl', 'stl-ascii', 'stl-binary', 'off', 'ply', '3mf', 'glb', 'amf', 'step', 'dxf', 'trisect'}, optional
    By default the extension decides, else the content.

Raises
------
InputError
    With line and column or byte, for a file that cannot be read.
InvalidSolid
    When it bounds no solid.
)");
    c.def(
        "write", &write_solid, py::arg("path"), py::kw_only(), py::arg("format") = py::none(),
        R"(Writes the triangles of `mesh` to an OBJ, STL, OFF, PLY, 3MF, GLB, AMF or STEP file, or the solid to a native one.

A native file (``.trisect``) has the solid to the last bit, with its tree and the names of its faces.
)");
    m.def(
        "read_mesh",
        [](const std::filesystem::path& path, const std::optional<std::string>& format) {
            const ReadOptions reading{format_of(format), {}};
            PolygonMesh mesh = run([&] { return read_mesh(path, reading); });
            py::object vertices = to_array(std::move(mesh.points));
            return py::make_tuple(vertices, face_arrays(std::move(mesh)));
        },
        py::arg("path"), py::kw_only(), py::arg("format") = py::none(),
        R"(Vertices and faces of a mesh file, as they are in it.

Returns
-------
vertices : ndarray, shape (n, 3)
faces : ndarray, shape (m, 3), or list of ndarray where not all are triangles
)");
    m.def(
        "write_mesh",
        [](const std::filesystem::path& path, const py::object& vertices, const py::object& faces,
           const std::optional<std::string>& format) {
            const PolygonMesh mesh = mesh_of(vertices, faces);
            const WriteOptions writing{format_of(format), PlyEncoding::BinaryLittleEndian};
            run([&] { write_mesh(path, mesh, writing); });
        },
        py::arg("path"), py::arg("vertices"), py::arg("faces"), py::kw_only(),
        py::arg("format") = py::none(), "Writes vertices and faces to a mesh file.");
}

}  // namespace trisect::python

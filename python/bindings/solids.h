// SPDX-License-Identifier: Apache-2.0
//
// Functions for solids that several parts of the module use.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <pybind11/pybind11.h>

#include <trisect/brep/polygon_mesh.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/native_file.h>
#include <trisect/bsp/solid.h>

namespace trisect::python {

namespace py = pybind11;

/// The class Solid, to which each part adds its own methods.
[[nodiscard]] py::class_<Solid> solid_class(const py::module_& m);

/// A solid of a mesh. \throw as Solid::from_mesh; UsageError that names a vertex that is not finite
[[nodiscard]] Solid import_solid(const PolygonMesh& mesh, const SolidOptions& options);

/// The same of what Python gave. Arrays of doubles and of indices of 32 bits are read where they
/// are. \throw as above; py::type_error, UsageError that name the argument and the place
[[nodiscard]] Solid import_solid(const py::object& vertices, const py::object& faces,
                                 const SolidOptions& options);

/// Under the limits of this thread.
[[nodiscard]] Solid evaluated(const Expression& formula, EvaluateOptions::Winding winding =
                                                             EvaluateOptions::Winding::Positive);

/// The boundary as exact text; of a complement, that of the set itself.
[[nodiscard]] std::string exact_boundary_text(const Solid& solid);

/// What a native file of it holds.
[[nodiscard]] std::string native_bytes_of(const Solid& solid);
/// Its faces name operands by numbers that nothing else in this process has: the file may come from
/// another one. \throw InputError with the place of what is damaged
[[nodiscard]] Solid solid_of(const NativeFile& file);

}  // namespace trisect::python

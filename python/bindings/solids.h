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

/// A boundary as exact text, and whether the solid is the complement of what it bounds.
struct ExactState {
    std::string text;
    bool is_complement = false;
};
[[nodiscard]] ExactState exact_state(const Solid& solid);
/// \throw as read_exact and Solid::from_brep
[[nodiscard]] Solid solid_of(const ExactState& state);

}  // namespace trisect::python

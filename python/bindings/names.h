// SPDX-License-Identifier: Apache-2.0
//
// Names of faces and corners of operands, as Python sees them.
#pragma once

#include <pybind11/pybind11.h>

#include <trisect/brep/brep.h>
#include <trisect/bsp/brep_index.h>
#include <trisect/bsp/interference/solid_interference.h>

namespace trisect::python {

namespace py = pybind11;

/// (operand, face)
[[nodiscard]] py::tuple to_tuple(const FaceSource& face);
/// Those of the first `face_count` faces that are set.
[[nodiscard]] py::tuple faces_of(const Place& place);
[[nodiscard]] py::tuple faces_of(const EntityName& name);
/// (operand, corner), or None
[[nodiscard]] py::object to_object(const CornerSource& corner);

}  // namespace trisect::python

// SPDX-License-Identifier: Apache-2.0
//
// Poses and affine maps from what Python callers have.
#pragma once

#include <pybind11/pybind11.h>

#include <trisect/brep/transform.h>
#include <trisect/kernel/pose.h>

namespace trisect::python {

namespace py = pybind11;

/// None (the identity), a Pose, or a matrix of shape (3, 4) or (4, 4). `what` names it in errors.
/// \throw py::type_error, UsageError
[[nodiscard]] Pose pose_of(const py::object& pose, const char* what);

/// A matrix of shape (3, 3), (3, 4) or (4, 4). \throw as above
[[nodiscard]] AffineMap affine_map_of(const py::object& matrix, const char* what);

}  // namespace trisect::python

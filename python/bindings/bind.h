// SPDX-License-Identifier: Apache-2.0
//
// The parts of the Python module, one function a subject.
#pragma once

#include <pybind11/pybind11.h>

namespace trisect::python {

namespace py = pybind11;

void bind_errors(py::module_& m);
void bind_limits(py::module_& m);
void bind_check(py::module_& m);
void bind_mend(py::module_& m);
void bind_pose(py::module_& m);
void bind_solid_type(py::module_& m);
void bind_formula(py::module_& m);
void bind_edited(py::module_& m);
void bind_measures(py::module_& m);
void bind_transforms(py::module_& m);
void bind_primitives(py::module_& m);
void bind_sweeps(py::module_& m);
void bind_fields(py::module_& m);
void bind_modelling(py::module_& m);
void bind_slices(py::module_& m);
void bind_files(py::module_& m);
void bind_queries(py::module_& m);
void bind_interference(py::module_& m);
void bind_regions(py::module_& m);
void bind_motion(py::module_& m);
void bind_enclosed(py::module_& m);
void bind_certificates(py::module_& m);
void bind_scene(py::module_& m);
void bind_verify(py::module_& m);
void bind_certified_mesh(py::module_& m);

}  // namespace trisect::python

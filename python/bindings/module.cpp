// SPDX-License-Identifier: Apache-2.0

#include "bind.h"

PYBIND11_MODULE(_trisect, m) {
    using namespace trisect::python;
    m.doc() = "Exact solid modelling: the compiled part of the package trisect.";
    m.attr("__version__") = TRISECT_VERSION;
    // Signatures with C++ types in them say nothing to a Python user; the docstrings have their
    // own.
    pybind11::options options;
    options.disable_function_signatures();
    bind_errors(m);
    bind_limits(m);
    bind_check(m);
    bind_mend(m);
    bind_pose(m);
    bind_solid_type(m);
    bind_formula(m);
    bind_edited(m);
    bind_measures(m);
    bind_transforms(m);
    bind_primitives(m);
    bind_sweeps(m);
    bind_fields(m);
    bind_modelling(m);
    bind_files(m);
    bind_queries(m);
    bind_slices(m);
    bind_interference(m);
    bind_regions(m);
    bind_motion(m);
    bind_enclosed(m);
    bind_certificates(m);
    bind_scene(m);
    bind_verify(m);
    bind_certified_mesh(m);
}

// SPDX-License-Identifier: Apache-2.0
//
// Solids made of solids: hulls, Minkowski sums, projections, offsets, and programs of OpenSCAD.

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <pybind11/stl.h>

#include <trisect/bsp/csg/csg_evaluate.h>
#include <trisect/bsp/csg/json/csg_json.h>
#include <trisect/bsp/modelling/hull_of_solids.h>
#include <trisect/bsp/modelling/minkowski.h>
#include <trisect/bsp/modelling/offset.h>
#include <trisect/bsp/modelling/offset_of_solid.h>
#include <trisect/bsp/modelling/projection.h>

#include "bind.h"
#include "run.h"
#include "solids.h"

namespace trisect::python {

namespace {

OffsetOptions::Corners corners_of(const std::string& word) {
    if (word == "round") return OffsetOptions::Corners::Round;
    if (word == "miter") return OffsetOptions::Corners::Miter;
    if (word == "chamfer") return OffsetOptions::Corners::Chamfer;
    if (word == "bevel") return OffsetOptions::Corners::Bevel;
    throw UsageError("corners: must be 'round', 'miter', 'chamfer' or 'bevel', not '" + word + "'");
}

void bind_hulls(py::class_<Solid>& c) {
    c.def(
        "convex_hull",
        [](const Solid& s, const py::args& others) {
            std::vector<Solid> all{s};
            for (const py::handle other : others) all.push_back(other.cast<const Solid&>());
            return run([&] { return hull(all); });
        },
        R"(The convex hull of this solid and others together.

Exact over corners that are doubles; others are rounded first, once.
)");
    c.def(
        "minkowski_sum",
        [](const Solid& a, const Solid& b) {
            return run_on_threads([&](std::uint32_t threads) {
                MinkowskiOptions options;
                options.evaluate.threads = threads;
                return minkowski_sum(a, b, options);
            });
        },
        py::arg("other"), R"(All sums of a point of this solid and a point of another one.

Of convex solids the hull of the sums of corners, else the union of many convex pieces. Exact where
corners and their sums are doubles.
)");
    c.def(
        "minkowski_difference",
        [](const Solid& a, const Solid& b) {
            return run_on_threads([&](std::uint32_t threads) {
                MinkowskiOptions options;
                options.evaluate.threads = threads;
                return minkowski_difference(a, b, options);
            });
        },
        py::arg("other"), "All points to which the other solid can be moved within this one.");
}

SolidOffsetOptions::Shape shape_of(const std::string& word) {
    if (word == "ball") return SolidOffsetOptions::Shape::Ball;
    if (word == "cube") return SolidOffsetOptions::Shape::Cube;
    if (word == "octahedron") return SolidOffsetOptions::Shape::Octahedron;
    throw UsageError("shape: must be 'ball', 'cube', 'octahedron' or a Solid, not '" + word + "'");
}

void bind_grow(py::class_<Solid>& c) {
    c.def(
        "grow",
        [](const Solid& s, double distance, const py::object& shape, std::uint32_t subdivisions,
           bool around) {
            SolidOffsetOptions options;
            options.subdivisions = subdivisions;
            if (around) options.fit = SolidOffsetOptions::Fit::Around;
            if (py::isinstance<Solid>(shape)) {
                const Solid tool = shape.cast<const Solid&>();
                return run_on_threads([&](std::uint32_t threads) {
                    options.minkowski.evaluate.threads = threads;
                    return offset_of_solid(s, distance, tool, options.minkowski);
                });
            }
            options.shape = shape_of(shape.cast<std::string>());
            return run_on_threads([&](std::uint32_t threads) {
                options.minkowski.evaluate.threads = threads;
                return offset_of_solid(s, distance, options);
            });
        },
        py::arg("distance"), py::kw_only(), py::arg("shape") = "ball", py::arg("subdivisions") = 1,
        py::arg("around") = false, R"(The solid grown by a distance, or shrunk by less than 0.

The Minkowski sum, or difference, with a polyhedron. It stands for a ball: with 0 to 3 subdivisions
its faces are as far from its centre as 0.79, 0.93, 0.98 and 0.995 of the distance.

Parameters
----------
distance : float
shape : {'ball', 'cube', 'octahedron'} or Solid
    Another solid takes the place of a ball of radius 1.
subdivisions : int
around : bool
    Whether the ball is within the polyhedron, in place of around it.
)");
}

void bind_plane(py::class_<Solid>& c) {
    c.def(
        "project",
        [](const Solid& s, std::optional<double> cut) {
            return run_on_threads([&](std::uint32_t threads) {
                EvaluateOptions options;
                options.threads = threads;
                return cut ? solid_of_region(section(s, *cut, options)) : shadow(s, options);
            });
        },
        py::kw_only(), py::arg("cut") = py::none(),
        R"(What the solid covers seen from above, as the prism over it between z = 0 and z = 1.

Parameters
----------
cut : float or None
    A height: the section there takes the place of the shadow.
)");
    c.def(
        "offset",
        [](const Solid& s, double distance, const std::string& corners, std::uint32_t segments,
           double miter_limit) {
            return run_on_threads([&](std::uint32_t threads) {
                OffsetOptions options;
                options.corners = corners_of(corners);
                options.segments = segments;
                options.miter_limit = miter_limit;
                options.evaluate.threads = threads;
                return offset_of_region(s, distance, options);
            });
        },
        py::arg("distance"), py::kw_only(), py::arg("corners") = "round", py::arg("segments") = 32,
        py::arg("miter_limit") = std::numeric_limits<double>::infinity(),
        R"(A region of the plane, as a prism between z = 0 and z = 1, grown, or shrunk by less than 0.

Parameters
----------
distance : float
corners : {'round', 'miter', 'chamfer', 'bevel'}
    Arcs; edges go on until they meet; a cut as far from the corner as the edges are; a cut between their ends.
segments : int
    Of a whole circle.
miter_limit : float
    Where edges would meet farther from the corner than so many times the distance, there is a chamfer.
)");
}

void bind_programs(py::class_<Solid>& c) {
    c.def_static(
        "from_csg",
        [](const std::string& text, const std::optional<std::string>& folder,
           const std::string& format) {
            if (format != "csg" && format != "json")
                throw UsageError("format: '" + format + "' is none of csg, json");
            return run_on_threads([&](std::uint32_t threads) {
                CsgOptions options;
                options.evaluate.threads = threads;
                options.reads_files = folder.has_value();
                if (folder) options.folder = *folder;
                return evaluate_csg(
                    format == "json" ? parse_csg_json(text, "text") : parse_csg(text, "text"),
                    options);
            });
        },
        py::arg("text"), py::kw_only(), py::arg("folder") = py::none(), py::arg("format") = "csg",
        R"(The solid of a program in OpenSCAD's evaluated form, or in JSON.

Parameters
----------
text : str
folder : str or None
    Where names of files that the program reads start; without it such programs are refused.
format : {'csg', 'json'}
)");
}

}  // namespace

void bind_modelling(py::module_& m) {
    py::class_<Solid> c = solid_class(m);
    bind_hulls(c);
    bind_grow(c);
    bind_plane(c);
    bind_programs(c);
}

}  // namespace trisect::python

// SPDX-License-Identifier: Apache-2.0

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <pybind11/stl.h>

#include <trisect/brep/primitives/box.h>
#include <trisect/brep/primitives/cone.h>
#include <trisect/brep/primitives/cylinder.h>
#include <trisect/brep/primitives/hull.h>
#include <trisect/brep/primitives/sphere.h>
#include <trisect/brep/primitives/torus.h>

#include "arrays.h"
#include "bind.h"
#include "run.h"
#include "solids.h"

namespace trisect::python {

namespace {

Solid solid_of_mesh(const PolygonMesh& mesh) { return import_solid(mesh, {}); }

void bind_flat(py::class_<Solid>& c) {
    c.def_static(
        "box",
        [](const py::object& low, const py::object& high) {
            if (high.is_none()) return solid_of_mesh(make_box(point_of(low, "size")));
            return solid_of_mesh(make_box(point_of(low, "low"), point_of(high, "high")));
        },
        py::arg("low"), py::arg("high") = py::none(), R"(The box between two corners.

Parameters
----------
low, high : array_like, shape (3,)
    ``box(size)`` has one corner at the origin.
)");
}

void bind_hull(py::class_<Solid>& c) {
    c.def_static(
        "hull",
        [](const py::object& points) {
            const auto rows = points_array(points, "points");
            const auto count = static_cast<std::size_t>(rows.size()) / 3;
            const std::span<const Point3d> list(reinterpret_cast<const Point3d*>(rows.data()),
                                                count);
            require_finite(list);
            try {
                return solid_of_mesh(run([&] { return make_hull(list); }));
            } catch (const UsageError& error) {
                throw UsageError(std::string("points: ") + error.what());
            }
        },
        py::arg("points"), R"(The convex hull of points, exactly.

Also what a convex solid sweeps over on a straight way: the hull of its vertices at both ends.

Parameters
----------
points : array_like, shape (n, 3)
    Not all in one plane.
)");
}

void bind_round(py::class_<Solid>& c) {
    c.def_static(
        "cylinder",
        [](double radius, double height, std::uint32_t segments) {
            return solid_of_mesh(make_cylinder(radius, height, segments));
        },
        py::arg("radius"), py::arg("height"), py::arg("segments") = 64,
        "A cylinder about z from z = 0 upwards; its corners lie on the circle.");
    c.def_static(
        "cone",
        [](double bottom_radius, double top_radius, double height, std::uint32_t segments) {
            return solid_of_mesh(make_cone(bottom_radius, top_radius, height, segments));
        },
        py::arg("bottom_radius"), py::arg("top_radius"), py::arg("height"),
        py::arg("segments") = 64, "A cone or frustum about z from z = 0 upwards.");
    c.def_static(
        "sphere",
        [](double radius, std::uint32_t subdivisions) {
            return solid_of_mesh(make_icosphere(radius, subdivisions));
        },
        py::arg("radius"), py::arg("subdivisions") = 4,
        "A polyhedron of 20 * 4**subdivisions triangles with its corners on a sphere.");
    c.def_static(
        "uv_sphere",
        [](double radius, std::uint32_t slices, std::uint32_t stacks) {
            return solid_of_mesh(make_uv_sphere(radius, slices, stacks));
        },
        py::arg("radius"), py::arg("slices") = 64, py::arg("stacks") = 32,
        "A sphere of triangles between circles of latitude.");
    c.def_static(
        "torus",
        [](double major_radius, double minor_radius, std::uint32_t major_segments,
           std::uint32_t minor_segments) {
            return solid_of_mesh(
                make_torus(major_radius, minor_radius, major_segments, minor_segments));
        },
        py::arg("major_radius"), py::arg("minor_radius"), py::arg("major_segments") = 64,
        py::arg("minor_segments") = 32, "A torus about z.");
}

}  // namespace

void bind_primitives(py::module_& m) {
    py::class_<Solid> c = solid_class(m);
    bind_flat(c);
    bind_hull(c);
    bind_round(c);
}

}  // namespace trisect::python

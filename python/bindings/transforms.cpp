// SPDX-License-Identifier: Apache-2.0
//
// Moved solids, and solids in two parts.

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <trisect/brep/transform.h>
#include <trisect/bsp/expression.h>
#include <trisect/bsp/modelling/mirrored.h>
#include <trisect/bsp/modelling/resized.h>
#include <trisect/bsp/solid_transform.h>
#include <trisect/bsp/split.h>

#include "arrays.h"
#include "bind.h"
#include "poses.h"
#include "run.h"
#include "solids.h"

namespace trisect::python {

namespace {

int axis_of(const py::object& axis) {
    if (py::isinstance<py::str>(axis)) {
        const auto word = axis.cast<std::string>();
        if (word == "x" || word == "y" || word == "z") return word[0] - 'x';
    } else if (py::isinstance<py::int_>(axis)) {
        const auto number = axis.cast<long>();
        if (number >= 0 && number <= 2) return static_cast<int>(number);
    }
    throw UsageError("axis: must be 'x', 'y' or 'z'");
}

Point3d direction_of(const py::object& axis) {
    if (!py::isinstance<py::str>(axis)) return point_of(axis, "axis");
    Point3d direction{};
    direction[static_cast<std::size_t>(axis_of(axis))] = 1;
    return direction;
}

Solid moved(const Solid& s, const AffineMap& map) {
    return run([&] { return transformed(s, map); });
}

void bind_rounding(py::module_& m) {
    py::class_<LatticeReport>(m, "Rounding", "What a transform or an import rounded.")
        .def_readonly("lossless", &LatticeReport::lossless, "Whether nothing moved.")
        .def_readonly("moved", &LatticeReport::moved, "Vertices with a rounded coordinate.")
        .def_readonly("max_move", &LatticeReport::max_move, "The largest change of a coordinate.")
        .def_readonly("flipped_faces", &LatticeReport::flipped_faces,
                      "Faces that were turned over or became flat.")
        .def(py::pickle(
            [](const LatticeReport& r) {
                return py::make_tuple(r.lattice.exponent, r.lossless, r.moved, r.max_move,
                                      r.flipped_faces);
            },
            [](const py::tuple& t) {
                return LatticeReport{Lattice{t[0].cast<int>()}, t[1].cast<bool>(),
                                     t[2].cast<std::size_t>(), t[3].cast<double>(),
                                     t[4].cast<std::size_t>()};
            }))
        .def("__repr__", [](const LatticeReport& r) {
            if (r.lossless) return std::string("<Rounding: none>");
            return "<Rounding: " + std::to_string(r.moved) + " vertices moved>";
        });
}

// One factor for all axes, or one for each.
Point3d factors_of(const py::object& factor) {
    const bool is_list = py::isinstance<py::array>(factor) || PySequence_Check(factor.ptr());
    if (is_list || PyNumber_Check(factor.ptr()) == 0) return point_of(factor, "factor");
    Point3d factors{};
    factors.fill(py::float_(factor).cast<double>());
    return factors;
}

template <class Map>
py::object under(const Solid& solid, const Map& map, bool report) {
    LatticeReport rounding;
    Solid result = run([&] { return transformed(solid, map, &rounding); });
    if (!report) return py::cast(std::move(result));
    return py::make_tuple(std::move(result), rounding);
}

void bind_motions(py::class_<Solid>& c) {
    c.def(
        "translate",
        [](const Solid& s, const py::object& by) {
            return moved(s, AffineMap::translation(point_of(by, "by")));
        },
        py::arg("by"), R"(The solid moved by a vector.

Exact where the vector is a multiple of the unit of coordinates or the unit can become finer;
otherwise the vector as a whole is rounded, by less than half a unit.
)");
    c.def(
        "rotate",
        [](const Solid& s, const py::object& axis, double degrees) {
            return moved(s, AffineMap::rotation(direction_of(axis), degrees));
        },
        py::arg("axis"), py::arg("degrees"), R"(The solid turned about an axis through the origin.

Quarter turns about coordinate axes are exact; otherwise each vertex is rounded once.

Parameters
----------
axis : {'x', 'y', 'z'} or array_like, shape (3,)
degrees : float
    Counter-clockwise seen from the tip of the axis.
)");
}

void bind_scalings(py::class_<Solid>& c) {
    c.def(
        "scale",
        [](const Solid& s, const py::object& factor) {
            return moved(s, AffineMap::scaling(factors_of(factor)));
        },
        py::arg("factor"), R"(The solid scaled from the origin.

Parameters
----------
factor : float or array_like, shape (3,)
)");
    c.def(
        "mirror",
        [](const Solid& s, const py::object& axis) {
            if (py::isinstance<py::array>(axis) || PySequence_Check(axis.ptr()) != 0)
                if (!py::isinstance<py::str>(axis)) {
                    const Point3d normal = point_of(axis, "axis");
                    return run([&] { return mirrored(s, normal); });
                }
            return moved(s, AffineMap::mirror(axis_of(axis)));
        },
        py::arg("axis"),
        R"(The solid mirrored in a plane through the origin.

Exact in coordinate planes and between two axes; otherwise each vertex is rounded once.

Parameters
----------
axis : {'x', 'y', 'z'} or array_like, shape (3,)
    The normal of the plane, of any length.
)");
    c.def(
        "resize",
        [](const Solid& s, const py::object& size, const py::object& follow) {
            const Point3d sizes = point_of(size, "size");
            std::array<bool, 3> follows{};
            if (py::isinstance<py::bool_>(follow))
                follows.fill(follow.cast<bool>());
            else
                follows = follow.cast<std::array<bool, 3>>();
            return run([&] { return resized(s, sizes, follows); });
        },
        py::arg("size"), py::kw_only(), py::arg("follow") = false,
        R"(The solid scaled from the origin to a size, to within rounding.

Parameters
----------
size : array_like, shape (3,)
    Of its bounds. 0 leaves an axis as it is.
follow : bool or tuple of three
    Axes of size 0 that take the factor of the axis with the largest new size.
)");
}

void bind_transform(py::class_<Solid>& c) {
    c.def(
        "transform",
        [](const Solid& s, const py::object& map, bool report) {
            if (py::isinstance<Pose>(map)) return under(s, map.cast<const Pose&>(), report);
            return under(s, affine_map_of(map, "map"), report);
        },
        py::arg("map"), py::kw_only(), py::arg("report") = false,
        R"(The solid under an affine map.

Maps that keep the lattice (quarter turns, mirrors, translations by its unit) are exact; of
others each vertex is rounded once. To compare moving solids use `interfere` with poses: there
nothing is rounded.

Parameters
----------
map : Pose or array_like, shape (3, 3), (3, 4) or (4, 4)
report : bool
    Also return what was rounded, a `Rounding`.

Raises
------
UsageError
    For a singular matrix.
)");
}

// The parts of a solid inside and outside of another set.
std::pair<Solid, Solid> parts(const Solid& s, const Solid& cutter) {
    SplitSolid out = run_on_threads([&](std::uint32_t threads) {
        EvaluateOptions options;
        options.threads = threads;
        return split(s, cutter, options);
    });
    return {std::move(out.common), std::move(out.rest)};
}

py::list slabs(const Solid& s, const py::iterable& planes) {
    std::vector<std::array<double, 4>> all;
    for (const py::handle plane : planes) {
        const std::vector<double> v =
            numbers_of(py::reinterpret_borrow<py::object>(plane), 4, "planes");
        all.push_back({v[0], v[1], v[2], v[3]});
    }
    py::list out;
    for (Solid& part : run_on_threads([&](std::uint32_t threads) {
             EvaluateOptions options;
             options.threads = threads;
             return split(s, all, options);
         }))
        out.append(py::cast(std::move(part)));
    return out;
}

void bind_split(py::class_<Solid>& c) {
    c.def(
        "split",
        [](const Solid& s, const py::object& cutter) {
            if (py::isinstance<Solid>(cutter)) return parts(s, cutter.cast<const Solid&>());
            const std::vector<double> v = numbers_of(cutter, 4, "cutter");
            return parts(s, Solid::half_space({v[0], v[1], v[2], v[3]}));
        },
        py::arg("cutter"), R"(Two parts: inside and outside of a solid, or below and above a plane.

Parameters
----------
cutter : Solid or array_like, shape (4,)
    Coefficients of the plane a x + b y + c z + d = 0; below is where this is negative.

Returns
-------
tuple of Solid
    Their union is this solid and they share no volume. Both come from one evaluation where that is
    possible, and are what ``solid & cutter`` and ``solid - cutter`` are.
)");
    c.def("split_by_planes", &slabs, py::arg("planes"),
          R"(The parts between planes: one more than there are planes.

Parameters
----------
planes : sequence of array_like, shape (4,)
    Coefficients (a, b, c, d) of each plane, at most 65536 of them.

Returns
-------
list of Solid
    What is below each plane and not below one before it, and last what is above all. Parallel planes
    in ascending order give slabs, of a mesh in one pass. Parts may be empty.
)");
    c.def(
        "trim",
        [](const Solid& s, const py::object& plane) {
            const std::vector<double> v = numbers_of(plane, 4, "plane");
            return evaluated(s - Solid::half_space({v[0], v[1], v[2], v[3]}));
        },
        py::arg("plane"), R"(The part on the side of a plane to which its normal points. Exact.

Parameters
----------
plane : array_like, shape (4,)
    Coefficients; the part has a x + b y + c z + d >= 0.
)");
}

}  // namespace

void bind_transforms(py::module_& m) {
    bind_rounding(m);
    py::class_<Solid> c = solid_class(m);
    bind_motions(c);
    bind_scalings(c);
    bind_transform(c);
    bind_split(c);
}

}  // namespace trisect::python

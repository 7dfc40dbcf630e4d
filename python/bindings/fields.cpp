// SPDX-License-Identifier: Apache-2.0
//
// Solids of functions and of heights.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include <pybind11/stl.h>

#include <trisect/brep/primitives/height_field.h>
#include <trisect/bsp/modelling/level_set.h>

#include "arrays.h"
#include "bind.h"
#include "run.h"
#include "solids.h"

namespace trisect::python {

namespace {

using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// Takes the lock for each call. The places are a copy, which the function may keep.
class PythonFunction {
public:
    explicit PythonFunction(py::object function) : function_(std::move(function)) {}

    void operator()(std::span<const Point3d> places, std::span<double> values) const {
        const py::gil_scoped_acquire lock;
        const auto count = static_cast<py::ssize_t>(places.size());
        py::array_t<double> rows({count, py::ssize_t{3}});
        std::copy_n(reinterpret_cast<const double*>(places.data()), 3 * places.size(),
                    rows.mutable_data());
        const Doubles results = Doubles::ensure(function_(rows));
        if (!results) {
            PyErr_Clear();
            throw UsageError("function: must return numbers");
        }
        if (results.ndim() != 1 || results.size() != count)
            throw UsageError("function: must return an array of shape (n,) for one of (n, 3)");
        std::copy_n(results.data(), values.size(), values.data());
    }

private:
    py::object function_;
};

Solid level_set_of(const py::object& function, const py::object& low, const py::object& high,
                   double edge_length, const LevelSetOptions& options) {
    if (PyCallable_Check(function.ptr()) == 0) throw py::type_error("function: must be callable");
    const Bounds box{point_of(low, "low"), point_of(high, "high")};
    const PythonFunction call(function);
    // Copies of a function that holds an object would need the lock.
    return run([&] {
        return level_set_by_batches([&](std::span<const Point3d> places,
                                        std::span<double> values) { call(places, values); },
                                    box, edge_length, options);
    });
}

void bind_level_set(py::class_<Solid>& c) {
    c.def_static(
        "level_set",
        [](const py::object& function, const py::object& low, const py::object& high,
           double edge_length, double level, std::uint32_t root_steps, std::uint64_t max_cells) {
            LevelSetOptions options;
            options.level = level;
            options.root_steps = root_steps;
            options.most_cells = max_cells;
            return level_set_of(function, low, high, edge_length, options);
        },
        py::arg("function"), py::arg("low"), py::arg("high"), py::arg("edge_length"), py::kw_only(),
        py::arg("level") = 0.0, py::arg("root_steps") = 0,
        py::arg("max_cells") = LevelSetOptions().most_cells,
        R"(Where a function of space is above a level, within a box.

By marching tetrahedra. The boundary is closed and does not touch itself, whatever the function is;
what is outside the box, or at the level, counts as outside.

Parameters
----------
function : callable
    Takes points, an array of shape (n, 3), and returns n numbers. n is some thousand at most.
low, high : array_like, shape (3,)
    Corners of the box.
edge_length : float
    Of the grid's cells, at most.
level : float
root_steps : int
    Calls for each edge of the grid that crosses the surface, to find where.
max_cells : int
    More are refused, with a `LimitError`.

Raises
------
UsageError
    For values that are not finite, with the place.
)");
}

void bind_height_field(py::class_<Solid>& c) {
    c.def_static(
        "height_field",
        [](const py::object& heights, double base, const py::object& spacing,
           const py::object& origin) {
            const Doubles rows = Doubles::ensure(heights);
            if (!rows) {
                PyErr_Clear();
                throw py::type_error("heights: must be an array of numbers");
            }
            if (rows.ndim() != 2) throw UsageError("heights: must have shape (rows, columns)");
            const auto steps = numbers_of(spacing, 2, "spacing");
            const auto first = numbers_of(origin, 2, "origin");
            const HeightGrid grid{{rows.data(), static_cast<std::size_t>(rows.size())},
                                  static_cast<std::uint32_t>(rows.shape(1)),
                                  {first[0], first[1]},
                                  {steps[0], steps[1]}};
            return run([&] { return Solid::from_mesh(make_height_field(grid, base)); });
        },
        py::arg("heights"), py::arg("base") = 0.0, py::kw_only(),
        py::arg("spacing") = py::make_tuple(1.0, 1.0), py::arg("origin") = py::make_tuple(0.0, 0.0),
        R"(What is above z = base and below heights over a grid.

Parameters
----------
heights : array_like, shape (rows, columns)
    Each above the base. Columns go along x, rows along y.
base : float
spacing, origin : array_like, shape (2,)
    Of columns and rows; x and y of the first height.
)");
}

}  // namespace

void bind_fields(py::module_& m) {
    py::class_<Solid> c = solid_class(m);
    bind_level_set(c);
    bind_height_field(c);
}

}  // namespace trisect::python

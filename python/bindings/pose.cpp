// SPDX-License-Identifier: Apache-2.0

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/operators.h>
#include <pybind11/stl.h>

#include <trisect/brep/exact_rational.h>
#include <trisect/kernel/error.h>
#include <trisect/kernel/pose.h>

#include "arrays.h"
#include "bind.h"
#include "fractions.h"
#include "poses.h"
#include "run.h"

namespace trisect::python {

namespace {

py::array_t<double> matrix_of(const Pose& pose) {
    py::array_t<double> matrix({4, 4});
    auto m = matrix.mutable_unchecked<2>();
    for (py::ssize_t i = 0; i < 4; ++i)
        for (py::ssize_t j = 0; j < 4; ++j)
            m(i, j) = i < 3 ? pose.approximate()[static_cast<std::size_t>(4 * i + j)]
                            : static_cast<double>(j == 3);
    return matrix;
}

Pose from_matrix(const py::object& matrix, const char* what) {
    const AffineMap map = affine_map_of(matrix, what);
    std::array<double, 12> rows{};
    for (std::size_t i = 0; i < 12; ++i) rows[i] = map.rows[i / 4][i % 4];
    try {
        return Pose::from_doubles(rows);
    } catch (const UsageError& error) {
        throw UsageError(std::string(what) + ": " + error.what());
    } catch (const LimitError& error) {
        throw LimitError(std::string(what) + ": " + error.what());
    }
}

}  // namespace

AffineMap affine_map_of(const py::object& matrix, const char* what) {
    auto a = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(matrix);
    if (!a) throw py::type_error(std::string(what) + ": must be a matrix of numbers");
    const bool fits = a.ndim() == 2 && ((a.shape(0) == 3 && (a.shape(1) == 3 || a.shape(1) == 4)) ||
                                        (a.shape(0) == 4 && a.shape(1) == 4));
    if (!fits)
        throw UsageError(std::string(what) +
                         ": must have the shape (3, 3), (3, 4) or (4, 4), not " +
                         std::string(py::str(a.attr("shape"))));
    const auto m = a.unchecked<2>();
    if (a.shape(0) == 4 && !(m(3, 0) == 0 && m(3, 1) == 0 && m(3, 2) == 0 && m(3, 3) == 1))
        throw UsageError(std::string(what) +
                         ": the last row of a matrix of shape (4, 4) must be "
                         "0 0 0 1");
    AffineMap map;
    for (py::ssize_t i = 0; i < 3; ++i)
        for (py::ssize_t j = 0; j < a.shape(1); ++j)
            map.rows[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] = m(i, j);
    return map;
}

Pose pose_of(const py::object& pose, const char* what) {
    if (pose.is_none()) return {};
    if (py::isinstance<Pose>(pose)) return pose.cast<const Pose&>();
    return from_matrix(pose, what);
}

namespace {

// Rows of (M | t) / S.
py::tuple exact_rows(const Pose& pose) {
    const ExactRational s(pose.denominator());
    py::tuple rows(3);
    for (std::size_t i = 0; i < 3; ++i) {
        py::tuple row(4);
        for (std::size_t j = 0; j < 3; ++j)
            row[j] = to_fraction(ExactRational(pose.matrix(i, j)) / s);
        row[3] = to_fraction(ExactRational(pose.translation(i)) / s);
        rows[i] = row;
    }
    return rows;
}

py::tuple limbs_of(const Pose::Number& number) {
    py::tuple limbs(7);
    for (int i = 0; i < 7; ++i) limbs[static_cast<std::size_t>(i)] = number.limb(i);
    return limbs;
}

Pose::Number number_of(const py::handle& limbs) {
    const auto list = limbs.cast<std::array<std::uint64_t, 7>>();
    Pose::Number number;
    for (int i = 0; i < 7; ++i) number.set_limb(i, list[static_cast<std::size_t>(i)]);
    return number;
}

// Nine numbers of M, three of t, and S.
py::tuple pose_state(const Pose& pose) {
    py::tuple state(13);
    for (std::size_t i = 0; i < 9; ++i) state[i] = limbs_of(pose.matrix(i / 3, i % 3));
    for (std::size_t i = 0; i < 3; ++i) state[9 + i] = limbs_of(pose.translation(i));
    state[12] = limbs_of(pose.denominator());
    return state;
}

Pose pose_of_state(const py::tuple& state) {
    if (state.size() != 13) throw UsageError("this pickle of a Pose is of another version");
    std::array<Pose::Number, 9> m;
    std::array<Pose::Number, 3> t;
    for (std::size_t i = 0; i < 9; ++i) m[i] = number_of(state[i]);
    for (std::size_t i = 0; i < 3; ++i) t[i] = number_of(state[9 + i]);
    return Pose::from_integers(m, t, number_of(state[12]));
}

}  // namespace

void bind_pose(py::module_& m) {
    py::class_<Pose>(m, "Pose", R"(An exact affine map that places a solid in the world.

It is exactly what it was made from, and nothing is rounded where solids are compared under
poses: what is flush stays flush. Functions that take a pose take a matrix of shape (3, 4) or
(4, 4) as well, or None for the identity.
)")
        .def(py::init<>())
        .def_static(
            "from_matrix", [](const py::object& a) { return from_matrix(a, "matrix"); },
            py::arg("matrix"), R"(The map with these numbers, as they are.

Parameters
----------
matrix : array_like, shape (3, 3), (3, 4) or (4, 4)
)")
        .def_static(
            "from_quaternion",
            [](const std::array<std::int64_t, 4>& q, const py::object& translation) {
                return Pose::from_quaternion(q, point_of(translation, "translation"));
            },
            py::arg("quaternion"), py::arg("translation") = py::make_tuple(0.0, 0.0, 0.0),
            R"(The exact rotation by a quaternion of integers (w, x, y, z), then a translation.

``(1, 0, 0, 1)`` is a quarter turn about z.
)")
        .def_static(
            "from_translation",
            [](const py::object& by) { return Pose::from_translation(point_of(by, "by")); },
            py::arg("by"), "The translation by doubles, as they are.")
        .def_static(
            "rotation_near",
            [](const py::object& axis, double degrees, int bits) {
                return Pose::rotation_near(point_of(axis, "axis"), degrees, bits);
            },
            py::arg("axis"), py::arg("degrees"), py::arg("bits") = 20,
            R"(An exact rotation about an axis through the origin, by an angle near the given one.

Parameters
----------
axis : array_like, shape (3,)
degrees : float
bits : int
    Of the quaternion of integers, 4 to 52: the angle is off by less than ``2**(3 - bits)``
    radians, and by nothing for quarter turns about coordinate axes.
)")
        .def("inverse", &Pose::inverse, "The inverse map, exactly.")
        .def("matrix", &matrix_of, "The map in doubles, array of shape (4, 4).")
        .def("exact_matrix", &exact_rows, "The map as three rows of four Fractions.")
        .def(py::pickle(&pose_state, &pose_of_state))
        .def_property_readonly("is_mirror", &Pose::is_mirror, "Whether orientation is turned over.")
        .def(
            "__matmul__", [](const Pose& a, const Pose& b) { return a * b; }, py::is_operator(),
            "First the right one, then the left one, exactly.")
        .def(
            "__mul__", [](const Pose& a, const Pose& b) { return a * b; }, py::is_operator(),
            "The same as ``@``.")
        .def(
            "__eq__", [](const Pose& a, const Pose& b) { return a == b; }, py::is_operator(),
            "Whether the maps are the same.")
        .def("__hash__",
             [](const Pose& a) { return py::hash(py::tuple(py::cast(a.approximate()))); })
        .def("__repr__", [](const Pose& a) {
            return "<trisect.Pose " + std::string(py::str(matrix_of(a).attr("tolist")())) + ">";
        });
}

}  // namespace trisect::python

// SPDX-License-Identifier: Apache-2.0
//
// Conversions between exact numbers and fractions.Fraction.
#pragma once

#include <pybind11/pybind11.h>

#include <trisect/brep/exact_point.h>
#include <trisect/brep/exact_rational.h>

namespace trisect::python {

namespace py = pybind11;

/// A fractions.Fraction.
[[nodiscard]] py::object to_fraction(const ExactRational& value);
/// A tuple of three.
[[nodiscard]] py::tuple to_fractions(const ExactPoint& point);
/// The value of an int, a float or a Fraction. `what` names it in errors.
/// \throw py::type_error, UsageError for a float that is not finite
[[nodiscard]] ExactRational exact_of(const py::handle& number, const char* what);

}  // namespace trisect::python

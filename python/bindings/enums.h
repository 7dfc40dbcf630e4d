// SPDX-License-Identifier: Apache-2.0
//
// Enumerations of the library as enum.IntEnum: they compare with numpy's integers.
#pragma once

#include <span>
#include <string>
#include <utility>

#include <pybind11/pybind11.h>

namespace trisect::python {

namespace py = pybind11;

using EnumMember = std::pair<std::string, int>;

/// Adds the class to the module.
void bind_enum(py::module_& m, const char* name, const char* doc,
               std::span<const EnumMember> members);

/// The member of a class that bind_enum() added.
[[nodiscard]] py::object enum_member(const char* name, int value);

template <class Enum>
py::object enum_member(const char* name, Enum value) {
    return enum_member(name, static_cast<int>(value));
}

}  // namespace trisect::python

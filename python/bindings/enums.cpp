// SPDX-License-Identifier: Apache-2.0

#include "enums.h"

namespace trisect::python {

void bind_enum(py::module_& m, const char* name, const char* doc,
               std::span<const EnumMember> members) {
    py::list pairs;
    for (const auto& [member, value] : members) pairs.append(py::make_tuple(member, value));
    const py::module_ enums = py::module_::import("enum");
    const py::object made =
        enums.attr("IntEnum")(name, pairs, py::arg("module") = m.attr("__name__"));
    made.attr("__doc__") = doc;
    // An IntEnum is printed as its number, which tells nobody anything.
    made.attr("__str__") = enums.attr("Enum").attr("__str__");
    m.attr(name) = made;
}

py::object enum_member(const char* name, int value) {
    return py::module_::import("trisect._trisect").attr(name)(value);
}

}  // namespace trisect::python

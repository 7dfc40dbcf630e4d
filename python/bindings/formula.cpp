// SPDX-License-Identifier: Apache-2.0
//
// Formulas, which are evaluated in one pass, and booleans of many operands.

#include <string>
#include <vector>

#include <trisect/bsp/expression.h>
#include <trisect/bsp/solid.h>

#include "bind.h"
#include "embedding.h"
#include "run.h"
#include "solids.h"

namespace trisect::python {

namespace {

// A Solid or a Formula. \throw py::type_error naming the place
Expression formula_of(const py::handle& operand, const std::string& what) {
    if (py::isinstance<Solid>(operand)) return Expression(operand.cast<const Solid&>());
    if (py::isinstance<Expression>(operand)) return operand.cast<const Expression&>();
    const std::string type = py::str(py::type::of(operand).attr("__name__"));
    throw py::type_error(what + ": must be a Solid or a Formula, not " + type);
}

std::vector<Expression> formulas_of(const py::iterable& operands, const char* what) {
    std::vector<Expression> formulas;
    for (const py::handle operand : operands)
        formulas.push_back(formula_of(
            operand, std::string(what) + ": operand " + std::to_string(formulas.size())));
    return formulas;
}

// b, or nothing where Python should try b's operator.
template <class Combine>
py::object combined(const Expression& a, const py::object& b, const Combine& combine) {
    if (!py::isinstance<Solid>(b) && !py::isinstance<Expression>(b))
        return py::reinterpret_borrow<py::object>(Py_NotImplemented);
    return py::cast(combine(a, formula_of(b, "")));
}

template <class Combine>
void def_operator(py::class_<Expression>& c, const char* name, const char* reflected,
                  const char* doc, const Combine& combine) {
    c.def(
        name,
        [combine](const Expression& a, const py::object& b) { return combined(a, b, combine); },
        doc);
    c.def(
        reflected,
        [combine](const Expression& a, const py::object& b) {
            return combined(a, b, [&](const auto& x, const auto& y) { return combine(y, x); });
        },
        doc);
}

void bind_formula_type(py::module_& m) {
    py::class_<Expression> c(m, "Formula",
                             R"(A boolean formula over solids that nothing has evaluated yet.

Operators of `Solid` compute at once. A formula collects them, and `evaluate` works on the whole
of it in one pass, without solids in between.

Parameters
----------
solid : Solid

Examples
--------
>>> part = evaluate(Formula(plate) - hole - pocket | rib)
)");
    c.def(py::init([](const Solid& s) { return Expression(s); }), py::arg("solid"));
    def_operator(c, "__or__", "__ror__", "Union.",
                 [](const auto& a, const auto& b) { return a | b; });
    def_operator(c, "__and__", "__rand__", "Intersection.",
                 [](const auto& a, const auto& b) { return a & b; });
    def_operator(c, "__sub__", "__rsub__", "Difference.",
                 [](const auto& a, const auto& b) { return a - b; });
    def_operator(c, "__xor__", "__rxor__", "Symmetric difference.",
                 [](const auto& a, const auto& b) { return a ^ b; });
    c.def(
        "__invert__", [](const Expression& a) { return ~a; }, "Complement.");
    c.def("__repr__", [](const Expression&) { return "<trisect.Formula>"; });
}

}  // namespace

void bind_formula(py::module_& m) {
    bind_formula_type(m);
    m.def(
        "evaluate",
        [](const py::object& formula, const std::string& winding) {
            return evaluated(formula_of(formula, "evaluate"), winding_of(winding));
        },
        py::arg("formula"), py::kw_only(), py::arg("winding") = "positive",
        R"(The solid that a formula describes. Exact, and in one pass.

Parameters
----------
formula : Formula or Solid
winding : {'positive', 'nonzero'}
    What counts as inside an operand that overlaps itself several times.

Returns
-------
Solid
)");
    m.def(
        "union",
        [](const py::iterable& operands) {
            return evaluated(Expression::any_of(formulas_of(operands, "union")));
        },
        py::arg("operands"), R"(The union of any number of solids, in one pass.

Parameters
----------
operands : iterable of Solid or Formula
    None gives the empty set.

Returns
-------
Solid
)");
    m.def(
        "intersection",
        [](const py::iterable& operands) {
            return evaluated(Expression::all_of(formulas_of(operands, "intersection")));
        },
        py::arg("operands"), R"(The intersection of any number of solids, in one pass.

Parameters
----------
operands : iterable of Solid or Formula
    None gives all of space.

Returns
-------
Solid
)");
    m.def(
        "difference",
        [](const py::object& first, const py::iterable& others) {
            return evaluated(formula_of(first, "difference: first") -
                             Expression::any_of(formulas_of(others, "difference")));
        },
        py::arg("first"), py::arg("others"), R"(A solid without any number of others, in one pass.

Parameters
----------
first : Solid or Formula
others : iterable of Solid or Formula

Returns
-------
Solid
)");
}

}  // namespace trisect::python

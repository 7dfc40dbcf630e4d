// SPDX-License-Identifier: Apache-2.0
//
// Formulas that are evaluated again after edits.

#include <memory>
#include <mutex>
#include <string>

#include <trisect/bsp/edited_formula.h>
#include <trisect/kernel/error.h>

#include "bind.h"
#include "embedding.h"
#include "run.h"

namespace trisect::python {

namespace {

/// One thread at a time, which Python's lock does not see to while a call runs without it.
struct Edited {
    explicit Edited(const EvaluateOptions& options) : formula(options) {}
    EditedFormula formula;
    ChangeReport change;
    std::mutex in_use;
};

Expression formula_from(const py::object& operand) {
    if (py::isinstance<Solid>(operand)) return Expression(operand.cast<const Solid&>());
    if (py::isinstance<Expression>(operand)) return operand.cast<const Expression&>();
    const std::string type = py::str(py::type::of(operand).attr("__name__"));
    throw py::type_error("evaluate: must be a Solid or a Formula, not " + type);
}

Solid evaluated_again(Edited& edited, const py::object& operand) {
    const Expression formula = formula_from(operand);
    const std::unique_lock lock(edited.in_use, std::try_to_lock);
    if (!lock) throw UsageError("this EditedFormula is in use by another thread");
    return run([&] { return edited.formula.evaluate(formula, &edited.change); });
}

py::object box_of(const Edited& edited) {
    if (!edited.change.box) return py::none();
    const Bounds& box = *edited.change.box;
    return py::make_tuple(py::make_tuple(box.lo[0], box.lo[1], box.lo[2]),
                          py::make_tuple(box.hi[0], box.hi[1], box.hi[2]));
}

}  // namespace

void bind_edited(py::module_& m) {
    py::class_<Edited, std::unique_ptr<Edited>> c(
        m, "EditedFormula",
        R"(Keeps the last formula and its solid, and evaluates the next one near what changed.

An operand is the same where it is the same `Solid`. An edit costs what it changes; the first
evaluation costs more than `evaluate`. Limits are those of each call, the number of threads that
of the beginning. One thread at a time.

Parameters
----------
winding : {'positive', 'nonzero'}

Examples
--------
>>> edited = EditedFormula()
>>> part = edited.evaluate(Formula(plate) - hole - pocket)
>>> part = edited.evaluate(Formula(plate) - larger_hole - pocket)
>>> edited.evaluated_all
False
)");
    c.def(py::init([](const std::string& winding) {
              EvaluateOptions options;
              options.threads = limits_of_thread().threads;
              options.winding = winding_of(winding);
              return std::make_unique<Edited>(options);
          }),
          py::kw_only(), py::arg("winding") = "positive");
    c.def("evaluate", &evaluated_again, py::arg("formula"),
          R"(The solid that `evaluate(formula)` has.

Parameters
----------
formula : Formula or Solid

Returns
-------
Solid
)");
    c.def_property_readonly(
        "changed_operands", [](const Edited& e) { return e.change.changed_operands; },
        "How many operands of the last two formulas are in one of them only.");
    c.def_property_readonly("box", &box_of,
                            "Corners of the box around them; None where none changed, or where all "
                            "was evaluated.");
    c.def_property_readonly(
        "evaluated_all", [](const Edited& e) { return e.change.evaluated_all; },
        "Whether the last call evaluated everywhere, as the first one does.");
    c.def("__repr__", [](const Edited&) { return "<trisect.EditedFormula>"; });
}

}  // namespace trisect::python

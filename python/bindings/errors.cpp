// SPDX-License-Identifier: Apache-2.0
//
// Errors of the library as the exceptions of trisect/_errors.py.

#include <exception>
#include <string>

#include <trisect/brep/validate/defect.h>
#include <trisect/kernel/error.h>

#include "bind.h"

namespace trisect::python {

namespace {

const char* class_name(ErrorCode code) {
    switch (code) {
        case ErrorCode::Usage:
            return "UsageError";
        case ErrorCode::Input:
            return "InputError";
        case ErrorCode::InvalidSolid:
            return "InvalidSolid";
        case ErrorCode::Limit:
            return "LimitError";
        case ErrorCode::Cancelled:
            return "CancelledError";
        case ErrorCode::Unsupported:
            return "UnsupportedError";
        case ErrorCode::Internal:
            return "InternalError";
    }
    return "Error";
}

void raise(const Error& error, const py::object& report = py::none()) {
    const py::object type = py::module_::import("trisect._errors").attr(class_name(error.code()));
    const py::object made = type(error.what());
    if (!report.is_none()) made.attr("report") = report;
    PyErr_SetObject(type.ptr(), made.ptr());
}

void translate(std::exception_ptr pending) {
    if (!pending) return;
    try {
        std::rethrow_exception(pending);
    } catch (const InvalidSolid& error) {
        raise(error, py::cast(error.report()));
    } catch (const Error& error) {
        raise(error);
    }
}

}  // namespace

void bind_errors(py::module_&) { py::register_exception_translator(&translate); }

}  // namespace trisect::python

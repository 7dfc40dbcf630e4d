// SPDX-License-Identifier: Apache-2.0
#include "failure.h"

#include <trisect/brep/validate/defect.h>
#include <trisect/bsp/csg/csg_error.h>

#include <filesystem>
#include <new>

#include "child_process.h"
#include "mesh_files.h"
#include "report_json.h"
#include "way_out.h"

namespace trisect::app {
namespace {

std::string_view kind_name(int code) {
    if (code == exit_missing_program) return "missing_program";
    switch (static_cast<ErrorCode>(code)) {
        case ErrorCode::Usage:
            return "usage";
        case ErrorCode::Input:
            return "input";
        case ErrorCode::InvalidSolid:
            return "invalid_solid";
        case ErrorCode::Limit:
            return "limit";
        case ErrorCode::Cancelled:
            return "cancelled";
        case ErrorCode::Unsupported:
            return "unsupported";
        case ErrorCode::Internal:
            break;
    }
    return "internal";
}

Json place_number(std::uint64_t n) { return n == 0 ? Json() : Json(n); }

Json failure_document(const Failure& failure) {
    Json error;
    error["code"] = failure.code;
    error["kind"] = kind_name(failure.code);
    error["message"] = failure.message;
    error["file"] = failure.place.file.empty() ? Json() : Json(failure.place.file);
    error["line"] = place_number(failure.place.line);
    error["column"] = place_number(failure.place.column);
    if (failure.has_offset) {
        error["offset"] = failure.place.offset;
    }
    if (!failure.defects.is_null()) error["defects"] = failure.defects;
    if (!failure.hint.empty()) error["hint"] = failure.hint;
    Json document;
    document["schema"] = "trisect.error/1";
    document["error"] = std::move(error);
    return document;
}

Failure simple(ErrorCode code, const std::string& message) {
    return {static_cast<int>(code), message, {}, {}};
}

}  // namespace

Failure current_failure() {
    try {
        throw;
    } catch (const InvalidSolid& e) {
        return {static_cast<int>(e.code()), e.what(), {},
                defects_json(e.report()),   false,    way_out_hint(e.report())};
    } catch (const OperandError& e) {
        const bool has_defects = !e.report().empty();
        return {static_cast<int>(e.code()),
                e.what(),
                FilePlace{e.file(), 0, 0, 0},
                has_defects ? defects_json(e.report()) : Json(),
                false,
                e.hint()};
    } catch (const InputError& e) {
        return {static_cast<int>(e.code()), e.what(), e.place(), {}, e.place().line == 0};
    } catch (const CsgError& e) {
        return {static_cast<int>(e.code()), e.what(), e.place(), {}};
    } catch (const Error& e) {
        return simple(e.code(), e.what());
    } catch (const MissingProgram& e) {
        return {exit_missing_program, e.what(), {}, {}};
    } catch (const std::bad_alloc&) {
        return simple(ErrorCode::Limit, "out of memory (see --max-memory)");
    } catch (const std::filesystem::filesystem_error& e) {
        return simple(ErrorCode::Input, e.what());
    } catch (const std::exception& e) {
        return simple(ErrorCode::Internal, std::string("internal error: ") + e.what());
    } catch (...) {
        return simple(ErrorCode::Internal, "internal error: unknown exception");
    }
}

std::string document_text(const Json& document) {
    return document.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void report_failure(Console& console, bool json, const Failure& failure) noexcept {
    try {
        console.complain("trisect: error: " + failure.message);
        if (!failure.hint.empty()) console.complain("trisect: hint: " + failure.hint);
        if (json) console.print(document_text(failure_document(failure)));
    } catch (...) {
        return;  // nobody is listening any more
    }
}

}  // namespace trisect::app

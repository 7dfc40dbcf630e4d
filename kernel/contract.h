// SPDX-License-Identifier: Apache-2.0
//
// Contracts: checks of the library's own promises.
// A broken promise is a mistake of this library, never of its user. It leaves as an Error with
// ErrorCode::Internal.
//
// TRISECT_EXPECTS is cheap and on in every build; TRISECT_AUDIT_CHECK may be expensive and exists
// only where TRISECT_AUDIT is defined.
#pragma once

#include <string>

#include <trisect/kernel/error.h>

namespace trisect::detail {

[[noreturn]] inline void contract_violated(const char* what, const char* file, int line) {
    throw Error(ErrorCode::Internal, std::string("internal error: ") + what + " (" + file + ":" +
                                         std::to_string(line) + ")");
}

}  // namespace trisect::detail

#define TRISECT_EXPECTS(condition, what)                                    \
    do {                                                                    \
        if (!(condition)) [[unlikely]]                                      \
            ::trisect::detail::contract_violated(what, __FILE__, __LINE__); \
    } while (false)

#if defined(TRISECT_AUDIT)
#define TRISECT_AUDIT_CHECK(condition, what) TRISECT_EXPECTS(condition, what)
#else
#define TRISECT_AUDIT_CHECK(condition, what) \
    do {                                     \
    } while (false)
#endif

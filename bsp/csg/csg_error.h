// SPDX-License-Identifier: Apache-2.0
//
// CsgError: a failure with its place in a text of a modelling program.
#pragma once

#include <string>
#include <utility>

#include <trisect/kernel/error.h>

namespace trisect {

/// Malformed text is ErrorCode::Input, what this version cannot do Unsupported, what is beyond
/// CsgLimits Limit, and a polyhedron that bounds no solid InvalidSolid.
class CsgError : public Error {
public:
    CsgError(ErrorCode code, FilePlace place, const std::string& message)
        : Error(code, place.to_string() + ": " + message), place_(std::move(place)) {}
    [[nodiscard]] const FilePlace& place() const noexcept { return place_; }

private:
    FilePlace place_;
};

}  // namespace trisect

// SPDX-License-Identifier: Apache-2.0
//
// Arithmetic of GDML's attributes: names, numbers, + - * / ^, functions.
#pragma once

#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace trisect::app {

/// What is wrong with a formula.
class GdmlFormulaError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// What names stand for.
class GdmlNames {
public:
    virtual ~GdmlNames() = default;
    /// A constant, a variable or a quantity; with indices, an entry of a matrix, from 1 on.
    [[nodiscard]] virtual std::optional<double> value(std::string_view name,
                                                      std::span<const double> indices) const = 0;
};

/// The value of a formula, in doubles; finite. \throw GdmlFormulaError
[[nodiscard]] double gdml_value(std::string_view formula, const GdmlNames& names);

}  // namespace trisect::app

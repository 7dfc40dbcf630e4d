// SPDX-License-Identifier: Apache-2.0
#include "formula.h"

#include <span>

namespace trisect::app {

Expression formula(const std::string& operation, const std::vector<Operand>& operands) {
    std::vector<Expression> terms;
    terms.reserve(operands.size());
    for (const Operand& operand : operands) terms.emplace_back(operand.solid);
    if (terms.size() == 1) return terms.front();
    if (operation == "union") return Expression::any_of(terms);
    if (operation == "intersection") return Expression::all_of(terms);
    if (operation == "difference") {
        return terms.front() - Expression::any_of(std::span(terms).subspan(1));
    }
    Expression result = terms.front();
    for (std::size_t i = 1; i < terms.size(); ++i) result = result ^ terms[i];
    return result;
}

}  // namespace trisect::app

// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "gdml/gdml_expression.h"

namespace {

using trisect::app::gdml_value;
using trisect::app::GdmlFormulaError;

class Names : public trisect::app::GdmlNames {
public:
    [[nodiscard]] std::optional<double> value(std::string_view name,
                                              std::span<const double> indices) const override {
        if (name == "half" && indices.empty()) return 0.5;
        if (name == "m" && indices.size() == 2) return 10 * indices[0] + indices[1];
        return std::nullopt;
    }
};

double value(std::string_view formula) { return gdml_value(formula, Names()); }

TEST(GdmlExpression, Arithmetic) {
    EXPECT_EQ(value("1 + 2*3"), 7);
    EXPECT_EQ(value("(1+2)*3"), 9);
    EXPECT_EQ(value("-2^2"), -4);
    EXPECT_EQ(value("2^-1"), 0.5);
    EXPECT_EQ(value("2**3"), 8);
    EXPECT_EQ(value("7-2-1"), 4);
    EXPECT_EQ(value("8/4/2"), 1);
    EXPECT_EQ(value("- -3"), 3);
    EXPECT_EQ(value("1e2+.5+1."), 101.5);
}

TEST(GdmlExpression, NamesFunctionsAndMatrices) {
    EXPECT_EQ(value("4*half"), 2);
    EXPECT_EQ(value("m[1, 1+1]"), 12);
    EXPECT_EQ(value("sqrt(16)+max(1,half)"), 5);
    EXPECT_EQ(value("cos(0)"), 1);
}

TEST(GdmlExpression, WhatIsRefused) {
    for (const char* wrong : {"", "1+", "(1", "1)", "1 2", "nobody", "m[1]", "f(1)", "sin()", "1/0",
                              "sqrt(-1)", "$", "1e999"})
        EXPECT_THROW((void)value(wrong), GdmlFormulaError) << wrong;
    EXPECT_THROW((void)value(std::string(5000, '(')), GdmlFormulaError);
    EXPECT_THROW((void)value(std::string(5000, '-') + "1"), GdmlFormulaError);
    EXPECT_THROW((void)value(std::string(1U << 20, '1')), GdmlFormulaError);
}

}  // namespace

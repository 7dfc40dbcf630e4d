// SPDX-License-Identifier: Apache-2.0
//
// The table of rules in docs/booleans.md against the one in code.

#include <trisect/bsp/evaluate/rules.h>

#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace {

using trisect::EvaluateCounters;
using trisect::detail::Rule;

using Row = std::vector<std::string>;

// The cells of a line "| a | b |", without the blanks around them.
Row cells_of(const std::string& line) {
    Row cells;
    for (std::size_t begin = line.find('|') + 1; begin < line.size();) {
        const std::size_t end = line.find('|', begin);
        if (end == std::string::npos) break;
        const std::string cell = line.substr(begin, end - begin);
        const std::size_t first = cell.find_first_not_of(' ');
        const std::size_t last = cell.find_last_not_of(' ');
        cells.push_back(first == std::string::npos ? "" : cell.substr(first, last - first + 1));
        begin = end + 1;
    }
    return cells;
}

// The rows below the line of headings and the rule under it.
std::vector<Row> documented_rules() {
    std::ifstream page(TRISECT_DOCS "/booleans.md");
    std::vector<Row> rows;
    std::string line;
    while (std::getline(page, line) && !line.starts_with("| rule |")) {
    }
    std::getline(page, line);
    while (std::getline(page, line) && line.starts_with("|")) rows.push_back(cells_of(line));
    return rows;
}

std::string name_of(std::uint64_t EvaluateCounters::*counter) {
    const std::vector<std::pair<std::uint64_t EvaluateCounters::*, std::string>> names{
        {&EvaluateCounters::constant_cells, "`constant_cells`"},
        {&EvaluateCounters::shared_cells, "`shared_cells`"},
        {&EvaluateCounters::divided_cells, "`divided_cells`"},
        {&EvaluateCounters::grid_leaves, "`grid_leaves`"},
        {&EvaluateCounters::filtered_leaves, "`filtered_leaves`"},
        {&EvaluateCounters::prism_leaves, "`prism_leaves`"},
        {&EvaluateCounters::exact_leaves, "`exact_leaves`"},
        {&EvaluateCounters::half_space_cuts, "`half_space_cuts`"},
    };
    for (const auto& [member, name] : names)
        if (member == counter) return name;
    return "a counter without a name";
}

TEST(Rules, AreThoseOfTheDocumentation) {
    const std::vector<Row> documented = documented_rules();
    ASSERT_EQ(documented.size(), trisect::detail::rules().size());
    for (std::size_t i = 0; i < documented.size(); ++i) {
        const Rule& rule = trisect::detail::rules()[i];
        ASSERT_GE(documented[i].size(), 4U);
        EXPECT_EQ(documented[i][0], rule.name);
        EXPECT_EQ(documented[i][1], rule.condition) << rule.name;
        EXPECT_EQ(documented[i][2], rule.keeps) << rule.name;
        EXPECT_EQ(documented[i][3], name_of(rule.counter)) << rule.name;
    }
}

TEST(Rules, ScopesFollowEachOther) {
    using namespace trisect::detail;
    EXPECT_EQ(formula_rules().size() + constant_rules().size() + polygon_rules().size(),
              rules().size());
    for (const Rule& rule : formula_rules())
        EXPECT_TRUE(std::holds_alternative<FormulaRule>(rule.how)) << rule.name;
    for (const Rule& rule : constant_rules())
        EXPECT_TRUE(std::holds_alternative<CellRule>(rule.how)) << rule.name;
    for (const Rule& rule : polygon_rules())
        EXPECT_FALSE(std::holds_alternative<FormulaRule>(rule.how)) << rule.name;
}

}  // namespace

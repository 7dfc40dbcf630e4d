// SPDX-License-Identifier: Apache-2.0
//
// The table of ways in docs/booleans.md against the one in code.

#include <trisect/bsp/evaluate/ways.h>

#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace {

using trisect::EvaluateStats;
using trisect::detail::Way;

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
std::vector<Row> documented_ways() {
    std::ifstream page(TRISECT_DOCS "/booleans.md");
    std::vector<Row> rows;
    std::string line;
    while (std::getline(page, line) && !line.starts_with("| way |")) {
    }
    std::getline(page, line);
    while (std::getline(page, line) && line.starts_with("|")) rows.push_back(cells_of(line));
    return rows;
}

std::string name_of(std::uint64_t EvaluateStats::*counter) {
    const std::vector<std::pair<std::uint64_t EvaluateStats::*, std::string>> names{
        {&EvaluateStats::constant_cells, "`constant_cells`"},
        {&EvaluateStats::shared_cells, "`shared_cells`"},
        {&EvaluateStats::divided_cells, "`divided_cells`"},
        {&EvaluateStats::grid_leaves, "`grid_leaves`"},
        {&EvaluateStats::plain_leaves, "`plain_leaves`"},
        {&EvaluateStats::prism_leaves, "`prism_leaves`"},
        {&EvaluateStats::exact_leaves, "`exact_leaves`"},
    };
    for (const auto& [member, name] : names)
        if (member == counter) return name;
    return "a counter without a name";
}

TEST(Ways, AreThoseOfTheDocumentation) {
    const std::vector<Row> documented = documented_ways();
    ASSERT_EQ(documented.size(), trisect::detail::ways().size());
    for (std::size_t i = 0; i < documented.size(); ++i) {
        const Way& way = trisect::detail::ways()[i];
        ASSERT_GE(documented[i].size(), 4U);
        EXPECT_EQ(documented[i][0], way.name);
        EXPECT_EQ(documented[i][1], way.condition) << way.name;
        EXPECT_EQ(documented[i][2], way.keeps) << way.name;
        EXPECT_EQ(documented[i][3], name_of(way.counter)) << way.name;
    }
}

TEST(Ways, ScopesFollowEachOther) {
    using namespace trisect::detail;
    EXPECT_EQ(formula_ways().size() + constant_ways().size() + polygon_ways().size(),
              ways().size());
    for (const Way& way : formula_ways())
        EXPECT_TRUE(std::holds_alternative<FormulaWay>(way.how)) << way.name;
    for (const Way& way : constant_ways())
        EXPECT_TRUE(std::holds_alternative<CellWay>(way.how)) << way.name;
    for (const Way& way : polygon_ways())
        EXPECT_FALSE(std::holds_alternative<FormulaWay>(way.how)) << way.name;
}

}  // namespace

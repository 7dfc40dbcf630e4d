// SPDX-License-Identifier: Apache-2.0
//
// The formula of a leaf as a function of winding numbers.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <unordered_map>
#include <vector>

#include <trisect/bsp/cells/leaf_problem.h>
#include <trisect/bsp/cells/residual.h>

namespace trisect::detail {

inline constexpr int unknown_winding = std::numeric_limits<int>::min();

/// Evaluates the formula for rows: winding numbers by operand, and behind them how many terms of
/// every operation are inside or unknown. A row follows the change of one winding number in the
/// time of the operations above that operand whose values change, usually one or two; walking the
/// formula would take the time of all operands, for every part and every operand that cuts it. Of
/// up to three operands, as nearly all leaves have, there is a table instead, and rows are winding
/// numbers only. Keeps its memory from leaf to leaf.
class LeafFormula {
public:
    void start(const LeafProblem& problem);

    [[nodiscard]] std::size_t row_size() const { return has_table() ? operands_ : counted_size(); }
    /// Completes a row whose winding numbers are set.
    void fill(std::span<int> row);
    /// Changes the winding number of an operand in a complete row.
    void set(std::span<int> row, std::size_t operand, int winding);
    /// 0 or 1; -1 when the winding numbers that are known do not decide it: then as in
    /// bounded_value_of().
    [[nodiscard]] int value(std::span<const int> row) const;

private:
    struct Node {
        Residual::Kind kind = Residual::Kind::Constant;
        std::int32_t first_parent = -1;  // place in parents_
        int terms = 0;
        int inside = 0;  // while nothing is known
        int unknown = 0;
        int value = -1;
    };
    struct Parent {
        std::int32_t node = 0;
        std::int32_t next = -1;  // the next parent of the same term
    };
    [[nodiscard]] std::int32_t compile(const Residual& formula);
    void add_parent(std::int32_t& first, std::int32_t node);
    [[nodiscard]] bool has_table() const { return !table_.empty(); }
    [[nodiscard]] std::size_t counted_size() const { return operands_ + 3 * nodes_.size(); }
    void tabulate(const LeafProblem& problem);
    void count(std::span<int> row) const;
    [[nodiscard]] int counted_value(std::span<const int> row) const;
    [[nodiscard]] int value_of(int winding) const {
        return winding == unknown_winding ? -1 : (is_inside(winding, rule_) ? 1 : 0);
    }
    [[nodiscard]] static int value_of(const Node& node, int inside, int unknown);
    void tell_parents(std::span<int> row, std::int32_t first, int before, int after);
    void update(std::span<int> row);
    [[nodiscard]] int* counts(std::span<int> row, std::size_t node) const {
        return &row[operands_ + 3 * node];
    }

    std::size_t operands_ = 0;
    EvaluateOptions::Winding rule_ = EvaluateOptions::Winding::Positive;
    std::int32_t root_ = 0;  // a node, or an operand as ~number
    int constant_ = -1;      // of a formula that is one
    std::vector<std::int32_t> operand_of_slot_;
    std::vector<Node> nodes_;  // terms before what they are terms of
    std::vector<Parent> parents_;
    std::vector<std::int32_t> first_parent_;  // by operand
    std::unordered_map<const Residual*, std::int32_t> known_;
    bool remembers_ = false;
    std::vector<std::int8_t> table_;    // by -1, 0, 1 of all operands as digits
    SlotValues values_;                 // of which an entry of the table is made
    std::vector<std::uint64_t> dirty_;  // a bit for every node
    std::size_t first_dirty_ = 0;
};

}  // namespace trisect::detail

// SPDX-License-Identifier: Apache-2.0

#include <trisect/bsp/evaluate/formula_halves.h>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <unordered_map>
#include <utility>
#include <vector>

namespace trisect::detail {

namespace {

// Terms of an operation, those with a common slot in one group.
class TermGroups {
public:
    explicit TermGroups(const Residual& operation) : parent_(operation.children.size()) {
        std::iota(parent_.begin(), parent_.end(), std::size_t{0});
        weights_.assign(parent_.size(), 0);
        std::unordered_map<std::int32_t, std::size_t> first;  // term, by slot
        for (std::size_t i = 0; i < parent_.size(); ++i)
            for_each_slot(*operation.children[i], [&](std::int32_t slot) {
                const auto [known, is_new] = first.try_emplace(slot, i);
                if (is_new) {
                    ++weights_[i];
                    ++total_;
                } else {
                    join(known->second, i);
                }
            });
    }
    [[nodiscard]] std::size_t slots() const { return total_; }
    [[nodiscard]] std::size_t slots_of(std::size_t term) const { return weights_[term]; }
    /// The first term of the group.
    [[nodiscard]] std::size_t group_of(std::size_t term) {
        while (parent_[term] != term) term = parent_[term] = parent_[parent_[term]];
        return term;
    }

private:
    void join(std::size_t a, std::size_t b) {
        const auto [first, second] = std::minmax({group_of(a), group_of(b)});
        parent_[second] = first;
    }
    std::vector<std::size_t> parent_;
    std::vector<std::size_t> weights_;  // slots that no term before has
    std::size_t total_ = 0;
};

}  // namespace

Residual::Ref FormulaHalves::joined(std::int32_t first, std::int32_t second) const {
    Residual::Ref both =
        Residual::of_distinct(kind, {Residual::of_slot(first), Residual::of_slot(second)});
    return negated ? Residual::negation(std::move(both)) : both;
}

std::optional<FormulaHalves> halves_of(const Residual& formula) {
    const bool negated = formula.kind == Residual::Kind::Not;
    const Residual& operation = negated ? *formula.children[0] : formula;
    const std::size_t n = operation.children.size();
    if (n < 2) return std::nullopt;
    TermGroups groups(operation);
    std::vector<std::size_t> slots(n, 0);  // by group
    for (std::size_t i = 0; i < n; ++i) slots[groups.group_of(i)] += groups.slots_of(i);
    // Whole groups are in the first half until the next one would be better in the second.
    std::vector<bool> is_first(n, false);
    std::size_t taken = 0;
    for (std::size_t i = 0; i < n; ++i) {
        if (slots[i] == 0) continue;
        if (taken != 0 && 2 * taken + slots[i] > groups.slots()) break;
        is_first[i] = true;
        taken += slots[i];
    }
    if (taken == groups.slots()) return std::nullopt;
    std::array<std::vector<Residual::Ref>, 2> terms;
    for (std::size_t i = 0; i < n; ++i)
        terms[is_first[groups.group_of(i)] ? 0 : 1].push_back(operation.children[i]);
    FormulaHalves out{operation.kind, negated, {}};
    for (std::size_t i = 0; i < 2; ++i)
        out.terms[i] = Residual::of_distinct(operation.kind, std::move(terms[i]));
    return out;
}

}  // namespace trisect::detail

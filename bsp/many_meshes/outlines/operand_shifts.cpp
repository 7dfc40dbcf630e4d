// SPDX-License-Identifier: Apache-2.0
//
// What is wanted of two operands is decided by the first of their moves that says something: the
// larger growth, the smaller growth, the moves along the axes. Which operands grow and which shrink
// is chosen so that one of the two does what is wanted (growth_signs.h); of two of which one does
// not the other one has to grow or shrink more. Where that goes in a circle nothing grows, and the
// order along each axis has to be right. Orders are found by taking out what nothing has to be
// before.

#include <trisect/bsp/many_meshes/outlines/operand_shifts.h>

#include <algorithm>
#include <functional>
#include <numeric>
#include <queue>
#include <utility>

#include <trisect/bsp/many_meshes/outlines/growth_signs.h>

namespace trisect::detail {

OperandShifts::OperandShifts(std::vector<Growth> growths) : growths_(std::move(growths)) {
    for (Ranks& r : preferred_) {
        r.resize(growths_.size());
        std::iota(r.begin(), r.end(), 0U);
    }
    prefer_by_size();
    ranks_ = {preferred_[0], preferred_[0], preferred_[0], preferred_[1]};
}

void OperandShifts::prefer_by_size() {
    Ranks order = preferred_[0];
    std::ranges::stable_sort(order, std::greater<>(), [&](std::uint32_t s) {
        const Growth& g = growths_[s];
        return std::pair(g.cuts, g.sign * g.size);
    });
    for (std::uint32_t i = 0; i < order.size(); ++i) preferred_[1][order[i]] = i;
}

bool OperandShifts::choose_signs(std::span<const Wanted> wanted) {
    GrowthSigns signs(growths_.size());
    for (const Wanted& w : wanted) signs.want({w.above, w.growth[0]}, {w.below, w.growth[1]});
    std::vector<std::int8_t> given;
    for (const Growth& g : growths_) given.push_back(g.sign);
    const auto chosen = signs.near(given);
    if (!chosen) return false;
    for (std::size_t i = 0; i < growths_.size(); ++i) growths_[i].sign = (*chosen)[i];
    prefer_by_size();
    return true;
}

// Of those that may come next the preferred one first.
std::optional<OperandShifts::Ranks> OperandShifts::ordered(const Ranks& preferred,
                                                           std::span<const Before> all) {
    const std::size_t slots = preferred.size();
    std::vector<std::vector<std::uint32_t>> behind(slots);
    std::vector<std::uint32_t> ahead(slots, 0);
    for (const Before& b : all) {
        behind[b.slot].push_back(b.other);
        ++ahead[b.other];
    }
    using Next = std::pair<std::uint32_t, std::uint32_t>;  // the preferred rank, and the slot
    std::priority_queue<Next, std::vector<Next>, std::greater<>> next;
    for (std::uint32_t s = 0; s < slots; ++s)
        if (ahead[s] == 0) next.emplace(preferred[s], s);
    Ranks ranks(slots);
    std::uint32_t count = 0;
    for (; !next.empty(); ++count) {
        const std::uint32_t s = next.top().second;
        next.pop();
        ranks[s] = count;
        for (const std::uint32_t o : behind[s])
            if (--ahead[o] == 0) next.emplace(preferred[o], o);
    }
    if (count != slots) return std::nullopt;
    return ranks;
}

// Of two that do not agree the one that does what is wanted comes first.
bool OperandShifts::order_growths(std::span<const Wanted> wanted) {
    std::vector<Before> all;
    for (const Wanted& w : wanted) {
        const auto [above, below] = growths_along(w);
        if (std::max(above, below) <= 0) continue;
        if (above < 0) all.push_back({w.below, w.above});
        if (below < 0) all.push_back({w.above, w.below});
    }
    auto ranks = ordered(preferred_[1], all);
    if (ranks) ranks_[3] = *std::move(ranks);
    return ranks.has_value();
}

bool OperandShifts::order_moves(std::span<const Wanted> wanted) {
    std::array<std::uint8_t, 3> axes{0, 1, 2};
    do {
        std::array<std::vector<Before>, 3> all;
        for (const Wanted& w : wanted) {
            if (along_growth(w) != 0) continue;
            std::size_t axis = axes[0];
            for (std::size_t k = 1; k < 3 && w.direction[axis] == 0; ++k) axis = axes[k];
            all[axis].push_back(w.direction[axis] > 0 ? Before{w.above, w.below}
                                                      : Before{w.below, w.above});
        }
        std::array<std::optional<Ranks>, 3> ranks;
        for (std::size_t k = 0; k < 3; ++k) ranks[k] = ordered(preferred_[0], all[k]);
        if (!ranks[0] || !ranks[1] || !ranks[2]) continue;
        axes_ = axes;
        for (std::size_t k = 0; k < 3; ++k) ranks_[k] = *std::move(ranks[k]);
        return true;
    } while (std::ranges::next_permutation(axes).found);
    return false;
}

std::optional<OperandShifts> OperandShifts::satisfying(std::vector<Growth> growths,
                                                       std::span<const Wanted> wanted) {
    OperandShifts all(std::move(growths));
    const auto are_satisfied = [&] {
        return std::ranges::all_of(wanted, [&](const Wanted& w) { return all.satisfies(w); });
    };
    if (all.choose_signs(wanted) && all.order_growths(wanted) && all.order_moves(wanted) &&
        are_satisfied())
        return all;
    all.do_grow_ = false;
    if (all.order_moves(wanted) && are_satisfied()) return all;
    return std::nullopt;
}

int OperandShifts::along_growth(const Wanted& w) const {
    if (!do_grow_) return 0;
    const std::size_t first = growth_rank(w.above) < growth_rank(w.below) ? 0 : 1;
    const std::array<int, 2> along = growths_along(w);
    return along[first] != 0 ? along[first] : along[1 - first];
}

std::array<int, 2> OperandShifts::growths_along(const Wanted& w) const {
    return {growths_[w.above].sign * w.growth[0], growths_[w.below].sign * w.growth[1]};
}

int OperandShifts::along_moves(const Wanted& w) const {
    for (const std::uint8_t k : axes_) {
        if (w.direction[k] == 0) continue;
        return rank(k, w.above) < rank(k, w.below) ? w.direction[k] : -w.direction[k];
    }
    return 0;
}

bool OperandShifts::satisfies(const Wanted& wanted) const {
    const int grown = along_growth(wanted);
    return (grown != 0 ? grown : along_moves(wanted)) > 0;
}

// That the first one grows is as if the second one shrank about the same centre, but for the scale
// of all.
InfinitesimalShift OperandShifts::of_pair(std::uint32_t first, std::uint32_t second) const {
    InfinitesimalShift out;
    out.axes = axes_;
    for (std::size_t k = 0; k < 3; ++k)
        out.signs[k] =
            static_cast<std::int8_t>(rank(axes_[k], second) < rank(axes_[k], first) ? 1 : -1);
    if (!do_grow_) return out;
    const Growth& one = growths_[first];
    const Growth& other = growths_[second];
    out.growth = static_cast<std::int8_t>(-one.sign);
    out.centre = one.centre;
    out.next_growth = other.sign;
    out.next_centre = other.centre;
    if (growth_rank(first) > growth_rank(second)) {
        std::swap(out.growth, out.next_growth);
        std::swap(out.centre, out.next_centre);
    }
    return out;
}

}  // namespace trisect::detail

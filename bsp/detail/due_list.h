// SPDX-License-Identifier: Apache-2.0
//
// DueList: things that have to be looked at when an odometer has come so far.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace trisect::detail {

/// Numbers with the reading of an odometer at which each is due, in no order: all that is asked is
/// what is due by now. Levels hold what lies between 2^(i-1) and 2^i quanta ahead and know the
/// least reading in them, so a level is looked through when something in it is due, and what is
/// not yet due moves down. An entry is touched about once for each halving of what lies ahead of
/// it; those far ahead cost nothing. (Ahuja, Mehlhorn, Orlin and Tarjan 1990 keep a whole order in
/// this way.)
class DueList {
public:
    struct Item {
        double due = 0;
        std::uint32_t name = 0;
    };

    /// Empty, with a new quantum > 0: about the least difference that matters.
    void reset(double quantum) {
        for (std::vector<Item>& l : levels_) l.clear();
        next_.fill(never);
        per_quantum_ = 1 / quantum;
    }
    void push(const Item& item, double now) {
        const std::size_t l = level(item.due - now);
        levels_[l].push_back(item);
        if (item.due < next_[l]) next_[l] = item.due;
    }
    /// Calls visit(item) for all that are due and drops them. visit must not push.
    template <class Visit>
    void take(double now, Visit&& visit) {
        for (std::size_t l = 0; l < levels_.size(); ++l) {
            if (!(next_[l] <= now)) continue;
            next_[l] = never;
            scratch_.swap(levels_[l]);
            for (const Item& item : scratch_) {
                if (item.due <= now)
                    visit(item);
                else
                    push(item, now);
            }
            scratch_.clear();
        }
    }
    [[nodiscard]] std::size_t count_due(double now) const {
        std::size_t n = 0;
        for (std::size_t l = 0; l < levels_.size(); ++l)
            if (next_[l] <= now)
                for (const Item& item : levels_[l])
                    if (item.due <= now) ++n;
        return n;
    }

private:
    static constexpr double never = std::numeric_limits<double>::infinity();
    static constexpr std::size_t level_count = 32;

    [[nodiscard]] std::size_t level(double ahead) const {
        const double quanta = ahead * per_quantum_;
        if (!(quanta >= 1)) return 0;
        const auto exponent = (std::bit_cast<std::uint64_t>(quanta) >> 52U) - 1023U;
        return exponent + 1 < level_count ? static_cast<std::size_t>(exponent) + 1
                                          : level_count - 1;
    }

    std::array<std::vector<Item>, level_count> levels_;
    std::array<double, level_count> next_{};
    std::vector<Item> scratch_;
    double per_quantum_ = 1;
};

}  // namespace trisect::detail

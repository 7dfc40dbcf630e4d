// SPDX-License-Identifier: Apache-2.0
//
// DueList: items to be examined when an odometer reaches a value.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <trisect/kernel/support/double2.h>

namespace trisect::detail {

/// For each of the numbers 0, 1, ... the reading of an odometer at which it is due. Readings are
/// side by side in blocks of which the least is known, and a question looks at all blocks and into
/// those with something due: less than keeping an order, until there are some ten thousand. (A
/// radix heap takes as many instructions, and waits for its lists.) What is due is anywhere, so
/// that a branch for each would mostly be guessed wrong: it is collected without.
class DueList {
public:
    static constexpr double never = std::numeric_limits<double>::infinity();

    void clear() {
        readings_.clear();
        least_.clear();
        due_.clear();
    }
    void set(std::uint32_t name, double due) {
        if (name >= readings_.size()) grow(name);
        readings_[name] = due;
        least_[name / block] = std::min(least_[name / block], due);
    }
    /// Never due any more.
    void drop(std::uint32_t name) { set(name, never); }
    [[nodiscard]] double operator[](std::uint32_t name) const { return readings_[name]; }

    /// Calls look(name) for all that are due, which returns the new reading. What it leaves due is
    /// appended to `left` and may be forgotten if it is not set or dropped afterwards. look must
    /// not set anything.
    template <class Look>
    void take(double now, Look&& look, std::vector<std::uint32_t>& left) {
        const std::size_t due = collect(now);
        std::size_t end = left.size();
        left.resize(end + due);
        for (std::size_t i = 0; i < due; ++i) {
            const std::uint32_t name = due_[i];
            const Double2 next = both(look(name));
            const Mask2 later = next > both(now);
            left[end] = name;
            end += 1 - (bits_of(later) & 1U);
            readings_[name] = choose(later, next, both(readings_[name]))[0];
            double& least = least_[name / block];
            least = smaller(choose(later, next, both(never)), both(least))[0];
        }
        left.resize(end);
    }
    [[nodiscard]] std::size_t count_due(double now) const {
        std::size_t n = 0;
        for (std::size_t b = 0; b < least_.size(); ++b)
            if (least_[b] <= now) n += static_cast<std::size_t>(std::popcount(due_in(b, now)));
        return n;
    }
    /// No reading is less than this.
    [[nodiscard]] double first() const {
        Double2 first = both(never);
        for (std::size_t b = 0; b < least_.size(); b += 2) first = smaller(load(&least_[b]), first);
        return std::min(first[0], first[1]);
    }

private:
    static constexpr std::size_t block = 8;
    static constexpr std::size_t group = 16;  // of blocks

    void grow(std::uint32_t name) {
        least_.resize((name / (block * group) + 1) * group, never);
        readings_.resize(block * least_.size(), never);
        due_.resize(readings_.size() + 1);
    }
    // Bit i: number i of the block is due.
    [[nodiscard]] unsigned due_in(std::size_t b, double now) const {
        unsigned due = 0;
        for (std::size_t i = 0; i < block; i += 2)
            due |= where_at_most(load(&readings_[block * b + i]), both(now)) << i;
        return due;
    }
    // Writes down the numbers that are due, and of the others in their blocks the least.
    [[nodiscard]] std::size_t collect(double now) {
        std::size_t end = 0;
        for (std::size_t from = 0; from < least_.size(); from += group) {
            unsigned blocks = 0;
            for (std::size_t i = 0; i < group; i += 2)
                blocks |= where_at_most(load(&least_[from + i]), both(now)) << i;
            for (; blocks != 0; blocks &= blocks - 1) {
                const std::size_t b = from + static_cast<std::size_t>(std::countr_zero(blocks));
                Double2 later = both(never);
                for (std::size_t i = 0; i < block; i += 2) {
                    const Double2 r = load(&readings_[block * b + i]);
                    const Mask2 is_due = r <= both(now);
                    later = smaller(choose(is_due, both(never), r), later);
                    const unsigned bits = bits_of(is_due);
                    due_[end] = static_cast<std::uint32_t>(block * b + i);
                    end += bits & 1U;
                    due_[end] = static_cast<std::uint32_t>(block * b + i + 1);
                    end += bits >> 1U;
                }
                least_[b] = std::min(later[0], later[1]);
            }
        }
        return end;
    }

    std::vector<double> readings_;
    std::vector<double> least_;       // lower bounds of each block
    std::vector<std::uint32_t> due_;  // room for the numbers that are
};

}  // namespace trisect::detail

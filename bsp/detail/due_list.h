// SPDX-License-Identifier: Apache-2.0
//
// DueList: things that have to be looked at when an odometer has come so far.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace trisect::detail {

/// For each of the numbers 0, 1, ... the reading of an odometer at which it is due. Readings are
/// side by side in blocks of which the least is known, and a question looks at all blocks and into
/// those with something due: less than keeping an order, until there are some ten thousand.
class DueList {
public:
    static constexpr double never = std::numeric_limits<double>::infinity();

    void clear() {
        readings_.clear();
        least_.clear();
    }
    void set(std::uint32_t name, double due) {
        if (name >= readings_.size()) {
            least_.resize(name / block + 1, never);
            readings_.resize(block * least_.size(), never);
        }
        readings_[name] = due;
        least_[name / block] = std::min(least_[name / block], due);
    }
    /// Never due any more.
    void drop(std::uint32_t name) { set(name, never); }
    [[nodiscard]] double operator[](std::uint32_t name) const { return readings_[name]; }

    /// Calls look(name, reading) for all that are due, which returns the new reading; what it
    /// leaves due, and is not set or dropped afterwards, may be forgotten. look must not set
    /// anything.
    template <class Look>
    void take(double now, Look&& look) {
        for (std::size_t b = 0; b < least_.size(); ++b) {
            if (!(least_[b] <= now)) continue;
            // Without branches, in a busy block any may be due, and with four minima at a time: one
            // after the other they would wait for each other.
            double* readings = &readings_[block * b];
            unsigned due = 0;
            std::array<double, 4> later{never, never, never, never};
            for (std::size_t i = 0; i < block; ++i) {
                const bool is_due = readings[i] <= now;
                due |= static_cast<unsigned>(is_due) << i;
                const double r = is_due ? never : readings[i];
                later[i % 4] = r < later[i % 4] ? r : later[i % 4];
            }
            double least = std::min(std::min(later[0], later[1]), std::min(later[2], later[3]));
            for (; due != 0; due &= due - 1) {
                const auto i = static_cast<std::size_t>(std::countr_zero(due));
                const double next = look(static_cast<std::uint32_t>(block * b + i), readings[i]);
                if (!(next > now)) continue;
                readings[i] = next;
                least = std::min(least, next);
            }
            least_[b] = least;
        }
    }
    [[nodiscard]] std::size_t count_due(double now) const {
        std::size_t n = 0;
        for (std::size_t b = 0; b < least_.size(); ++b)
            if (least_[b] <= now)
                for (std::size_t i = block * b; i < block * (b + 1); ++i)
                    n += readings_[i] <= now ? 1 : 0;
        return n;
    }
    /// No reading is less than this.
    [[nodiscard]] double first() const {
        std::array<double, 4> first{never, never, never, never};
        std::size_t b = 0;
        for (; b + 4 <= least_.size(); b += 4)
            for (std::size_t k = 0; k < 4; ++k)
                first[k] = least_[b + k] < first[k] ? least_[b + k] : first[k];
        for (; b < least_.size(); ++b) first[0] = std::min(first[0], least_[b]);
        return std::min(std::min(first[0], first[1]), std::min(first[2], first[3]));
    }

private:
    static constexpr std::size_t block = 8;

    std::vector<double> readings_;
    std::vector<double> least_;  // lower bounds of each block
};

}  // namespace trisect::detail

// SPDX-License-Identifier: Apache-2.0
//
// Candidates of clashes: pairs of parts whose boxes meet.
#pragma once

#include <array>
#include <bit>
#include <compare>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <trisect/brep/measure.h>

#include "clash_manifest.h"

namespace trisect::app {

/// The next double, as std::nextafter has it, without a call.
[[nodiscard]] inline double next_above(double v) {
    if (v == 0) return std::numeric_limits<double>::denorm_min();
    if (!(v < std::numeric_limits<double>::infinity())) return v;
    const auto bits = std::bit_cast<std::int64_t>(v);
    return std::bit_cast<double>(v > 0 ? bits + 1 : bits - 1);
}
[[nodiscard]] inline double next_below(double v) { return -next_above(-v); }

/// Contains what it is of, whatever was rounded.
[[nodiscard]] Bounds posed_box(const Bounds& box, const std::array<double, 12>& pose);

/// A part, as far as the search for pairs needs it.
struct ClashBox {
    Bounds box;  ///< in the world
    std::uint32_t part = 0;
    std::uint32_t group = 0;
};

struct ClashCandidate {
    std::uint32_t a = 0;  ///< parts, a < b
    std::uint32_t b = 0;
    friend auto operator<=>(const ClashCandidate&, const ClashCandidate&) = default;
};

/// How near parts of two groups may be for a set to say something of them.
class ClashLimits {
public:
    ClashLimits(std::span<const ClashSet> sets, std::size_t groups);

    /// Below 0: no set has them.
    [[nodiscard]] double of(std::uint32_t g, std::uint32_t h) const {
        return limits_[g * groups_ + h];
    }
    [[nodiscard]] double most() const { return most_; }

private:
    std::size_t groups_;
    std::vector<double> limits_;
    double most_ = 0;
};

/// Whether some set has the two, and they are near enough for it.
[[nodiscard]] bool is_candidate(const ClashLimits& limits, const ClashBox& a, const ClashBox& b);

/// Every `count`-th of something, from the `number`-th on.
struct ClashShare {
    std::uint32_t number = 0;
    std::uint32_t count = 1;
};

/// Boxes in the order of their lower ends along the axis on which they are shortest beside the
/// whole: each is compared with those that begin before it ends.
class ClashSweep {
public:
    ClashSweep() = default;
    ClashSweep(const ClashLimits& limits, std::span<const ClashBox> boxes);

    /// As add_candidates, of pairs whose first box in the order is in the share: all shares
    /// together have each pair once. \pre what the constructor was given
    void add_candidates(const ClashLimits& limits, std::span<const ClashBox> boxes,
                        const Bounds& cell, const ClashShare& share,
                        std::vector<ClashCandidate>& out) const;

private:
    // One coordinate of a box, as the sweep needs them side by side.
    struct Item {
        double lo = 0;
        double hi = 0;
        std::uint32_t at = 0;
    };
    std::vector<Item> items_;
};

/// Adds the pairs among `boxes` whose place is in `cell`: the lower corner of what the two boxes
/// have in common. Cells are half-open, so among cells that fill space each pair has one. For that
/// a box must be in the list of each cell that it meets, grown upwards by `limits.most()`.
void add_candidates(const ClashLimits& limits, std::span<const ClashBox> boxes, const Bounds& cell,
                    std::vector<ClashCandidate>& out);

}  // namespace trisect::app

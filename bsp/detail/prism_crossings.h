// SPDX-License-Identifier: Apache-2.0
//
// Where walls of prisms cross each other.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <trisect/bsp/detail/prism_facets.h>
#include <trisect/bsp/detail/solid_state.h>

namespace trisect::detail {

/// A place on a wall where another one crosses it: the part of the way from its `from` to its `to`,
/// as a fraction.
struct PrismCrossing {
    LeafIndex wall = 0;
    double at = 0;  ///< relative error below 2^-51
    Int128 part = 0;
    Int128 whole = 0;
};

/// Exact order of two places on one wall.
[[nodiscard]] int compare_places(const PrismCrossing& a, const PrismCrossing& b);

class PrismCrossings {
public:
    /// How many other walls each one may have beside it, on average. Where they are more, looking
    /// at all of them once takes longer than cells do.
    static constexpr std::size_t most_per_wall = 2048;

    /// False when walls touch or overlap without crossing each other, and where too many lie side
    /// by side. Time O(n log n + n m) for n walls with m others beside each.
    [[nodiscard]] bool find(const LeafProblem& problem, std::span<const PrismWall> walls,
                            EvaluateStats& stats);
    /// In their order along the wall.
    [[nodiscard]] std::span<const PrismCrossing> of(LeafIndex wall) const {
        const std::size_t i = LeafWork::u(wall);
        return std::span(sorted_).subspan(first_[i], first_[i + 1] - first_[i]);
    }

private:
    [[nodiscard]] bool compare(std::span<const PrismWall> walls, LeafIndex s, LeafIndex t);

    struct Found {
        LeafIndex on = 0;
        PrismCrossing crossing;
    };
    std::vector<LeafIndex> order_;
    std::vector<Found> found_;
    std::vector<PrismCrossing> sorted_;
    std::vector<std::size_t> first_;  // by wall
};

}  // namespace trisect::detail

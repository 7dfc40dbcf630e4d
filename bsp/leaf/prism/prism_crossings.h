// SPDX-License-Identifier: Apache-2.0
//
// Crossings of the side faces of prisms.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/leaf/prism/prism_facets.h>
#include <trisect/kernel/support/as_index.h>

namespace trisect::detail {

/// How far PrismCrossing::at may be from what it stands for.
inline constexpr double place_error = 0x1p-36;

/// A place on a side face where another one crosses it.
struct PrismCrossing {
    LeafIndex on = 0;         ///< that side face
    LeafIndex side_face = 0;  ///< the other one
    double at = 0;            ///< part of the way from its `from` to its `to`; within place_error
};

/// Crossings are many, up to the square of the number of side faces: what is exact about their
/// places is computed when two of them are so near to each other that doubles cannot decide.
class PrismCrossings {
public:
    /// How many other side faces each one may have beside it, on average. Where they are more,
    /// looking at all of them once takes longer than cells do.
    static constexpr std::size_t most_per_side_face = 2048;

    /// False when side faces touch or overlap without crossing each other, and where too many lie
    /// side by side. `side_faces` must outlive later queries. Time O(n log n + n m) for n side
    /// faces with m others beside each. By several threads where there are many: the same is found
    /// for any number.
    [[nodiscard]] bool find(const LeafProblem& problem, std::span<const PrismSideFace> side_faces,
                            EvaluateStats& stats, std::uint32_t threads = 1);
    /// In their order along the side face.
    [[nodiscard]] std::span<const PrismCrossing> of(LeafIndex side_face) const {
        const std::size_t i = as_index(side_face);
        return std::span(found_).subspan(first_[i], first_[i + 1] - first_[i]);
    }
    /// Whether two side faces cross a third one in the same place.
    [[nodiscard]] bool any_coincide() const;
    /// Exact order of two places on one side face.
    [[nodiscard]] int compare(const PrismCrossing& a, const PrismCrossing& b) const;

private:
    // What a part of the search has found.
    struct Part {
        std::vector<PrismCrossing> found;
        std::uint64_t pairs_boxes = 0;
        std::size_t looked_at = 0;
        bool touches = false;
    };
    void put_in_order(std::uint32_t threads);
    void search(const LeafProblem& problem, const EvaluateStats& before, std::size_t begin,
                std::size_t end, Part& part) const;
    void compare_at(std::size_t i, std::size_t j, Part& part) const;
    [[nodiscard]] bool cross(LeafIndex s, LeafIndex t, std::vector<PrismCrossing>& found) const;

    std::span<const PrismSideFace> side_faces_;
    std::vector<std::pair<Coordinate, LeafIndex>> order_;  // by `from`
    std::vector<double> low_v_;                            // in that order
    std::vector<double> high_v_;
    std::vector<PrismCrossing> found_;  // by side face, and in their order there
    std::vector<std::size_t> first_;    // by side face
};

}  // namespace trisect::detail

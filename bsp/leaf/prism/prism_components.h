// SPDX-License-Identifier: Apache-2.0
//
// Connected components of an operand's caps in one plane.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <trisect/bsp/cells/leaf_problem.h>
#include <trisect/bsp/leaf/prism/prism_facets.h>
#include <trisect/kernel/support/as_index.h>

namespace trisect::detail {

/// Caps of one operand in one plane that have corners in common. The side faces that end at one of
/// its corners bound it. In the result a component is whole, or may not be.
class PrismComponents {
public:
    /// What side faces say of a component: it is not whole; the result is below it, or above it.
    enum Sign : std::uint8_t { Broken = 1, Below = 2, Above = 4 };

    /// False when a side face ends where its operand has no cap. \pre each operand is all facets of
    /// one source.
    [[nodiscard]] bool list(const LeafProblem& problem, const PrismFacets& facets);
    [[nodiscard]] std::size_t size() const { return positions_.size(); }
    [[nodiscard]] std::size_t position(std::int32_t i) const { return positions_[as_index(i)]; }
    /// By several threads at once.
    void note(std::int32_t i, Sign sign) {
        const std::atomic_ref signs(signs_[as_index(i)]);
        if ((signs.load(std::memory_order_relaxed) & sign) == 0)
            signs.fetch_or(sign, std::memory_order_relaxed);
    }
    /// Once all is noted, as is_below().
    [[nodiscard]] bool is_whole(std::int32_t i) const {
        const unsigned signs = signs_[as_index(i)];
        return (signs & Broken) == 0 && signs != (Below | Above);
    }
    /// Whether the result is below a whole component.
    [[nodiscard]] bool is_below(std::int32_t i) const { return (signs_[as_index(i)] & Below) != 0; }
    /// That a side face bounds with its lower end, and with its upper one.
    [[nodiscard]] const std::array<std::int32_t, 2>& of_side_face(LeafIndex side_face) const {
        return of_side_face_[static_cast<std::size_t>(side_face)];
    }
    /// By the number of the cap.
    [[nodiscard]] std::int32_t of_cap(std::size_t cap) const { return of_cap_[cap]; }
    /// A number for the edge along the axis at an end of a side face (0: `from`, 1: `to`): side
    /// faces of one outline have one in common.
    [[nodiscard]] std::uint32_t edge_at(LeafIndex side_face, std::size_t end) const {
        return edges_[static_cast<std::size_t>(side_face)][end];
    }
    /// One more than the greatest such number.
    [[nodiscard]] std::size_t edge_count() const { return root_.size(); }

private:
    [[nodiscard]] std::uint32_t root(std::uint32_t v);
    void join(std::uint32_t v, std::uint32_t w);

    std::vector<std::uint32_t> first_;    // by operand: of its source's points, numbered in a row
    std::vector<std::uint32_t> root_;     // by point
    std::vector<std::int32_t> number_;    // of components, by root
    std::vector<std::size_t> positions_;  // of components
    std::vector<std::uint8_t> signs_;     // that were noted of them
    std::vector<std::array<std::int32_t, 2>> of_side_face_;
    std::vector<std::int32_t> of_cap_;
    std::vector<std::array<std::uint32_t, 2>> edges_;
};

}  // namespace trisect::detail

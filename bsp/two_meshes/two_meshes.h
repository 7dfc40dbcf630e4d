// SPDX-License-Identifier: Apache-2.0
//
// TwoMeshes, CubesOfBoth: two meshes that are compared as wholes, and where they are.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include <trisect/bsp/cells/crossings.h>
#include <trisect/bsp/cells/solid_state.h>
#include <trisect/bsp/divide/reference_points.h>
#include <trisect/bsp/two_meshes/cube_grid.h>
#include <trisect/kernel/support/parallel_parts.h>

namespace trisect::detail {

/// As ParallelParts counts them.
[[nodiscard]] inline std::uint32_t threads_if(bool parallel) { return parallel ? 0 : 1; }

/// Both, at the same time where the search is done by several threads.
template <class First, class Second>
void do_both(bool parallel, const First& first, const Second& second) {
    if (parallel) {
        both_at_once(first, second);
    } else {
        first();
        second();
    }
}

/// Whether far out one is below an imported mesh's facets.
[[nodiscard]] inline bool is_below_far_out(const SolidState& solid,
                                           const Crossings::Operand& operand) {
    const int winding =
        complemented_winding(solid.root().node->winding(), solid.root().complemented);
    return (winding == operand.open) == operand.is_open_below();
}

/// The meshes, and whether they are worth it.
struct TwoMeshes {
    /// Meshes of so many times the facets of the other one cost more as a whole than by their
    /// index.
    static constexpr std::size_t of_a_size = 16;
    /// Fewer facets are looked at in two milliseconds; more are worth an index from the first time
    /// on.
    static constexpr std::size_t soon_compared = std::size_t{1} << 16;

    std::array<const CellNode*, 2> nodes;
    std::array<const LatticeMesh*, 2> meshes{};
    Box common;

    explicit TwoMeshes(const SolidStates& solids)
        : nodes{solids[0]->root().node.get(), solids[1]->root().node.get()} {
        common = source(0).box();
        for (std::size_t i = 0; i < 2; ++i) {
            meshes[i] = &source(i).mesh();
            common = common.intersected(source(i).box());
        }
    }
    [[nodiscard]] const Source& source(std::size_t i) const {
        return *nodes[i]->polygons().whole_source();
    }
    [[nodiscard]] std::size_t larger() const {
        return std::max(nodes[0]->size(), nodes[1]->size());
    }
    [[nodiscard]] std::size_t smaller() const {
        return std::min(nodes[0]->size(), nodes[1]->size());
    }
    [[nodiscard]] bool are_comparable() const {
        return nodes[0]->refinement() == nullptr && nodes[1]->refinement() == nullptr &&
               (are_of_a_size() || (larger() < soon_compared && !larger_node().was_compared()));
    }
    // A mesh that is far larger is looked at as a whole once, if at all. Then it gets an index
    // (evaluator.cpp), by which the next small one is found at once.
    void note_comparison() const {
        if (!are_of_a_size()) larger_node().note_comparison();
    }
    [[nodiscard]] bool are_of_a_size() const { return larger() < of_a_size * smaller(); }
    [[nodiscard]] const CellNode& larger_node() const {
        return nodes[0]->size() < nodes[1]->size() ? *nodes[1] : *nodes[0];
    }
    [[nodiscard]] bool have_outer_references() const {
        return lies_outside(nodes[0]->reference(), source(0).box()) &&
               lies_outside(nodes[1]->reference(), source(1).box());
    }
};

/// Cubes that either mesh occupies, as many as its facets fill at a price. Where facets are long
/// they are larger: of the least number each facet meets few.
struct CubesOfBoth {
    std::optional<CubeGrid> grid;
    std::array<std::optional<OccupiedCubes>, 2> cubes;

    CubesOfBoth(const TwoMeshes& two, bool parallel);
    [[nodiscard]] bool are_useful() const {
        return cubes[0] && cubes[0]->is_useful() && cubes[1]->is_useful();
    }
};

}  // namespace trisect::detail
